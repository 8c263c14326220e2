// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "gridding/structure_of.h"

namespace geomend::gridding {

/// Adds the faults that polylines in plan stand for: each closed part is the ring around where a horizon is torn apart, each open part a
/// trace. Sets of several horizons are brought together: parts of one name, or whose middle lines are nearest each other in plan, are one
/// fault. A horizon without rings of its own has those of the nearest horizon with some.
/// Failure: (usage) where options.fault_polygons names what is not there.
Result<void> add_fault_lines(const Dataset& dataset, const StructureOptions& options, bool height_is_depth, FoundStructure& found);

}  // namespace geomend::gridding
