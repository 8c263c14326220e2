// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "model/objects.h"

namespace geomend {

/// A face of a cell by the cell's own corner numbers, in cyclic order.
struct LocalFace {
    std::uint8_t count = 0;
    std::array<std::uint8_t, 6> numbers{};

    std::span<const std::uint8_t> corners() const { return {numbers.data(), count}; }
};

/// The faces of a cell type, in the numbering that (cell, local face) means everywhere: normals point out of a cell in VTK's
/// order. Second-order types have those of their corners. Empty for other dimensions and for polyhedra, whose faces are stated.
std::span<const LocalFace> faces_of(CellType type);

/// The edges of a cell type by the cell's own corner numbers, lower number first, ascending. Empty as for faces_of().
std::span<const std::array<std::uint8_t, 2>> edges_of(CellType type);

}  // namespace geomend
