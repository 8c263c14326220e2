// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/repair.h"

#include <algorithm>
#include <array>

#include "pipeline/command_options.h"
#include "pipeline/shape.h"
#include "repair/grid_steps.h"
#include "repair/surface_driver.h"

namespace geomend {

namespace {

bool is_grid(const Object& object) {
    const auto* grid = std::get_if<CornerPointGrid>(&object);
    return grid != nullptr && validators::has_geometry(*grid);
}

Result<void> known_step(const std::string& name) {
    if (repair::surface_step(name) != nullptr) return {};
    return repair::known_grid_steps(std::array{name});
}

Result<void> mend_grids(Dataset& dataset, const RepairRequest& request, RepairReport& report) {
    const auto usual = repair::usual_grid_steps();
    std::vector<std::string> names = request.recipe.steps;
    if (names.empty()) names.assign(usual.begin(), usual.end());
    if (auto known = repair::known_grid_steps(names); !known) return known;
    auto done = repair::run_grid_steps(dataset, names, {request.checks, request.gap});
    if (!done) return std::move(done).why();
    for (auto& [step, what] : *done) {
        ReportedStep reported;
        reported.step = std::move(step);
        reported.what = std::move(what);
        reported.changed = reported.what.count;
        report.file.steps.push_back(std::move(reported));
    }
    report.recipe.steps = names;
    return {};
}

// Puts a mended model in place of the objects that it was made from.
void replace_surfaces(Dataset& dataset, repair::SurfaceRepair repaired) {
    Dataset made = std::move(repaired.result.dataset);
    for (std::uint32_t o = 0; o < dataset.objects.size(); ++o) {
        if (!std::ranges::binary_search(repaired.objects, o)) made.objects.push_back(std::move(dataset.objects[o]));
    }
    dataset.objects = std::move(made.objects);
    dataset.models = std::move(made.models);
    dataset.breps.clear();
    dataset.findings.clear();  // of what was read
    for (Loss& loss : made.losses) add_loss(dataset.losses, std::move(loss));
}

repair::SurfaceDriverOptions driver_options(const RepairRequest& request) {
    const repair::Recipe& recipe = request.recipe;
    repair::SurfaceDriverOptions options;
    options.steps.max_gap = recipe.max_gap.value_or(-1);
    options.steps.box = recipe.box;
    options.steps.automatic_box = recipe.automatic_box;
    options.steps.contacts = recipe.contacts;
    options.steps.monitor = request.checks.monitor;
    options.max_displacement = recipe.max_displacement.value_or(-1);
    options.keep_worse = request.keep_invalid;
    options.checks = request.checks;
    return options;
}

ReportedStep reported(repair::SurfaceStepDone& done) {
    ReportedStep step;
    step.step = done.step;
    step.what = std::move(done.outcome.what);
    step.kept = done.kept;
    step.changed = done.outcome.changed;
    step.max_displacement = done.outcome.max_displacement;
    step.mean_displacement = done.outcome.mean_displacement;
    step.seconds = done.seconds;
    step.why = done.why;
    for (auto& c : done.outcome.contacts) {
        step.contacts.push_back({std::move(c.border), std::move(c.on), c.gap, std::move(c.decision), std::move(c.why)});
    }
    return step;
}

Result<void> mend_surfaces(Dataset& dataset, const std::vector<Finding>& before, const RepairRequest& request, RepairReport& report) {
    const repair::Recipe& recipe = request.recipe;
    const bool box = recipe.box.has_value() || recipe.automatic_box;
    const auto names = recipe.steps.empty() ? repair::plan_for(before, recipe.max_gap.has_value(), box) : recipe.steps;
    for (const std::string& name : names) {
        if (repair::surface_step(name) == nullptr)
            return failure(FailureKind::usage, "F018", {}, "--step " + name + ": no such step of surfaces");
    }
    auto repaired = repair::repair_surfaces(dataset, before, names, driver_options(request));
    if (!repaired) return std::move(repaired).why();
    for (auto& done : repaired->steps) report.file.steps.push_back(reported(done));
    report.recipe.steps = names;
    report.recipe.tolerance = repaired->lengths.tolerance;
    report.recipe.near = repaired->lengths.near;
    replace_surfaces(dataset, std::move(*repaired));
    return {};
}

bool has_regions(const Dataset& dataset) {
    return std::ranges::any_of(dataset.models, [](const StatedModel& m) { return !m.regions.empty(); });
}

// A result without any region states none that could be found open: what did not close before does not close now either.
void keep_unclosed(const ReportedFile& before, ReportedFile& after) {
    for (const Finding& f : before.findings) {
        const bool unclosed = f.severity == Severity::error && (f.code == "B05" || f.code == "B06" || f.code == "B12");
        const bool known = std::ranges::find(after.findings, f.code, &Finding::code) != after.findings.end();
        if (!unclosed || known) continue;
        after.findings.push_back(f);
        after.valid = false;
    }
}

Result<void> mend(Dataset& dataset, const Format& target, const RepairRequest& request, RepairReport& report) {
    const std::string& path = request.files.inputs.front();
    flatten_meshes(dataset);
    auto before = validate(path, dataset, request.checks);
    if (!before) return std::move(before).why();
    report.valid_before = count_by_severity(before->findings).error == 0;
    report.recipe = request.recipe;
    const bool stated = !dataset.models.empty();
    const bool grids = std::ranges::any_of(dataset.objects, is_grid);
    auto mended = grids ? mend_grids(dataset, request, report) : mend_surfaces(dataset, before->findings, request, report);
    if (!mended) return mended;
    const bool closed = grids || has_regions(dataset);
    // Regions that were found, and stated by none of the inputs, are no loss where the target holds none.
    if (!stated && target.wants == WriterWants::objects) dataset.models.clear();
    auto after = validate(path, dataset, request.checks);
    if (!after) return std::move(after).why();
    if (!closed) keep_unclosed(*before, *after);
    after->steps = std::move(report.file.steps);
    report.file = std::move(*after);
    if (request.inspect) {
        if (auto inspected = request.inspect(dataset, dataset.breps, report.file); !inspected) return inspected;
    }
    const bool errors = count_by_severity(report.file.findings).error > 0;
    if (errors && !request.keep_invalid)
        return failure(FailureKind::cannot_hold, "F021", {request.files.output}, "the result is not valid: nothing was written");
    if (request.dry_run) return failure(FailureKind::cannot_hold, "F021", {request.files.output}, "a dry run writes nothing");
    report.written = true;
    return {};
}

}  // namespace

Result<RepairReport> repair_file(const RepairRequest& request) {
    for (const std::string& name : request.recipe.steps) {
        if (auto known = known_step(name); !known) return std::move(known).why();
    }
    RepairReport report;
    ConvertRequest files = request.files;
    if (files.load.command.empty()) files.load.command = repair_option_rows();
    const auto converted = convert(files, [&](Dataset& dataset, const Format& target) { return mend(dataset, target, request, report); });
    if (converted) {
        report.losses = converted->losses;
        return report;
    }
    const bool stopped_by_findings = !report.written && !report.file.file.empty() && converted.why().kind == FailureKind::cannot_hold;
    if (stopped_by_findings) return report;
    return converted.why();
}

}  // namespace geomend
