// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/repair.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/wording.h"
#include "pipeline/command_options.h"
#include "pipeline/repair_cells.h"
#include "pipeline/shape.h"
#include "repair/code_steps.h"
#include "repair/grid_steps.h"
#include "repair/plans.h"
#include "topology/brep_from_dataset.h"
#include "topology/lengths.h"
#include "topology/region_surfaces.h"
#include "validators/check_selection.h"

namespace geomend {

namespace {

bool is_grid(const Object& object) {
    const auto* grid = std::get_if<CornerPointGrid>(&object);
    return grid != nullptr && validators::has_geometry(*grid);
}

// Failure (usage) where steps or options are not for grids.
Result<void> are_of_grids(const RepairRequest& request) {
    const auto refuse = [&](const std::string& what) {
        return failure(FailureKind::usage, "F018", {request.files.inputs.front()}, what + " is for models of surfaces, and this is a grid");
    };
    for (const std::string& name : request.recipe.steps) {
        if (repair::surface_step(name) != nullptr) return refuse("step " + name);
    }
    if (request.recipe.box || request.recipe.automatic_box) return refuse("a box");
    if (request.recipe.max_gap) return refuse("--max-gap");
    if (request.recipe.max_displacement) return refuse("--max-displacement");
    if (!request.recipe.contacts.empty()) return refuse("a contact");
    if (!request.recipe.edits.empty()) return refuse("an edit");
    return {};
}

// The same for models of surfaces.
Result<void> are_of_surfaces(const RepairRequest& request) {
    const auto refuse = [&](const std::string& what) {
        return failure(FailureKind::usage, "F018", {request.files.inputs.front()}, what + " is for grids, and this is a model of surfaces");
    };
    for (const std::string& name : request.recipe.steps) {
        if (repair::surface_step(name) == nullptr) return refuse("step " + name);
    }
    return request.gap ? refuse("--option gap") : Result<void>();
}

Result<void> mend_grids(Dataset& dataset, const RepairRequest& request, RepairReport& report) {
    const auto usual = repair::usual_grid_steps();
    std::vector<std::string> names = request.recipe.steps;
    if (names.empty()) names.assign(usual.begin(), usual.end());
    if (auto of_grids = are_of_grids(request); !of_grids) return of_grids;
    auto done = repair::run_grid_steps(dataset, names, {request.checks, request.gap});
    if (!done) return std::move(done).why();
    for (auto& [step, what] : *done) {
        ReportedStep reported;
        reported.step = std::move(step);
        reported.what = std::move(what);
        reported.changed = reported.what.count;
        report.file.steps.push_back(std::move(reported));
    }
    const auto surfaces = std::ranges::count_if(dataset.objects, [](const Object& o) { return std::holds_alternative<Surface>(o); });
    if (surfaces > 0 && !report.file.steps.empty()) {
        report.file.steps.back().what.message += "; " + geomend::counted(static_cast<std::uint64_t>(surfaces), "surface", "surfaces") +
                                                 " beside the grid: left as read, mend them in a run of their own";
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

repair::SurfaceDriverOptions driver_options(const RepairRequest& request, std::span<const repair::SurfaceEdit> edits) {
    const repair::Recipe& recipe = request.recipe;
    repair::SurfaceDriverOptions options;
    options.steps.max_gap = recipe.max_gap.value_or(-1);
    options.steps.box = recipe.box;
    options.steps.automatic_box = recipe.automatic_box;
    options.steps.contacts = recipe.contacts;
    options.steps.scar_angle = recipe.scar_angle.value_or(options.steps.scar_angle);
    options.steps.micro_volume = recipe.micro_volume.value_or(-1);
    options.steps.edits = edits;
    options.steps.monitor = request.checks.monitor;
    options.max_displacement = recipe.max_displacement.value_or(-1);
    options.keep_worse = request.keep_invalid;
    options.checks = request.checks;
    options.keep_model = static_cast<bool>(request.inspect);
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
    step.peak_memory = done.peak_memory;
    step.why = done.why;
    for (auto& c : done.outcome.contacts) {
        step.contacts.push_back({std::move(c.border), std::move(c.on), c.gap, std::move(c.decision), std::move(c.why)});
    }
    return step;
}

/// Reads what edits add, and puts its surfaces behind the others under the names that they are to have.
Result<void> read_edits(std::vector<repair::SurfaceEdit>& edits, const RepairRequest& request, Dataset& dataset) {
    for (repair::SurfaceEdit& edit : edits) {
        if (edit.file.empty()) continue;
        LoadOptions load = request.files.load;
        load.from.clear();
        load.one_of_many = true;
        auto loaded = geomend::load(edit.file, load);
        if (!loaded) return std::move(loaded).why();
        for (Object& object : loaded->objects) {
            auto* surface = std::get_if<Surface>(&object);
            if (surface == nullptr || surface->polygons.size() == 0) continue;
            if (!edit.surface.empty()) surface->info.name = edit.surface;
            edit.objects.push_back(static_cast<std::uint32_t>(dataset.objects.size()));
            dataset.objects.push_back(std::move(object));
        }
        if (edit.objects.empty()) return failure(FailureKind::usage, "F018", {edit.file}, "there is no surface with triangles in it");
    }
    return {};
}

// What was found before a repair: at the tolerance that was asked for, and at the one by rule where that is smaller.
struct FoundBefore {
    ReportedFile asked;
    std::optional<ReportedFile> strict;

    const std::vector<Finding>& judged() const { return strict ? strict->findings : asked.findings; }
};

// The options by which a larger tolerance that was asked for is left out; nothing where none was, or it is no larger.
std::optional<validators::CheckOptions> strict_options(const Dataset& dataset, const validators::CheckOptions& checks) {
    if (checks.tolerance < 0 || checks.tolerance <= topology::local_lengths(dataset, {}).largest.tolerance) return std::nullopt;
    validators::CheckOptions strict = checks;
    strict.tolerance = -1;
    strict.closing_tolerance = false;
    return strict;
}

// Whether models that may be sound each by itself, or a model and surfaces beside it, become one.
bool is_of_several_models(const Dataset& dataset) { return topology::model_sources(dataset).size() > 1; }

std::vector<repair::SurfacePlan> plans_of(const Dataset& dataset, const FoundBefore& before, const repair::Recipe& recipe) {
    if (!recipe.steps.empty()) return {{recipe.steps, -1, {}}};
    repair::PlanFacts facts;
    facts.findings = before.asked.findings;
    facts.strict = before.judged();
    facts.close_gaps = recipe.max_gap.has_value();
    facts.box = recipe.box.has_value() || recipe.automatic_box;
    facts.several_models = is_of_several_models(dataset);
    if (before.asked.closing && !recipe.tolerance) {
        facts.closing = before.asked.closing->tolerance;
        facts.closes_whole = before.asked.closing->left == 0;
    }
    auto plans = repair::plans_for(facts);
    if (plans.empty()) plans.emplace_back();
    return plans;
}

/// What a repair did, where somebody looks at it.
repair::ModelChanges changes_by(repair::SurfaceRepair& repaired, std::span<const repair::SurfaceEdit> edits) {
    if (!repaired.model) return {};
    std::vector<std::uint32_t> new_objects;
    for (const repair::SurfaceEdit& edit : edits) new_objects.insert(new_objects.end(), edit.objects.begin(), edit.objects.end());
    std::ranges::sort(new_objects);
    auto changes = repair::changes_of(*repaired.model, new_objects);
    repaired.model.reset();
    return changes;
}

std::string joins_with(const repair::PlannedRepair::WouldJoin& would_join) {
    const std::string length = rounded(would_join.tolerance);
    return counted(would_join.regions, "thin region lies", "thin regions lie") + " between surfaces that agree within " + length +
           ": with --tolerance " + length + " these become one";
}

Result<void> mend_surfaces(Dataset& dataset, const FoundBefore& before, const RepairRequest& request, RepairReport& report,
                           repair::ModelChanges& changes) {
    repair::Recipe recipe = request.recipe;
    if (auto of_surfaces = are_of_surfaces(request); !of_surfaces) return of_surfaces;
    if (request.checks.tolerance >= 0) recipe.tolerance = request.checks.tolerance;
    auto plans = plans_of(dataset, before, recipe);
    auto edits = recipe.edits;
    if (auto read = read_edits(edits, request, dataset); !read) return read;
    for (repair::SurfacePlan& plan : plans) {
        const bool named = std::ranges::find(plan.steps, "edit") != plan.steps.end();
        if (!edits.empty() && !named) plan.steps.insert(plan.steps.begin(), "edit");
    }
    const bool search = recipe.steps.empty() && !recipe.tolerance && !before.judged().empty();
    auto planned = repair::repair_by_plans(dataset, before.judged(), plans, driver_options(request, edits), search);
    if (!planned) return std::move(planned).why();
    repair::SurfaceRepair* repaired = &planned->repair;
    for (auto& done : repaired->steps) report.file.steps.push_back(reported(done));
    if (!planned->plan.why.empty() && !report.file.steps.empty()) report.file.steps.front().what.message += "; " + planned->plan.why;
    if (planned->would_join && !report.file.steps.empty())
        report.file.steps.front().what.message += "; " + joins_with(*planned->would_join);
    const std::uint64_t errors = count_by_severity(before.judged()).error;
    if (planned->would_close) report.file.closing = {*planned->would_close, errors, 0, 0};
    else if (planned->would_close_gap) report.file.closing = {0, errors, 0, *planned->would_close_gap};
    report.recipe.steps = planned->plan.steps;
    report.recipe.tolerance = repaired->lengths.tolerance;
    report.recipe.near = repaired->lengths.near;
    if (!report.file.steps.empty()) {
        constexpr std::array words{"lost", "made", "parted"};  // as the kinds are numbered
        for (const repair::NameChange& change : repaired->result.changes)
            report.file.steps.back().names.push_back({words[change.kind], change.name, change.from});
    }
    report.closed = repaired->closed;
    report.open = repaired->should_close && !repaired->closed;
    changes = changes_by(*repaired, edits);
    replace_surfaces(dataset, std::move(*repaired));
    return {};
}

// A result without any region states none that could be found open: what did not close before does not close now either.
void keep_unclosed(const ReportedFile& before, ReportedFile& after) {
    for (const Finding& f : before.findings) {
        const bool unclosed = f.severity == Severity::error && (f.code == "B05" || f.code == "B06" || f.code == "B12");
        const bool known = std::ranges::find(after.findings, f.code, &Finding::code) != after.findings.end();
        if (unclosed && !known) after.findings.push_back(f);
    }
    const bool told = std::ranges::any_of(after.findings, [](const Finding& f) { return f.severity == Severity::error; });
    if (!told) after.findings.push_back(make_finding("B06", "the surfaces enclose no volume: the result has no region"));
    after.valid = false;
}

// Whether a file says where regions are: in a model, by groups of a mesh, or by cells.
bool states_regions(const Dataset& dataset) {
    return !dataset.models.empty() ||
           std::ranges::any_of(dataset.objects, [](const Object& object) { return std::holds_alternative<CellMesh>(object); });
}

// Regions that a repair has found are stated by what it writes, so that a surface with one of them on both sides is meant to be so. Whether
// it was meant to part anything is as open as it was: what is said of that where nothing is stated is added.
Result<void> add_undecided(const std::string& path, Dataset& dataset, validators::CheckOptions checks, ReportedFile& after) {
    if (dataset.models.empty() || !validators::wanted(checks, "B29")) return {};
    checks.only = {"B29"};
    checks.closing_tolerance = false;
    auto models = std::exchange(dataset.models, {});
    auto found = validate(path, dataset, checks);
    dataset.models = std::move(models);
    if (!found) return std::move(found).why();
    for (Finding& finding : found->findings) {
        const bool known =
            std::ranges::any_of(after.findings, [&](const Finding& f) { return f.code == "B29" && f.message == finding.message; });
        if (finding.code == "B29" && !known) after.findings.push_back(std::move(finding));
    }
    return {};
}

// What is found in a result: at the tolerance that was asked for, and where it seems sound then, at the one by rule, too. What was
// not welded is not one for those who read the result.
Result<ReportedFile> validate_result(const std::string& path, const Dataset& dataset, const validators::CheckOptions& checks,
                                     std::vector<Brep>* judged) {
    auto after = validate(path, dataset, checks, judged);
    if (!after || count_by_severity(after->findings).error > 0) return after;
    const auto strict = strict_options(dataset, checks);
    if (!strict) return after;
    std::vector<Brep> strictly;
    auto again = validate(path, dataset, *strict, judged != nullptr ? &strictly : nullptr);
    if (again && count_by_severity(again->findings).error == 0) return after;
    if (judged != nullptr) *judged = std::move(strictly);
    return again;
}

Result<FoundBefore> found_before(const std::string& path, const Dataset& dataset, bool grids, const validators::CheckOptions& checks,
                                 std::vector<Brep>* judged = nullptr) {
    auto asked = validate(path, dataset, checks, judged);
    if (!asked) return std::move(asked).why();
    FoundBefore before{std::move(*asked), {}};
    const auto strict = grids ? std::nullopt : strict_options(dataset, checks);
    if (!strict) return before;
    auto again = validate(path, dataset, *strict);
    if (!again) return std::move(again).why();
    before.strict = std::move(*again);
    return before;
}

// Whether the regions of meshes go into a format by the surfaces around them alone: it is these that have to be sound then.
bool leaves_cells_behind(const Dataset& dataset, const Format& target) {
    return target.wants == WriterWants::faced_model && std::ranges::any_of(dataset.objects, [](const Object& object) {
               const auto* mesh = std::get_if<CellMesh>(&object);
               return mesh != nullptr && !mesh->entities.empty();
           });
}

Result<void> mend(Dataset& dataset, const Format& target, const RepairRequest& request, RepairReport& report) {
    const std::string& path = request.files.inputs.front();
    flatten_meshes(dataset);
    const bool stated = !dataset.models.empty(), regions_stated = states_regions(dataset);
    const bool grids = std::ranges::any_of(dataset.objects, is_grid);
    std::vector<Brep> judged;
    std::vector<Brep>* const wanted = request.inspect ? &judged : nullptr;
    auto before = found_before(path, dataset, grids, request.checks, wanted);
    if (!before) return std::move(before).why();
    if (request.inspect && request.look) {
        if (auto looked = request.look(dataset, judged, before->asked); !looked) return looked;
    }
    judged.clear();
    report.valid_before = count_by_severity(before->judged()).error == 0;
    report.recipe = request.recipe;
    const bool cells_only = !grids && mend_cells(dataset, before->judged(), request, report) && !leaves_cells_behind(dataset, target);
    if (!grids && !cells_only && !report.file.steps.empty()) {  // what is left to mend in the surfaces
        before = found_before(path, dataset, grids, request.checks);
        if (!before) return std::move(before).why();
    }
    if (!grids && !cells_only) surround_regions(dataset);
    report.closed = grids || cells_only;
    repair::ModelChanges changes;
    auto mended = cells_only ? Result<void>()
                  : grids    ? mend_grids(dataset, request, report)
                             : mend_surfaces(dataset, *before, request, report, changes);
    if (!mended && mended.why().error.where.file.empty() && mended.why().kind == FailureKind::usage) {
        Failure why = mended.why();
        why.error.where.file = path;
        return why;
    }
    if (!mended) return mended;
    // Regions that were found, and stated by none of the inputs, are no loss where the target holds none.
    if (!stated && target.wants == WriterWants::objects) dataset.models.clear();
    auto after = validate_result(path, dataset, request.checks, wanted);
    if (!after) return std::move(after).why();
    if (!grids && !cells_only && !regions_stated) {
        if (auto added = add_undecided(path, dataset, request.checks, *after); !added) return added;
    }
    if (report.open) keep_unclosed(before->asked, *after);
    else if (!report.closed && !report.valid_before && after->valid == true) {
        after->valid.reset();
        after->findings.push_back(
            make_finding("F167",
                         "the result is not fully checked: the surfaces enclose no region, so that nothing says whether they are "
                         "open where they should close; no error is left in what was checked",
                         {path}));
    }
    after->steps = std::move(report.file.steps);
    if (!after->closing) after->closing = report.file.closing;
    report.file = std::move(*after);
    if (request.inspect) {
        if (auto inspected = request.inspect(dataset, judged, changes, report.file); !inspected) return inspected;
    }
    report.edited = std::ranges::none_of(report.file.steps, [](const ReportedStep& s) { return s.step == "edit" && !s.kept; });
    if (!report.edited)
        return failure(FailureKind::cannot_hold, "F021", {request.files.output}, "the edit was undone: nothing was written");
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
        if (auto known = repair::known_step(name); !known) return std::move(known).why();
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
