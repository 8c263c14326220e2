// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/xml_names.h"

#include <algorithm>

#include "base/utf8.h"
#include "model/attribute_names.h"

namespace geomend::vtk {

namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20; }

bool is_xml_name(std::string_view name) { return is_utf8(name) && std::ranges::none_of(name, is_control); }

}  // namespace

bool has_xml_names(const std::vector<Attribute>& attributes) {
    return !has_equal_names(attributes) && std::ranges::all_of(attributes, [](const Attribute& a) { return is_xml_name(a.name); });
}

std::string xml_name(std::string_view name) {
    std::string text = is_utf8(name) ? std::string(name) : latin1_to_utf8(name);
    std::ranges::replace_if(text, is_control, ' ');
    return text;
}

void make_xml_names(std::vector<Attribute>& attributes) {
    if (has_xml_names(attributes)) return;
    std::vector<std::string> own;
    for (Attribute& a : attributes) {
        own.push_back(a.name);
        a.name = xml_name(a.name);
    }
    make_names_differ(attributes);
    for (std::size_t i = 0; i < own.size(); ++i) {
        Attribute& a = attributes[i];
        if (a.name == own[i]) continue;
        std::erase_if(a.annotations, [](const auto& pair) { return pair.first == own_name_key; });
        a.annotations.emplace_back(own_name_key, std::move(own[i]));
    }
}

std::optional<Dataset> with_xml_names(const Dataset& dataset) {
    if (std::ranges::all_of(dataset.objects, [](const Object& object) { return has_xml_names(info_of(object).attributes); })) return {};
    Dataset copy = dataset;
    for (Object& object : copy.objects) make_xml_names(info_of(object).attributes);
    return copy;
}

}  // namespace geomend::vtk
