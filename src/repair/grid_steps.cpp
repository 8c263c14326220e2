// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/grid_steps.h"

#include <algorithm>
#include <array>

namespace geomend::repair {

namespace {

constexpr std::array<std::string_view, 2> monotone_mends = {"C03", "C07"};
constexpr std::array<std::string_view, 1> close_gaps_mends = {"C04"};
constexpr std::array<std::string_view, 1> drop_collapsed_mends = {"C05"};
constexpr std::array<std::string_view, 1> drop_isolated_mends = {"C21"};
constexpr std::array<std::string_view, 2> minpv_mends = {"C16", "F153"};
constexpr std::array<std::string_view, 1> handedness_mends = {"C12"};

constexpr std::array steps = {
    StepRow{"monotone", "where the bottom of a cell lies above its top on a pillar, it comes down to the top; what touched it follows",
            monotone_mends, monotone},
    StepRow{"close-gaps",
            "gaps and overlaps up to the tolerance, or --option gap=L, between cells one above the other: both meet at the mean",
            close_gaps_mends, close_gaps},
    StepRow{"drop-collapsed", "active cells without thickness on any pillar become inactive", drop_collapsed_mends, drop_collapsed},
    StepRow{"drop-isolated", "active cells that touch no other become inactive", drop_isolated_mends, drop_isolated},
    StepRow{"minpv", "active cells with a pore volume below MINPV become inactive", minpv_mends, minpv},
    StepRow{"pinch", "inactive layers up to PINCH's threshold (0.001) between active cells are closed: both meet at the mean", {}, pinch},
    StepRow{"handedness", "the rows of a left-handed grid are put in the opposite order; geometry stays", handedness_mends, handedness},
    StepRow{"depth-sign", "a grid whose layers go upwards gets the opposite sign of depth", {}, depth_sign},
};
constexpr std::array<std::string_view, 3> usual = {"monotone", "close-gaps", "drop-collapsed"};

}  // namespace

std::span<const StepRow> grid_steps() { return steps; }
std::span<const std::string_view> usual_grid_steps() { return usual; }

Result<void> known_grid_steps(std::span<const std::string> names) {
    for (const std::string& name : names) {
        if (std::ranges::find(steps, std::string_view(name), &StepRow::name) != steps.end()) continue;
        std::string all;
        for (const StepRow& row : steps) all += (all.empty() ? "" : ", ") + std::string(row.name);
        return failure(FailureKind::usage, "F018", {}, "--step " + name + ": no such step; there are " + all);
    }
    return {};
}

Result<std::vector<StepDone>> run_grid_steps(Dataset& dataset, std::span<const std::string> names, const StepOptions& options) {
    std::vector<StepDone> done;
    for (const std::string& name : names) {
        const auto row = std::ranges::find(steps, std::string_view(name), &StepRow::name);
        for (Object& object : dataset.objects) {
            auto* grid = std::get_if<CornerPointGrid>(&object);
            if (grid == nullptr || !validators::has_geometry(*grid) || !misfit(*grid).empty()) continue;
            if (options.checks.monitor != nullptr && options.checks.monitor->stopped())
                return failure(FailureKind::cancelled, "F022", {}, "the repair was stopped; nothing was written");
            const validators::GridScope scope(*grid, options.checks);
            StepReport report = row->run(*grid, scope, options);
            report.entities.insert(report.entities.begin(), {"corner-point-grid", grid->info.name});
            if (row->run == handedness && report.count > 0) {
                for (Object& other : dataset.objects) {
                    if (auto* follower = std::get_if<CornerPointGrid>(&other); follower != nullptr && follower != grid)
                        follow_reversal(*grid, *follower);
                }
            }
            done.push_back({name, std::move(report)});
        }
    }
    return done;
}

}  // namespace geomend::repair
