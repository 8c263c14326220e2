// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/dataset.h"

// XML holds text in UTF-8 and no control characters. Names that are not so stand in the file as near as it allows, with their own
// beside them (model/attribute_names.h), so that we read the same names again.

namespace geomend::vtk {

/// The name as XML can hold it: bytes that are not UTF-8 are taken as Latin-1, control characters become blanks.
std::string xml_name(std::string_view name);

/// Whether XML can hold the names of all attributes, and its readers tell them apart.
bool has_xml_names(const std::vector<Attribute>& attributes);

/// Gives attributes names that XML can hold and that differ from each other.
void make_xml_names(std::vector<Attribute>& attributes);

/// A copy whose attributes have such names; nothing where all have so already, which is usual.
std::optional<Dataset> with_xml_names(const Dataset& dataset);

}  // namespace geomend::vtk
