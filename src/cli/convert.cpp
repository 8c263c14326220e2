// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/convert.h"

#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/common_options.h"
#include "pipeline/json_parts.h"

namespace geomend::cli {

namespace {

struct ConvertOptions : CommonOptions {
    std::vector<std::string> inputs;
    std::string output;
    std::string like;
    bool lossy = false;
};

Json result_json(const ConvertOptions& o, const Result<ConvertReport>& result) {
    Json j{{"inputs", o.inputs}, {"output", o.output}};
    if (!result) {
        j["written"] = false;
        j["error"] = failure_json(result.why());
        return j;
    }
    j["written"] = true;
    j["format"] = result->format;
    Json findings = Json::array();
    for (const Finding& f : result->findings) findings.push_back(finding_json(f));
    j["findings"] = std::move(findings);
    j["loss"] = losses_json(result->losses);
    return j;
}

ExitStatus run(const ConvertOptions& o) {
    auto options = format_options(o.options);
    if (!options) return report(options.why());
    if (const auto both = json_in_the_way(o.json, o.output)) return report(*both);
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    ConvertRequest request;
    request.inputs = o.inputs;
    request.output = o.output;
    request.to = o.to;
    request.like = o.like;
    request.lossy = o.lossy;
    request.tolerance = o.tolerance;
    request.accept_unterminated = o.accept_unterminated;
    request.load = {o.from, std::move(*options), &monitor};
    const auto result = convert(request);
    ExitStatus status = ExitStatus::done;
    if (!result) status = report(result.why());
    else if (!o.quiet) {
        report(result->findings, o.verbose);
        report(result->losses, o.verbose);
    }
    if (o.json) status = worse(status, print_beside(json_text(result_json(o, result)), result ? o.output : std::string()));
    return status;
}

}  // namespace

void add_convert(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("convert", "Convert one or several files into one output; lists what the target cannot hold");
    auto o = std::make_shared<ConvertOptions>();
    command->add_option("IN", o->inputs, "Input files; - is standard input")->required();
    command->add_option("-o,--output", o->output, "Output file; - is standard output")->required()->type_name("OUT");
    command->add_option("--like", o->like, "Put the values of the inputs' cells onto the corner-point grid of this file")
        ->type_name("GRID");
    command->add_flag("--lossy", o->lossy, "Write even where substance is lost (it is listed)");
    add_common_options(*command, *o, true);
    command->callback([o, &status] { status = run(*o); });
}

}  // namespace geomend::cli
