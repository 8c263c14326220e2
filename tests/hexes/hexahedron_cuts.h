// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "hexes/lattice_meshes.h"
#include "model/cell_faces.h"

namespace geomend::test {

/// Tetrahedra over the eight corners of a hexahedron, in VTK's order, that fill it without a further vertex.
struct HexahedronCut {
    std::uint8_t diagonals = 0;  ///< bit f: local face f is cut from its second corner to its fourth, not from its first to its third
    Tets tets;                   ///< wound so that they are inside of the faces
};

/// All cuts of a hexahedron by what meets what alone, whether a hexahedron in space can be cut so or not: tetrahedra are put on open
/// triangles, beginning with those of the cut faces, until none is open. Those with all corners on one face are left out, and what is no
/// ball: where the cells around an edge or a vertex hang together in more than one way.
class HexahedronCuts {
public:
    HexahedronCuts() {
        for (unsigned diagonals = 0; diagonals < 64; ++diagonals) {
            sides_.fill(unused);
            std::size_t f = 0;
            for (const LocalFace& face : faces_of(CellType::hexahedron)) {
                const auto c = face.corners();
                const std::size_t s = diagonals >> f++ & 1u;
                open({c[s], c[(s + 2) % 4], c[s + 1]});
                open({c[s], c[(s + 3) % 4], c[(s + 2) % 4]});
            }
            now_.diagonals = static_cast<std::uint8_t>(diagonals);
            fill();
        }
    }
    std::vector<HexahedronCut> cuts;

private:
    using Triple = std::array<std::uint32_t, 3>;
    static constexpr std::size_t most_tets = 15;
    enum Side : std::uint8_t { unused, even, odd, closed };

    static std::size_t bits(const Triple& t) { return std::size_t{1} << t[0] | std::size_t{1} << t[1] | std::size_t{1} << t[2]; }
    static Side side(const Triple& t) {
        const int falls = (t[0] > t[1] ? 1 : 0) + (t[1] > t[2] ? 1 : 0) + (t[0] > t[2] ? 1 : 0);
        return falls % 2 == 0 ? even : odd;
    }
    /// A triangle that still needs a tetrahedron in front of it.
    void open(const Triple& t) {
        sides_[bits(t)] = side(t);
        corners_[bits(t)] = t;
    }
    static bool is_on_face(std::size_t corners) {
        return std::ranges::any_of(faces_of(CellType::hexahedron), [&](const LocalFace& face) {
            std::size_t all = 0;
            for (const std::uint8_t k : face.corners()) all |= std::size_t{1} << k;
            return (corners & ~all) == 0;
        });
    }

    void fill() {
        const auto first = std::ranges::find_if(sides_, [](Side s) { return s == even || s == odd; });
        if (first == sides_.end()) {
            if (is_ball()) cuts.push_back(now_);
            return;
        }
        if (now_.tets.size() == most_tets) return;
        const auto at = static_cast<std::size_t>(first - sides_.begin());
        for (std::uint32_t apex = 0; apex < 8; ++apex) {
            if ((at >> apex & 1) == 0 && !is_on_face(at | std::size_t{1} << apex)) put_on(corners_[at], apex);
        }
    }

    void put_on(const Triple& t, std::uint32_t apex) {
        const auto sides = sides_;
        const auto corners = corners_;
        sides_[bits(t)] = closed;
        bool fits = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const Triple next{t[k], t[(k + 1) % 3], apex};
            const Side before = sides_[bits(next)];
            fits = fits && before != closed && before != side(next);
            if (before == unused) open(next);
            else sides_[bits(next)] = closed;
        }
        now_.tets.push_back({t[0], t[1], t[2], apex});
        if (fits) fill();
        now_.tets.pop_back();
        sides_ = sides;
        corners_ = corners;
    }

    /// The corners of tetrahedra without those given, as sets of bits.
    std::vector<std::size_t> link(std::size_t of) const {
        std::vector<std::size_t> all;
        for (const auto& t : now_.tets) {
            std::size_t own = 0;
            for (const std::uint32_t v : t) own |= std::size_t{1} << v;
            if ((own & of) == of) all.push_back(own & ~of);
        }
        return all;
    }
    /// Whether all are together where each that meets others in a corner is.
    static bool is_connected(const std::vector<std::size_t>& sets) {
        if (sets.empty()) return true;
        std::size_t reached = sets[0], before = 0, all = 0;
        for (const std::size_t s : sets) all |= s;
        while (reached != before) {
            before = reached;
            for (const std::size_t s : sets) {
                if ((s & reached) != 0) reached |= s;
            }
        }
        return reached == all;
    }
    bool is_ball() const {
        for (std::size_t a = 0; a < 8; ++a) {
            for (std::size_t b = a + 1; b < 8; ++b) {
                if (!is_connected(link(std::size_t{1} << a | std::size_t{1} << b))) return false;
            }
            // The triangles around a vertex of the border are a disk.
            const auto around = link(std::size_t{1} << a);
            std::size_t corners = 0;
            std::vector<std::size_t> edges;
            for (const std::size_t s : around) {
                corners |= s;
                for (std::size_t k = 0; k < 8; ++k) {
                    if ((s >> k & 1) != 0) edges.push_back(s & ~(std::size_t{1} << k));
                }
            }
            std::ranges::sort(edges);
            edges.erase(std::ranges::unique(edges).begin(), edges.end());
            if (std::popcount(corners) + static_cast<int>(around.size()) - static_cast<int>(edges.size()) != 1) return false;
            if (!is_connected(around)) return false;
        }
        return true;
    }

    std::array<Side, 256> sides_{};
    std::array<Triple, 256> corners_{};
    HexahedronCut now_;
};

}  // namespace geomend::test
