// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "repair/surface_model.h"

namespace geomend::repair {

/// Where a surface must be parted, so that it is manifold: a piece between lines that goes through an edge more than twice hangs together
/// around that edge. Parts that were apart when it was read, and were joined border to border, stay parts of their own. What still is not
/// manifold is parted into what goes straight through such edges and what ends or crosses there, along its sharpest bends.
/// \return edges of the soup between two triangles, ascending; none where all pieces are manifold. Near-linear.
std::vector<std::array<std::uint32_t, 2>> self_joints(const SurfaceModel& model);

}  // namespace geomend::repair
