// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "model/objects.h"

// What an object has besides points, cells and values, and which VTK has no word for: parts, labels, named
// sets, entities, twins. It goes along as one more line of JSON (names and roles are in dataset_text) and as arrays
// whose names begin with "geomend.".

namespace geomend::vtk {

/// Name of the field array that holds dataset_text(), and of the one that holds structure_text().
inline constexpr std::string_view text_field = "geomend";
inline constexpr std::string_view structure_field = "geomend.structure";

/// The structure of an object as one line of JSON.
std::string structure_text(const Object& object);

/// Arrays for what is per point or per cell: labels, twins, sets, entity of each cell. To be added to the attributes of
/// the object that is written (locations are those of the object).
std::vector<Attribute> structure_arrays(const Object& object);

/// Puts back what the two functions gave, and takes the arrays out of the object's attributes. What does not
/// fit the object (edited by others meanwhile) is passed over. The object may become one of another kind
/// (a mesh of triangles that was a surface). \return false where the text is not such a text
bool restore_structure(std::string_view text, Object& object);

/// Spacing and direction of an image for the steps of a raster (VTK: step = spacing times column of the matrix,
/// row-major). Exact for steps along the axes.
struct ImageAxes {
    std::array<double, 3> spacing{1, 1, 1};
    std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};
};
ImageAxes image_axes(const Raster& raster);

}  // namespace geomend::vtk
