// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/half_cells.h"

#include <algorithm>

namespace geomend::grid {

namespace {

// Corners of each face of a cell, in CellFace order, round the face.
constexpr std::array<std::array<unsigned, 4>, 6> face_corners{
    {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};

std::size_t tiles_along(std::uint32_t columns, std::uint32_t size) { return (std::size_t{columns} + size - 1) / size; }

}  // namespace

void take_half_cells(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k, HalfCells& cell) {
    cell.corners = cell_corners(grid, i, j, k);
    Vec3 sum{};
    Corners quarter;
    for (std::size_t c = 0; c < 8; ++c) {
        sum = plus(sum, cell.corners[c]);
        quarter[c] = times(0.25, cell.corners[c]);
    }
    const Vec3 middle = times(0.125, sum);
    for (std::size_t face = 0; face < 6; ++face) {
        const auto& [a, b, c, d] = face_corners[face];
        cell.arm[face] = minus(plus(plus(plus(quarter[a], quarter[b]), quarter[c]), quarter[d]), middle);
        cell.arm_square[face] = dot(cell.arm[face], cell.arm[face]);
    }
}

std::size_t Tile::count(const CornerPointGrid& grid) { return tiles_along(grid.dims[0], width) * tiles_along(grid.dims[1], height); }

Tile::Tile(const CornerPointGrid& grid, std::size_t number) {
    const std::size_t across = tiles_along(grid.dims[0], width);
    first_i = static_cast<std::uint32_t>(number % across) * width;
    first_j = static_cast<std::uint32_t>(number / across) * height;
    end_i = grid.dims[0] - first_i > width ? first_i + width : grid.dims[0];
    end_j = grid.dims[1] - first_j > height ? first_j + height : grid.dims[1];
}

void TileLayer::fill(const CornerPointGrid& grid, const std::vector<std::uint8_t>& present, const Tile& tile, std::uint32_t k) {
    cells_.resize(std::size_t{Tile::width + 1} * (Tile::height + 1));
    first_i_ = tile.first_i;
    first_j_ = tile.first_j;
    const std::uint32_t end_i = std::min(tile.end_i + 1, grid.dims[0]), end_j = std::min(tile.end_j + 1, grid.dims[1]);
    for (std::uint32_t j = tile.first_j; j < end_j; ++j) {
        std::size_t cell = grid.cell(tile.first_i, j, k);
        HalfCells* to = cells_.data() + std::size_t{Tile::width + 1} * (j - first_j_);
        for (std::uint32_t i = tile.first_i; i < end_i; ++i, ++cell, ++to) {
            if (present[cell] != 0) take_half_cells(grid, i, j, k, *to);
        }
    }
}

}  // namespace geomend::grid
