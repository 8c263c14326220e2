// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/turned_cell.h"

namespace geomend::exchange {

namespace {

using Swap = std::array<std::uint8_t, 2>;

// The first swaps are those of the corners, so that first-order types have a part of the row.
constexpr std::array<Swap, 3> tetrahedron{{{0, 1}, {5, 6}, {7, 8}}};
constexpr std::array<Swap, 4> pyramid{{{1, 3}, {5, 8}, {6, 7}, {10, 12}}};
constexpr std::array<Swap, 6> wedge{{{0, 3}, {1, 4}, {2, 5}, {6, 9}, {7, 10}, {8, 11}}};
constexpr std::array<Swap, 9> hexahedron{{{0, 4}, {1, 5}, {2, 6}, {3, 7}, {8, 12}, {9, 13}, {10, 14}, {11, 15}, {24, 25}}};
constexpr std::array<Swap, 5> pentagonal_prism{{{0, 5}, {1, 6}, {2, 7}, {3, 8}, {4, 9}}};
constexpr std::array<Swap, 6> hexagonal_prism{{{0, 6}, {1, 7}, {2, 8}, {3, 9}, {4, 10}, {5, 11}}};

}  // namespace

std::span<const Swap> turning_swaps(CellType type) {
    const auto first = [](const auto& row, std::size_t count) { return std::span<const Swap>(row).first(count); };
    switch (type) {
        case CellType::tetrahedron:
            return first(tetrahedron, 1);
        case CellType::quadratic_tetrahedron:
            return tetrahedron;
        case CellType::pyramid:
            return first(pyramid, 1);
        case CellType::quadratic_pyramid:
            return pyramid;
        case CellType::wedge:
            return first(wedge, 3);
        case CellType::quadratic_wedge:
        case CellType::biquadratic_wedge:
            return wedge;
        case CellType::hexahedron:
            return first(hexahedron, 4);
        case CellType::quadratic_hexahedron:
            return first(hexahedron, 8);
        case CellType::triquadratic_hexahedron:
            return hexahedron;
        case CellType::pentagonal_prism:
            return pentagonal_prism;
        case CellType::hexagonal_prism:
            return hexagonal_prism;
        default:
            return {};
    }
}

}  // namespace geomend::exchange
