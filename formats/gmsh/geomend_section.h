// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/gmsh/write_plan.h"

namespace geomend::gmsh {

/// The line of the $Geomend section: dataset_text of what a reader will find, which is one mesh with the plan's
/// entities and the described attributes. Contains no '$', which clients look for.
std::string geomend_line(const Dataset& dataset, const CellMesh& mesh, const WritePlan& plan, const std::vector<Attribute>& described,
                         bool v41, std::vector<Loss>& losses);

/// Applies such a line to a Dataset of one mesh; a line of someone else's making changes what it can and no more.
void apply_geomend_line(std::string_view line, Dataset& dataset);

}  // namespace geomend::gmsh
