// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/line_graph.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/parallel.h"

namespace geomend::topology {

namespace {

EdgeUse use_of(const BrepData::Surface& surface, const PolygonEdges& edges, std::uint32_t surface_index, std::uint32_t corner,
               EdgeUse::Kind kind) {
    const std::uint32_t from = surface.nodes[edges.start_node(corner)].value, to = surface.nodes[edges.end_node(corner)].value;
    return {std::min(from, to), std::max(from, to), surface_index, corner, static_cast<std::int8_t>(from < to ? 1 : -1), kind};
}

/// Vertices where an edge may lie on a line: used by several surfaces, or on the border of one.
std::vector<std::uint8_t> candidate_vertices(const BrepData& brep, std::span<const FaceEdges> faces,
                                             std::span<const PolygonEdges> all_edges) {
    constexpr std::uint32_t several = no_index - 1;
    std::vector<std::uint32_t> user(brep.vertices.size(), no_index);
    std::vector<std::uint8_t> candidate(brep.vertices.size(), 0);
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const VertexId v : brep.surfaces[s].nodes) {
            std::uint32_t& first = user[v.value];
            if (first == no_index) {
                first = s;
            } else if (first != s && first != several) {
                first = several;
                candidate[v.value] = 1;
            }
        }
    }
    for (std::size_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        const PolygonEdges& edges = all_edges[s];
        for (const std::uint32_t corner : faces[s].border) {
            candidate[surface.nodes[edges.start_node(corner)].value] = 1;
            candidate[surface.nodes[edges.end_node(corner)].value] = 1;
        }
    }
    return candidate;
}

std::vector<EdgeUse> collect_uses(const BrepData& brep, std::span<const FaceEdges> faces, std::span<const PolygonEdges> all_edges,
                                  const StatedLines& stated) {
    auto candidate = candidate_vertices(brep, faces, all_edges);
    for (const auto& edge : stated.edges) candidate[edge.from] = candidate[edge.to] = 1;
    std::vector<std::vector<EdgeUse>> per_surface(brep.surfaces.size());
    parallel_for_each_index(brep.surfaces.size(), [&](std::size_t s) {
        const auto& surface = brep.surfaces[s];
        const PolygonEdges& edges = all_edges[s];
        auto& uses = per_surface[s];
        const auto index = static_cast<std::uint32_t>(s);
        for (const std::uint32_t corner : faces[s].border) uses.push_back(use_of(surface, edges, index, corner, EdgeUse::border));
        for (std::uint32_t corner = 0; corner < surface.polygons.corners.size(); ++corner) {
            if (surface.neighbours[corner] == no_index) continue;
            if (candidate[surface.nodes[edges.start_node(corner)].value] == 0) continue;
            if (candidate[surface.nodes[edges.end_node(corner)].value] == 0) continue;
            uses.push_back(use_of(surface, edges, index, corner, EdgeUse::inside));
        }
        std::erase_if(uses, [](const EdgeUse& use) { return use.low == use.high; });  // no length after welding
    });
    std::size_t total = stated.edges.size();
    for (const auto& uses : per_surface) total += uses.size();
    std::vector<EdgeUse> all;
    all.reserve(total);
    for (const auto& uses : per_surface) all.insert(all.end(), uses.begin(), uses.end());
    for (const auto& edge : stated.edges) {
        if (edge.from == edge.to) continue;
        all.push_back({std::min(edge.from, edge.to), std::max(edge.from, edge.to), no_index, edge.line,
                       static_cast<std::int8_t>(edge.from < edge.to ? 1 : -1), EdgeUse::stated});
    }
    std::sort(all.begin(), all.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.surface, a.corner) < std::tie(b.low, b.high, b.surface, b.corner);
    });
    return all;
}

/// The model vertices of the polygon behind a use, sorted: to tell whether polygons of two surfaces coincide.
std::vector<std::uint32_t> polygon_vertices(const BrepData& brep, std::span<const PolygonEdges> all_edges, const EdgeUse& use) {
    const auto& surface = brep.surfaces[use.surface];
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t node : surface.polygons[all_edges[use.surface].polygon(use.corner)]) {
        vertices.push_back(surface.nodes[node].value);
    }
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

/// An edge inside several surfaces is a line where they cross or part, not where they only coincide.
bool more_than_two_polygons(const BrepData& brep, std::span<const PolygonEdges> all_edges, std::span<const EdgeUse> uses) {
    std::vector<std::vector<std::uint32_t>> distinct;
    for (const EdgeUse& use : uses) {
        auto vertices = polygon_vertices(brep, all_edges, use);
        if (std::find(distinct.begin(), distinct.end(), vertices) != distinct.end()) continue;
        distinct.push_back(std::move(vertices));
        if (distinct.size() > 2) return true;
    }
    return false;
}

