// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "gridding/structure.h"
#include "model/dataset.h"

namespace geomend::gridding {

/// What the user says of the inputs.
struct StructureOptions {
    std::vector<std::string> horizons;        ///< names, top to base; empty: all, by their mean depths
    std::vector<std::string> fault_polygons;  ///< per horizon the name of its polygons or "-"; empty: by their depths
    std::vector<std::string> erodes, lapped;  ///< names of horizons
    std::vector<std::string> leave_out;       ///< names of horizons and faults
    std::optional<std::size_t> area;          ///< the object whose lines say where the grid is: they are no faults
    double least_dip = 30;                    ///< degrees; faults that are flatter are no faults of pillars
};

/// Something of the inputs that is not in the structure.
struct LeftOut {
    std::string name, why;
};

struct FoundStructure {
    Structure structure;
    std::vector<Point> outline;  ///< places whose hull is where all horizons are
    bool is_boxed = false;       ///< surfaces close it at its sides
    std::vector<LeftOut> left_out;
    std::vector<std::string> notes;  ///< what was taken for granted
};

/// Horizons and faults of a Dataset: maps and surfaces of horizons (surfaces of no stated role by how steep they are), surfaces of
/// faults, rings and lines in plan of faults. Surfaces of boundaries are horizons where they are flat. Where no input states the sign of
/// z and the heights of all maps are positive and increase in the order of the horizons, they are depths.
/// Failure: (usage) for a name that is not there; (cannot_hold, F027) for fewer than two horizons, or for faults flatter than the limit
/// that are not left out.
Result<FoundStructure> structure_of(const Dataset& dataset, const StructureOptions& options);

}  // namespace geomend::gridding
