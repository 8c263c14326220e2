// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/resize.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text_cursor.h"
#include "base/wording.h"
#include "volume/stress_error.h"

namespace geomend {

namespace {

Failure no_stress(const ResizeRequest& request, const std::string& why) {
    return failure(FailureKind::cannot_hold, "F026", {request.file}, "--resize-by: " + why);
}

/// Only faces and lines beside tetrahedra.
bool is_beside(CellType type) { return type < CellType::tetrahedron; }

/// The tetrahedra of a file, with their stress.
struct StressedCells {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 4>> cells;
    std::vector<std::array<double, 6>> stress;
    std::vector<std::uint32_t> groups;
    std::vector<double> young;
};

Result<const Attribute*> stress_of(const CellMesh& mesh, const ResizeRequest& request) {
    std::vector<const Attribute*> all;
    const Attribute* named = nullptr;
    for (const Attribute& a : mesh.info.attributes) {
        const bool fits = a.location == AttributeLocation::cell && (a.components == 6 || a.components == 9);
        if (!fits || std::holds_alternative<std::vector<std::string>>(a.values)) continue;
        all.push_back(&a);
        if (named == nullptr && (same_word(a.name, "stress") || same_word(a.name, "s"))) named = &a;
    }
    if (named != nullptr) return named;
    if (all.size() == 1) return all.front();
    if (all.empty()) return no_stress(request, "no property of cells has the six components of a stress, or the nine of a matrix");
    return no_stress(request, "several properties of cells have as many components as a stress, and none is called stress or S");
}

std::array<double, 6> stress_at(const Attribute& a, std::size_t cell) {
    const auto at = [&](std::size_t i) { return value_as_double(a, cell * a.components + i); };
    if (a.components == 6) return {at(0), at(1), at(2), at(3), at(4), at(5)};
    return {at(0), at(4), at(8), at(1), at(5), at(2)};
}

Result<StressedCells> stressed_cells(const CellMesh& mesh, const Attribute& stress, const ResizeRequest& request) {
    StressedCells made;
    made.points = mesh.points;
    const Attribute* young = nullptr;
    for (const Attribute& a : mesh.info.attributes) {
        if (a.location == AttributeLocation::cell && a.components == 1 && same_word(a.name, "young")) young = &a;
    }
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        if (is_beside(mesh.types[c])) continue;
        if (mesh.types[c] != CellType::tetrahedron)
            return no_stress(request, "cells that are no tetrahedra: the error is estimated for linear tetrahedra");
        const auto nodes = mesh.cell_nodes(c);
        made.cells.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
        made.stress.push_back(stress_at(stress, c));
        if (!std::ranges::all_of(made.stress.back(), [](double v) { return std::isfinite(v); }))
            return no_stress(request, "cell " + std::to_string(c) + " (from 0) has no stress");
        if (!mesh.cell_entity.empty()) made.groups.push_back(mesh.cell_entity[c]);
        if (young == nullptr) continue;
        made.young.push_back(value_as_double(*young, c));
        if (!(made.young.back() > 0) || !std::isfinite(made.young.back()))
            return no_stress(request, "cell " + std::to_string(c) + " (from 0) has a young that is not above 0");
    }
    return made;
}

}  // namespace

Result<Resized> sizes_by_stress(const ResizeRequest& request, const LoadOptions& options) {
    LoadOptions own;
    own.monitor = options.monitor;
    auto dataset = load(request.file, own);
    if (!dataset) return std::move(dataset).why();
    const auto has_cells = [](const Object& o) {
        const auto* mesh = std::get_if<CellMesh>(&o);
        return mesh != nullptr && std::ranges::any_of(mesh->types, [](CellType t) { return !is_beside(t); });
    };
    const auto found = std::ranges::find_if(dataset->objects, has_cells);
    if (found == dataset->objects.end()) return no_stress(request, "there are no tetrahedra");
    const auto& mesh = std::get<CellMesh>(*found);
    const auto stress = stress_of(mesh, request);
    if (!stress) return stress.why();
    const auto all = stressed_cells(mesh, **stress, request);
    if (!all) return all.why();
    const volumes::StressField field{all->points, all->cells, all->stress, all->groups, all->young, request.poisson};
    const volumes::StressError error = volumes::stress_error(field, request.allowed);
    Resized made;
    made.sizes = volumes::sizes_at_points(field, error);
    ResizeReport& report = made.report;
    report.stress = (*stress)->name;
    report.cells = all->cells.size();
    report.above = error.above;
    report.without_energy = error.without_energy;
    report.allowed = request.allowed;
    report.whole = error.whole;
    report.largest = error.largest;
    const auto [least, largest] = std::ranges::minmax_element(made.sizes, {}, &volumes::SizedPoint::size);
    if (!(least->size > 0)) return no_stress(request, "a tetrahedron has no volume and no edges");
    report.least_size = least->size;
    report.largest_size = largest->size;
    return made;
}

Json resize_json(const ResizeReport& report) {
    return {{"stress", report.stress},
            {"cells", report.cells},
            {"allowed", report.allowed},
            {"whole", report.whole},
            {"largest", report.largest},
            {"above", report.above},
            {"without_energy", report.without_energy},
            {"least_size", report.least_size},
            {"largest_size", report.largest_size}};
}

std::string resize_text(const ResizeReport& report) {
    const auto percent = [](double share) { return rounded(100 * share) + " %"; };
    return "stress of " + counted(report.cells, "tetrahedron", "tetrahedra") + ": the error of the whole is " + percent(report.whole) +
           ", of single cells up to " + percent(report.largest) + "; " + std::to_string(report.above) + " of them are above " +
           percent(report.allowed) + (report.above > 0 ? ": edges become shorter there\n" : "\n");
}

}  // namespace geomend
