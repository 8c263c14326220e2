// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

#include "validators/model_scope.h"

// The checks of boundary representations; the table that joins them is in registry.cpp. Each adds one finding for an
// entity, or for a pair of entities, and none where all is well. A function may tell several codes.

namespace geomend::validators {

inline constexpr double smallest_angle = 1;          ///< Q01, degrees
inline constexpr double smallest_fold_angle = 10;    ///< Q03, degrees
inline constexpr double smallest_contact_angle = 5;  ///< Q04, degrees

void check_near_points(const ModelScope&, std::vector<Finding>&);         // M01
void check_isolated_points(const ModelScope&, std::vector<Finding>&);     // M02
void check_degenerate(const ModelScope&, std::vector<Finding>&);          // B01
void check_flat_triangles(const ModelScope&, std::vector<Finding>&);      // M03
void check_repeats(const ModelScope&, std::vector<Finding>&);             // M04
void check_winding(const ModelScope&, std::vector<Finding>&);             // M05 M06
void check_holes(const ModelScope&, std::vector<Finding>&);               // M07
void check_manifold(const ModelScope&, std::vector<Finding>&);            // B03
void check_pieces(const ModelScope&, std::vector<Finding>&);              // B04
void check_region_closed(const ModelScope&, std::vector<Finding>&);       // B05
void check_model_closed(const ModelScope&, std::vector<Finding>&);        // B06 of models that state regions
void check_seams(const ModelScope&, std::vector<Finding>&);               // B07
void check_openings(const ModelScope&, std::vector<Finding>&);            // B06 B29
void check_free_ends(const ModelScope&, std::vector<Finding>&);           // B09
void check_leaks(const ModelScope&, std::vector<Finding>&);               // B12 B25
void check_stated_regions(const ModelScope&, std::vector<Finding>&);      // B13
void check_stated_sides(const ModelScope&, std::vector<Finding>&);        // B30
void check_universe(const ModelScope&, std::vector<Finding>&);            // B31
void check_region_overlap(const ModelScope&, std::vector<Finding>&);      // B14
void check_thin_regions(const ModelScope&, std::vector<Finding>&);        // B15
void check_outside_surfaces(const ModelScope&, std::vector<Finding>&);    // B16
void check_radial_order(const ModelScope&, std::vector<Finding>&);        // B17
void check_stated_borders(const ModelScope&, std::vector<Finding>&);      // B19
void check_intersections(const ModelScope&, std::vector<Finding>&);       // B02 B08 B10 B11 B20 B22 B26 B27 B28
void check_shared_points(const ModelScope&, std::vector<Finding>&);       // B22
void check_near_misses(const ModelScope&, std::vector<Finding>&);         // B23 B24
void check_names_of_model(const ModelScope&, std::vector<Finding>&);      // G01 G06 G08
void check_region_lists(const ModelScope&, std::vector<Finding>&);        // G02
void check_fault_displacement(const ModelScope&, std::vector<Finding>&);  // G03
void check_horizon_order(const ModelScope&, std::vector<Finding>&);       // G04
void check_horizons_pass(const ModelScope&, std::vector<Finding>&);       // G05
void check_list_members(const ModelScope&, std::vector<Finding>&);        // G07
void check_layer_lists(const ModelScope&, std::vector<Finding>&);         // G09
void check_triangle_angles(const ModelScope&, std::vector<Finding>&);     // Q01
void check_short_edges(const ModelScope&, std::vector<Finding>&);         // Q02
void check_folds(const ModelScope&, std::vector<Finding>&);               // Q03
void check_contact_angles(const ModelScope&, std::vector<Finding>&);      // Q04

/// Errors that say that a surface itself is wrong, and so the regions that it bounds.
inline constexpr std::array<std::string_view, 9> own_errors = {"B01", "B02", "B03", "B04", "B07", "B26", "B27", "M04", "M05"};

/// Entities that are not valid because a finding with an error is about one that bounds them: B18, one for each region.
void spread_errors(const ModelScope&, std::vector<Finding>&);

}  // namespace geomend::validators
