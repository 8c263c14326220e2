// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "repair/surface_model.h"

namespace geomend::repair {

/// Triangles that stick out of the closed outer boundary of a model. The boundary is made of the patches that have no free border
/// at all, where these close around a volume by themselves; without such there is none, and nothing sticks out. Only patches
/// of which a part lies inside or on it lose what is outside.
/// \param keep per triangle of model.model.soup whether it is looked at
/// \pre the soup is cut: nothing crosses. Failure (internal) where it cannot be assembled. Cost: near-linear.
Result<std::vector<std::uint32_t>> outside_of_boundary(const SurfaceModel& model, std::span<const std::uint8_t> keep);

}  // namespace geomend::repair
