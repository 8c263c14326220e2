// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "model/brep.h"

namespace geomend::test {

/// What a mesher made of a boundary representation.
struct Meshed {
    bool done = false;            ///< it ended well and wrote cells
    std::vector<double> volumes;  ///< of the regions that it filled, ascending
    std::string log;              ///< what it printed
};

bool has_tetgen();
bool has_gmsh();

/// Runs `tetgen -pA` on all polygons of the surfaces, each its own facet, over the model's vertices.
Meshed mesh_with_tetgen(const BrepData& brep);

/// Converts a file into a Gmsh script and runs `gmsh -3` on that.
Meshed mesh_with_gmsh(const std::string& model_file);

/// The volumes of a model's regions, ascending.
std::vector<double> region_volumes(const BrepData& brep);

}  // namespace geomend::test
