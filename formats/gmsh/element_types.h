// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "model/objects.h"

namespace geomend::gmsh {

/// What an MSH element type is in our model. Numbers and node orders are those of the section "MSH file format"
/// and "Node ordering" of the Gmsh reference manual.
struct ElementType {
    int number = 0;  ///< MSH type number
    CellType cell = CellType::vertex;
    std::uint32_t nodes = 0;              ///< nodes of the element in the file
    std::uint32_t kept = 0;               ///< nodes of `cell`; fewer than `nodes` where we have no such cell type
    const std::uint8_t* order = nullptr;  ///< node i of the cell is node order[i] of the element; nullptr: the same
    int dimension = 0;
};

/// The row of an MSH type number, or nullptr where it is not known or cannot be read (polygons, sub-elements).
const ElementType* element_type(std::int64_t number);

/// The row of the MSH type that holds a cell exactly, or nullptr.
const ElementType* element_type_of(CellType cell);

/// Largest number of nodes of an element that is written.
inline constexpr std::uint32_t most_written_nodes = 27;

/// Nodes of a cell in the order of MSH.
inline void file_order(const ElementType& type, std::span<const std::uint32_t> cell, std::uint32_t* to) {
    if (type.order == nullptr) {
        for (std::uint32_t i = 0; i < type.nodes; ++i) to[i] = cell[i];
    } else {
        for (std::uint32_t i = 0; i < type.nodes; ++i) to[type.order[i]] = cell[i];
    }
}

}  // namespace geomend::gmsh
