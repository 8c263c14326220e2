// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

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

/// Gives attributes whose names are equal names that differ: "x", "x (2)", ... Values of points stand apart from those of
/// edges, polygons and cells, which go into one section of a file. \return whether any name was changed
inline bool make_names_differ(std::vector<Attribute>& attributes) {
    const auto section = [](const Attribute& a) {
        return a.location == AttributeLocation::polygon || a.location == AttributeLocation::edge ? AttributeLocation::cell : a.location;
    };
    std::set<std::pair<AttributeLocation, std::string>> names, used;
    for (const Attribute& a : attributes) names.insert({section(a), a.name});
    if (names.size() == attributes.size()) return false;
    for (Attribute& a : attributes) {
        if (used.insert({section(a), a.name}).second) continue;
        std::string name;
        for (int n = 2; name.empty() || !names.insert({section(a), name}).second; ++n) name = a.name + " (" + std::to_string(n) + ")";
        a.annotations.emplace_back(own_name_key, std::exchange(a.name, std::move(name)));
    }
    return true;
}

/// A copy in which the attributes of each object have different names; nothing where they have so already, which is usual.
inline std::optional<Dataset> with_different_names(const Dataset& dataset) {
    std::optional<Dataset> copy;
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) {
        std::vector<Attribute> words;
        for (const Attribute& a : info_of(dataset.objects[i]).attributes) {
            words.emplace_back();
            words.back().name = a.name;
            words.back().location = a.location;
        }
        if (!make_names_differ(words)) continue;
        if (!copy) copy = dataset;
        make_names_differ(info_of(copy->objects[i]).attributes);
    }
    return copy;
}

}  // namespace geomend