bool is_line_edge(const BrepData& brep, std::span<const PolygonEdges> all_edges, std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses) {
        if (use.kind != EdgeUse::inside) return true;
    }
    return uses.size() > 2 && more_than_two_polygons(brep, all_edges, uses);
}

void keep_line_edges(const BrepData& brep, std::span<const PolygonEdges> all_edges, LineGraph& graph) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < graph.uses.size();) {
        std::size_t j = i + 1;
        while (j < graph.uses.size() && graph.uses[j].low == graph.uses[i].low && graph.uses[j].high == graph.uses[i].high) ++j;
        if (is_line_edge(brep, all_edges, std::span(graph.uses).subspan(i, j - i))) {
            graph.edges.push_back({static_cast<std::uint32_t>(kept), static_cast<std::uint32_t>(kept + j - i), no_index, 0});
            for (; i < j; ++i) graph.uses[kept++] = graph.uses[i];
        }
        i = j;
    }
    graph.uses.resize(kept);
}

/// The uses that decide what a line is: borders and stated lines; for edges without either, or where no surface
/// can state a cut, all.
class Signature {
public:
    Signature(std::span<const EdgeUse> uses, bool shared_nodes) : uses_(uses) {
        for (const EdgeUse& use : uses) count_all_ &= use.kind == EdgeUse::inside;
        count_all_ |= shared_nodes;
        skip();
    }
    bool at_end() const { return at_ == uses_.size(); }
    const EdgeUse& operator*() const { return uses_[at_]; }
    void operator++() {
        ++at_;
        skip();
    }

private:
    void skip() {
        while (!count_all_ && at_ < uses_.size() && uses_[at_].kind == EdgeUse::inside) ++at_;
    }
    std::span<const EdgeUse> uses_;
    std::size_t at_ = 0;
    bool count_all_ = true;
};

bool same_signature(std::span<const EdgeUse> a, std::span<const EdgeUse> b, bool shared_nodes) {
    Signature x(a, shared_nodes), y(b, shared_nodes);
    for (; !x.at_end() && !y.at_end(); ++x, ++y) {
        if ((*x).surface != (*y).surface) return false;
        if ((*x).kind == EdgeUse::stated && (*x).corner != (*y).corner) return false;
    }
    return x.at_end() && y.at_end();
}

bool borders(std::span<const EdgeUse> uses, std::uint32_t surface, bool shared_nodes) {
    for (Signature s(uses, shared_nodes); !s.at_end(); ++s) {
        if ((*s).surface == surface) return true;
    }
    return false;
}

/// Vertices on lines with their line edges, and which of them are corners.
struct LineVertices {
    std::vector<std::uint32_t> local;  // model vertex -> index below, or no_index
    std::vector<std::uint32_t> vertex;
    std::vector<std::uint32_t> first, edges;
    std::vector<std::uint8_t> corner;

    LineVertices(const BrepData& brep, const LineGraph& graph) {
        local.assign(brep.vertices.size(), no_index);
        std::vector<std::uint8_t> on_line(brep.vertices.size(), 0);
        for (const auto& edge : graph.edges) {
            on_line[graph.uses[edge.first_use].low] = 1;
            on_line[graph.uses[edge.first_use].high] = 1;
        }
        for (std::uint32_t v = 0; v < on_line.size(); ++v) {
            if (on_line[v] == 0) continue;
            local[v] = static_cast<std::uint32_t>(vertex.size());
            vertex.push_back(v);
        }
        first.assign(vertex.size() + 1, 0);
        for (const auto& edge : graph.edges) {
            ++first[local[graph.uses[edge.first_use].low] + 1];
            ++first[local[graph.uses[edge.first_use].high] + 1];
        }
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        edges.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
            const EdgeUse& use = graph.uses[graph.edges[e].first_use];
            edges[next[local[use.low]]++] = e;
            edges[next[local[use.high]]++] = e;
        }
        corner.assign(vertex.size(), 0);
    }
    std::span<const std::uint32_t> edges_at(std::uint32_t i) const { return std::span(edges).subspan(first[i], first[i + 1] - first[i]); }
};

