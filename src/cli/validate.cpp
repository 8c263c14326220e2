// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/validate.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "cli/check_arguments.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/validate_many.h"
#include "drawing/scene.h"
#include "formats/options.h"
#include "pipeline/command_options.h"
#include "report/baseline.h"
#include "validators/readiness.h"

namespace geomend::cli {

namespace {

struct ValidateOptions : CommonOptions, CheckArguments, WorkerArguments {
    std::vector<std::string> files;
    std::string baseline, target;
};

// What an earlier report says of each file; nullptr for files that it does not have.
using Earlier = std::vector<const Baseline::File*>;

// Says on standard error what a baseline cannot tell.
void tell_gaps(const ValidateOptions& o, const std::vector<std::string>& files, const Earlier& earlier) {
    if (o.quiet || o.baseline.empty()) return;
    for (std::size_t f = 0; f < files.size(); ++f) {
        const char *baseline = o.baseline.c_str(), *file = files[f].c_str();
        if (earlier[f] == nullptr) std::fprintf(stderr, "geomend: %s has nothing about %s: all its findings are new\n", baseline, file);
        else if (earlier[f]->not_listed > 0)
            std::fprintf(stderr, "geomend: %s does not list %llu findings of %s (--max-findings): they count as new\n", baseline,
                         static_cast<unsigned long long>(earlier[f]->not_listed), earlier[f]->file.c_str());
    }
}

// One file, in this process. Only a stop, a wrong command line or debris that cannot be written is a failure.
Result<Report> judge_here(const ValidateOptions& o, const LoadOptions& load, const validators::CheckOptions& checks,
                          const Baseline& baseline, DebrisFolder& debris, ExitStatus& status) {
    Report all = empty_report(o);
    const std::string& path = o.files.front();
    const Earlier earlier = baseline_files(baseline, {path});
    tell_gaps(o, {path}, earlier);
    const Inspect show = inspection(o, debris, 1);
    auto file = validate(path, load, checks, [&](const Dataset& dataset, std::span<const Brep> breps, ReportedFile& found) -> Result<void> {
        if (earlier[0] != nullptr) leave_out_known(found, *earlier[0]);
        return show ? show(dataset, breps, found) : Result<void>();
    });
    if (!file) {
        const FailureKind kind = file.why().kind;
        if (kind == FailureKind::cancelled || kind == FailureKind::usage || kind == FailureKind::unwritable) return std::move(file).why();
        status = worse(status, report(file.why()));
        all.files.push_back(unreadable_file(path, file.why()));
        return all;
    }
    if (fails(o, file->findings)) status = worse(status, ExitStatus::findings);
    all.files.push_back(std::move(*file));
    return all;
}

// Many files, each in a worker. What an earlier report knows and debris are dealt with here, one file after the other.
Result<Report> judge_many(const CLI::App& command, const ValidateOptions& o, const FoundFiles& found, const Monitor& monitor,
                          const Baseline& baseline, DebrisFolder& debris, ExitStatus& status) {
    auto all = judge_in_workers(command, found, o, o.threads, &monitor, status);
    if (!all) return all;
    Report head = empty_report(o);
    all->tool = std::move(head.tool);
    all->most_findings = head.most_findings;
    all->fails_from = head.fails_from;
    std::vector<std::string> names;
    for (const ReportedFile& file : all->files) names.push_back(file.file);
    const Earlier earlier = baseline_files(baseline, names);
    tell_gaps(o, names, earlier);
    for (std::size_t f = 0; f < names.size(); ++f) {
        ReportedFile& file = all->files[f];
        if (file.outcome != FileOutcome::judged) continue;
        if (earlier[f] != nullptr) leave_out_known(file, *earlier[f]);
        if (!o.debris.empty() && file.scene) {
            if (auto written = debris.write(file); !written) return std::move(written).why();
        }
        if (!draws_page(o)) file.scene.reset();
        if (fails(o, file.findings)) status = worse(status, ExitStatus::findings);
    }
    return all;
}

// In a worker: all that was found in one file, and what pages and debris need of its model.
WorkerAnswer work(const ValidateOptions& o, const LoadOptions& load, const validators::CheckOptions& checks, const std::string& path) {
    const bool draw = draws_page(o) || !o.debris.empty();
    Report said = empty_report(o);
    said.most_findings = static_cast<std::size_t>(-1);
    auto file = validate(path, load, checks, [&](const Dataset& dataset, std::span<const Brep> breps, ReportedFile& found) -> Result<void> {
        if (!draw) return {};
        // As they will stand in the report: marks come in the order of their findings.
        std::ranges::stable_sort(found.findings, [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
        found.scene = make_scene(dataset, breps);
        mark_findings(*found.scene, dataset, breps, found.findings);
        if (draws_page(o)) thin(*found.scene, page_triangles(o.run_size));
        else found.scene->parts.clear();
        return {};
    });
    const ExitStatus status = file ? ExitStatus::done : exit_status(file.why().kind);
    said.files.push_back(file ? std::move(*file) : unreadable_file(path, file.why()));
    return {status, worker_report(said)};
}

ExitStatus run(const CLI::App& command, const ValidateOptions& o) {
    settle_worker(o, o.threads);
    auto options = format_options(o.options);
    if (!options) return report(options.why());
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    auto checks = check_options(o, o, &monitor);
    if (!checks) return report(checks.why());
    checks->target = o.target;
    if (auto known = checked_options(*options, {{}, nullptr, validate_option_rows()}); !known) return report(known.why());
    const LoadOptions load{o.from, std::move(*options), &monitor, validate_option_rows(), o.is_worker() && o.run_size > 1};
    if (o.is_worker() && o.serves) return serve(o, o.threads, [&](const std::string& path) { return work(o, load, *checks, path); });
    if (o.is_worker()) {
        const WorkerAnswer answer = work(o, load, *checks, o.files.front());
        return worse(answer.status, print(answer.report));
    }

    DebrisFolder debris(o.debris, o.max_findings, &monitor);
    if (auto targets = check_targets(o, debris); !targets) return report(targets.why());
    Baseline baseline;
    if (!o.baseline.empty()) {
        auto read = read_baseline(o.baseline);
        if (!read) return report(read.why());
        baseline = std::move(*read);
    }
    ExitStatus status = ExitStatus::done;
    const FoundFiles files = find_files(o.files);
    const bool many = o.files.size() > 1 || need_workers(files, o);
    auto all =
        many ? judge_many(command, o, files, monitor, baseline, debris, status) : judge_here(o, load, *checks, baseline, debris, status);
    if (!all) return report(all.why());
    all->exit_status = static_cast<int>(status);
    for (const std::string& file : o.reports) {
        if (auto written = write_report(*all, file, &monitor); !written) status = worse(status, report(written.why()));
    }
    if (o.json) return worse(status, print(report_json(*all)));
    if (o.quiet) return status;
    all->all_notes = o.verbose;
    return worse(status, print(report_text(*all, wants_color(STDOUT_FILENO))));
}

}  // namespace

void add_validate(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("validate", "Check models; nothing is written but the report");
    auto o = std::make_shared<ValidateOptions>();
    command->add_option("FILE", o->files, "Files, folders and patterns to check; - is standard input")->required();
    command->add_option("--baseline", o->baseline, "Leave out what this JSON report of an earlier run has")->type_name("OLD.json");
    add_check_arguments(*command, *o);
    std::vector<std::string> targets;
    for (const validators::Target& target : validators::all_targets()) targets.emplace_back(target.name);
    command->add_option("--for", o->target, "Also what this simulator or mesher needs, and what it would choke on")
        ->type_name("TARGET")
        ->check(CLI::IsMember(targets));
    add_worker_arguments(*command, *o);
    add_common_options(*command, *o, false);
    command->callback([o, command, &status] { status = run(*command, *o); });
}

}  // namespace geomend::cli
