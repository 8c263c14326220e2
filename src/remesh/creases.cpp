// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/creases.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/length.h"
#include "base/vectors.h"
#include "remesh/edge_mesh.h"

namespace geomend::remeshing {

namespace {

/// Whether the edge of a corner is sharp: the angle across it is large, and neither side is so narrow that this is noise.
bool is_sharp(const BrepData& brep, const BrepData::Surface& surface, std::uint32_t h, std::uint32_t back, const CreaseRules& rules) {
    const auto place = [&](std::uint32_t corner) { return brep.vertices[surface.nodes[surface.polygons.corners[corner]].value]; };
    const Vec3 a = place(h), b = place(next_of(h)), c = place(previous_of(h)), d = place(previous_of(back));
    const Vec3 m = cross(minus(b, a), minus(c, a)), n = cross(minus(a, b), minus(d, b));
    const double m_length = length(m), n_length = length(n);
    if (!(m_length > 0) || !(n_length > 0) || dot(m, n) > std::cos(rules.angle) * m_length * n_length) return false;
    return std::abs(dot(m, minus(d, a))) >= rules.height * m_length && std::abs(dot(n, minus(c, a))) >= rules.height * n_length;
}

/// The half-edge that runs back across an edge, or no_index.
std::uint32_t twin_of(const BrepData::Surface& surface, std::uint32_t h) {
    const std::uint32_t t = surface.neighbours[h];
    if (t == no_index) return no_index;
    const auto& corners = surface.polygons.corners;
    for (std::uint32_t g = 3 * t; g < 3 * t + 3; ++g) {
        if (surface.neighbours[g] == h / 3 && corners[g] == corners[next_of(h)] && corners[next_of(g)] == corners[h]) return g;
    }
    return no_index;
}

/// Sharp edges of a surface while they are put together to chains.
class Chains {
public:
    explicit Chains(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges) {
        for (const auto& [a, b] : edges) {
            at_[a].push_back({b, static_cast<std::uint32_t>(used_.size())});
            at_[b].push_back({a, static_cast<std::uint32_t>(used_.size())});
            used_.push_back(0);
        }
    }
    /// \param ends whether a chain ends at a vertex, though it goes on there
    std::vector<std::vector<std::uint32_t>> take(const std::vector<std::uint8_t>& ends) {
        std::vector<std::vector<std::uint32_t>> chains;
        const auto is_end = [&](std::uint32_t v) { return at_[v].size() != 2 || ends[v] != 0; };
        for (const bool closed : {false, true}) {
            for (const auto& [v, edges] : at_) {
                if (!closed && !is_end(v)) continue;
                for (const auto& [to, edge] : edges) {
                    if (used_[edge] == 0) chains.push_back(follow(v, to, edge, is_end));
                }
            }
        }
        return chains;
    }

private:
    template <class IsEnd>
    std::vector<std::uint32_t> follow(std::uint32_t from, std::uint32_t to, std::uint32_t edge, const IsEnd& is_end) {
        std::vector<std::uint32_t> chain{from, to};
        used_[edge] = 1;
        while (!is_end(chain.back()) && chain.back() != from) {
            const auto& on = at_[chain.back()];
            const auto& next = used_[on[0].second] == 0 ? on[0] : on[1];
            if (used_[next.second] != 0) break;
            used_[next.second] = 1;
            chain.push_back(next.first);
        }
        return chain;
    }
    std::map<std::uint32_t, std::vector<std::pair<std::uint32_t, std::uint32_t>>> at_;  // vertex -> other ends and edges
    std::vector<std::uint8_t> used_;
};

class Cutter {
public:
    Cutter(BrepData& brep, const CreaseRules& rules) : brep_(brep), rules_(rules), ends_(brep.vertices.size(), 0) {
        for (std::uint32_t c = 0; c < brep.corners.size(); ++c) corner_at_.emplace(brep.corners[c].vertex.value, c);
        for (const auto& line : brep.lines) {
            for (const VertexId v : line.vertices) ends_[v.value] = 1;
        }
        for (const auto& corner : brep.corners) ends_[corner.vertex.value] = 1;
    }

    void cut(BrepData::Surface& surface) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>> sharp;  // vertices -> half-edges
        for (std::uint32_t h = 0; h < surface.polygons.corners.size(); ++h) {
            const std::uint32_t back = twin_of(surface, h);
            if (back == no_index || back < h || !is_sharp(brep_, surface, h, back, rules_)) continue;
            const auto vertex = [&](std::uint32_t g) { return surface.nodes[surface.polygons.corners[g]].value; };
            const std::uint32_t a = vertex(h), b = vertex(back);
            sharp.emplace(std::pair(std::min(a, b), std::max(a, b)), std::pair(h, back));
        }
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (const auto& [ends, halves] : sharp) edges.push_back(ends);
        for (const auto& chain : Chains(edges).take(ends_)) {
            if (length_of_chain(chain) < rules_.length) continue;
            for (std::size_t i = 1; i < chain.size(); ++i) {
                const auto [low, high] = std::minmax(chain[i - 1], chain[i]);
                const auto& [h, back] = sharp.at({low, high});
                surface.neighbours[h] = surface.neighbours[back] = no_index;
            }
            add_line(surface, chain);
        }
    }

private:
    double length_of_chain(const std::vector<std::uint32_t>& chain) const {
        double sum = 0;
        for (std::size_t i = 1; i < chain.size(); ++i) sum += length(minus(brep_.vertices[chain[i]], brep_.vertices[chain[i - 1]]));
        return sum;
    }
    CornerId corner_at(std::uint32_t vertex) {
        const auto [at, is_new] = corner_at_.emplace(vertex, static_cast<std::uint32_t>(brep_.corners.size()));
        if (is_new) brep_.corners.push_back({{}, VertexId(vertex)});
        return CornerId(at->second);
    }
    void add_line(BrepData::Surface& surface, const std::vector<std::uint32_t>& chain) {
        BrepData::Line line;
        for (const std::uint32_t v : chain) line.vertices.push_back(VertexId(v));
        line.corners = {corner_at(chain.front()), corner_at(chain.back())};
        surface.lines.push_back({LineId(brep_.lines.size()), true});
        brep_.lines.push_back(std::move(line));
    }

    BrepData& brep_;
    const CreaseRules& rules_;
    std::vector<std::uint8_t> ends_;
    std::map<std::uint32_t, std::uint32_t> corner_at_;
};

}  // namespace

BrepData cut_at_creases(const BrepData& brep, const CreaseRules& rules) {
    BrepData made = brep;
    Cutter cutter(made, rules);
    for (auto& surface : made.surfaces) {
        if (surface.polygons.all_triangles()) cutter.cut(surface);
    }
    return made;
}

}  // namespace geomend::remeshing
