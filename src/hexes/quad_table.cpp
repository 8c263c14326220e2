// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/quad_table.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/parallel.h"
#include "base/vectors.h"

namespace geomend::hexes {

namespace {

/// A facet at an edge from a vertex to a higher one.
struct EdgeFacet {
    std::uint32_t other, beyond, wall;
    auto operator<=>(const EdgeFacet&) const = default;
};

/// Facets, each once, at the lower ends of their edges.
struct EdgeFacets {
    std::vector<std::uint64_t> offsets;
    std::vector<EdgeFacet> facets;
};

template <class Visit>
void each_edge_facet(const TetMesh& m, const Visit& visit) {
    for (std::uint32_t f = 0; f < 4 * m.tets.size(); ++f) {
        const std::uint32_t other = m.across[f / 4][f % 4];
        if (other != no_index && other < f) continue;
        const auto c = m.facet(f);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = c[k], b = c[(k + 1) % 3];
            visit(std::min(a, b), EdgeFacet{std::max(a, b), c[(k + 2) % 3], m.wall[f / 4][f % 4]});
        }
    }
}

EdgeFacets edge_facets_of(const TetMesh& m) {
    EdgeFacets e;
    e.offsets.assign(m.positions.size() + 1, 0);
    each_edge_facet(m, [&](std::uint32_t v, const EdgeFacet&) { ++e.offsets[v + 1]; });
    std::partial_sum(e.offsets.begin(), e.offsets.end(), e.offsets.begin());
    e.facets.resize(e.offsets.back());
    std::vector<std::uint64_t> next(e.offsets.begin(), e.offsets.end() - 1);
    each_edge_facet(m, [&](std::uint32_t v, const EdgeFacet& facet) { e.facets[next[v]++] = facet; });
    parallel_for_each_index(m.positions.size(), [&](std::size_t v) {
        std::sort(e.facets.begin() + static_cast<std::ptrdiff_t>(e.offsets[v]),
                  e.facets.begin() + static_cast<std::ptrdiff_t>(e.offsets[v + 1]));
    });
    return e;
}

/// Whether the corners of a quadrangle all turn the way the whole does, with sines no less than the least.
bool is_convex(const std::array<Vec3, 4>& p, double least_sine) {
    std::array<Vec3, 4> side{}, normal{};
    std::array<double, 4> squared{};
    for (std::size_t k = 0; k < 4; ++k) {
        side[k] = minus(p[(k + 1) % 4], p[k]);
        squared[k] = dot(side[k], side[k]);
    }
    const Vec3 whole = cross(minus(p[2], p[0]), minus(p[3], p[1]));
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t before = (k + 3) % 4;
        normal[k] = cross(side[before], side[k]);
        if (dot(normal[k], normal[k]) < least_sine * least_sine * squared[before] * squared[k]) return false;
        if (!(dot(normal[k], whole) > 0)) return false;
    }
    return true;
}

struct FoundQuad {
    std::array<std::uint32_t, 4> v;  ///< in cyclic order
};

/// The quadrangles whose diagonals begin at a vertex and end at a higher one.
void quads_at(const TetMesh& m, const EdgeFacets& e, std::uint32_t a, double least_sine, std::vector<FoundQuad>& found) {
    const std::uint64_t end = e.offsets[a + 1];
    for (std::uint64_t first = e.offsets[a], last = first; first < end; first = last) {
        for (last = first; last < end && e.facets[last].other == e.facets[first].other;) ++last;
        const std::uint32_t c = e.facets[first].other;
        for (std::uint64_t i = first; i < last; ++i) {
            for (std::uint64_t k = i + 1; k < last; ++k) {
                const EdgeFacet &one = e.facets[i], &two = e.facets[k];
                if (!may_be_quad(m, a, c, one.wall, two.wall)) continue;
                if (is_convex({m.positions[a], m.positions[one.beyond], m.positions[c], m.positions[two.beyond]}, least_sine))
                    found.push_back({{a, one.beyond, c, two.beyond}});
            }
        }
    }
}

}  // namespace

bool may_be_quad(const TetMesh& mesh, std::uint32_t a, std::uint32_t c, std::uint32_t first, std::uint32_t second) {
    if (first != second || first == TetMesh::held_wall || mesh.lines.has(a, c)) return false;
    return first != TetMesh::no_wall || !mesh.wall_edges.has(a, c);
}

QuadTable::QuadTable(const TetMesh& m, double least_sine) {
    const EdgeFacets e = edge_facets_of(m);
    constexpr std::size_t grain = 1024;
    std::vector<std::vector<FoundQuad>> parts((m.positions.size() + grain - 1) / grain);
    parallel_for_each_index(parts.size(), [&](std::size_t part) {
        for (std::size_t v = part * grain; v < std::min((part + 1) * grain, m.positions.size()); ++v)
            quads_at(m, e, static_cast<std::uint32_t>(v), least_sine, parts[part]);
    });
    offsets_.assign(m.positions.size() + 1, 0);
    for (const auto& part : parts) {
        for (const FoundQuad& quad : part) {
            for (const std::uint32_t v : quad.v) ++offsets_[v + 1];
        }
    }
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    corners_.resize(offsets_.back());
    std::vector<std::uint64_t> next(offsets_.begin(), offsets_.end() - 1);
    for (const auto& part : parts) {
        for (const FoundQuad& quad : part) {
            for (std::size_t k = 0; k < 4; ++k) {
                const std::uint32_t x = quad.v[(k + 3) % 4], y = quad.v[(k + 1) % 4];
                corners_[next[quad.v[k]]++] = {std::min(x, y), std::max(x, y), quad.v[(k + 2) % 4]};
            }
        }
    }
    // A quadrangle with both diagonals is there once: what is left of the second is set to the first and passed over by at().
    parallel_for_each_index(m.positions.size(), [&](std::size_t v) {
        std::sort(corners_.begin() + static_cast<std::ptrdiff_t>(offsets_[v]),
                  corners_.begin() + static_cast<std::ptrdiff_t>(offsets_[v + 1]));
    });
    std::uint64_t out = 0;
    for (std::size_t v = 0; v < m.positions.size(); ++v) {
        const std::uint64_t begin = offsets_[v], end = offsets_[v + 1];
        offsets_[v] = out;
        for (std::uint64_t i = begin; i < end; ++i) {
            if (i == begin || corners_[i] != corners_[i - 1]) corners_[out++] = corners_[i];
        }
    }
    offsets_.back() = out;
    corners_.resize(out);
}

std::span<const QuadTable::Corner> QuadTable::at(std::uint32_t vertex, std::uint32_t x, std::uint32_t y) const {
    const std::span<const Corner> all = at(vertex);
    if (x > y) std::swap(x, y);
    const auto first = std::lower_bound(all.begin(), all.end(), Corner{x, y, 0});
    auto last = first;
    while (last != all.end() && last->x == x && last->y == y) ++last;
    return {first, last};
}

}  // namespace geomend::hexes
