// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/repair.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "base/input.h"
#include "base/number_text.h"
#include "base/output.h"
#include "cli/check_arguments.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "drawing/changes.h"
#include "drawing/scene.h"
#include "repair/grid_steps.h"
#include "repair/surface_steps.h"

namespace geomend::cli {

namespace {

struct RepairOptions : CommonOptions, CheckArguments {
    std::vector<std::string> inputs;
    std::string output;
    std::vector<std::string> steps;
    std::string step_list;  // separated by commas
    std::string recipe, write_recipe, box;
    std::optional<double> max_gap, max_displacement;
    bool lossy = false, keep_invalid = false, dry_run = false;
};

Result<std::optional<double>> gap_of(const FormatOptions& options) {
    const std::string_view text = option_value(options, "gap");
    if (text.empty()) return std::optional<double>();
    double gap = 0;
    if (parse_real(text, gap) != NumberStatus::ok || !(gap >= 0) || gap > 1e20)
        return failure(FailureKind::usage, "F018", {}, "--option gap=" + std::string(text) + ": expected a length");
    return std::optional<double>(gap);
}

std::vector<std::string> steps_of(const RepairOptions& o) {
    std::vector<std::string> steps;
    for (std::size_t at = 0; !o.step_list.empty() && at <= o.step_list.size();) {
        const std::size_t end = std::min(o.step_list.find(',', at), o.step_list.size());
        steps.push_back(o.step_list.substr(at, end - at));
        at = end + 1;
    }
    steps.insert(steps.end(), o.steps.begin(), o.steps.end());
    return steps;
}

// Options that no step of a list takes are no help to it, but a mistake.
Result<void> taken_by_steps(const RepairOptions& o, const repair::Recipe& recipe) {
    if (recipe.steps.empty()) return {};
    const auto has = [&](std::initializer_list<std::string_view> names) {
        return std::ranges::any_of(names,
                                   [&](std::string_view name) { return std::ranges::find(recipe.steps, name) != recipe.steps.end(); });
    };
    const auto refuse = [](const std::string& option, const std::string& steps) {
        return failure(FailureKind::usage, "F018", {}, option + ": none of the steps takes it; it is for " + steps);
    };
    if (!o.box.empty() && !has({"box"})) return refuse("--box", "box");
    if (o.max_gap && !has({"close", "holes", "tails"})) return refuse("--max-gap", "holes, close and tails");
    return {};
}

std::filesystem::path folder_of(const std::string& recipe) { return std::filesystem::path(recipe).parent_path(); }

// Files of edits are named from the folder of the recipe.
void find_beside(const std::string& recipe, std::vector<repair::SurfaceEdit>& edits) {
    for (repair::SurfaceEdit& edit : edits) {
        if (!edit.file.empty()) edit.file = (folder_of(recipe) / edit.file).string();  // as it is where it is absolute
    }
}

// The same files, as a recipe in another folder names them.
void name_from(const std::string& recipe, std::vector<repair::SurfaceEdit>& edits) {
    for (repair::SurfaceEdit& edit : edits) {
        if (edit.file.empty() || std::filesystem::path(edit.file).is_absolute()) continue;
        std::error_code none;
        const auto here = std::filesystem::absolute(recipe, none).parent_path();
        const auto named = std::filesystem::absolute(edit.file, none).lexically_normal().lexically_relative(here.lexically_normal());
        if (!none && !named.empty()) edit.file = named.string();
    }
}

// The recipe that is named, if one is; what the command line says besides takes the place of its entries.
Result<repair::Recipe> recipe_of(const RepairOptions& o) {
    repair::Recipe recipe;
    if (!o.recipe.empty()) {
        auto input = Input::open(o.recipe);
        if (!input) return std::move(input).why();
        auto parsed = repair::parse_recipe(input->bytes(), o.recipe);
        if (!parsed) return std::move(parsed).why();
        recipe = std::move(*parsed);
        find_beside(o.recipe, recipe.edits);
    }
    if (auto steps = steps_of(o); !steps.empty()) recipe.steps = std::move(steps);
    if (o.max_gap) recipe.max_gap = o.max_gap;
    if (o.max_displacement) recipe.max_displacement = o.max_displacement;
    if (!o.box.empty()) {
        recipe.box.reset();
        recipe.automatic_box = false;
        if (auto box = repair::parse_box(o.box, recipe); !box) return std::move(box).why();
    }
    if (auto taken = taken_by_steps(o, recipe); !taken) return std::move(taken).why();
    return recipe;
}

Result<RepairRequest> request_of(const RepairOptions& o, const Monitor& monitor) {
    auto options = format_options(o.options);
    if (!options) return std::move(options).why();
    RepairRequest request;
    auto gap = gap_of(*options);
    if (!gap) return std::move(gap).why();
    request.gap = *gap;
    auto checks = check_options(o, o, &monitor);
    if (!checks) return std::move(checks).why();
    request.checks = std::move(*checks);
    take_files(o, std::move(*options), &monitor, request.files);
    auto recipe = recipe_of(o);
    if (!recipe) return std::move(recipe).why();
    if (request.checks.tolerance < 0 && recipe->tolerance) request.checks.tolerance = *recipe->tolerance;
    if (request.checks.near < 0 && recipe->near) request.checks.near = *recipe->near;
    request.recipe = std::move(*recipe);
    request.dry_run = o.dry_run;
    request.keep_invalid = o.keep_invalid;
    return request;
}

// What is written beside the result must be neither an input nor the result.
Result<void> check_places(const RepairOptions& o) {
    std::vector<std::string> beside = o.reports, taken = o.inputs;
    beside.push_back(o.write_recipe);
    taken.push_back(o.output);
    taken.push_back(o.recipe);
    return keep_places_apart(beside, std::move(taken), "a report or recipe");
}

// With --report FILE.html the model is drawn before and after; with --debris what was left out is written, and what the findings
// mark. Nothing where neither is asked for. `debris` must outlive the request.
void look_on(RepairRequest& request, const CheckArguments& a, DebrisFolder& debris) {
    const bool page = draws_page(a), write = !a.debris.empty();
    if (!page && !write) return;
    auto before = std::make_shared<Scene>();
    auto counts = std::make_shared<SeverityCounts>();
    request.look = [page, before, counts](const Dataset& dataset, std::span<const Brep> breps, ReportedFile& file) -> Result<void> {
        if (page) *before = make_scene(dataset, breps);
        *counts = count_by_severity(file.findings);
        return {};
    };
    request.inspect = [page, write, before, counts, &debris](const Dataset& dataset, std::span<const Brep> breps,
                                                             const repair::ModelChanges& changes, ReportedFile& file) -> Result<void> {
        file.scene = make_scene(dataset, breps);
        mark_findings(*file.scene, dataset, breps, file.findings);
        file.changes = reported_changes(std::move(*before), changes);
        file.changes->errors_before = counts->error;
        file.changes->warnings_before = counts->warning;
        if (write) {
            if (auto written = debris.write(file); !written) return written;
            if (auto written = debris.write(*file.changes, file.scene->crs); !written) return written;
        }
        mark_changes(*file.scene, breps, changes);
        constexpr std::size_t both = 2;
        thin(*file.scene, page_triangles(both));
        thin(file.changes->before, page_triangles(both));
        if (!page) file.scene.reset();
        return {};
    };
}

ExitStatus run(const RepairOptions& o) {
    if (auto places = check_places(o); !places) return report(places.why());
    if (const auto both = json_in_the_way(o.json, o.output)) return report(*both);
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    DebrisFolder debris(o.debris, o.max_findings, &monitor);
    if (auto targets = check_targets(o, debris); !targets) return report(targets.why());
    auto request = request_of(o, monitor);
    if (!request) return report(request.why());
    look_on(*request, o, debris);
    auto repaired = repair_file(*request);
    if (!repaired) return report(repaired.why());
    const bool was_sound = repaired->valid_before && repaired->file.steps.empty();
    const bool valid = repaired->edited && count_by_severity(repaired->file.findings).error == 0;
    ExitStatus status = !valid ? ExitStatus::invalid_result : fails(o, repaired->file.findings) ? ExitStatus::findings : ExitStatus::done;
    Report all = empty_report(o);
    all.files.push_back(std::move(repaired->file));
    all.exit_status = static_cast<int>(status);
    for (const std::string& file : o.reports) {
        if (auto written = write_report(all, file, &monitor); !written) status = worse(status, report(written.why()));
    }
    if (!o.quiet) report(repaired->losses, o.verbose);
    if (!o.write_recipe.empty()) {
        OutputSet output(o.write_recipe);
        name_from(o.write_recipe, repaired->recipe.edits);
        output.main_file() << repair::recipe_text(repaired->recipe);
        if (auto written = output.commit(&monitor); !written) status = worse(status, report(written.why()));
    }
    if (o.json) return worse(status, print_about(repair_json(all), o.output, repaired->written));
    if (!o.quiet) {
        // The model itself may go to standard output.
        const std::string text = report_text(all, wants_color(o.output == "-" ? STDERR_FILENO : STDOUT_FILENO)) +
                                 (was_sound ? "  there was nothing to mend\n" : "");
        status = worse(status, print_about(text, o.output, repaired->written));
    }
    if (o.dry_run) std::fputs("geomend: a dry run: nothing was written\n", stderr);
    else if (!repaired->edited)
        std::fputs("geomend: what was to be edited was undone: nothing was written (--keep-invalid keeps it)\n", stderr);
    else if (!repaired->written) std::fputs("geomend: the result is not valid: nothing was written (--keep-invalid writes it)\n", stderr);
    return status;
}

}  // namespace

void add_repair(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("repair", "Mend what validate finds, by explicit steps");
    auto o = std::make_shared<RepairOptions>();
    command->add_option("IN", o->inputs, "Input files, taken as one model; - is standard input")->required();
    command->add_option("-o,--output", o->output, "Output file; - is standard output")->required()->type_name("OUT");
    std::string names;
    for (const repair::SurfaceStepRow& row : repair::surface_steps()) names += (names.empty() ? "" : "|") + std::string(row.name);
    for (const repair::StepRow& row : repair::grid_steps()) names += (names.empty() ? "" : "|") + std::string(row.name);
    command->add_option("--step", o->steps, "A step, may be repeated; taken in the order given (default: those that mend what is found)")
        ->type_name(names)
        ->allow_extra_args(false);
    command->add_option("--steps", o->step_list, "Steps, separated by commas, in the order in which they are taken")->type_name("A,B,...");
    command->add_option("--recipe", o->recipe, "File (TOML) of steps, lengths and decisions; the command line goes before it")
        ->type_name("FILE");
    command->add_option("--write-recipe", o->write_recipe, "Writes the recipe with which the same is done again")->type_name("FILE");
    command->add_flag("--dry-run", o->dry_run, "Does all but write: the plan, what each step would do, and what is left");
    command->add_option("--box", o->box, "Adds the six sides of a box: auto, or x0,x1,y0,y1,z0,z1")->type_name("BOX");
    command
        ->add_option("--max-gap", o->max_gap, "Largest gap that is closed and overshoot that is trimmed (default 1e-3 of the model's size)")
        ->type_name("L")
        ->check(is_length());
    command->add_option("--max-displacement", o->max_displacement, "A step that moves a vertex farther is undone")
        ->type_name("L")
        ->check(is_length());
    command->add_flag("--keep-invalid", o->keep_invalid, "Write the result even where it still has errors");
    command->add_flag("--lossy", o->lossy, "Write even where the target cannot hold all of the model");
    add_check_arguments(*command, *o);
    add_common_options(*command, *o, true);
    command->callback([o, &status] { status = run(*o); });
}

}  // namespace geomend::cli
