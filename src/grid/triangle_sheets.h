// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace geomend::grid {

/// Triangles as sheets: each hangs together across edges that two triangles share, is cut where more than two meet, and is
/// wound one way.
struct TriangleSheets {
    std::vector<std::uint32_t> sheet;  ///< per triangle, from 0 in the order of first triangles
    std::vector<std::uint8_t> turned;  ///< per triangle: 1 where it must be wound the other way; all 0 unless asked for
    std::uint32_t count = 0;
};

/// Parts a set of triangles into sheets. A sheet that comes round to itself, with more than two of its triangles at an edge, is
/// parted once more, by planes, so that it ends there. Winding: the fewer triangles of a sheet are turned; a sheet with one side
/// only stays as it is where it comes back turned over.
/// \param triangles numbers of points; no two have the same three
/// \param plane per triangle a number of the plane (of cell faces) that it is from
/// \param may_turn false: triangles keep their winding, and sheets end where it changes
/// Cost: n log n.
TriangleSheets triangle_sheets(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const std::uint64_t> plane,
                               bool may_turn);

}  // namespace geomend::grid
