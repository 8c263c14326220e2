// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/mesh_surfaces.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <numeric>
#include <string_view>

#include "topology/faces_from_mesh.h"
#include "topology/mesh_parts.h"
#include "topology/surface_array.h"

namespace geomend::topology {

namespace {

/// "Surface_ID" as "surfaceid".
std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return plain;
}

/// The array that says to which surface cells belong; nullptr where none is called so.
const Attribute* surface_array(const ObjectInfo& info, std::size_t cells) {
    constexpr std::array<std::string_view, 22> names = {
        "surface",       "surfaces", "surfaceid", "surfaceids",       "surfacename", "patch", "patchid",      "patches",
        "cellentityids", "entityid", "entity",    "feature",          "featureid",   "name",  "gmshphysical", "gmshgeometrical",
        "attribute",     "part",     "partid",    "stlsolidlabeling", "regionid",    "region"};
    for (const std::string_view wanted : names) {
        for (const Attribute& a : info.attributes) {
            const bool whole =
                !std::holds_alternative<std::vector<double>>(a.values) && !std::holds_alternative<std::vector<float>>(a.values);
            const bool of_cells = a.location == AttributeLocation::cell || a.location == AttributeLocation::polygon;
            if (whole && of_cells && a.components == 1 && value_count(a) == cells && plain_name(a.name) == wanted) return &a;
        }
    }
    return nullptr;
}

/// The value of an array for a cell, as a word.
std::string word_of(const Attribute& array, std::uint32_t cell) {
    if (const auto* words = std::get_if<std::vector<std::string>>(&array.values)) return (*words)[cell];
    return std::to_string(static_cast<std::int64_t>(value_as_double(array, cell)));
}

/// The other cells by what an array says of them; whole numbers in their order.
void add_labelled(const ObjectInfo& info, const Attribute& array, const std::vector<std::uint32_t>& cells, std::vector<MeshSurface>& all) {
    const bool words = std::holds_alternative<std::vector<std::string>>(array.values);
    std::map<std::pair<double, std::string>, std::vector<std::uint32_t>> by_label;
    for (const std::uint32_t c : cells)
        by_label[{words ? 0 : value_as_double(array, c), words ? word_of(array, c) : std::string()}].push_back(c);
    for (auto& [label, own] : by_label) {
        MeshSurface surface;
        const std::string word = word_of(array, own.front());
        surface.name = words ? word : array.name + " " + word;
        if (surface.name.empty()) surface.name = info.name;
        surface.cells = std::move(own);
        surface.part = static_cast<std::uint32_t>(all.size());
        all.push_back(std::move(surface));
    }
}

}  // namespace

bool is_surface_mesh(const CellMesh& mesh) {
    if (std::ranges::any_of(mesh.entities, [](const CellMesh::Entity& e) { return e.dimension == 3; })) return false;
    bool has_faces = false;
    for (const CellType type : mesh.types) {
        if (dimension(type) == 3) return false;
        has_faces |= dimension(type) == 2;
    }
    return has_faces;
}

std::vector<MeshSurface> surfaces_of_mesh(const CellMesh& mesh) {
    std::vector<MeshSurface> all;
    std::vector<std::uint8_t> taken(mesh.cell_count(), 0);
    const auto cells = cells_by_entity(mesh);
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
        if (mesh.entities[e].dimension != 2 || cells[e].empty()) continue;
        MeshSurface surface;
        surface.name = entity_name(mesh, mesh.entities[e], "Surface");
        surface.role = mesh.entities[e].role;
        surface.role_text = mesh.entities[e].role_text;
        for (const std::uint32_t c : cells[e]) {
            taken[c] = 1;
            if (dimension(mesh.types[c]) == 2) surface.cells.push_back(c);
        }
        surface.entity = e;
        surface.part = static_cast<std::uint32_t>(all.size());
        if (!surface.cells.empty()) all.push_back(std::move(surface));
    }
    std::vector<std::uint32_t> rest;
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
        if (taken[c] == 0 && dimension(mesh.types[c]) == 2) rest.push_back(c);
    }
    if (rest.empty()) return all;
    if (const Attribute* array = surface_array(mesh.info, mesh.cell_count())) {
        add_labelled(mesh.info, *array, rest, all);
        return all;
    }
    MeshSurface surface;
    surface.name = mesh.info.name;
    surface.role = mesh.info.role;
    surface.role_text = mesh.info.role_text;
    surface.cells = std::move(rest);
    all.push_back(std::move(surface));
    return all;
}

bool has_surface_array(const Surface& surface) { return surface_array(surface.info, surface.polygons.size()) != nullptr; }

std::vector<MeshSurface> surfaces_by_array(const Surface& surface) {
    const ObjectInfo& info = surface.info;
    if (!surface.parts.empty() || info.role != FeatureRole::unknown || !info.role_text.empty() || !info.feature.empty()) return {};
    const Attribute* array = surface_array(info, surface.polygons.size());
    if (array == nullptr) return {};
    std::vector<std::uint32_t> polygons(surface.polygons.size());
    std::iota(polygons.begin(), polygons.end(), 0);
    std::vector<MeshSurface> all;
    add_labelled(info, *array, polygons, all);
    if (all.size() < 2) all.clear();
    return all;
}

}  // namespace geomend::topology
