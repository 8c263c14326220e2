// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "hexes/candidates.h"
#include "hexes/closing.h"
#include "hexes/pair_set.h"
#include "hexes/split_cells.h"

namespace geomend::hexes {

/// What lies across a facet or behind half of a quadrangle: a facet of a tetrahedron, half of a quadrangle, nothing (no_index), or a
/// triangle of a cell.
constexpr std::uint32_t half_bit = 0x80000000u, of_cell = 0xfffffffeu;
constexpr bool is_half(std::uint32_t code) { return (code & half_bit) != 0 && code < of_cell; }
constexpr bool is_facet(std::uint32_t code) { return (code & half_bit) == 0; }

/// A quadrangle of a cell, with what is behind it.
struct FrontQuad {
    std::uint32_t cell, face;
    std::array<std::uint32_t, 4> v;  ///< wound outwards
    std::uint32_t start;  ///< 0 or 1: its halves are v[start], v[start + 1], v[start + 2] and v[start], v[start + 2], v[start + 3]
    std::array<std::uint32_t, 2> behind;  ///< per half
    std::vector<std::uint32_t> far;       ///< facets on walls that belong to the cell behind
    std::vector<std::uint32_t> absorbed;  ///< tetrahedra on it that became a part of it
    bool is_done = false;

    std::uint32_t corner(std::uint32_t k) const { return v[(start + k) % 4]; }
    std::uint64_t diagonal() const { return pair_key(corner(0), corner(2)); }
    /// The half that does not have a corner of it. \pre the corner is not on the diagonal
    std::uint32_t half_without(std::uint32_t vertex) const { return vertex == corner(3) ? 0 : 1; }
};

/// Selected cells in the place of their tetrahedra, the tetrahedra that are left, and what lies behind the quadrangles between them.
class ClosingFront {
protected:
    ClosingFront(const TetMesh& mesh, const Candidates& candidates, ClosingCounts& counts);

    void add_cell(std::uint32_t i);
    /// A facet of a cell's own tetrahedra on one of its faces.
    void note_facet(std::uint32_t i, std::uint32_t cell, const std::array<std::uint32_t, 6>& quad_of, std::uint32_t facet);
    void put_place(std::uint32_t facet, std::uint32_t cell, std::uint32_t face, std::uint32_t half);
    void link_quads();
    std::uint32_t largest(std::span<const std::uint32_t> tets) const;
    /// Takes what lies flat on a quadrangle as a part of it. Done is what then ends the mesh or has another cell behind it.
    void settle(std::uint32_t number);
    /// Two cells with one quadrangle.
    void join(std::uint32_t a, std::uint32_t b);
    void place_far(const FrontQuad& q, std::uint32_t cell, std::uint32_t face);
    /// A tetrahedron with the corners of the quadrangle becomes a part of it: behind it, the quadrangle has its other diagonal.
    void absorb(std::uint32_t number, std::uint32_t t);
    /// The quadrangle is two triangles: what was absorbed is there again.
    void give_up(std::uint32_t number);
    void done(std::uint32_t number);
    template <class Change>
    void move_pending(FrontQuad& q, const Change& change);
    /// What lies across `code` is `other`.
    void link(std::uint32_t code, std::uint32_t other);
    std::uint32_t index_in(std::uint32_t t, std::uint32_t v) const;
    /// The tetrahedra around the diagonal behind a quadrangle, and the chain of their other corners.
    bool find_fan(const FrontQuad& q);
    std::array<Vec3, 4> points(const FrontQuad& q) const;
    /// The wall facets that the tetrahedra behind have on the quadrangle belong to the pyramid's base.
    std::uint32_t add_pyramid(const FrontQuad& q, std::uint32_t apex);
    MixedMesh finish();

    const TetMesh& m_;
    const Candidates& all_;
    ClosingCounts& counts_;
    std::vector<std::array<std::uint32_t, 4>> tets_, across_, sources_;  ///< sources: facets of the mesh on walls
    std::vector<std::uint32_t> tet_of_;
    std::vector<std::uint8_t> alive_;
    std::vector<Vec3> positions_;
    std::vector<MixedMesh::NewVertex> new_vertices_;
    std::vector<MixedMesh::Cell> cells_;
    std::vector<CellFaceRef> facet_places_;  ///< face: twice the local face, and the half of a quadrangle
    std::vector<FrontQuad> quads_;
    std::vector<std::uint32_t> half_of_;                        ///< per facet of a cell's own tetrahedra; else no_index
    std::unordered_map<std::uint64_t, std::uint32_t> pending_;  ///< diagonals of quadrangles that are not closed yet
    std::vector<OpenQuad> failed_;
    std::vector<std::uint32_t> fan_, chain_;
};

}  // namespace geomend::hexes
