// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/validate.h"

#include <unistd.h>

#include <cstdio>
#include <memory>

#include "cli/check_arguments.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/validate_many.h"
#include "validators/readiness.h"

namespace geomend::cli {

namespace {

struct ValidateOptions : CommonOptions, CheckArguments, WorkerArguments {
    std::vector<std::string> files;
    std::string target;
};

// Every file is judged, whatever became of the others; only a stop or a wrong command line ends it.
Result<Report> judge(const ValidateOptions& o, const LoadOptions& load, const validators::CheckOptions& checks, ExitStatus& status) {
    Report all = empty_report(o);
    for (const std::string& path : o.files) {
        auto file = validate(path, load, checks);
        if (!file) {
            const FailureKind kind = file.why().kind;
            if (kind == FailureKind::cancelled || kind == FailureKind::usage) return std::move(file).why();
            status = worse(status, o.is_worker ? exit_status(kind) : report(file.why()));
            all.files.push_back(unreadable_file(path, file.why()));
            continue;
        }
        if (fails(o, file->findings)) status = worse(status, ExitStatus::findings);
        all.files.push_back(std::move(*file));
    }
    return all;
}

// Files that workers judged.
Result<Report> judge_many(const CLI::App& command, const ValidateOptions& o, const FoundFiles& files, const Monitor& monitor,
                          ExitStatus& status) {
    auto all = judge_in_workers(command, files, o, o.threads, &monitor, status);
    if (!all) return all;
    const Report with_head = empty_report(o);
    all->tool = with_head.tool;
    all->most_findings = with_head.most_findings;
    for (const ReportedFile& file : all->files) {
        if (file.outcome == FileOutcome::judged && fails(o, file.findings)) status = worse(status, ExitStatus::findings);
    }
    return all;
}

// The whole of what a worker says goes to standard output, also where it is not done.
ExitStatus work(const ValidateOptions& o, const Result<Report>& all, ExitStatus status) {
    Report said = empty_report(o);
    if (all) said = *all;
    else said.files.push_back(unreadable_file(o.files.front(), all.why()));
    said.most_findings = static_cast<std::size_t>(-1);
    return worse(all ? status : exit_status(all.why().kind), print(report_json(said)));
}

ExitStatus run(const CLI::App& command, const ValidateOptions& o) {
    settle_worker(o, o.threads);
    auto options = format_options(o.options);
    if (!options) return report(options.why());
    if (!o.report.empty()) {
        if (auto form = report_form(o.report); !form) return report(form.why());
    }
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    auto checks = check_options(o, o, &monitor);
    if (!checks) return report(checks.why());
    checks->target = o.target;
    const LoadOptions load{o.from, std::move(*options), &monitor};
    ExitStatus status = ExitStatus::done;
    const FoundFiles files = o.is_worker ? FoundFiles() : find_files(o.files);
    const auto all =
        o.files.size() > 1 || need_workers(files, o) ? judge_many(command, o, files, monitor, status) : judge(o, load, *checks, status);
    if (o.is_worker) return work(o, all, status);
    if (!all) return report(all.why());
    if (!o.report.empty()) {
        if (auto written = write_report(*all, o.report); !written) status = worse(status, report(written.why()));
    }
    if (o.json) return worse(status, print(report_json(*all)));
    if (o.quiet) return status;
    return worse(status, print(report_text(*all, ::isatty(STDOUT_FILENO) == 1)));
}

}  // namespace

void add_validate(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("validate", "Check models; nothing is written but the report");
    auto o = std::make_shared<ValidateOptions>();
    command->add_option("FILE", o->files, "Files, folders and patterns to check; - is standard input")->required();
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
