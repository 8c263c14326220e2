// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/dataset.h"
#include "validators/cell_scope.h"
#include "validators/check_selection.h"
#include "validators/closing_tolerance.h"
#include "validators/grid_scope.h"
#include "validators/model_scope.h"
#include "validators/object_scope.h"
#include "validators/places.h"

namespace geomend::validators {

/// One row of the table of checks.
struct Check {
    std::string_view code;
    std::string_view condition;                                           ///< when it finds something, with its thresholds; one line
    void (*run)(const GridScope&, std::vector<Finding>&) = nullptr;       ///< of corner-point grids; nullptr: told elsewhere
    bool of_records = false;                                              ///< needs no geometry
    void (*model)(const ModelScope&, std::vector<Finding>&) = nullptr;    ///< of boundary representations
    void (*cells)(const CellScope&, std::vector<Finding>&) = nullptr;     ///< of cell meshes
    void (*object)(const ObjectScope&, std::vector<Finding>&) = nullptr;  ///< of point sets, polylines, wells, rasters, structured grids
};

/// All checks, in the order of their codes.
std::span<const Check> all_checks();

/// Findings of one grid, and the lengths that it was judged by.
struct Checked {
    std::vector<Finding> findings;
    Lengths lengths;               ///< of several clusters the largest ones
    topology::LocalLengths local;  ///< of surfaces and cell meshes; else empty
    NamesInFile names;             ///< of surfaces and regions that findings name
    /// The tolerance at which most errors vanish, as borders of surfaces agree within it only.
    std::optional<ClosingTolerance> closing;
    bool geometry = true;  ///< false: there is none, only records were checked (F161 tells)
};

/// Runs all wanted checks of the surfaces and cells of a Dataset: of each model that it states, of all other surfaces
/// together, and of each cell mesh. Never changes it. What the file's claims disagree with is told, too. Cost: near-linear; up to four
/// times that where there are errors and borders of surfaces nearly agree, for what a larger tolerance would mend.
/// \param judged where not null: the boundary representations that findings are about are added to it
/// Failure (cancelled) when the monitor stops it.
Result<Checked> check_models(const Dataset& dataset, const CheckOptions& options, std::vector<Brep>* judged = nullptr);

/// Runs all wanted checks of an object that is judged by itself (see is_judged_alone). Never changes it. Cost: near-linear.
/// Failure (cancelled) when the monitor stops it.
Result<Checked> check(const Object& object, const CheckOptions& options);

/// C30: local grids that refine the same cells of their host. `grids` are those of one file. Cost: linear in the cells of hosts
/// and local grids.
void check_local_grids(std::span<const CornerPointGrid* const> grids, std::vector<Finding>& findings);

/// Runs all wanted checks of a corner-point grid. Never changes it. Cost: linear in cells but for columns whose cells
/// overlap. Failure (cancelled) when the monitor stops it.
Result<Checked> check(const CornerPointGrid& grid, const CheckOptions& options);

}  // namespace geomend::validators
