// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <type_traits>

#include "model/attribute.h"

namespace geomend {

/// Gives floating-point values the opposite sign, as heights between elevation and depth; no-data values stay. Linear.
inline void turn_signs(Attribute& attribute) {
    std::visit(
        [&](auto& values) {
            using Value = typename std::decay_t<decltype(values)>::value_type;
            if constexpr (std::is_floating_point_v<Value>) {
                for (Value& v : values) {
                    if (!is_no_data(attribute, v)) v = -v;
                }
            }
        },
        attribute.values);
}

}  // namespace geomend
