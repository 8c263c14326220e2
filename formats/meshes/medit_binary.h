// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "model/objects.h"

// The binary form of Medit files, as of libMeshb: a one in the machine's byte order, the version, then sections. Each begins with its
// number and the place in the file where the next one begins, then their count. Versions 1 and 2 have places of 32 bits, 3 and 4 of
// 64; version 1 has coordinates in single precision; version 4 has counts and numbers of 64 bits.

namespace geomend::meshes {

/// Numbers of the sections that are read and written.
enum class MeditSection : std::int32_t { dimension = 3, vertices = 4, end = 54 };

/// A section of cells.
struct MeditCells {
    std::int32_t number;
    CellType type;
    std::array<std::uint8_t, 8> order;  ///< per node of ours its place in the file; it is its own inverse
};

// The first triangle of a prism looks into the cell, that of VTK's wedge out of it.
inline constexpr std::array<MeditCells, 7> medit_cells{{{5, CellType::line, {0, 1}},
                                                        {6, CellType::triangle, {0, 1, 2}},
                                                        {7, CellType::quad, {0, 1, 2, 3}},
                                                        {8, CellType::tetrahedron, {0, 1, 2, 3}},
                                                        {49, CellType::pyramid, {0, 1, 2, 3, 4}},
                                                        {9, CellType::wedge, {0, 2, 1, 3, 5, 4}},
                                                        {10, CellType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}}}};

}  // namespace geomend::meshes
