// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "cli/common_options.h"
#include "pipeline/debris.h"
#include "pipeline/validate.h"
#include "report/report.h"
#include "validators/grid_scope.h"

namespace geomend::cli {

/// What the commands that check (validate, repair) take beside the common options.
struct CheckArguments {
    std::vector<std::string> reports;
    std::string debris, fail_on = "error";
    std::vector<std::string> checks, skip;
    std::size_t max_findings = static_cast<std::size_t>(-1);
};

void add_check_arguments(CLI::App& command, CheckArguments& arguments);

/// What the checks are told. Failure (usage) for a wrong value of options cells, as, horizons.
Result<validators::CheckOptions> check_options(const CommonOptions& common, const CheckArguments& arguments, const Monitor* monitor);

/// True where a finding is at or above the severity of --fail-on.
bool fails(const CheckArguments& arguments, std::span<const Finding> findings);

/// Whether a report is a page, which draws the model.
inline bool draws_page(const CheckArguments& arguments) {
    return std::ranges::any_of(arguments.reports, [](const std::string& report) { return report.ends_with(".html"); });
}

/// What is done with the findings of a file before its dataset is gone: with --report FILE.html the model is drawn, with
/// --debris what they mark is written. Empty where there is nothing to do. `debris` must outlive it. `files` is their number.
Inspect inspection(const CheckArguments& arguments, DebrisFolder& debris, std::size_t files);

/// Failure where --report or --debris could not be followed at the end: told before the work.
Result<void> check_targets(const CheckArguments& arguments, const DebrisFolder& debris);

/// A report without files yet.
Report empty_report(const CheckArguments& arguments);

}  // namespace geomend::cli
