// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>

// Large Gocad files that are made up on the spot.

namespace geomend::bench {

/// A Model3d of 880 surfaces, 776,000 triangles and 42 MB: coordinates are float32 offsets from a local origin printed
/// with 17 digits, as Gocad prints them.
std::string synthetic_model();

/// A TSolid of 584,000 tetrahedra with one property and the surfaces behind their facets, 47 MB.
std::string synthetic_solid();

}  // namespace geomend::bench
