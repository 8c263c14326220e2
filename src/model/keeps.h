// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

namespace geomend {

enum class Keeping : std::uint8_t { no, partly, yes };

/// What a format can hold; a row of `geomend formats`.
struct Keeps {
    Keeping points = Keeping::no;
    Keeping polylines = Keeping::no;
    Keeping surfaces = Keeping::no;
    Keeping polygons = Keeping::no;  ///< faces with more than three corners
    Keeping cells = Keeping::no;
    Keeping polyhedra = Keeping::no;
    Keeping structured_grids = Keeping::no;
    Keeping rasters = Keeping::no;
    Keeping corner_point_grids = Keeping::no;
    Keeping fault_faces = Keeping::no;  ///< named sets of cell faces
    Keeping connections = Keeping::no;  ///< between cells that are not neighbours
    Keeping wells = Keeping::no;
    Keeping brep = Keeping::no;  ///< surfaces, regions and their sides
    Keeping several_objects = Keeping::no;
    Keeping names = Keeping::no;
    Keeping roles = Keeping::no;  ///< fault, horizon, ...
    Keeping attributes = Keeping::no;
    Keeping units = Keeping::no;  ///< of attributes and axes
    Keeping no_data = Keeping::no;
    Keeping crs = Keeping::no;
    Keeping exact_coordinates = Keeping::no;  ///< doubles come back bit by bit
};

}  // namespace geomend
