// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "model/brep.h"
#include "remesh/size_rules.h"

namespace geomend {

/// The sizes that cells of a model are to have.
struct WantedSizes {
    double size = 0;                                               ///< 0: those of triangles, which are there
    std::span<const std::pair<std::string, double>> of_regions{};  ///< by name
    std::span<const remeshing::SizeRule> rules{};                  ///< those by distance have a say
    double further = 0;                                            ///< cells that are wanted by anything else
};

/// Failure (limit, F023) where sizes make more cells than that, with their number, and sizes that would do. The number is an estimate: the
/// volume of regions by that of a cell, and around surfaces with a rule as sizes change with the distance. Linear in the triangles of
/// these.
Result<void> check_cell_number(const BrepData& brep, const WantedSizes& sizes, std::uint64_t most);

/// The same for a lattice with steps of these lengths.
Result<void> check_lattice(const BrepData& brep, const Vec3& steps, std::uint64_t most);

}  // namespace geomend