/// A surface that is present at a line vertex without bordering the line touches it there: a corner.
void mark_touched(const BrepData& brep, const LineGraph& graph, bool shared_nodes, LineVertices& at) {
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        std::vector<std::uint8_t> used(surface.nodes.size(), 0);
        for (const std::uint32_t node : surface.polygons.corners) used[node] = 1;
        for (std::size_t n = 0; n < surface.nodes.size(); ++n) {
            const std::uint32_t i = at.local[surface.nodes[n].value];
            if (i == no_index || at.corner[i] != 0 || used[n] == 0) continue;
            if (!borders(graph.edge_uses(graph.edges[at.edges_at(i)[0]]), s, shared_nodes)) at.corner[i] = 1;
        }
    }
}

void mark_corners(const BrepData& brep, const LineGraph& graph, const StatedLines& stated, LineVertices& at) {
    for (std::uint32_t i = 0; i < at.vertex.size(); ++i) {
        const auto around = at.edges_at(i);
        const bool through = around.size() == 2 && same_signature(graph.edge_uses(graph.edges[around[0]]),
                                                                  graph.edge_uses(graph.edges[around[1]]), stated.shared_nodes);
        if (!through) at.corner[i] = 1;
    }
    for (const std::uint32_t v : stated.corners) {
        if (at.local[v] != no_index) at.corner[at.local[v]] = 1;
    }
    mark_touched(brep, graph, stated.shared_nodes, at);
}

/// Walks from a corner (or any vertex of a closed line) along edges that are not taken yet.
class LineWalker {
public:
    LineWalker(LineGraph& graph, const LineVertices& at) : graph_(graph), at_(at), taken_(graph.edges.size(), 0) {}

    bool taken(std::uint32_t edge) const { return taken_[edge] != 0; }

    /// Vertices (as indices into LineVertices) from `start` over `edge` to the next corner or back to start.
    std::vector<std::uint32_t> walk(std::uint32_t start, std::uint32_t edge, std::vector<std::uint32_t>& path) {
        std::vector<std::uint32_t> chain{start};
        path.clear();
        std::uint32_t here = start;
        while (true) {
            taken_[edge] = 1;
            path.push_back(edge);
            const EdgeUse& use = graph_.uses[graph_.edges[edge].first_use];
            const std::uint32_t low = at_.local[use.low], high = at_.local[use.high];
            here = here == low ? high : low;
            chain.push_back(here);
            if (at_.corner[here] != 0 || here == start) return chain;
            const auto around = at_.edges_at(here);
            edge = around[0] == edge ? around[1] : around[0];
        }
    }

private:
    LineGraph& graph_;
    const LineVertices& at_;
    std::vector<std::uint8_t> taken_;
};

struct Chain {
    std::vector<std::uint32_t> vertices;  // indices into LineVertices
    std::vector<std::uint32_t> edges;
};

/// Closed lines get a corner where the file states one, else at their lowest vertex.
void choose_closed_corners(const LineGraph& graph, const StatedLines& stated, LineVertices& at) {
    std::vector<std::uint8_t> hinted(at.vertex.size(), 0), seen(graph.edges.size(), 0);
    for (const std::uint32_t v : stated.corner_hints) {
        if (at.local[v] != no_index) hinted[at.local[v]] = 1;
    }
    const auto follow = [&](std::uint32_t start, std::uint32_t edge, auto&& visit) {
        std::uint32_t here = start;
        while (seen[edge] == 0) {
            seen[edge] = 1;
            const EdgeUse& use = graph.uses[graph.edges[edge].first_use];
            here = here == at.local[use.low] ? at.local[use.high] : at.local[use.low];
            if (at.corner[here] != 0) return;
            visit(here);
            const auto around = at.edges_at(here);
            edge = around[0] == edge ? around[1] : around[0];
        }
    };
    for (std::uint32_t i = 0; i < at.vertex.size(); ++i) {
        if (at.corner[i] == 0) continue;
        for (const std::uint32_t edge : at.edges_at(i)) follow(i, edge, [](std::uint32_t) {});
    }
    for (std::uint32_t i = 0; i < at.vertex.size(); ++i) {
        if (at.corner[i] != 0 || seen[at.edges_at(i)[0]] != 0) continue;
        std::uint32_t best = i;
        follow(i, at.edges_at(i)[0], [&](std::uint32_t j) {
            if (hinted[j] > hinted[best] || (hinted[j] == hinted[best] && j < best)) best = j;
        });
        at.corner[best] = 1;
    }
}

std::vector<Chain> collect_chains(LineGraph& graph, const LineVertices& at) {
    LineWalker walker(graph, at);
    std::vector<Chain> chains;
    for (std::uint32_t i = 0; i < at.vertex.size(); ++i) {
        if (at.corner[i] == 0) continue;
        for (const std::uint32_t edge : at.edges_at(i)) {
            if (walker.taken(edge)) continue;
            Chain chain;
            chain.vertices = walker.walk(i, edge, chain.edges);
            chains.push_back(std::move(chain));
        }
    }
    const auto lowest = [](const Chain& c) { return *std::min_element(c.edges.begin(), c.edges.end()); };
    std::sort(chains.begin(), chains.end(), [&](const Chain& a, const Chain& b) { return lowest(a) < lowest(b); });
    return chains;
}

