// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pipeline/json_parts.h"
#include "pipeline/load.h"
#include "volume/tetrahedra.h"

namespace geomend {

/// What the user wants of sizes by the error of a calculation.
struct ResizeRequest {
    std::string file;       ///< tetrahedra with their stress
    double allowed = 0.05;  ///< error, as a share
    double poisson = 0.25;  ///< ratio of the rock
};

/// What the stress of the file says.
struct ResizeReport {
    std::string stress;                                      ///< the name of the property
    std::string place;                                       ///< where the result and the model do not lie in one place; else empty
    std::uint64_t cells = 0, above = 0, without_energy = 0;  /// as of volumes::StressError
    double allowed = 0, whole = 0, largest = 0;
    double wanted_cells = 0;                  ///< about how many cells have the sizes that they should
    double least_size = 0, largest_size = 0;  ///< that cells should have
};

struct Resized {
    ResizeReport report;
    std::vector<volumes::SizedPoint> sizes;
};

/// Reads tetrahedra with their stress, see stressed_cells(), estimates the error, and gives the sizes that cells should have at their
/// points. \param model points of the model that is meshed: the result must lie there Failure as of load() and stressed_cells(); the
/// latter, too, where the result covers less than half of the box around the model.
Result<Resized> sizes_by_stress(const ResizeRequest& request, const LoadOptions& options, std::span<const Vec3> model);

Json resize_json(const ResizeReport& report);
std::string resize_text(const ResizeReport& report);

}  // namespace geomend
