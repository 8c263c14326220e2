// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/repair_cells.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/measures.h"
#include "repair/cell_cleaning.h"
#include "repair/surface_driver.h"
#include "topology/lengths.h"

namespace geomend {

namespace {

constexpr std::array<std::string_view, 6> codes_of_cells = {"M20", "M22", "M26", "M27", "M28", "M35"};

bool is_of_cells(const Finding& f) { return std::ranges::find(codes_of_cells, std::string_view(f.code)) != codes_of_cells.end(); }

bool has_volume(const CellMesh& mesh) {
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        if (mesh.types[c] == CellType::polyhedron || cell_volume(mesh, c) != 0) return true;
    }
    return false;
}

// Whether something is to be mended in the cells. A mesh that is inside out as a whole is sound alone (M35 is a note), but not beside
// others: some formats hold them all in one mesh.
bool finds_of_cells(std::span<const Finding> before, const Dataset& dataset) {
    const auto meshes = std::ranges::count_if(dataset.objects, [](const Object& object) {
        const auto* mesh = std::get_if<CellMesh>(&object);
        return mesh != nullptr && has_volume(*mesh);
    });
    return std::ranges::any_of(
        before, [&](const Finding& f) { return is_of_cells(f) && (f.severity != Severity::info || (f.code == "M35" && meshes > 1)); });
}

bool asks_for_surfaces(std::span<const Finding> before, const repair::Recipe& recipe) {
    if (!recipe.edits.empty() || recipe.box || recipe.automatic_box || recipe.max_gap) return true;
    if (!recipe.steps.empty()) return std::ranges::any_of(recipe.steps, [](const std::string& s) { return s != "clean"; });
    std::vector<Finding> others;
    std::ranges::copy_if(before, std::back_inserter(others), [](const Finding& f) { return !is_of_cells(f); });
    return !repair::plan_for(others, false).empty();
}

}  // namespace

bool mend_cells(Dataset& dataset, std::span<const Finding> before, const RepairRequest& request, RepairReport& report) {
    const auto& steps = request.recipe.steps;
    const bool found = finds_of_cells(before, dataset);
    const bool named = std::ranges::find(steps, "clean") != steps.end();
    const double by_rule = topology::local_lengths(dataset, {}).largest.tolerance;
    const double tolerance = request.checks.tolerance >= 0 ? request.checks.tolerance : by_rule;
    bool cells = false;
    ReportedStep step;
    step.step = "clean";
    const std::clock_t start = std::clock();
    for (Object& object : dataset.objects) {
        auto* mesh = std::get_if<CellMesh>(&object);
        if (mesh == nullptr || !has_volume(*mesh)) continue;
        cells = true;
        if (!(named || (found && steps.empty())) || !(tolerance > 0)) continue;
        const auto done = repair::clean_cells(*mesh, tolerance);
        step.changed += done.changes();
        if (done.changes() > 0) dataset.breps.clear();
        if (const std::string text = repair::cleaning_text(done); !text.empty())
            step.what.message += (step.what.message.empty() ? "" : "; ") + (mesh->info.name.empty() ? text : mesh->info.name + ": " + text);
    }
    if (!cells) return false;
    if (named || (found && steps.empty())) {
        if (step.what.message.empty()) step.what.message = "nothing to clean in the cells";
        step.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        report.file.steps.push_back(std::move(step));
        report.recipe.steps = {"clean"};
        report.recipe.tolerance = tolerance;
    }
    if (asks_for_surfaces(before, request.recipe)) return false;
    const bool surfaces = std::ranges::any_of(dataset.objects, [](const Object& o) { return std::holds_alternative<Surface>(o); });
    return !(named && surfaces);
}

}  // namespace geomend
