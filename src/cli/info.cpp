// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/info.h"

#include <memory>

#include "cli/commands.h"
#include "cli/common_options.h"
#include "formats/options.h"
#include "pipeline/command_options.h"
#include "pipeline/complexity_report.h"

namespace geomend::cli {

namespace {

struct InfoOptions : CommonOptions {
    std::vector<std::string> files;
    bool complexity = false;
    std::string sites;
};

// The cells of all boundary representations of all files, as points.
void take_sites(const FileSummary& summary, Dataset& sites) {
    for (const BrepSummary& b : summary.breps) {
        if (!b.complexity || !b.complexity->cells) continue;
        sites.objects.emplace_back(complexity_sites(*b.complexity, b.name.empty() ? "complexity" : b.name + " complexity"));
    }
}

ExitStatus write_sites(Dataset sites, const std::string& path) {
    if (sites.objects.empty())
        return report(failure(FailureKind::cannot_hold, "F017", {path}, "there are no cells to write: no model has closed regions"));
    const auto written = write_objects(std::move(sites), path);
    return written ? ExitStatus::done : report(written.why());
}

ExitStatus run(const InfoOptions& o) {
    auto options = format_options(o.options);
    if (!options) return report(options.why());
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    if (auto known = checked_options(*options, {{}, nullptr, info_option_rows()}); !known) return report(known.why());
    const LoadOptions load{o.from, std::move(*options), &monitor, info_option_rows(), o.files.size() > 1};
    const auto measures = complexity_options(load.options, &monitor);
    if (!measures) return report(measures.why());
    const bool measured = o.complexity || !o.sites.empty();
    ExitStatus status = ExitStatus::done;
    std::vector<FileSummary> summaries;
    Dataset sites;
    for (const std::string& file : o.files) {
        FileSummary summary = summarise(file, load, measured ? &*measures : nullptr, o.tolerance);
        if (!summary.error) take_sites(summary, sites);
        if (summary.error) status = worse(status, report(*summary.error));
        else if (!o.quiet) report(summary.findings, o.verbose);
        if (summary.error && summary.error->kind == FailureKind::cancelled) return status;
        if (o.json) summaries.push_back(std::move(summary));
        else if (!summary.error) status = worse(status, print(info_text(summary, o.verbose)));
    }
    if (!o.sites.empty()) status = worse(status, write_sites(std::move(sites), o.sites));
    if (o.json) status = worse(status, print(info_json(summaries)));
    return status;
}

}  // namespace

void add_info(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("info", "List what files hold: objects, counts, bounds, attributes, boundary representation");
    auto o = std::make_shared<InfoOptions>();
    command->add_option("FILE", o->files, "Files to look at; - is standard input")->required();
    command->add_flag("--complexity", o->complexity, "Also how complex the boundary representation is, and where");
    command->add_option("--complexity-sites", o->sites, "Write the cells in which elements were counted as points")->type_name("FILE");
    add_common_options(*command, *o, false);
    command->callback([o, &status] { status = run(*o); });
}

}  // namespace geomend::cli
