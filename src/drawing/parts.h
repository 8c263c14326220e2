// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/objects.h"
#include "report/scene.h"

// Objects as parts of a scene. Only for sources of this room.

namespace geomend::scene {

/// The polygon as a fan of its first corner.
void add_fan(std::span<const std::uint32_t> polygon, std::vector<std::array<std::uint32_t, 3>>& triangles);

/// The faces of a cell, by corner nodes; none for cells without volume.
std::vector<std::vector<std::uint32_t>> faces_of_cell(const CellMesh& mesh, std::size_t cell);

/// Parts of a corner-point grid: for each side and each fault the sides of present cells that face no cell, or one whose
/// corners lie elsewhere. Sides are whole, so that both cells at a fault show theirs; where a face is stated to lie on a
/// fault it is in the part of that name. Cells with corners that are not finite are left out. Cost: linear.
void add_parts(const CornerPointGrid& grid, std::vector<ScenePart>& parts);

/// Parts of any other object; grids of cells by their outside.
void add_parts(const Object& object, std::vector<ScenePart>& parts);

/// Whether all corners of a cell are finite and less than 1e20.
bool is_finite(const std::array<Vec3, 8>& corners);

/// Corners of a cell, elevation-up.
std::array<Vec3, 8> elevated_corners(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k);

}  // namespace geomend::scene
