// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>

#include "base/vec3.h"
#include "model/brep.h"

namespace geomend::hexes {

/// The directions at right angles that the normals of a model's surfaces follow best: those of a box's sides, however it is turned, and
/// also where layers inside of it dip. They are named so that they are close to x, y and z. Cost: linear in triangles.
std::array<Vec3, 3> main_axes(const BrepData& brep);

}  // namespace geomend::hexes