void make_corners(BrepData& brep, const StatedLines& stated, const LineVertices& at, std::vector<std::uint32_t>& corner_of) {
    std::vector<std::uint32_t> vertices;
    for (std::size_t i = 0; i < at.vertex.size(); ++i) {
        if (at.corner[i] != 0) vertices.push_back(at.vertex[i]);
    }
    vertices.insert(vertices.end(), stated.corners.begin(), stated.corners.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    corner_of.assign(at.vertex.size(), no_index);
    for (const std::uint32_t v : vertices) {
        if (at.local[v] != no_index) corner_of[at.local[v]] = static_cast<std::uint32_t>(brep.corners.size());
        brep.corners.push_back({{}, VertexId(v)});
    }
}

void make_lines(BrepData& brep, LineGraph& graph, const LineVertices& at, const std::vector<std::uint32_t>& corner_of) {
    graph.line_first_edge.push_back(0);
    for (const Chain& chain : collect_chains(graph, at)) {
        BrepData::Line line;
        const auto number = static_cast<std::uint32_t>(brep.lines.size());
        for (const std::uint32_t i : chain.vertices) line.vertices.emplace_back(at.vertex[i]);
        line.corners = {CornerId(corner_of[chain.vertices.front()]), CornerId(corner_of[chain.vertices.back()])};
        std::uint32_t stated_line = no_index;
        for (std::size_t k = 0; k < chain.edges.size(); ++k) {
            auto& edge = graph.edges[chain.edges[k]];
            edge.line = number;
            edge.direction = chain.vertices[k] < chain.vertices[k + 1] ? 1 : -1;
            const auto& last = graph.uses[edge.last_use - 1];  // stated lines sort last
            if (last.kind == EdgeUse::stated) stated_line = last.corner;
        }
        graph.stated_line.push_back(stated_line);
        graph.line_edges.insert(graph.line_edges.end(), chain.edges.begin(), chain.edges.end());
        graph.line_first_edge.push_back(static_cast<std::uint32_t>(graph.line_edges.size()));
        brep.lines.push_back(std::move(line));
    }
}

void attach_surfaces(BrepData& brep, LineGraph& graph) {
    graph.nets.resize(brep.surfaces.size());
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        const auto edges =
            std::span(graph.line_edges).subspan(graph.line_first_edge[l], graph.line_first_edge[l + 1] - graph.line_first_edge[l]);
        const auto representative = graph.edge_uses(graph.edges[edges[0]]);
        for (std::size_t i = 0; i < representative.size();) {
            std::size_t j = i + 1;
            while (j < representative.size() && representative[j].surface == representative[i].surface) ++j;
            const std::uint32_t s = representative[i].surface;
            if (s != no_index) {
                brep.surfaces[s].lines.insert(brep.surfaces[s].lines.end(), j - i, {LineId(l), j - i > 1});
            }
            i = j;
        }
        std::map<std::uint32_t, std::int64_t> net;
        for (const std::uint32_t e : edges) {
            const auto& edge = graph.edges[e];
            for (const EdgeUse& use : graph.edge_uses(edge)) {
                if (use.surface == no_index) continue;
                net[use.surface] += use.direction * edge.direction;
                brep.surfaces[use.surface].neighbours[use.corner] = no_index;
            }
        }
        for (const auto& [surface, sum] : net) graph.nets[surface].push_back({l, sum});
    }
}

}  // namespace

LineGraph build_lines(BrepData& brep, std::span<const FaceEdges> faces, const StatedLines& stated) {
    LineGraph graph;
    std::vector<PolygonEdges> all_edges;
    all_edges.reserve(brep.surfaces.size());
    for (const auto& surface : brep.surfaces) all_edges.emplace_back(surface.polygons);
    graph.uses = collect_uses(brep, faces, all_edges, stated);
    keep_line_edges(brep, all_edges, graph);
    LineVertices at(brep, graph);
    mark_corners(brep, graph, stated, at);
    choose_closed_corners(graph, stated, at);
    std::vector<std::uint32_t> corner_of;
    make_corners(brep, stated, at, corner_of);
    make_lines(brep, graph, at, corner_of);
    attach_surfaces(brep, graph);
    return graph;
}

}  // namespace geomend::topology
