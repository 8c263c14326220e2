// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/validate.h"

#include <unistd.h>

#include <cstdio>
#include <memory>

#include "cli/check_arguments.h"
#include "cli/commands.h"
#include "cli/common_options.h"

namespace geomend::cli {

namespace {

struct ValidateOptions : CommonOptions, CheckArguments {
    std::vector<std::string> files;
};

// Every file is judged, whatever became of the others; only a stop or a wrong command line ends it.
Result<Report> judge(const ValidateOptions& o, const LoadOptions& load, const validators::CheckOptions& checks, ExitStatus& status) {
    Report all = empty_report(o);
    for (const std::string& path : o.files) {
        auto file = validate(path, load, checks);
        if (!file) {
            const FailureKind kind = file.why().kind;
            if (kind == FailureKind::cancelled || kind == FailureKind::usage) return std::move(file).why();
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
    if (!o.report.empty()) {
        if (auto form = report_form(o.report); !form) return report(form.why());
    }
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    auto checks = check_options(o, o, &monitor);
    if (!checks) return report(checks.why());
    const LoadOptions load{o.from, std::move(*options), &monitor};
    ExitStatus status = ExitStatus::done;
    const auto all = judge(o, load, *checks, status);
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
    add_check_arguments(*command, *o);
    add_common_options(*command, *o, false);
    command->callback([o, &status] { status = run(*o); });
}

}  // namespace geomend::cli
