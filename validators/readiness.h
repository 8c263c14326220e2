// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/dataset.h"
#include "topology/lengths.h"

namespace geomend::validators {

/// What a simulator or mesher reads.
enum class TargetInput : std::uint8_t {
    corner_point,  ///< a corner-point grid
    surfaces,      ///< surfaces that close around regions, which it fills itself
    cells          ///< cells of three dimensions
};

/// A finding of another check that a target cannot live with, or only badly, although it is no error for itself.
struct TargetBurden {
    std::string_view code, consequence;
    bool stops = false;  ///< the target cannot be run: an error
};

/// Which names of regions and surfaces a target can take.
struct NameRule {
    std::size_t longest = 0;  ///< in bytes; 0: nobody asks for names
    bool letter_first = false, blanks = true, ascii = false, case_counts = true;
    std::string_view forbidden;
};

/// A target of `validate --for`.
struct Target {
    std::string_view name, title;
    TargetInput input;
    std::string_view families;  ///< of checks whose errors stop it: letters of their codes
    std::span<const TargetBurden> burdens;
    NameRule names;
    std::span<const CellType> cell_types;  ///< that it takes; empty: does not apply
    bool names_patches = false;            ///< it needs names for the outer faces of cells
    bool tags_cells = false;               ///< it tells regions apart by what cells are tagged with
};

/// All targets, in the order of their names.
std::span<const Target> all_targets();
/// The target of a name, or nullptr.
const Target* find_target(std::string_view name);

/// What keeps a Dataset from being used by a target: findings S01 and on. It reads what the other checks found, and looks at
/// what only matters to simulators: kinds of cells, properties, names, tags. Never changes anything.
/// \param found findings of the other checks of the same Dataset
/// \param lengths by which the other checks judged surfaces and cells
/// Failure (internal) as of topology::models_to_judge. Cost: linear; for targets that take surfaces near-linear.
Result<std::vector<Finding>> readiness(const Dataset& dataset, const Target& target, const topology::LocalLengths& lengths,
                                       std::span<const Finding> found);

// The parts of it.
Finding target_finding(std::string_view code, std::string message);
void check_grid_for_flow(const CornerPointGrid& grid, std::vector<Finding>& findings);             // S03 S04 S05 S09 S12
void check_cells_for(const Target& target, const CellMesh& mesh, std::vector<Finding>& findings);  // S07 S08 S10
Result<void> check_regions(const Dataset& dataset, const Target& target, const topology::LocalLengths& lengths,
                           std::vector<Finding>& findings);                                      // S03
void check_names(const Dataset& dataset, const Target& target, std::vector<Finding>& findings);  // S06

}  // namespace geomend::validators
