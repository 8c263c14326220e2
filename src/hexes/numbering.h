// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hexes/closing.h"

namespace geomend::hexes {

/// Whether somebody who reads the mesh takes a cell with its corners numbered this way.
using CellCheck = std::function<bool(CellType, std::span<const Vec3>)>;

/// Whether a check takes a prism or pyramid in one of the numberings of its corners that do not turn it inside out.
bool is_taken(const CellCheck& check, CellType type, std::span<const Vec3> corners);

/// Numbers the corners of prisms and pyramids so that a check takes them, the numbering at hand first; what is known of their faces
/// follows. \return the cells that it takes in no numbering, ascending. Cost: as of the check for each.
std::vector<std::uint32_t> number_corners(MixedMesh& mesh, const CellCheck& check);

/// Which of the first `count` cells of a mesh are among some, or share a quadrangle with one of them; ascending. n log n.
std::vector<std::uint32_t> beside_cells(const MixedMesh& mesh, std::span<const std::uint32_t> some, std::size_t count);

}  // namespace geomend::hexes
