// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "model/dataset.h"

namespace geomend {

/// What a Dataset says besides its geometry and its values, as one line of JSON: for every object name, role,
/// feature, coordinate system, groups, annotations, labels' start, and the unit, kind, class, no-data, legal range
/// and annotations of every attribute (by name and location); entities' names and roles of cell meshes; and all of
/// `models`. Formats without a place for these things (VTK field data, MSH) carry this text along.
std::string dataset_text(const Dataset& dataset);

/// What of an object's info dataset_text() writes, but its attributes.
ObjectInfo words_of(const ObjectInfo& info);

/// Puts back what dataset_text gave: objects are matched by position, attributes by name and location, entities
/// by dimension and tag. Things that are not there any more are passed over. False (and nothing is changed) when
/// the text is not such a text.
bool apply_dataset_text(std::string_view text, Dataset& dataset);

}  // namespace geomend
