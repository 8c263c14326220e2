// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/dataset.h"

// Several objects in a file that has room for one dataset: their cells and points stand one after another, an array
// tells whose they are, and they come back apart.

namespace geomend::vtk {

/// Objects as one mesh, and the text that takes them apart again.
struct Merged {
    CellMesh mesh;
    std::string text;
};

/// \pre mesh_from_object works on each. Attributes of the same name, location, type and number of components share an
/// array (NaN or 0 where an object has none); others get a name of their own.
Merged merge_objects(const std::vector<Object>& objects);

/// The objects behind a merged one, or nothing where the text is another or does not fit (then `merged` is as it was).
/// \param merged the object as read: a mesh, a surface, ... Its field attributes go to the first object.
std::vector<Object> split_objects(std::string_view text, Object& merged);

/// The path of a well as a line, with its measured depth; markers, zones and curves are losses of substance.
PolylineSet polyline_of_well(const Well& well, std::vector<Loss>& losses);

/// A dataset for dataset_text(): the words of the given objects (which stand for source[i] of the dataset), without their
/// geometry, and the models where they still fit.
Dataset text_only(const Dataset& dataset, const std::vector<Object>& objects, const std::vector<std::size_t>& source);

}  // namespace geomend::vtk
