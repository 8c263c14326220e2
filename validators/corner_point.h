// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "validators/cell_findings.h"

// The checks of corner-point grids, one function per code; the table that joins them is in registry.cpp. Each adds one
// finding to the list, or none where all is well (C04 and C18 one for each of the two things that they tell apart, C23 and
// C24 one for each array, C25 one for faults with multipliers and one for others).

namespace geomend::validators {

// Bounds of what is merely worth knowing. `geomend checks` prints them.
inline constexpr double least_angle = 10;       ///< C09, degrees
inline constexpr double greatest_angle = 170;   ///< C09, degrees
inline constexpr double largest_aspect = 1000;  ///< C22, longest over shortest mean edge

void check_coordinates(const GridScope&, std::vector<Finding>&);          // C02
void check_inverted(const GridScope&, std::vector<Finding>&);             // C03
void check_vertical_neighbours(const GridScope&, std::vector<Finding>&);  // C04
void check_collapsed(const GridScope&, std::vector<Finding>&);            // C05
void check_wedges(const GridScope&, std::vector<Finding>&);               // C06
void check_inside_out(const GridScope&, std::vector<Finding>&);           // C07
void check_concave(const GridScope&, std::vector<Finding>&);              // C08
void check_angles(const GridScope&, std::vector<Finding>&);               // C09
void check_flat_pillars(const GridScope&, std::vector<Finding>&);         // C10
void check_crossing_pillars(const GridScope&, std::vector<Finding>&);     // C11
void check_handedness(const GridScope&, std::vector<Finding>&);           // C12
void check_map_axes(const GridScope&, std::vector<Finding>&);             // C13
void check_activity(const GridScope&, std::vector<Finding>&);             // C15
void check_pore_volumes(const GridScope&, std::vector<Finding>&);         // C16
void check_parts(const GridScope&, std::vector<Finding>&);                // C17
void check_fault_throws(const GridScope&, std::vector<Finding>&);         // C18
void check_single_precision(const GridScope&, std::vector<Finding>&);     // C19
void check_fault_boxes(const GridScope&, std::vector<Finding>&);          // C20
void check_isolated(const GridScope&, std::vector<Finding>&);             // C21
void check_flat_cells(const GridScope&, std::vector<Finding>&);           // C22
void check_scattered_regions(const GridScope&, std::vector<Finding>&);    // C23
void check_region_numbers(const GridScope&, std::vector<Finding>&);       // C24
void check_fault_effects(const GridScope&, std::vector<Finding>&);        // C25
void check_shared_fault_faces(const GridScope&, std::vector<Finding>&);   // C26
void check_stated_connections(const GridScope&, std::vector<Finding>&);   // C29
void check_radial_angles(const GridScope&, std::vector<Finding>&);        // C31
void check_idle_faults(const GridScope&, std::vector<Finding>&);          // G03

/// Active cells that touch no other, where there is more than one active cell; ascending. What C21 tells of cells.
std::vector<std::size_t> isolated_cells(const GridScope&);

/// C01: what the lengths of the arrays say. The other checks need it to find nothing.
void check_array_lengths(const CornerPointGrid&, std::vector<Finding>&);

}  // namespace geomend::validators
