// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/brep.h"
#include "remesh/line_plan.h"

namespace geomend::remeshing {

/// Sizes at the vertices of a model. \param of sizes of interfaces or surfaces by name; vertices of several have the least
std::vector<double> entity_sizes(const BrepData& brep, double size, std::span<const std::pair<std::string, double>> of);

/// Lowers sizes until they grow along no edge of a surface by more than a share of its length. Cost: n log n in the vertices that
/// change.
void grade(const BrepData& brep, double growth, std::vector<double>& sizes);

/// Lowers sizes where two lines of a surface run close to one another, so that triangles between them can be near equilateral.
/// Lines that leave a corner at more than some 40 degrees are not close there.
/// \param least where sizes would be less, they stay: no edge of a fair length makes a good triangle there, and short ones many bad ones
void limit_by_width(const BrepData& brep, const LinePlan& lines, double least, std::vector<double>& sizes);

}  // namespace geomend::remeshing
