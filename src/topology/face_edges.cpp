// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/face_edges.h"

#include <algorithm>
#include <map>
#include <span>

#include "geometry/vectors.h"

namespace geomend::topology {

PolygonEdges::PolygonEdges(const Polygons& polygons) : polygons_(&polygons) {
    if (polygons.all_triangles()) return;
    polygon_of_.resize(polygons.corners.size());
    for (std::size_t p = 0; p < polygons.size(); ++p) {
        std::fill(polygon_of_.begin() + static_cast<std::ptrdiff_t>(polygons.offsets[p]),
                  polygon_of_.begin() + static_cast<std::ptrdiff_t>(polygons.offsets[p + 1]), static_cast<std::uint32_t>(p));
    }
}

namespace {

/// One use of an edge, filed under its lower node.
struct Use {
    std::uint32_t other;   // the higher node
    std::uint32_t corner;  // where it starts
};

bool is_degenerate(std::span<const std::uint32_t> polygon) {
    if (polygon.size() < 3) return true;
    if (polygon.size() == 3) return polygon[0] == polygon[1] || polygon[1] == polygon[2] || polygon[2] == polygon[0];
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        if (polygon[i] == polygon[(i + 1) % polygon.size()]) return true;
    }
    return false;
}

bool same_nodes(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    return a.size() == b.size() && std::is_permutation(a.begin(), a.end(), b.begin());
}

/// Calls with the lower node and the use of each edge, polygon by polygon.
template <class Body>
void for_each_use(const Polygons& polygons, const std::vector<std::uint8_t>& skip, const Body& body) {
    std::size_t corner = 0;
    for (std::size_t p = 0; p < polygons.size(); ++p) {
        const auto polygon = polygons[p];
        const std::size_t n = polygon.size();
        if (skip.empty() || skip[p] == 0) {
            for (std::size_t i = 0; i < n; ++i) {
                const std::uint32_t a = polygon[i], b = polygon[i + 1 == n ? 0 : i + 1];
                body(std::min(a, b), Use{std::max(a, b), static_cast<std::uint32_t>(corner + i)});
            }
        }
        corner += n;
    }
}

/// By their higher node, then by corner. They come with ascending corners, mostly a handful: insertion keeps equal ones in order.
void sort_uses(std::span<Use> uses) {
    if (uses.size() > 32) {
        std::stable_sort(uses.begin(), uses.end(), [](const Use& x, const Use& y) { return x.other < y.other; });
        return;
    }
    for (std::size_t i = 1; i < uses.size(); ++i) {
        const Use use = uses[i];
        std::size_t k = i;
        for (; k > 0 && uses[k - 1].other > use.other; --k) uses[k] = uses[k - 1];
        uses[k] = use;
    }
}

/// Uses of all edges, grouped by their lower node and sorted by the higher one inside each group.
struct EdgeTable {
    std::vector<std::uint32_t> first;  // per node, into uses
    std::vector<Use> uses;

    EdgeTable(const BrepData::Surface& surface, const std::vector<std::uint8_t>& skip) {
        first.assign(surface.nodes.size() + 1, 0);
        for_each_use(surface.polygons, skip, [&](std::uint32_t low, const Use&) { ++first[low + 1]; });
        for (std::size_t n = 1; n < first.size(); ++n) first[n] += first[n - 1];
        uses.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for_each_use(surface.polygons, skip, [&](std::uint32_t low, const Use& use) { uses[next[low]++] = use; });
        for (std::size_t n = 0; n + 1 < first.size(); ++n) sort_uses(std::span(uses).subspan(first[n], first[n + 1] - first[n]));
    }

