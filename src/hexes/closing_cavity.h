// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hexes/cavity_apex.h"
#include "hexes/closing_front.h"
#include "hexes/half_spaces.h"

namespace geomend::hexes {

/// A front whose quadrangles may be closed by a vertex in a cavity: tetrahedra behind them and beside these are taken out, and pyramids and
/// tetrahedra over one new vertex fill their place.
class CavityFront : protected ClosingFront {
protected:
    using ClosingFront::ClosingFront;

    /// Where the fan behind a quadrangle leaves no room for a vertex: takes tetrahedra beside it out as well, until there is room for one
    /// that sees all around.
    bool open_cavity(std::uint32_t number);

    /// The least shape of cells around a new vertex that come in the place of some tetrahedra; less where all of these are thin.
    double shape_wanted(std::span<const std::uint32_t> tets) const;

    std::vector<HalfSpace> beside_;  ///< what other quadrangles need

private:
    /// Takes the tetrahedron behind one of some triangles of the border, the one that leaves most room.
    bool grow(std::uint32_t number, std::span<const std::uint32_t> triangles);
    bool is_in_cavity(std::uint32_t t) const;
    /// Half of a quadrangle that gets a pyramid over the vertex in the cavity.
    bool is_capped(std::uint32_t facet) const;
    std::array<std::uint32_t, 3> facet(std::uint32_t number) const;
    /// The facets around the cavity, and the quadrangles that have both halves there and all that is behind their diagonal inside.
    void find_border(std::uint32_t number);
    CavityBorder border_places() const;
    /// Whether a vertex or an edge that stays lies inside of the cavity.
    bool loses_something() const;
    /// Pyramids on the capped quadrangles and tetrahedra on the other faces of the border, all over one new vertex.
    void fill_cavity(const Vec3& place);
    /// What two faces of a cavity's border have made meets above their common edge.
    void join_at(std::uint64_t edge, std::array<std::uint32_t, 2> faces, const std::vector<std::uint32_t>& made);
    /// The edge between the two corners of a tetrahedron that are none of two.
    static std::uint64_t pair_key_without(const std::array<std::uint32_t, 4>& tet, std::uint32_t k, std::uint32_t l);

    std::vector<std::uint32_t> cavity_, border_, capped_;  ///< tetrahedra, facets around them, quadrangles with both halves there
    bool is_simple_ = false;                               ///< each edge of the border is one of two faces there
    std::vector<std::pair<std::uint64_t, std::uint32_t>> border_edges_;  ///< with the number of the facet in `border_`; ascending
};

}  // namespace geomend::hexes
