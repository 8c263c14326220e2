// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/corner_values.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "model/attribute_operations.h"
#include "topology/faces_from_surfaces.h"

namespace geomend::topology {

namespace {

/// One attribute over those surfaces that have it.
struct Column {
    struct Holder {
        std::uint32_t surface;
        const Attribute* attribute;
    };
    std::vector<Holder> holders;
    const Attribute& first() const { return *holders.front().attribute; }
};

bool same_column(const Attribute& a, const Attribute& b) {
    return a.name == b.name && a.components == b.components && a.values.index() == b.values.index() && a.no_data == b.no_data &&
           a.unit == b.unit && a.kind == b.kind && a.property_class == b.property_class && a.legal_min == b.legal_min &&
           a.legal_max == b.legal_max && a.component_names == b.component_names && a.code_names == b.code_names &&
           a.corner_values == b.corner_values && a.time == b.time && a.annotations == b.annotations;
}

std::vector<Column> columns_of(const BrepData& brep) {
    std::vector<Column> columns;
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        for (const Attribute& a : surface.attributes) {
            if (a.location != AttributeLocation::point || value_count(a) < surface.nodes.size() * a.components) continue;
            auto column = std::find_if(columns.begin(), columns.end(),
                                       [&](const Column& c) { return c.holders.back().surface != s && same_column(c.first(), a); });
            if (column == columns.end()) column = columns.emplace(columns.end());
            column->holders.push_back({s, &a});
        }
    }
    return columns;
}

template <class Value>
std::optional<Value> as_value(double x) {
    if constexpr (std::is_same_v<Value, std::string>) {
        return std::nullopt;
    } else if constexpr (std::is_floating_point_v<Value>) {
        return static_cast<Value>(x);
    } else {
        const bool fits = x >= static_cast<double>(std::numeric_limits<Value>::min()) &&
                          x < static_cast<double>(std::numeric_limits<Value>::max()) && x == static_cast<double>(static_cast<Value>(x));
        return fits ? std::optional(static_cast<Value>(x)) : std::nullopt;
    }
}

/// The value for places without one: the stated one, else one that no surface uses, which is then put into `no_data`.
/// \pre made.corner_values is there
template <class Value>
Value filler(const Column& column, Attribute& made) {
    if (made.no_data) {
        if (const auto stated = as_value<Value>(*made.no_data)) return *stated;
    }
    const auto used = [&](const Value& value) {
        return std::any_of(column.holders.begin(), column.holders.end(), [&](const Column::Holder& h) {
            const auto& values = std::get<std::vector<Value>>(h.attribute->values);
            return std::find(values.begin(), values.end(), value) != values.end();
        });
    };
    if constexpr (!std::is_same_v<Value, std::string>) {
        for (const double candidate : {-99999.0, -9999.0, -999999.0, -9999999.0, -1.0, 32767.0, 255.0, 127.0, -128.0, -127.0, 126.0}) {
            const auto value = as_value<Value>(candidate);
            if (!value || static_cast<double>(*value) != candidate || used(*value)) continue;
            made.no_data = candidate;
            made.corner_values->made_no_data = true;
            return *value;
        }
    }
    return Value{};
}

/// Fills `point_values` (over model vertices); false where surfaces differ or vertices have no value that could be told.
template <class Value>
bool agree(const BrepData& brep, const Column& column, const Attribute& made, std::vector<Value>& values) {
    const std::size_t n = made.components;
    std::vector<std::uint8_t> set(brep.vertices.size(), 0);
    values.assign(brep.vertices.size() * n, Value{});
    std::size_t filled = 0;
    for (const auto& [s, attribute] : column.holders) {
        const auto& from = std::get<std::vector<Value>>(attribute->values);
        const auto& nodes = brep.surfaces[s].nodes;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const std::size_t v = nodes[i].value;
            for (std::size_t k = 0; k < n; ++k) {
                if (set[v] != 0 && !same_value(values[v * n + k], from[i * n + k])) return false;
                values[v * n + k] = from[i * n + k];
            }
            filled += set[v] == 0 ? 1 : 0;
            set[v] = 1;
        }
    }
    if (filled == set.size()) return true;
    const auto missing = made.no_data ? as_value<Value>(*made.no_data) : std::nullopt;
    if (!missing) return false;
    for (std::size_t v = 0; v < set.size(); ++v) {
        for (std::size_t k = 0; k < n && set[v] == 0; ++k) values[v * n + k] = *missing;
    }
    return true;
}

