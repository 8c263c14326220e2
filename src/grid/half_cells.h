// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/vectors.h"
#include "grid/cell_geometry.h"
#include "model/corner_point.h"

namespace geomend::grid {

/// What half-cell transmissibilities need of the geometry of a cell.
struct HalfCells {
    Corners corners;
    std::array<Vec3, 6> arm;  ///< per CellFace: from the mean of the corners to the mean of the face's own four
    std::array<double, 6> arm_square;
};

/// Corners and arms of a cell. \pre i < nx, j < ny, k < nz
void take_half_cells(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k, HalfCells& cell);

/// Vector area of a quadrangle: that of the two triangles at its first corner.
inline Vec3 vector_area(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 ac = minus(c, a), first = cross(minus(b, a), ac), second = cross(ac, minus(d, a));
    return {first[0] / 2 + second[0] / 2, first[1] / 2 + second[1] / 2, first[2] / 2 + second[2] / 2};
}

/// Columns of a grid side by side, whose cells are looked at layer by layer: small enough that two layers of them stay in
/// the cache.
struct Tile {
    static constexpr std::uint32_t width = 64, height = 16;
    std::uint32_t first_i, first_j, end_i, end_j;

    /// Number of the tiles of a grid, and one of them.
    static std::size_t count(const CornerPointGrid& grid);
    Tile(const CornerPointGrid& grid, std::size_t number);
};

/// Half cells of the present cells of one layer of a tile and of the columns next to it in +I and +J.
class TileLayer {
public:
    void fill(const CornerPointGrid& grid, const std::vector<std::uint8_t>& present, const Tile& tile, std::uint32_t k);
    /// \pre the cell is present and in the layer that was filled last, at most one column beyond the tile in +I or +J
    const HalfCells& at(std::uint32_t i, std::uint32_t j) const {
        return cells_[(i - first_i_) + std::size_t{Tile::width + 1} * (j - first_j_)];
    }

private:
    std::uint32_t first_i_ = 0, first_j_ = 0;
    std::vector<HalfCells> cells_;
};

}  // namespace geomend::grid
