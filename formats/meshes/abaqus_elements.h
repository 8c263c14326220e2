// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "model/objects.h"

namespace geomend::meshes {

/// What Abaqus calls elements of a type and how it orders their nodes: per node of Abaqus ours. In collapsed elements several are the same.
struct AbaqusElement {
    CellType type;
    std::string_view name;  ///< as written; variants (C3D8R, C3D10M) begin with it
    std::span<const std::uint8_t> order;
    std::span<const std::uint8_t> faces;  ///< per face of ours the number of Abaqus' face; empty but for solids
};

/// All types of elements that are read or written.
std::span<const AbaqusElement> abaqus_elements();

/// The row of a type of cell, or nullptr.
const AbaqusElement* abaqus_element_of(CellType type);

/// The same as it is written: pyramids as collapsed C3D8, since CalculiX and Abaqus/Standard of old know no C3D5.
const AbaqusElement* abaqus_element_written(CellType type);

/// What a C3D8 is that names nodes several times, whichever way it is turned: a tetrahedron, a pyramid or a prism. nullptr where it is none
/// of these.
/// \pre eight nodes
const AbaqusElement* abaqus_collapsed(std::span<const std::int64_t> nodes);

/// The row of an element by the name that a deck has for it (upper case): C3D8R is C3D8, S4R, M3D4 and CPS4 are quads, B31 and T3D2 lines.
/// nullptr where it is none of these.
const AbaqusElement* abaqus_element_called(std::string_view name);

}  // namespace geomend::meshes
