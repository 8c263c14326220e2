// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/brep.h"
#include "repair/surface_model.h"

namespace geomend::repair {

/// Gives a surface of a mended model the values of the patch that it is a piece of: at each node those at the place of its
/// triangle's source, so that the two sides of a contact keep their own.
/// \param triangles per polygon of the surface its triangle in model.model.soup
/// \pre the polygons are these triangles, each with its corners in any order
void carry_values(const SurfaceModel& model, std::uint32_t patch, std::span<const std::uint32_t> triangles, std::span<const Vec3> vertices,
                  BrepData::Surface& surface);

}  // namespace geomend::repair
