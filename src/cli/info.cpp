// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/info.h"

#include <memory>

#include "cli/commands.h"
#include "cli/common_options.h"

namespace geomend::cli {

namespace {

struct InfoOptions : CommonOptions {
    std::vector<std::string> files;
};

ExitStatus run(const InfoOptions& o) {
    auto options = format_options(o.options);
    if (!options) return report(options.why());
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    const LoadOptions load{o.from, std::move(*options), &monitor};
    ExitStatus status = ExitStatus::done;
    std::vector<FileSummary> summaries;
    for (const std::string& file : o.files) {
        FileSummary summary = summarise(file, load);
        if (summary.error) status = worse(status, report(*summary.error));
        else if (!o.quiet) report(summary.findings, o.verbose);
        if (summary.error && summary.error->kind == FailureKind::cancelled) return status;
        if (o.json) summaries.push_back(std::move(summary));
        else if (!summary.error) status = worse(status, print(info_text(summary, o.verbose)));
    }
    if (o.json) status = worse(status, print(info_json(summaries)));
    return status;
}

}  // namespace

void add_info(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("info", "Tell what files hold: objects, counts, bounds, attributes, boundary representation");
    auto o = std::make_shared<InfoOptions>();
    command->add_option("FILE", o->files, "Files to look at; - is standard input")->required();
    add_common_options(*command, *o, false);
    command->callback([o, &status] { status = run(*o); });
}

}  // namespace geomend::cli
