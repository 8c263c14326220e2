// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/box_tree.h"
#include "model/objects.h"

namespace geomend::gridding {

/// What of an object lies at a place: rows of its attributes, or no_index.
struct RowsAt {
    std::uint32_t point = no_index, cell = no_index;
};

/// Finds what of an object lies at places, elevation-up. Lattices: the nearest sample, whose own box is half a step wide to all sides,
/// and the cell between samples; along directions with one sample it holds everywhere, so that maps do at all heights. Cells: the cell
/// around the place and the nearest of its points. The object may be gone afterwards.
class PlaceFinder {
public:
    /// Nothing for objects without volume or samples: surfaces, lines, points, wells, meshes without cells, broken lattices.
    /// Cost: n log n in cells. \pre map axes of corner-point grids are applied
    static std::optional<PlaceFinder> of(const Object& object);
    /// Some cells of a corner-point grid; rows of cells are numbers of the grid's cells.
    static PlaceFinder of_cells(const CornerPointGrid& grid, std::span<const std::uint32_t> cells);

    /// Where cells overlap that of the lowest row. Cost: constant for lattices, logarithmic for cells.
    RowsAt at(const Vec3& place) const;
    /// How large its pieces are along x, y and z on average; infinite where they hold everywhere.
    const std::array<double, 3>& size() const { return size_; }

private:
    struct Lattice {
        std::array<std::uint32_t, 3> dims{};
        Vec3 origin{};
        std::array<Vec3, 3> rows{};  // of the inverse of the steps; zero for directions with one sample
        std::array<std::vector<double>, 3> coordinates;
    };
    std::optional<Lattice> lattice_;
    CellMesh mesh_;
    std::vector<std::uint32_t> cell_rows_, point_rows_;  // empty: cells and points are their own rows
    std::optional<BoxTree> tree_;
    std::vector<std::uint32_t> boxed_;  // per box its cell
    std::array<double, 3> size_{};

    static std::optional<PlaceFinder> of_raster(const Raster& raster);
    void take_cells();
    RowsAt in_lattice(const Vec3& place) const;
    bool holds(std::uint32_t cell, const Vec3& place) const;
};

}  // namespace geomend::gridding
