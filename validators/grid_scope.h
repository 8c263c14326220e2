// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/finding.h"
#include "base/monitor.h"
#include "grid/boundary_model.h"
#include "grid/cell_geometry.h"
#include "grid/connections.h"
#include "model/corner_point.h"
#include "topology/lengths.h"

namespace geomend::validators {

/// What the user says of the checks.
struct CheckOptions {
    double tolerance = -1;                         ///< length up to which points count as one; negative: by rule
    double near = -1;                              ///< search length for near misses; negative: by rule
    bool all_cells = false;                        ///< also inactive cells are judged
    std::vector<std::string> only, skip;           ///< codes; `only` empty: all
    std::string target;                            ///< of a simulator or mesher that the model is for (readiness.h); empty: none
    std::optional<grid::ModelRequest> grid_model;  ///< also the boundary representations of corner-point grids are judged
    bool closing_tolerance = true;                 ///< a larger tolerance at which models close is looked for where there are errors
    const Monitor* monitor = nullptr;
};

using topology::Lengths;

/// Distance from a number to the next larger one of the precision that a file stores. \param single float32, else float64
double step_above(double value, bool single);

/// False for grids of which only records were given: neither pillars nor depths.
inline bool has_geometry(const CornerPointGrid& grid) { return !grid.pillars.empty() || !grid.depths.empty(); }

/// A corner-point grid with what all its checks need: which cells are judged and by what lengths. Cells with a corner
/// that is not finite, or as large as 1e20, are found by C02 and judged by no other check.
class GridScope {
public:
    /// \pre misfit(grid) is empty, or the grid has no geometry (no cell is judged then); the grid outlives the scope.
    /// Cost: linear, in parallel.
    GridScope(const CornerPointGrid& grid, const CheckOptions& options);

    const CornerPointGrid& grid() const { return grid_; }
    const Lengths& lengths() const { return lengths_; }
    double tolerance() const { return lengths_.tolerance; }
    /// The tolerance for depths of one pillar: as tolerance(), but by the steps of the largest depth alone, because
    /// depths are compared with depths only and northings are often a thousand times larger.
    double depth_tolerance() const { return depth_tolerance_; }
    bool all_cells() const { return all_cells_; }
    /// The attribute whose values the regions of a boundary representation are to be; empty: none was named.
    const std::string& asked_regions() const { return asked_regions_; }
    bool in_scope(std::size_t cell) const { return all_cells_ || grid_.is_active(cell); }
    bool judged(std::size_t cell) const { return judged_[cell] != 0; }
    std::uint64_t judged_count() const { return judged_count_; }
    /// Most judged cells have a positive volume in (x, y, depth).
    bool right_handed() const { return right_handed_; }
    const Monitor* monitor() const { return monitor_; }
    bool stopped() const { return monitor_ != nullptr && monitor_->stopped(); }

    /// Corners of a cell; of cylindrical grids as radius, angle in degrees and depth, so that a ring does not close on
    /// itself.
    grid::Corners corners(std::uint32_t i, std::uint32_t j, std::uint32_t k) const;
    double depth(std::uint32_t i, std::uint32_t j, std::uint32_t k, unsigned c) const {
        return grid_.depths[corner_index(grid_.dims, i, j, k, c)];
    }
    /// Which active cells touch; worked out when first asked for. Not for several threads at once.
    const grid::Connections& connections() const;

private:
    void choose_cells();
    void measure(const CheckOptions& options);

    const CornerPointGrid& grid_;
    const Monitor* monitor_;
    bool all_cells_;
    std::string asked_regions_;
    bool right_handed_ = true;
    Lengths lengths_;
    double depth_tolerance_ = 0;
    std::uint64_t judged_count_ = 0;
    std::vector<std::uint8_t> judged_;
    mutable std::unique_ptr<grid::Connections> connections_;
};

}  // namespace geomend::validators
