// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "model/object_info.h"

// Looking up what travels with objects and attributes. Only the family that stated an annotation looks for its key.

namespace geomend {

/// The text of the first annotation with a key, or nullptr. Linear in the annotations.
inline const std::string* find_annotation(const Attribute& a, std::string_view key) {
    for (const auto& [k, value] : a.annotations) {
        if (k == key) return &value;
    }
    return nullptr;
}
inline const std::string* find_annotation(const ObjectInfo& info, std::string_view key) {
    for (const Annotation& a : info.annotations) {
        if (a.key == key) return &a.value;
    }
    return nullptr;
}

/// The same, empty where there is none. \param of an Attribute or an ObjectInfo, which outlives the result
template <class Annotated>
std::string_view annotation(const Annotated& of, std::string_view key) {
    const std::string* text = find_annotation(of, key);
    return text == nullptr ? std::string_view() : std::string_view(*text);
}

}  // namespace geomend
