// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cli/check_arguments.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "drawing/scene.h"
#include "pipeline/grids.h"

namespace geomend::cli {

void add_check_arguments(CLI::App& command, CheckArguments& a) {
    command
        .add_option("--report", a.reports,
                    "Write a report: .json, .html (a page with the model), .sarif, .xml (JUnit) or .txt; may be given several times")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command.add_option("--debris", a.debris, "Write what each finding marks into a folder, as .vtp and .ts")->type_name("DIR");
    command.add_option("--fail-on", a.fail_on, "Findings from which the exit status is 1 (default error)")
        ->type_name("error|warning|info|never")
        ->check(CLI::IsMember({"error", "warning", "info", "never"}));
    command.add_option("--checks", a.checks, "Run only these checks")->type_name("CODE,...")->delimiter(',')->allow_extra_args(false);
    command.add_option("--skip", a.skip, "Leave these checks out")->type_name("CODE,...")->delimiter(',')->allow_extra_args(false);
    command.add_option("--max-findings", a.max_findings, "Most findings that are listed for a file; all are counted")
        ->type_name("N")
        ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000'000}));
}

Result<validators::CheckOptions> check_options(const CommonOptions& common, const CheckArguments& a, const Monitor* monitor) {
    validators::CheckOptions o;
    o.tolerance = common.tolerance;
    o.near = common.near;
    o.only = a.checks;
    o.skip = a.skip;
    o.monitor = monitor;
    const auto options = format_options(common.options);
    if (!options) return options.why();
    const std::string_view cells = option_value(*options, "cells");
    if (!cells.empty() && cells != "all" && cells != "active")
        return failure(FailureKind::usage, "F018", {}, "--option cells=" + std::string(cells) + ": expected all or active");
    o.all_cells = cells == "all";
    const std::string_view as = option_value(*options, "as");
    if (!as.empty() && as != "brep" && as != "cells")
        return failure(FailureKind::usage, "F018", {}, "--option as=" + std::string(as) + ": expected brep or cells");
    if (as == "brep") {
        auto request = model_request(*options);
        if (!request) return std::move(request).why();
        o.grid_model = std::move(*request);
    }
    return o;
}

namespace {

// From which severity on findings fail; none: never.
std::optional<Severity> fails_from(const CheckArguments& a) {
    if (a.fail_on == "never") return std::nullopt;
    return a.fail_on == "info" ? Severity::info : a.fail_on == "warning" ? Severity::warning : Severity::error;
}

}  // namespace

bool fails(const CheckArguments& a, std::span<const Finding> findings) {
    const auto least = fails_from(a);
    return least && std::ranges::any_of(findings, [&](const Finding& f) { return f.severity >= *least; });
}

Inspect inspection(const CheckArguments& a, DebrisFolder& debris, std::size_t files) {
    const bool page = draws_page(a), write = !a.debris.empty();
    if (!page && !write) return {};
    return [page, write, files, &debris](const Dataset& dataset, std::span<const Brep> breps, ReportedFile& file) -> Result<void> {
        file.scene = make_scene(dataset, breps);
        mark_findings(*file.scene, dataset, breps, file.findings);
        if (write) {
            if (auto written = debris.write(file); !written) return written;
        }
        if (page) thin(*file.scene, page_triangles(files));
        else file.scene.reset();
        return {};
    };
}

Result<void> check_targets(const CheckArguments& a, const DebrisFolder& debris) {
    for (const std::string& file : a.reports) {
        if (auto form = report_form(file); !form) return form;
    }
    return a.debris.empty() ? Result<void>() : debris.open();
}

Report empty_report(const CheckArguments& a) {
    Report report;
    report.tool = "geomend " GEOMEND_VERSION;
    report.most_findings = a.max_findings;
    report.fails_from = fails_from(a);
    return report;
}

}  // namespace geomend::cli
