// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <variant>

#include "model/objects.h"

namespace geomend {

/// Whether an object has no points, or no elements where its kind has some. Rasters and corner-point grids always have samples or cells.
inline bool holds_nothing(const Object& object) {
    struct Visitor {
        bool operator()(const PointSet& o) const { return o.points.empty(); }
        bool operator()(const PolylineSet& o) const { return o.points.empty(); }
        bool operator()(const Surface& o) const { return o.points.empty() || o.polygons.size() == 0; }
        bool operator()(const CellMesh& o) const { return o.points.empty() || o.cell_count() == 0; }
        bool operator()(const StructuredGrid& o) const { return o.points.empty(); }
        bool operator()(const Raster&) const { return false; }
        bool operator()(const Well& o) const { return o.path.empty() && o.markers.empty() && o.curves.empty(); }
        bool operator()(const CornerPointGrid&) const { return false; }
    };
    return std::visit(Visitor{}, object);
}

}  // namespace geomend
