// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/dataset.h"

// VTK and MSH tell the values of a file apart by their names alone: of two arrays with one name their readers keep one.

namespace geomend {

/// Annotation of an attribute that has another name in the file: its own name, which apply_dataset_text gives back.
inline constexpr std::string_view own_name_key = "geomend.own_name";

/// What tells an attribute apart in a file: its name in the section of the points, or in that of the edges, polygons and
/// cells, or of the whole.
inline std::pair<AttributeLocation, std::string> file_name_of(const Attribute& a) {
    const bool cells = a.location == AttributeLocation::polygon || a.location == AttributeLocation::edge;
    return {cells ? AttributeLocation::cell : a.location, a.name};
}

/// Whether a file could not tell all of them apart.
inline bool has_equal_names(const std::vector<Attribute>& attributes) {
    std::set<std::pair<AttributeLocation, std::string>> names;
    for (const Attribute& a : attributes) {
        if (!names.insert(file_name_of(a)).second) return true;
    }
    return false;
}

/// Gives attributes whose names are equal names that differ: "x", "x (2)", ... Others stay as they are.
inline void make_names_differ(std::vector<Attribute>& attributes) {
    if (!has_equal_names(attributes)) return;
    std::set<std::pair<AttributeLocation, std::string>> names, used;
    for (const Attribute& a : attributes) names.insert(file_name_of(a));
    for (Attribute& a : attributes) {
        if (used.insert(file_name_of(a)).second) continue;
        std::string own = a.name;
        for (int n = 2; a.name == own || !names.insert(file_name_of(a)).second; ++n) a.name = own + " (" + std::to_string(n) + ")";
        a.annotations.emplace_back(own_name_key, std::move(own));
    }
}

/// A copy in which the attributes of each object have different names; nothing where they have so already, which is usual.
inline std::optional<Dataset> with_different_names(const Dataset& dataset) {
    const auto equal = [](const Object& object) { return has_equal_names(info_of(object).attributes); };
    if (std::ranges::none_of(dataset.objects, equal)) return {};
    Dataset copy = dataset;
    for (Object& object : copy.objects) make_names_differ(info_of(object).attributes);
    return copy;
}

}  // namespace geomend
