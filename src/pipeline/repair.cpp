// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/repair.h"

#include <algorithm>

#include "pipeline/command_options.h"
#include "repair/grid_steps.h"

namespace geomend {

namespace {

bool is_grid(const Object& object) {
    const auto* grid = std::get_if<CornerPointGrid>(&object);
    return grid != nullptr && validators::has_geometry(*grid);
}

std::vector<std::string> steps_of(const RepairRequest& request) {
    if (!request.steps.empty()) return request.steps;
    const auto usual = repair::usual_grid_steps();
    return {usual.begin(), usual.end()};
}

Result<void> mend(Dataset& dataset, const RepairRequest& request, RepairReport& report) {
    const std::string& path = request.files.inputs.front();
    if (std::ranges::none_of(dataset.objects, is_grid))
        return failure(FailureKind::usage, "F018", {path},
                       "nothing in this file can be repaired yet: there is no corner-point grid with geometry");
    auto before = validate(path, dataset, request.checks);
    if (!before) return std::move(before).why();
    report.valid_before = count_by_severity(before->findings).error == 0;
    auto done = repair::run_grid_steps(dataset, steps_of(request), {request.checks, request.gap});
    if (!done) return std::move(done).why();
    auto after = validate(path, dataset, request.checks);
    if (!after) return std::move(after).why();
    report.file = std::move(*after);
    for (auto& [step, what] : *done) report.file.steps.push_back({std::move(step), std::move(what)});
    if (request.inspect) {
        if (auto inspected = request.inspect(dataset, dataset.breps, report.file); !inspected) return inspected;
    }
    const bool errors = count_by_severity(report.file.findings).error > 0;
    if (errors && !request.keep_invalid)
        return failure(FailureKind::cannot_hold, "F021", {request.files.output}, "the result is not valid: nothing was written");
    report.written = true;
    return {};
}

}  // namespace

Result<RepairReport> repair_file(const RepairRequest& request) {
    if (auto known = repair::known_grid_steps(request.steps); !known) return std::move(known).why();
    RepairReport report;
    ConvertRequest files = request.files;
    if (files.load.command.empty()) files.load.command = repair_option_rows();
    const auto converted = convert(files, [&](Dataset& dataset) { return mend(dataset, request, report); });
    if (converted) {
        report.losses = converted->losses;
        return report;
    }
    const bool stopped_by_findings = !report.written && !report.file.file.empty() && converted.why().kind == FailureKind::cannot_hold;
    if (stopped_by_findings) return report;
    return converted.why();
}

}  // namespace geomend
