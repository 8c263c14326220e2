// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/flat_cavity.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "hexes/half_spaces.h"
#include "hexes/jacobian.h"
#include "hexes/pair_set.h"
#include "volume/cell_quality.h"

namespace geomend::hexes {

namespace {

constexpr double nearly_flat = 1e-4, flat = 1e-7;  // sines of the least angle
constexpr double good_shape = 0.02, some_shape = 1e-5;

}  // namespace

double FlatCavities::sine(std::uint32_t t) const {
    const auto& c = m_.tets[t];
    return volumes::least_sine({m_.positions[c[0]], m_.positions[c[1]], m_.positions[c[2]], m_.positions[c[3]]});
}

std::vector<FlatCavities::Made> FlatCavities::replace() {
    is_gone_.assign(m_.tets.size(), 0);
    const auto count = static_cast<std::uint32_t>(m_.tets.size());
    for (std::uint32_t t = 0; t < count; ++t) {
        if (is_gone_[t] != 0 || sine(t) >= nearly_flat) continue;
        if (!replace_at(t, good_shape, 20) && sine(t) < flat) replace_at(t, some_shape, 26);
    }
    std::size_t next = 0;
    for (std::size_t t = 0; t < m_.tets.size(); ++t) {
        if (is_gone_[t] != 0) continue;
        m_.tets[next] = m_.tets[t];
        m_.region[next] = m_.region[t];
        m_.cells[next++] = m_.cells[t];
    }
    m_.tets.resize(next);
    m_.region.resize(next);
    m_.cells.resize(next);
    m_.across.clear();
    return std::move(made_);
}

bool FlatCavities::replace_at(std::uint32_t t, double least_shape, std::size_t most_facets) {
    cavity_ = {t};
    while (true) {
        find_border();
        if (border_.size() > most_facets) return false;
        if (Vec3 p; place(least_shape, p) && !loses_something()) {
            fill(p);
            return true;
        }
        const std::uint32_t next = grow();
        if (next == no_index) return false;
        cavity_.push_back(next);
    }
}

void FlatCavities::find_border() {
    border_.clear();
    for (const std::uint32_t t : cavity_) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t other = m_.across[t][k];
            if (other == no_index || std::ranges::find(cavity_, other / 4) == cavity_.end() || is_wall_(4 * t + k))
                border_.push_back(4 * t + k);
        }
    }
}

/// A vertex that makes tetrahedra of some shape with all facets of the border.
bool FlatCavities::place(double least_shape, Vec3& p) const {
    if (cavity_.size() < 2) return false;
    const Vec3 origin = m_.positions[m_.tets[cavity_[0]][0]];
    std::vector<HalfSpace> inside;
    for (const std::uint32_t f : border_) {
        const auto c = m_.facet(f);
        const auto at = [&](std::size_t k) { return minus(m_.positions[c[k]], origin); };
        add_half_space(at(0), at(2), at(1), inside);
    }
    double reach = 0;
    for (const std::uint32_t f : border_) {
        for (const std::uint32_t v : m_.facet(f))
            reach = std::max(reach, dot(minus(m_.positions[v], origin), minus(m_.positions[v], origin)));
    }
    const auto found = deepest_place(inside, {}, 10 * std::sqrt(reach));
    if (!found || !(found->depth > 0)) return false;
    p = plus(found->place, origin);
    return std::ranges::all_of(border_, [&](std::uint32_t f) {
        const auto c = m_.facet(f);
        return scaled_jacobian(CellType::tetrahedron, std::array{m_.positions[c[0]], m_.positions[c[2]], m_.positions[c[1]], p}) >=
               least_shape;
    });
}

/// Whether a vertex or an edge that stays lies inside.
bool FlatCavities::loses_something() const {
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint64_t> edges;
    for (const std::uint32_t f : border_) {
        const auto c = m_.facet(f);
        for (std::size_t k = 0; k < 3; ++k) {
            vertices.push_back(c[k]);
            edges.push_back(pair_key(c[k], c[(k + 1) % 3]));
        }
    }
    const auto is_in = [](const auto& all, auto one) { return std::ranges::find(all, one) != all.end(); };
    for (const std::uint32_t t : cavity_) {
        const auto& c = m_.tets[t];
        for (std::size_t i = 0; i < 4; ++i) {
            if (!is_in(vertices, c[i])) return true;
            for (std::size_t j = i + 1; j < 4; ++j) {
                if (is_kept_(c[i], c[j]) && !is_in(edges, pair_key(c[i], c[j]))) return true;
            }
        }
    }
    return false;
}

/// The tetrahedron behind the facet of the border that is most in the way: seen from the middle, it is the least in front.
std::uint32_t FlatCavities::grow() {
    Vec3 middle{};
    for (const std::uint32_t f : border_) {
        for (const std::uint32_t v : m_.facet(f))
            middle = plus(middle, times(1.0 / static_cast<double>(3 * border_.size()), m_.positions[v]));
    }
    std::uint32_t best = no_index;
    double least = HUGE_VAL;
    for (const std::uint32_t f : border_) {
        const std::uint32_t other = m_.across[f / 4][f % 4];
        if (other == no_index || is_wall_(f) || std::ranges::find(cavity_, other / 4) != cavity_.end()) continue;
        const auto c = m_.facet(f);
        std::vector<HalfSpace> inside;
        add_half_space(m_.positions[c[0]], m_.positions[c[2]], m_.positions[c[1]], inside);
        const double depth = inside.empty() ? 0 : inside[0].depth(middle);
        if (depth < least) least = depth, best = other / 4;
    }
    return best;
}

void FlatCavities::fill(const Vec3& p) {
    const auto apex = static_cast<std::uint32_t>(m_.positions.size());
    const std::uint32_t region = m_.region[cavity_[0]];
    m_.positions.push_back(p);
    made_.push_back({p, m_.tets[cavity_[0]], region});
    const auto first = static_cast<std::uint32_t>(m_.tets.size());
    for (const std::uint32_t f : border_) {
        const auto t = static_cast<std::uint32_t>(m_.tets.size());
        const auto c = m_.facet(f);
        const std::uint32_t other = m_.across[f / 4][f % 4];
        m_.tets.push_back({c[0], c[2], c[1], apex});
        m_.across.push_back({no_index, no_index, no_index, other});
        if (other != no_index) m_.across[other / 4][other % 4] = 4 * t + 3;
        m_.region.push_back(region);
        m_.cells.push_back(m_.cells[f / 4]);
        is_gone_.push_back(0);
    }
    // Those that share an edge of the border: each edge has two facets there, but where the border touches itself.
    for (auto a = first; a < m_.tets.size(); ++a) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t v = m_.tets[a][(k + 1) % 3], w = m_.tets[a][(k + 2) % 3];
            for (auto b = first; b < m_.tets.size(); ++b) {
                for (std::uint32_t n = 0; b != a && n < 3; ++n) {
                    if (m_.tets[b][(n + 1) % 3] == w && m_.tets[b][(n + 2) % 3] == v) m_.across[a][k] = 4 * b + n;
                }
            }
        }
    }
    for (const std::uint32_t t : cavity_) is_gone_[t] = 1;
}

}  // namespace geomend::hexes
