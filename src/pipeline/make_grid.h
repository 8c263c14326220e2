// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gridding/build_grid.h"
#include "gridding/map_volumes.h"
#include "gridding/structure_of.h"
#include "pipeline/convert.h"
#include "pipeline/grid_properties.h"

namespace geomend {

/// What the user wants of a grid.
struct GridRequest {
    ConvertRequest files;
    gridding::StructureOptions structure;  ///< names of horizons and fault polygons may be files, too
    std::string layers;                    ///< as of gridding::parse_layers(); empty: one layer a zone
    std::optional<std::array<std::uint32_t, 2>> cells;
    std::optional<std::array<double, 2>> size;
    std::optional<double> rotation;            ///< degrees from x to I, to the left; nothing: of the faults, or of the model's box
    std::optional<std::array<double, 4>> box;  ///< x0, x1, y0, y1, what the grid covers at least
    std::string area;                          ///< object or file with a ring: columns outside are inactive
    std::string pillars_of;                    ///< a file whose corner-point grid gives the pillars
    gridding::GridOptions options;             ///< zones are made from `layers`
    PropertyRequest properties;
    bool count_connections = false;
    bool keep_made = false;  ///< the grid and the structure are wanted, too
};

/// What came of it.
struct GridMade {
    ConvertReport written;
    gridding::GridReport made;
    std::array<std::uint32_t, 3> dims{0, 0, 0};
    double rotation = 0;
    std::optional<std::uint64_t> nnc;              ///< pairs that touch; with a deck those that it has in a simulator
    std::vector<gridding::MapVolume> map_volumes;  ///< per zone, below active columns where maps have values; empty where not all are maps
    std::vector<std::string> regions;              ///< of a sealed model, by their numbers in REGION, from 1
    std::vector<gridding::LeftOut> left_out;
    std::vector<gridding::SampledProperty> properties;
    std::vector<std::string> notes;
    std::string beside;                   ///< an include with faults and regions that the format has no place for; empty: none is needed
    std::optional<CornerPointGrid> grid;  ///< where it is wanted
    std::optional<gridding::Structure> structure;  ///< as is this
    std::string deck;                              ///< the deck that was written beside the grid
};

/// Reads all inputs as one structural model, makes a corner-point grid of it and writes that.
/// Failure as of convert(), gridding::structure_of() and gridding::build_grid().
Result<GridMade> make_grid(GridRequest request);

/// What INTERFACE states of `grid --json`.
std::string grid_json(const GridMade& made);

}  // namespace geomend
