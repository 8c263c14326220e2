// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/format.h"
#include "model/objects.h"

namespace geomend::horizon {

/// The lattice of a horizon grid as IRAP, ZMAP+ and CPS-3 state it. Sample (i, j) stands at (x0, y0) plus i times
/// xinc along the x axis and j times yinc along the y axis, both turned by `rotation` degrees anticlockwise.
struct GridFrame {
    std::uint32_t nx = 1, ny = 1;
    double x0 = 0, y0 = 0;
    double xinc = 1, yinc = 1;
    double rotation = 0;
};

/// The two step vectors; multiples of 90 degrees are exact.
std::array<Vec3, 2> steps_of(const GridFrame& frame);

/// A raster of heights over a frame, i fastest. `file_sign` says what the heights count: depths are negated, but for
/// missing ones. \pre as many heights (float or double) as samples
Raster make_horizon(const GridFrame& frame, AttributeValues heights, double no_data, ZPositive file_sign, bool sign_stated);

/// Heights listed column by column from the west, each from north to south (ZMAP+, CPS-3), in our order.
std::vector<double> rows_from_columns(const std::vector<double>& columns, std::uint32_t nx, std::uint32_t ny);

/// What a grid format can hold.
struct GridRules {
    std::string_view title;         ///< "IRAP classic grids", for messages
    bool rotation = false;          ///< else the axes must lie along x and y
    bool single_precision = false;  ///< header and heights are float32
    double no_data = 9999900.0;     ///< value for missing heights
    bool any_no_data = false;       ///< the format states its no-data value, so that any will do
    /// Whether a name can go into the header; nullptr where the format has no place for names.
    bool (*holds_name)(std::string_view) = nullptr;
};

/// A horizon grid in the terms of its target: what remains is to print it.
struct FileGrid {
    GridFrame frame;
    std::vector<double> heights;  ///< i fastest, in the file's sign, missing ones are no_data
    double no_data = 0;
    std::string name;
    const Raster* raster = nullptr;  ///< where it comes from
    std::size_t object_index = 0;    ///< of the raster in its dataset
    std::size_t height_index = 0;    ///< of the attribute that is the height
};

/// Finds the one raster of a dataset that the target holds and turns it into the target's terms; everything that does
/// not go in, of the raster and of the dataset, is added to `losses`. Failure (cannot_hold) when there is no horizon grid
/// that can be held, (usage) when an option is wrong. Options: z=depth|elevation, height=ATTRIBUTE.
/// \param out  gives the name that a reader of the file will see
Result<FileGrid> grid_for_writing(const Dataset& dataset, const GridRules& rules, const OutputSet& out, const WriteOptions& options,
                                  std::vector<Loss>& losses);

/// Smallest and largest height that is not missing; zeros where all are.
std::array<double, 2> height_range(const FileGrid& grid);

}  // namespace geomend::horizon
