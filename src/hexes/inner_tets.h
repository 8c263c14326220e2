// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hexes/tet_mesh.h"

namespace geomend::hexes {

/// Finds the tetrahedra that fill a cell, given its corners. One for each thread: it keeps marks of vertices.
class InnerTets {
public:
    InnerTets(const TetMesh& mesh, std::span<const std::uint8_t> taken) : m_(mesh), taken_(taken), local_(mesh.positions.size(), 255) {}

    /// Whether tetrahedra fill the cell: of one region, none taken, all corners the cell's, with two facets on each quadrangle of the
    /// cell and one on each triangle, and no line or wall inside. They are found by going from one to the next, so that no table of
    /// patterns is needed. \param corners in VTK's order of a hexahedron or wedge
    bool find(CellType type, std::span<const std::uint32_t> corners);

    const std::vector<std::uint32_t>& tets() const { return tets_; }  ///< of the cell found, ascending
    std::uint8_t diagonals() const { return diagonals_; }             ///< as in Candidates
    std::uint8_t ends() const { return ends_; }                       ///< as in Candidates
    double volume() const { return volume_; }

private:
    bool flood(std::uint32_t seed, CellType type, std::span<const std::uint32_t> corners, bool goes_on);
    bool cross(std::uint32_t facet, CellType type, bool goes_on);
    bool lines_stay(CellType type, std::span<const std::uint32_t> corners) const;
    bool faces_are_whole(CellType type, std::span<const std::uint32_t> corners);
    bool face_may_be(std::span<const std::uint32_t> quad, std::uint32_t facet) const;
    /// Which corners of the cell a facet or tetrahedron has, as bits; 0 where it has others.
    template <std::size_t n>
    unsigned bits_of(const std::array<std::uint32_t, n>& vertices) const;

    const TetMesh& m_;
    std::span<const std::uint8_t> taken_;
    std::vector<std::uint8_t> local_;  ///< per vertex its number in the cell, or 255
    std::vector<std::uint32_t> tets_;
    std::array<std::array<std::uint32_t, 2>, 6> facets_{};  ///< per face of the cell the facets on it
    std::array<std::uint8_t, 6> facet_count_{};
    bool could_go_on_ = false;  ///< tetrahedra of the corners alone stand behind a facet on a face
    std::uint8_t diagonals_ = 0, ends_ = 0;
    double volume_ = 0;
};

}  // namespace geomend::hexes
