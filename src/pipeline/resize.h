// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
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
    std::uint64_t cells = 0, above = 0, without_energy = 0;  /// as of volumes::StressError
    double allowed = 0, whole = 0, largest = 0;
    double least_size = 0, largest_size = 0;  ///< that cells should have
};

struct Resized {
    ResizeReport report;
    std::vector<volumes::SizedPoint> sizes;
};

/// Reads tetrahedra with six (or, as a whole matrix, nine) components of stress for each, estimates the error, and gives the sizes that
/// cells should have at their points. Stress may jump between the regions that the file states; of the properties with as many components
/// it is the only one, or that called stress or S. Where cells have a property called young it is their modulus.
/// Failure as of load(), or (cannot_hold, F026) where there are no tetrahedra, other cells, or no such property.
Result<Resized> sizes_by_stress(const ResizeRequest& request, const LoadOptions& options);

Json resize_json(const ResizeReport& report);
std::string resize_text(const ResizeReport& report);

}  // namespace geomend
