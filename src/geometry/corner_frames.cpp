// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/corner_frames.h"

namespace geomend {

std::span<const std::array<unsigned, 4>> corner_frames(CellType type) {
    static constexpr std::array<std::array<unsigned, 4>, 4> tetrahedron = {{{0, 1, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {3, 1, 0, 2}}};
    static constexpr std::array<std::array<unsigned, 4>, 8> hexahedron = {
        {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}}};
    // With the normal of (0,1,2) out of the cell, as VTK documents it.
    static constexpr std::array<std::array<unsigned, 4>, 6> wedge = {
        {{0, 2, 1, 3}, {1, 0, 2, 4}, {2, 1, 0, 5}, {3, 4, 5, 0}, {4, 5, 3, 1}, {5, 3, 4, 2}}};
    static constexpr std::array<std::array<unsigned, 4>, 4> pyramid = {{{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}};
    switch (type) {
        case CellType::tetrahedron:
            return tetrahedron;
        case CellType::hexahedron:
            return hexahedron;
        case CellType::wedge:
            return wedge;
        case CellType::pyramid:
            return pyramid;
        default:
            return {};
    }
}

}  // namespace geomend
