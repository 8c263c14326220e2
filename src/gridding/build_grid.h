// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"
#include "gridding/layers.h"
#include "gridding/net.h"
#include "gridding/structure.h"
#include "model/corner_point.h"

namespace geomend::gridding {

/// What is wanted of a grid.
struct GridOptions {
    std::vector<ZoneLayers> zones;  ///< one per interval between horizons
    double min_thickness = 0;       ///< cells thinner than this everywhere are joined with a neighbour in their zone
    Path area;                      ///< columns whose middle is outside of this ring are inactive; empty: none are
    bool fault_sides_both = false;  ///< FAULTS names each face from both of its cells, not from one
    bool pinch = false;             ///< PINCH: cells are joined past others without thickness
    bool allow_repeated = false;    ///< where a pillar meets a horizon more than once the nearest to mid level is taken
    bool follow_faults = false;     ///< pillars of chains lean as their faults do
    const Monitor* monitor = nullptr;
};

struct ZoneReport {
    std::string name;
    std::uint32_t first_layer = 0, last_layer = 0;  ///< from 0
    double volume = 0;                              ///< of active cells
    std::uint64_t active = 0, without_thickness = 0;
};

struct FaultReport {
    std::string name;
    std::uint64_t faces = 0;  ///< of columns: edges of the chain, each as high as the grid
    std::uint64_t boxes = 0;
    double max_deviation = 0, mean_deviation = 0;              ///< of the chain from the trace, in the unit of the axes
    double max_deviation_cells = 0, mean_deviation_cells = 0;  ///< by the mean spacing of pillars
    std::uint64_t shared = 0;
    std::vector<std::string> ends_on;
    double max_throw = 0;     ///< largest difference of a horizon's depths at a pillar of the chain
    double max_lean = 0;      ///< how far its pillars are shifted from the uppermost to the lowest depth; 0: they are upright
    std::string why_upright;  ///< why they are, where they were to lean
    std::string why_not;      ///< why it is not in the grid; empty: it is
};

/// How well a horizon is met.
struct HorizonReport {
    std::string name;
    std::uint64_t read = 0, extended = 0, filled = 0;  ///< nodes, by where their depth comes from
    std::uint64_t unfaulted = 0;                       ///< pillars of one node whose depth was read
    double max_difference = 0;                         ///< between grid and horizon at these
    std::uint64_t moved = 0;                           ///< nodes at which it gave way to another horizon
    double max_moved = 0;
};

struct GridReport {
    std::vector<ZoneReport> zones;
    std::vector<FaultReport> faults;
    std::vector<HorizonReport> horizons;
    std::uint32_t blocks = 0;
    std::uint64_t active = 0;
    double cell = 0;  ///< mean spacing of pillars
    std::uint64_t joined_cells = 0;
    /// How right-angled columns are in plan at the uppermost and the lowest depth, 0 to 1, before and after pillars were made to lean.
    double mean_angles_before = 1, mean_angles_after = 1, least_angles_before = 1, least_angles_after = 1;
    bool border_relaxed = false;  ///< for that the border was relaxed towards upright columns
};

struct MadeGrid {
    CornerPointGrid grid;
    GridReport report;
};

/// The level at which traces are compared: between the mean depths of the uppermost and the lowest horizon.
double mid_level(const Structure& structure);

/// A corner-point grid of a structure: faults as chains of edges between pillars, blocks, horizons per block, layers per zone. Every
/// horizon is met at every pillar that has a value of it on the right side of all faults. Cells without thickness and columns for which
/// a horizon has no value are inactive. Attributes of cells: FIPNUM (zones) and FLUXNUM (fault blocks), with their names.
/// \pre at least two horizons; one rule per interval
/// Failure (cannot_hold, F027) where a pillar meets a horizon more than once: the message names horizon, place and extent.
Result<MadeGrid> build_grid(const Structure& structure, const Net& net, const GridOptions& options);

}  // namespace geomend::gridding
