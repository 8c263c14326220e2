// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "validators/object_scope.h"

// The checks of objects that are judged one by one; the table that joins them is in registry.cpp. Each looks at the kinds of
// objects that it knows, adds one finding where something is wrong, and none where all is well or the kind is another.

namespace geomend::validators {

void check_point_positions(const ObjectScope&, std::vector<Finding>&);  // M01 M10
void check_unused_points(const ObjectScope&, std::vector<Finding>&);    // M02
void check_edge_lengths(const ObjectScope&, std::vector<Finding>&);     // M11
void check_edge_repeats(const ObjectScope&, std::vector<Finding>&);     // M12
void check_line_meetings(const ObjectScope&, std::vector<Finding>&);    // M13 M14
void check_measured_depths(const ObjectScope&, std::vector<Finding>&);  // M30 M33
void check_path_stops(const ObjectScope&, std::vector<Finding>&);       // M31
void check_along_path(const ObjectScope&, std::vector<Finding>&);       // M32
void check_log_depths(const ObjectScope&, std::vector<Finding>&);       // M34
void check_raster_axes(const ObjectScope&, std::vector<Finding>&);      // M40 M41
void check_property_values(const ObjectScope&, std::vector<Finding>&);  // M42 M43
void check_lattice_cells(const ObjectScope&, std::vector<Finding>&);    // M20 M21
void check_lattice_layers(const ObjectScope&, std::vector<Finding>&);   // M50

}  // namespace geomend::validators
