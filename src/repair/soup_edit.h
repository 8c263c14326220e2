// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "repair/surface_model.h"

namespace geomend::repair {

/// Triangles of each patch that hang together over edges that two of them share.
struct Parts {
    std::vector<std::uint32_t> of;  ///< per triangle its part; no_index where it is not looked at
    std::uint32_t count = 0;
};

/// \param keep per triangle whether it is looked at
/// Parts are numbered by their first triangles. Edges with more than two triangles of the patch join all of them. n log n.
Parts parts_of(const TriangleSoup& soup, std::span<const std::uint8_t> keep);

/// Leaves out triangles, and vertices that none uses any more. \param keep per triangle of model.model.soup. Linear.
void keep_triangles(SurfaceModel& model, std::span<const std::uint8_t> keep);

}  // namespace geomend::repair
