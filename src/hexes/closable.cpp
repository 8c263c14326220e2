// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/closable.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>

#include "base/parallel.h"
#include "base/vectors.h"
#include "hexes/half_spaces.h"
#include "hexes/open_diagonal.h"
#include "model/cell_faces.h"

namespace geomend::hexes {

namespace {

using QuadCorners = std::array<std::uint32_t, 4>;

std::uint32_t index_in(const TetMesh& m, std::uint32_t t, std::uint32_t v) {
    return static_cast<std::uint32_t>(std::ranges::find(m.tets[t], v) - m.tets[t].begin());
}

/// Whether a tetrahedron has a vertex.
bool has(const TetMesh& m, std::uint32_t t, std::uint32_t v) { return index_in(m, t, v) < 4; }

/// The facets behind the two halves of a quadrangle, and its corners from one end of the diagonal on, wound towards them.
struct Behind {
    QuadCorners v;
    std::array<std::uint32_t, 2> facets;
};

/// Goes through tetrahedra that have all corners of the quadrangle. \return false where the mesh ends behind one
bool pass_flat(const TetMesh& m, Behind& b) {
    while (b.facets[0] != no_index && b.facets[1] != no_index && b.facets[0] / 4 == b.facets[1] / 4) {
        const std::uint32_t t = b.facets[0] / 4;
        const std::uint32_t without_0 = index_in(m, t, b.v[0]), without_2 = index_in(m, t, b.v[2]);
        if (without_0 == 4 || without_2 == 4) return false;
        // From the next corner on: its first half is without the old first corner.
        b = {{b.v[1], b.v[2], b.v[3], b.v[0]}, {m.across[t][without_0], m.across[t][without_2]}};
    }
    return b.facets[0] != no_index && b.facets[1] != no_index;
}

enum class Closable : std::uint8_t { yes, with_more, no };

/// Whether walls leave no room for a vertex in front of all of a quadrangle's corners: then it makes no difference how much else gives way.
bool is_held(const std::array<Vec3, 4>& quad, std::span<const std::array<Vec3, 3>> walls, std::span<const std::array<Vec3, 3>> others) {
    std::vector<HalfSpace> all;
    for (std::size_t k = 0; k < 4; ++k) add_half_space(quad[k], quad[(k + 1) % 4], quad[(k + 3) % 4], all);
    for (const auto& t : walls) add_half_space(t[0], t[1], t[2], all);
    const std::size_t fixed = all.size();
    for (const auto& t : others) add_half_space(t[0], t[1], t[2], all);
    const Vec3 across = minus(quad[2], quad[0]);
    const auto deepest = deepest_place(all, quad[0], 10 * std::sqrt(dot(across, across)));
    return deepest && !(deepest->depth > 0) && std::ranges::all_of(deepest->tight, [&](std::uint32_t t) { return t < fixed; });
}

Closable closable(const TetMesh& m, Behind b) {
    if (!pass_flat(m, b)) return Closable::yes;
    std::vector<Vec3> chain{m.positions[b.v[1]]};
    std::vector<std::array<Vec3, 3>> walls, others;
    std::uint32_t x = b.v[1], facet = b.facets[0];
    for (int count = 0; count < 64; ++count) {
        const std::uint32_t t = facet / 4, y = m.tets[t][facet % 4];
        chain.push_back(m.positions[y]);
        if (!has(m, t, b.v[0]) || !has(m, t, b.v[2]) || !has(m, t, x)) return Closable::no;
        const std::uint32_t k = index_in(m, t, x);
        for (const std::uint32_t end : {b.v[0], b.v[2]}) {
            const std::uint32_t number = 4 * t + index_in(m, t, end);
            const auto c = m.facet(number);
            const bool stays = m.wall[t][number % 4] != TetMesh::no_wall || m.across[t][number % 4] == no_index;
            (stays ? walls : others).push_back({m.positions[c[0]], m.positions[c[2]], m.positions[c[1]]});
        }
        if (4 * t + k == b.facets[1]) {
            const auto at = [&](std::size_t i) { return m.positions[b.v[i]]; };
            const std::array<Vec3, 4> quad{at(0), at(1), at(2), at(3)};
            if (has_place_for_apex({quad, chain})) return Closable::yes;
            return is_held(quad, walls, others) ? Closable::no : Closable::with_more;
        }
        if (m.wall[t][k] != TetMesh::no_wall || m.across[t][k] == no_index) return Closable::no;
        x = y;
        facet = m.across[t][k];
    }
    return Closable::no;
}

/// The quadrangles of a candidate with what is behind them.
template <class Visit>
void each_quad(const TetMesh& m, const Candidates& all, std::size_t i, const Visit& visit) {
    const auto tets = all.tets_of(i);
    std::uint32_t number = 0;
    for (const LocalFace& face : faces_of(all.types[i])) {
        const auto c = face.corners();
        const std::uint32_t start = all.diagonals[i] >> number++ & 1u;
        if (c.size() != 4) continue;
        Behind b{{}, {no_index, no_index}};
        for (std::size_t k = 0; k < 4; ++k) b.v[k] = all.corners[i][c[(start + k) % 4]];
        for (const std::uint32_t t : tets) {
            for (std::uint32_t k = 0; k < 4; ++k) {
                const auto f = m.facet(4 * t + k);
                const auto is_in = [&](std::uint32_t v) { return std::ranges::find(f, v) != f.end(); };
                if (!is_in(b.v[0]) || !is_in(b.v[2])) continue;
                if (is_in(b.v[1])) b.facets[0] = m.across[t][k];
                if (is_in(b.v[3])) b.facets[1] = m.across[t][k];
            }
        }
        visit(b);
    }
}

}  // namespace

std::vector<UnclosableCounts> count_unclosable(const TetMesh& mesh, const Candidates& candidates) {
    std::vector<UnclosableCounts> count(candidates.size());
    constexpr std::size_t grain = 20'000;  // candidates beside each other share quadrangles, which are judged once in a block
    parallel_blocks(candidates.size(), grain, [&](std::size_t first, std::size_t end) {
        std::unordered_map<std::uint64_t, Closable> known;
        for (std::size_t i = first; i < end; ++i) {
            each_quad(mesh, candidates, i, [&](const Behind& b) {
                if (b.facets[0] == no_index || b.facets[1] == no_index) return;
                const std::uint64_t key = (std::uint64_t{std::min(b.facets[0], b.facets[1])} << 32) | std::max(b.facets[0], b.facets[1]);
                const auto found = known.find(key);
                const Closable how = found != known.end() ? found->second : known.emplace(key, closable(mesh, b)).first->second;
                if (how == Closable::with_more) ++count[i].in_fan;
                if (how == Closable::no) ++count[i].at_all;
            });
        }
    });
    return count;
}

}  // namespace geomend::hexes
