// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.h"
#include "hexes/quad_table.h"
#include "hexes/tet_mesh.h"

namespace geomend::hexes {

/// Cells that may be made of tetrahedra, each with the tetrahedra that it would take the place of.
struct Candidates {
    std::vector<CellType> types;                        ///< hexahedron, wedge or pyramid
    std::vector<std::array<std::uint32_t, 8>> corners;  ///< in VTK's order; no_index behind the last one
    std::vector<double> quality;                        ///< scaled_jacobian()
    std::vector<double> volume;                         ///< of its tetrahedra
    /// Bit f: the tetrahedra cut the quadrangle that is local face f from its second corner to its fourth, not from its first to its third.
    std::vector<std::uint8_t> diagonals;
    std::vector<std::uint8_t> ends;  ///< bit f: the mesh ends at the quadrangle that is local face f
    std::vector<std::uint64_t> tet_offsets = {0};
    std::vector<std::uint32_t> tets;

    std::size_t size() const { return types.size(); }
    std::span<const std::uint32_t> tets_of(std::size_t i) const { return {tets.data() + tet_offsets[i], tets.data() + tet_offsets[i + 1]}; }
    std::span<const std::uint32_t> corners_of(std::size_t i) const { return {corners[i].data(), node_count(types[i])}; }
    void append(const Candidates& more);
    /// Leaves only some. \pre one flag each
    void keep(const std::vector<std::uint8_t>& kept);
};

struct SearchOptions {
    double least_quality = 0.3;                ///< scaled_jacobian() of each candidate
    std::span<const std::uint8_t> taken = {};  ///< tetrahedra that are not to be used; empty: all may be
    const Monitor* monitor = nullptr;
};

/// All hexahedra with valid shapes whose faces are pairs of facets and that tetrahedra of one region fill, whatever their number and
/// pattern. Refused is what has a line or a wall inside. Flat tetrahedra behind faces belong to none. Source: J. Pellerin, A. Johnen,
/// K. Verhetsel, J.-F. Remacle, "Identifying combinations of tetrahedra into hexahedra: a vertex based strategy" (2018).
/// Ascending by their least vertex; the same for any number of threads. Cost: 2 to 10 microseconds each.
Candidates find_hexahedra(const TetMesh& mesh, const QuadTable& quads, const SearchOptions& options);
/// The same for prisms.
Candidates find_prisms(const TetMesh& mesh, const QuadTable& quads, const SearchOptions& options);
/// Two tetrahedra that share a facet as a pyramid, up to three for each facet.
Candidates find_pyramids(const TetMesh& mesh, const QuadTable& quads, const SearchOptions& options);

}  // namespace geomend::hexes
