// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/attribute.h"

#include <limits>
#include <type_traits>

namespace geomend {

std::size_t value_count(const Attribute& a) {
    return std::visit([](const auto& v) { return v.size(); }, a.values);
}

double value_as_double(const Attribute& a, std::size_t i) {
    return std::visit(
        [i](const auto& v) -> double {
            using Value = typename std::decay_t<decltype(v)>::value_type;
            if constexpr (std::is_arithmetic_v<Value>) return static_cast<double>(v[i]);
            else return std::numeric_limits<double>::quiet_NaN();
        },
        a.values);
}

const char* type_name(const AttributeValues& values) {
    constexpr const char* names[] = {"float64", "float32", "int8",  "uint8",  "int16", "uint16",
                                     "int32",   "uint32",  "int64", "uint64", "string"};
    return names[values.index()];
}

const char* to_string(AttributeLocation location) {
    constexpr const char* names[] = {"point", "edge", "polygon", "cell", "pillar", "object"};
    return names[static_cast<std::size_t>(location)];
}

bool is_no_data(const Attribute& a, double value) {
    if (!a.no_data) return false;
    return value == *a.no_data || static_cast<float>(value) == static_cast<float>(*a.no_data);
}

Attribute without_values(const Attribute& a) {
    Attribute copy;
    copy.name = a.name;
    copy.location = a.location;
    copy.components = a.components;
    copy.unit = a.unit;
    copy.kind = a.kind;
    copy.property_class = a.property_class;
    copy.no_data = a.no_data;
    copy.legal_min = a.legal_min;
    copy.legal_max = a.legal_max;
    copy.component_names = a.component_names;
    copy.code_names = a.code_names;
    copy.corner_values = a.corner_values;
    copy.time = a.time;
    copy.annotations = a.annotations;
    return copy;
}

const Attribute* find_attribute(const std::vector<Attribute>& all, const std::string& name, AttributeLocation location) {
    for (const Attribute& a : all) {
        if (a.name == name && a.location == location) return &a;
    }
    return nullptr;
}

}  // namespace geomend
