// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/brep.h"

namespace geomend::remeshing {

/// Sizes at the vertices of a model. \param of sizes of interfaces or surfaces by name; vertices of several have the least
std::vector<double> entity_sizes(const BrepData& brep, double size, std::span<const std::pair<std::string, double>> of);

/// Lowers sizes until they grow along no edge of a surface by more than a share of its length. Cost: n log n in the vertices that
/// change.
void grade(const BrepData& brep, double growth, std::vector<double>& sizes);

}  // namespace geomend::remeshing