template <class Value>
void put_corners(const BrepData& brep, const Column& column, std::span<const std::size_t> first_cell, std::size_t cells, Attribute& made) {
    const std::size_t n = made.components;
    made.corner_values = CornerValues{made.components, {}, false};
    std::size_t widest = 1;
    for (const auto& holder : column.holders) {
        const Polygons& polygons = brep.surfaces[holder.surface].polygons;
        for (std::size_t p = 0; p < polygons.size(); ++p) widest = std::max(widest, polygons[p].size());
    }
    std::vector<Value> values(cells * widest * n, filler<Value>(column, made));
    for (const auto& [s, attribute] : column.holders) {
        const auto& from = std::get<std::vector<Value>>(attribute->values);
        const Polygons& polygons = brep.surfaces[s].polygons;
        for (std::size_t p = 0; p < polygons.size(); ++p) {
            std::size_t at = (first_cell[s] + p) * widest * n;
            for (const std::uint32_t node : polygons[p]) {
                for (std::size_t k = 0; k < n; ++k) values[at++] = from[node * n + k];
            }
        }
    }
    made.location = AttributeLocation::cell;
    made.components = static_cast<std::uint32_t>(widest * n);
    const auto names = made.component_names;
    for (std::size_t corner = 1; corner < widest; ++corner) {
        made.component_names.insert(made.component_names.end(), names.begin(), names.end());
    }
    made.values = std::move(values);
}

void list_holders(const Column& column, std::span<const std::int64_t> tags, Attribute& made) {
    auto& surfaces = made.corner_values->surfaces.emplace();
    for (const auto& holder : column.holders) surfaces.push_back(tags[holder.surface]);
}

/// False where the corners of the polygons around one node differ.
template <class Value>
bool gather(const CellMesh& mesh, const Attribute& attribute, std::uint32_t n, std::span<const std::uint32_t> cells,
            const BrepData::Surface& surface, std::vector<Value>& values) {
    const auto& from = std::get<std::vector<Value>>(attribute.values);
    std::vector<std::uint8_t> set(surface.nodes.size(), 0);
    values.assign(surface.nodes.size() * n, Value{});
    for (std::size_t p = 0; p < cells.size(); ++p) {
        const auto polygon = surface.polygons[p];
        if (mesh.cell_nodes(cells[p]).size() != polygon.size() || polygon.size() * n > attribute.components) return false;
        std::size_t at = std::size_t{cells[p]} * attribute.components;
        for (const std::uint32_t node : polygon) {
            for (std::size_t k = 0; k < n; ++k, ++at) {
                if (set[node] != 0 && !same_value(values[node * n + k], from[at])) return false;
                values[node * n + k] = from[at];
            }
            set[node] = 1;
        }
    }
    return true;
}

}  // namespace

std::uint32_t components_per_corner(const Attribute& attribute) {
    if (!attribute.corner_values || attribute.location != AttributeLocation::cell) return 0;
    const std::uint32_t n = attribute.corner_values->components;
    return n >= 1 && n <= attribute.components ? n : 0;
}

bool missing_in(const Attribute& attribute, std::span<const std::uint32_t> cells) {
    if (!attribute.no_data) return false;
    for (const std::uint32_t c : cells) {
        for (std::size_t k = 0; k < attribute.components; ++k) {
            if (!is_no_data(attribute, value_as_double(attribute, std::size_t{c} * attribute.components + k))) return false;
        }
    }
    return true;
}

std::vector<Attribute> shared_node_attributes(const BrepData& brep, std::span<const std::size_t> first_cell,
                                              std::span<const std::int64_t> tags, std::size_t cells) {
    std::vector<Attribute> result;
    const bool filled = std::any_of(brep.regions.begin(), brep.regions.end(), [](const auto& r) { return !r.cell_types.empty(); });
    for (const Column& column : columns_of(brep)) {
        Attribute made = restricted(column.first(), {}, AttributeLocation::point);
        std::visit(
            [&](const auto& kind) {
                using Value = typename std::decay_t<decltype(kind)>::value_type;
                std::vector<Value> values;
                if (!filled && column.holders.size() == brep.surfaces.size() && agree(brep, column, made, values)) {
                    made.values = std::move(values);
                } else {
                    put_corners<Value>(brep, column, first_cell, cells, made);
                    list_holders(column, tags, made);
                }
            },
            column.first().values);
        result.push_back(std::move(made));
    }
    return result;
}

void add_corner_values(const CellMesh& mesh, const Attribute& attribute, std::span<const std::uint32_t> cells, std::int64_t tag,
                       BrepData::Surface& surface) {
    const std::uint32_t n = components_per_corner(attribute);
    const auto& holders = attribute.corner_values->surfaces;
    bool held = attribute.no_data ? !missing_in(attribute, cells) : !holders;
    if (!held && holders) held = std::find(holders->begin(), holders->end(), tag) != holders->end();
    if (!held) return;
    Attribute made = restricted(attribute, {}, AttributeLocation::point);
    const bool gathered = n > 0 && std::visit(
                                       [&](const auto& kind) {
                                           using Value = typename std::decay_t<decltype(kind)>::value_type;
                                           std::vector<Value> values;
                                           if (!gather(mesh, attribute, n, cells, surface, values)) return false;
                                           made.values = std::move(values);
                                           return true;
                                       },
                                       attribute.values);
    if (!gathered) {
        surface.attributes.push_back(
            restricted(attribute, std::vector<std::uint32_t>(cells.begin(), cells.end()), AttributeLocation::polygon));
        return;
    }
    made.components = n;
    if (!made.component_names.empty()) made.component_names.resize(n);
    if (made.corner_values->made_no_data) made.no_data.reset();
    made.corner_values.reset();
    surface.attributes.push_back(std::move(made));
}

}  // namespace geomend::topology
