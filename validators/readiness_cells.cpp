// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <set>

#include "base/vectors.h"
#include "validators/cell_findings.h"
#include "validators/cell_scope.h"
#include "validators/readiness.h"

// What simulators need of a mesh beside sound cells: types they know, tags, names for the outside.

namespace geomend::validators {

namespace {

Finding about(const CellMesh& mesh, std::string_view code, std::string message) {
    Finding f = target_finding(code, std::move(message));
    f.entities = {{"cell-mesh", mesh.info.name}};
    return f;
}

Vec3 middle_of(const CellMesh& mesh, std::span<const std::uint32_t> nodes) {
    Vec3 sum{};
    for (const std::uint32_t n : nodes) sum = plus(sum, times(1.0 / static_cast<double>(nodes.size()), mesh.points[n]));
    return sum;
}

/// \param nodes where in the cell: all of it, or a face
void list(const CellMesh& mesh, std::size_t cell, std::span<const std::uint32_t> nodes, Finding& f) {
    ++f.count;
    f.element_kind = "cell";
    if (f.elements.size() >= listed_elements) return;
    f.elements.push_back(mesh.cell_labels[cell]);
    f.index.push_back(static_cast<std::int64_t>(cell));
    if (!nodes.empty()) f.points.push_back(middle_of(mesh, nodes));
}

void check_types(const Target& target, const CellMesh& mesh, std::vector<Finding>& findings) {
    std::map<CellType, Finding> unknown;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const CellType type = mesh.types[cell];
        if (dimension(type) == 3 && std::ranges::find(target.cell_types, type) == target.cell_types.end())
            list(mesh, cell, mesh.cell_nodes(cell), unknown[type]);
    }
    for (auto& [type, cells] : unknown) {
        Finding f =
            about(mesh, "S07",
                  std::string(target.title) + " has no cells of type " + to_string(type) + ": the mesh has " + std::to_string(cells.count));
        f.count = cells.count;
        f.element_kind = cells.element_kind;
        f.elements = std::move(cells.elements);
        f.index = std::move(cells.index);
        f.points = std::move(cells.points);
        findings.push_back(std::move(f));
    }
}

void check_tags(const Target& target, const CellMesh& mesh, std::vector<Finding>& findings) {
    const auto& attributes = mesh.info.attributes;
    const bool numbered = std::ranges::any_of(
        attributes, [](const Attribute& a) { return a.location == AttributeLocation::cell && a.name == "attribute" && a.components == 1; });
    const bool sets = std::ranges::any_of(mesh.info.sets, [](const NamedSet& s) { return s.location == AttributeLocation::cell; });
    if (numbered || sets) return;
    Finding untagged = about(mesh, "S08", {});
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        if (dimension(mesh.types[cell]) != 3) continue;
        if (mesh.cell_entity.empty() || mesh.cell_entity[cell] == no_index) list(mesh, cell, mesh.cell_nodes(cell), untagged);
    }
    if (untagged.count == 0) return;
    untagged.message = "no region is stated for " + counted(untagged.count, "cell", "cells") + ": " + std::string(target.title) +
                       " treats all cells as one region, and no property can be given to a part";
    findings.push_back(std::move(untagged));
}

std::vector<std::uint32_t> sorted_vertices(const CellScope& scope, std::span<const std::uint32_t> nodes) {
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t n : nodes) vertices.push_back(scope.vertex_of()[n]);
    std::ranges::sort(vertices);
    return vertices;
}

bool is_named(const CellMesh& mesh, std::size_t cell) {
    if (mesh.cell_entity.empty() || mesh.cell_entity[cell] == no_index) return false;
    const CellMesh::Entity& entity = mesh.entities[mesh.cell_entity[cell]];
    return !entity.name.empty() || std::ranges::any_of(entity.groups, [&](std::uint32_t g) { return !mesh.groups[g].name.empty(); });
}

// Outer faces that no named cell of two dimensions covers.
void check_patches(const Target& target, const CellMesh& mesh, std::vector<Finding>& findings) {
    const CellScope scope(mesh, {}, {});
    std::set<std::vector<std::uint32_t>> named;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        if (dimension(mesh.types[cell]) == 2 && is_named(mesh, cell)) named.insert(sorted_vertices(scope, mesh.cell_nodes(cell)));
    }
    Finding bare = about(mesh, "S10", {});
    std::uint64_t outer = 0;
    for (std::size_t g = 0; g + 1 < scope.group_first().size(); ++g) {
        const auto group = scope.grouped().subspan(scope.group_first()[g], scope.group_first()[g + 1] - scope.group_first()[g]);
        if (group.size() != 1) continue;
        ++outer;
        const VolumeFace& face = scope.faces()[group[0]];
        if (named.contains(sorted_vertices(scope, scope.nodes_of(face)))) continue;
        list(mesh, face.cell, scope.nodes_of(face), bare);
    }
    if (bare.count == 0) return;
    bare.message = std::to_string(bare.count) + " of " + counted(outer, "outer face", "outer faces") +
                   " have no name: " + std::string(target.title) +
                   " puts them into one patch, and no boundary condition can be given to a part";
    findings.push_back(std::move(bare));
}

}  // namespace

void check_cells_for(const Target& target, const CellMesh& mesh, std::vector<Finding>& findings) {
    check_types(target, mesh, findings);
    if (target.tags_cells) check_tags(target, mesh, findings);
    if (target.names_patches) check_patches(target, mesh, findings);
}

}  // namespace geomend::validators
