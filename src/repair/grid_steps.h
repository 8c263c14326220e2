// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/dataset.h"
#include "validators/grid_scope.h"

namespace geomend::repair {

struct StepOptions {
    validators::CheckOptions checks;  ///< tolerance, and whether inactive cells are mended, too
    std::optional<double> gap;        ///< largest gap or overlap that close-gaps closes; else the tolerance
};

/// What a step did to a grid: count of cells, the first ones, measures, and a message. It has no code.
using StepReport = Finding;

/// A step that changes one grid. The scope was made of the grid as it is before.
using Step = StepReport (*)(CornerPointGrid&, const validators::GridScope&, const StepOptions&);

struct StepRow {
    std::string_view name;
    std::string_view meaning;                 ///< one line
    std::span<const std::string_view> mends;  ///< codes of findings that it mends
    Step run;
};

/// All steps, the usual ones first.
std::span<const StepRow> grid_steps();
/// Steps that are taken where none is named: monotone, close-gaps, drop-collapsed.
std::span<const std::string_view> usual_grid_steps();

/// Failure (usage) where a name is of no step; the message lists those that there are.
Result<void> known_grid_steps(std::span<const std::string> names);

struct StepDone {
    std::string step;
    StepReport report;
};

/// Takes the steps in the order given on every corner-point grid of a dataset that has geometry (misfit() is empty).
/// Local grids and links to a grid whose cells get other numbers follow it.
/// \pre known_grid_steps(names)  Failure (cancelled) when stopped: the dataset is then half done.
Result<std::vector<StepDone>> run_grid_steps(Dataset& dataset, std::span<const std::string> names, const StepOptions& options);

// The steps.
StepReport monotone(CornerPointGrid&, const validators::GridScope&, const StepOptions&);
StepReport close_gaps(CornerPointGrid&, const validators::GridScope&, const StepOptions&);
StepReport pinch(CornerPointGrid&, const validators::GridScope&, const StepOptions&);
StepReport depth_sign(CornerPointGrid&, const validators::GridScope&, const StepOptions&);
StepReport drop_collapsed(CornerPointGrid&, const validators::GridScope&, const StepOptions&);
StepReport drop_isolated(CornerPointGrid&, const validators::GridScope&, const StepOptions&);
StepReport minpv(CornerPointGrid&, const validators::GridScope&, const StepOptions&);
StepReport handedness(CornerPointGrid&, const validators::GridScope&, const StepOptions&);

/// What another grid says of the cells of one whose rows were reversed: its links and its host cells.
/// \param reversed the grid after the reversal
void follow_reversal(const CornerPointGrid& reversed, CornerPointGrid& other);

}  // namespace geomend::repair