    template <class Body>
    void for_each_edge(const Body& body) const {
        for (std::size_t n = 0; n + 1 < first.size(); ++n) {
            for (std::size_t i = first[n]; i < first[n + 1];) {
                std::size_t j = i + 1;
                while (j < first[n + 1] && uses[j].other == uses[i].other) ++j;
                body(std::span<const Use>(uses).subspan(i, j - i));
                i = j;
            }
        }
    }
};

/// Polygons that repeat an earlier one share all its edges, hence are found around any edge.
std::vector<std::uint32_t> repeats(const BrepData::Surface& surface, const PolygonEdges& edges, const EdgeTable& table) {
    std::vector<std::uint32_t> found;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> candidates;  // sum of the nodes, polygon
    table.for_each_edge([&](std::span<const Use> around) {
        if (around.size() < 2) return;
        candidates.clear();
        for (const Use& use : around) {
            const std::uint32_t p = edges.polygon(use.corner);
            std::uint64_t sum = 0;
            for (const std::uint32_t node : surface.polygons[p]) sum += node;
            candidates.emplace_back(sum, p);
        }
        if (around.size() == 2 && candidates[0].first != candidates[1].first) return;
        std::sort(candidates.begin(), candidates.end());
        std::size_t kept = 0;  // the first of its kind
        for (std::size_t i = 1; i < candidates.size(); ++i) {
            const std::uint32_t p = candidates[kept].second, q = candidates[i].second;
            const bool repeat =
                p != q && candidates[kept].first == candidates[i].first && same_nodes(surface.polygons[p], surface.polygons[q]);
            if (repeat) {
                found.push_back(q);
            } else {
                kept = i;
            }
        }
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

/// Of polygons with the same nodes the one stays that is wound as its neighbours want it, whichever comes first in the file.
void keep_well_wound(const BrepData::Surface& surface, const PolygonEdges& edges, const EdgeTable& table,
                     std::vector<std::uint32_t>& repeats) {
    const auto sorted_nodes = [&](std::uint32_t p) {
        std::vector<std::uint32_t> nodes(surface.polygons[p].begin(), surface.polygons[p].end());
        std::ranges::sort(nodes);
        return nodes;
    };
    struct Alike {
        std::map<std::uint32_t, int> fits;  // per polygon how many neighbours run against it, less those that run with it
    };
    std::map<std::vector<std::uint32_t>, Alike> groups;
    for (const std::uint32_t p : repeats) groups[sorted_nodes(p)];
    const auto group_of = [&](std::uint32_t p) {
        const auto found = groups.find(sorted_nodes(p));
        return found == groups.end() ? nullptr : &found->second;
    };
    table.for_each_edge([&](std::span<const Use> around) {
        if (around.size() < 2) return;
        for (const Use& use : around) {
            const std::uint32_t p = edges.polygon(use.corner);
            Alike* alike = group_of(p);
            if (alike == nullptr) continue;
            int& fit = alike->fits[p];
            for (const Use& other : around) {
                if (group_of(edges.polygon(other.corner)) == alike) continue;
                fit += edges.start_node(other.corner) == edges.start_node(use.corner) ? -1 : 1;
            }
        }
    });
    repeats.clear();
    for (const auto& [nodes, alike] : groups) {
        const auto best = std::ranges::max_element(alike.fits, {}, [](const auto& fit) { return fit.second; });  // the first of equal ones
        for (const auto& [p, fit] : alike.fits) {
            if (p != best->first) repeats.push_back(p);
        }
    }
    std::ranges::sort(repeats);
}

}  // namespace

VertexId far_vertex(const BrepData& brep, const BrepData::Surface& surface, std::uint32_t polygon, const Vec3& a, const Vec3& b) {
    VertexId best;
    double largest = -1;
    for (const std::uint32_t node : surface.polygons[polygon]) {
        const VertexId vertex = surface.nodes[node];
        const Vec3 c = cross(minus(b, a), minus(brep.vertices[vertex.value], a));
        if (dot(c, c) <= largest) continue;
        largest = dot(c, c);
        best = vertex;
    }
    return best;
}

FaceEdges connect_polygons(BrepData::Surface& surface) {
    FaceEdges result;
    const PolygonEdges edges(surface.polygons);
    surface.neighbours.assign(surface.polygons.corners.size(), no_index);
    std::vector<std::uint8_t> skip;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        if (!is_degenerate(surface.polygons[p])) continue;
        result.degenerate.push_back(static_cast<std::uint32_t>(p));
        skip.resize(surface.polygons.size());
        skip[p] = 1;
    }
    EdgeTable table(surface, skip);
    result.duplicate = repeats(surface, edges, table);
    if (!result.duplicate.empty()) {
        keep_well_wound(surface, edges, table, result.duplicate);
        skip.resize(surface.polygons.size());
        for (const std::uint32_t p : result.duplicate) skip[p] = 1;
        table = EdgeTable(surface, skip);
    }
    table.for_each_edge([&](std::span<const Use> around) {
        if (around.size() != 2) {
            for (const Use& use : around) result.border.push_back(use.corner);
            return;
        }
        const std::uint32_t p = edges.polygon(around[0].corner), q = edges.polygon(around[1].corner);
        if (p == q) return;  // the polygon meets itself there, as around a hole
        surface.neighbours[around[0].corner] = q;
        surface.neighbours[around[1].corner] = p;
    });
    return result;
}

}  // namespace geomend::topology
