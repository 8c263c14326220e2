// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/validate.h"

#include <unistd.h>

#include <cstdio>
#include <memory>

#include "cli/check_arguments.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "report/baseline.h"

namespace geomend::cli {

namespace {

struct ValidateOptions : CommonOptions, CheckArguments {
    std::vector<std::string> files;
    std::string baseline;
};

// What an earlier report says of each file; nullptr for files that it does not have.
using Earlier = std::vector<const Baseline::File*>;

// Says on standard error what a baseline cannot tell.
void tell_gaps(const ValidateOptions& o, const Earlier& earlier) {
    if (o.quiet || o.baseline.empty()) return;
    for (std::size_t f = 0; f < o.files.size(); ++f) {
        const char *baseline = o.baseline.c_str(), *file = o.files[f].c_str();
        if (earlier[f] == nullptr) std::fprintf(stderr, "geomend: %s has nothing about %s: all its findings are new\n", baseline, file);
        else if (earlier[f]->not_listed > 0)
            std::fprintf(stderr, "geomend: %s does not list %llu findings of %s (--max-findings): they count as new\n", baseline,
                         static_cast<unsigned long long>(earlier[f]->not_listed), earlier[f]->file.c_str());
    }
}

// Every file is judged, whatever became of the others; only a stop, a wrong command line or debris that cannot be
// written ends it.
Result<Report> judge(const ValidateOptions& o, const LoadOptions& load, const validators::CheckOptions& checks, const Earlier& earlier,
                     const Inspect& show, ExitStatus& status) {
    Report all = empty_report(o);
    for (std::size_t number = 0; number < o.files.size(); ++number) {
        const std::string& path = o.files[number];
        auto file =
            validate(path, load, checks, [&](const Dataset& dataset, std::span<const Brep> breps, ReportedFile& found) -> Result<void> {
                if (earlier[number] != nullptr) leave_out_known(found, *earlier[number]);
                return show ? show(dataset, breps, found) : Result<void>();
            });
        if (!file) {
            const FailureKind kind = file.why().kind;
            if (kind == FailureKind::cancelled || kind == FailureKind::usage || kind == FailureKind::unwritable)
                return std::move(file).why();
            status = worse(status, report(file.why()));
            all.files.push_back(unreadable_file(path, file.why()));
            continue;
        }
        if (fails(o, file->findings)) status = worse(status, ExitStatus::findings);
        all.files.push_back(std::move(*file));
    }
    return all;
}

ExitStatus run(const ValidateOptions& o) {
    auto options = format_options(o.options);
    if (!options) return report(options.why());
    DebrisFolder debris(o.debris, o.max_findings);
    if (auto targets = check_targets(o, debris); !targets) return report(targets.why());
    Baseline baseline;
    if (!o.baseline.empty()) {
        auto read = read_baseline(o.baseline);
        if (!read) return report(read.why());
        baseline = std::move(*read);
    }
    const Earlier earlier = baseline_files(baseline, o.files);
    tell_gaps(o, earlier);
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    auto checks = check_options(o, o, &monitor);
    if (!checks) return report(checks.why());
    const LoadOptions load{o.from, std::move(*options), &monitor};
    ExitStatus status = ExitStatus::done;
    const auto all = judge(o, load, *checks, earlier, inspection(o, debris, o.files.size()), status);
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
    command->add_option("FILE", o->files, "Files to check; - is standard input")->required();
    command->add_option("--baseline", o->baseline, "Leave out what this JSON report of an earlier run has")->type_name("OLD.json");
    add_check_arguments(*command, *o);
    add_common_options(*command, *o, false);
    command->callback([o, &status] { status = run(*o); });
}

}  // namespace geomend::cli
