// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/closable.h"

#include <algorithm>
#include <unordered_map>

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

bool is_closable(const TetMesh& m, Behind b) {
    if (!pass_flat(m, b)) return true;
    std::vector<Vec3> chain{m.positions[b.v[1]]};
    std::uint32_t x = b.v[1], facet = b.facets[0];
    for (int count = 0; count < 64; ++count) {
        const std::uint32_t t = facet / 4, y = m.tets[t][facet % 4];
        chain.push_back(m.positions[y]);
        if (!has(m, t, b.v[0]) || !has(m, t, b.v[2]) || !has(m, t, x)) return false;
        const std::uint32_t k = index_in(m, t, x);
        if (4 * t + k == b.facets[1]) {
            const auto at = [&](std::size_t i) { return m.positions[b.v[i]]; };
            return has_place_for_apex({{at(0), at(1), at(2), at(3)}, chain});
        }
        if (m.wall[t][k] != TetMesh::no_wall || m.across[t][k] == no_index) return false;
        x = y;
        facet = m.across[t][k];
    }
    return false;
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

std::vector<std::uint8_t> count_unclosable(const TetMesh& mesh, const Candidates& candidates) {
    std::vector<std::uint8_t> count(candidates.size(), 0);
    std::unordered_map<std::uint64_t, bool> known;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        each_quad(mesh, candidates, i, [&](const Behind& b) {
            if (b.facets[0] == no_index || b.facets[1] == no_index) return;
            const std::uint64_t key = (std::uint64_t{std::min(b.facets[0], b.facets[1])} << 32) | std::max(b.facets[0], b.facets[1]);
            const auto found = known.find(key);
            const bool closable = found != known.end() ? found->second : known.emplace(key, is_closable(mesh, b)).first->second;
            if (!closable) ++count[i];
        });
    }
    return count;
}

}  // namespace geomend::hexes
