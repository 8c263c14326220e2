// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend::grid {

/// The triangles that stand for a face: the fan of its corner of lowest number, which is also how the volume of a
/// polyhedron sees the face. Where points lie on a straight edge at that corner, the fan would have triangles without
/// area; there the triangle behind them is divided instead, which is the same surface. Triangles two of whose corners
/// are at one position are left out.
/// \param polygon numbers into points, at least 3
/// \param triangles gets the triangles, wound like the polygon; it is emptied first. Cost: linear.
void face_triangles(std::span<const std::uint32_t> polygon, std::span<const Vec3> points,
                    std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace geomend::grid
