// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/build_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "base/parallel.h"
#include "base/wording.h"
#include "gridding/cell_layers.h"
#include "gridding/fault_faces.h"
#include "gridding/horizon_checks.h"
#include "gridding/lean.h"
#include "gridding/node_depths.h"

namespace geomend::gridding {

namespace {

/// What depths a horizon has, in one pass over them, several side by side: maps have millions.
struct DepthSpan {
    double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity(), sum = 0, count = 0;

    void add(double depth) {
        const bool is_known = depth - depth == 0;
        least = std::min(least, is_known ? depth : least);
        most = std::max(most, is_known ? depth : most);
        sum += is_known ? depth : 0;
        count += is_known ? 1 : 0;
    }
    void add(const DepthSpan& other) {
        least = std::min(least, other.least);
        most = std::max(most, other.most);
        sum += other.sum;
        count += other.count;
    }
    double mean() const { return count > 0 ? sum / count : 0; }
};

DepthSpan depths_of(const Horizon& horizon) {
    constexpr std::size_t lanes = 8;
    std::array<DepthSpan, lanes> side_by_side;
    if (const auto* map = std::get_if<HorizonMap>(&horizon.shape)) {
        const std::size_t whole = map->depths.size() / lanes * lanes;
        for (std::size_t i = 0; i < whole; i += lanes) {
            for (std::size_t l = 0; l < lanes; ++l) side_by_side[l].add(map->depths[i + l]);
        }
        for (std::size_t i = whole; i < map->depths.size(); ++i) side_by_side[i - whole].add(map->depths[i]);
    } else {
        for (const Vec3& v : std::get<Sheet>(horizon.shape).vertices) side_by_side[0].add(v[2]);
    }
    for (std::size_t l = 1; l < lanes; ++l) side_by_side[0].add(side_by_side[l]);
    return side_by_side[0];
}

double middle_of(const std::vector<DepthSpan>& depths) { return (depths.front().mean() + depths.back().mean()) / 2; }

/// The horizons at all nodes, in order at each; what had to be moved is counted.
std::vector<NodeDepths> all_depths(const Structure& structure, const NodeSetting& setting) {
    std::vector<NodeDepths> all(structure.horizons.size());
    parallel_for_each_index(all.size(), [&](std::size_t h) { all[h] = node_depths(structure, h, setting); });
    return all;
}

void put_nodes_in_order(const Structure& structure, const SplitPillars& split, std::vector<NodeDepths>& depths, GridReport& report) {
    std::vector<std::uint8_t> erodes, is_lapped;
    for (const Horizon& horizon : structure.horizons) {
        erodes.push_back(horizon.erodes ? 1 : 0);
        is_lapped.push_back(horizon.is_lapped ? 1 : 0);
    }
    std::vector<double> before(depths.size()), after(depths.size());
    for (std::size_t h = 0; h < depths.size(); ++h) report.horizons.push_back({structure.horizons[h].name});
    for (std::size_t n = 0; n < split.node_count(); ++n) {
        for (std::size_t h = 0; h < depths.size(); ++h) before[h] = depths[h].depths[n];
        after = before;
        put_in_order(after, erodes, is_lapped);
        const bool whole = !split.is_split(split.pillar_of[n]);
        for (std::size_t h = 0; h < depths.size(); ++h) {
            HorizonReport& r = report.horizons[h];
            const double moved = std::abs(after[h] - before[h]);
            const DepthSource source = depths[h].sources[n];
            (source == DepthSource::read ? r.read : source == DepthSource::extended ? r.extended : r.filled) += 1;
            if (source == DepthSource::read && whole) {
                ++r.unfaulted;
                r.max_difference = std::max(r.max_difference, moved);
            }
            if (moved > 0 && source != DepthSource::filled) {
                ++r.moved;
                r.max_moved = std::max(r.max_moved, moved);
            }
            depths[h].depths[n] = after[h];
        }
    }
}

std::string zone_name(const Structure& structure, const ZoneLayers& rule, std::size_t z) {
    if (!rule.zone.empty()) return rule.zone;
    return structure.horizons[z].name + " - " + structure.horizons[z + 1].name;
}

/// The attribute of cells that numbers something from 1.
template <class Number>
Attribute numbers(const CornerPointGrid& grid, const std::string& name, const std::vector<std::string>& meanings, const Number& number) {
    std::vector<std::int32_t> values(grid.cell_count());
    const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1];
    parallel_blocks(grid.dims[2], 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            for (std::size_t c = 0; c < layer; ++c) values[c + layer * k] = static_cast<std::int32_t>(number(c, k)) + 1;
        }
    });
    Attribute attribute;
    attribute.name = name;
    attribute.location = AttributeLocation::cell;
    attribute.values = std::move(values);
    for (std::size_t m = 0; m < meanings.size(); ++m) attribute.code_names.emplace_back(static_cast<int>(m) + 1, meanings[m]);
    return attribute;
}

void add_regions(const GridReport& report, const Blocks& blocks, CornerPointGrid& grid) {
    std::vector<std::string> zones, block_names;
    std::vector<std::uint32_t> zone_of(grid.dims[2]);
    for (std::uint32_t z = 0; z < report.zones.size(); ++z) {
        zones.push_back(report.zones[z].name);
        for (std::uint32_t k = report.zones[z].first_layer; k <= report.zones[z].last_layer; ++k) zone_of[k] = z;
    }
    for (std::uint32_t b = 0; b < blocks.count; ++b) block_names.push_back("block " + std::to_string(b + 1));
    grid.info.attributes.push_back(numbers(grid, "FIPNUM", zones, [&](std::size_t, std::size_t k) { return zone_of[k]; }));
    grid.info.attributes.push_back(numbers(grid, "FLUXNUM", block_names, [&](std::size_t c, std::size_t) { return blocks.of[c]; }));
}

/// The pillars end where the grid does.
void set_pillars(const Net& net, const std::array<double, 2>& range, CornerPointGrid& grid) {
    grid.pillars = net.lines;
    for (std::size_t p = 0; p < net.pillar_count(); ++p) {
        double* line = grid.pillars.data() + 6 * p;
        if (!net.is_upright(p)) continue;
        line[2] = range[0];
        line[5] = range[1];
    }
}

/// Lets pillars lean, checked at the mean depths of all horizons, too.
LeanResult follow_faults(const Structure& structure, const Chains& chains, const std::array<double, 2>& range,
                         std::span<const DepthSpan> horizons, Net& net, GridReport& report) {
    std::vector<double> levels;
    for (const DepthSpan& depths : horizons) levels.push_back(depths.mean());
    LeanResult lean = lean_pillars(structure, chains, range[0], range[1], levels, net);
    report.mean_angles_before = lean.angles_before;
    report.mean_angles_after = lean.angles_after;
    report.least_angles_before = lean.least_before;
    report.least_angles_after = lean.least_after;
    report.border_relaxed = lean.border_relaxed;
    return lean;
}

void add_lean(const LeanResult& lean, std::vector<FaultReport>& faults) {
    for (std::size_t f = 0; f < lean.faults.size(); ++f) {
        if (lean.faults[f].leans) faults[f].max_lean = lean.faults[f].max_shift;
        faults[f].why_upright = lean.faults[f].why_not;
    }
}

Failure stopped() { return failure(FailureKind::cancelled, "F022", {}, "stopped; nothing was written"); }

}  // namespace

double mid_level(const Structure& structure) {
    return middle_of({depths_of(structure.horizons.front()), depths_of(structure.horizons.back())});
}

Result<MadeGrid> build_grid(const Structure& structure, const Net& upright, const GridOptions& options) {
    MadeGrid made;
    Net net = upright;
    std::vector<DepthSpan> spans;
    for (const Horizon& horizon : structure.horizons) spans.push_back(depths_of(horizon));
    const double level = middle_of(spans);
    DepthSpan all;
    for (const DepthSpan& span : spans) all.add(span);
    const std::array<double, 2> range{all.least, all.most};
    made.report.cell = spacing_of(net, level);

    std::vector<Path> traces;
    std::vector<FaultSides> sides;
    std::vector<double> reach;
    double widest = 0;
    for (const Horizon& horizon : structure.horizons) {
        if (const auto* map = std::get_if<HorizonMap>(&horizon.shape))
            widest = std::max(widest, std::hypot(map->step[0][0], map->step[0][1]));
    }
    for (const Fault& fault : structure.faults) {
        traces.push_back(fault.trace);
        sides.emplace_back(fault);
        reach.push_back(sides.back().reach(range[0], range[1]) + 2.5 * made.report.cell + 2 * widest);
    }
    const Chains chains = make_chains(net, traces, level);
    for (std::size_t f = 0; f < sides.size(); ++f) {
        const auto& chain = chains.chains[f].pillars;
        if (!chain.empty()) sides[f].go_on(net.is_outermost(chain.front()), net.is_outermost(chain.back()));
    }
    LeanResult lean;
    const bool has_surfaces = std::ranges::any_of(structure.faults, [](const Fault& f) { return !f.sheet.triangles.empty(); });
    if (options.follow_faults && has_surfaces) lean = follow_faults(structure, chains, range, spans, net, made.report);
    const SplitPillars split = split_pillars(net, chains.edges);
    const Blocks blocks = fault_blocks(net, chains.edges);
    made.report.blocks = blocks.count;
    const NodeGraph graph = node_graph(net, split);
    const NearFaults near = near_faults(upright, split, graph, chains, reach, level);
    if (options.monitor != nullptr && options.monitor->stopped()) return stopped();

    auto depths = all_depths(structure, {net, split, graph, near, sides, reach, level, made.report.cell});
    if (auto once = refuse_repeated(structure, net, split, depths, options.allow_repeated); !once) return std::move(once).why();
    put_nodes_in_order(structure, split, depths, made.report);
    if (options.monitor != nullptr && options.monitor->stopped()) return stopped();

    CornerPointGrid& grid = made.grid;
    grid.info.name = "grid";
    grid.info.crs.z_positive = ZPositive::depth;
    grid.info.crs.z_positive_stated = true;
    if (options.pinch) grid.pinch = CornerPointGrid::Pinch{};
    set_pillars(net, range, grid);
    std::vector<std::string> names;
    for (std::size_t z = 0; z < options.zones.size(); ++z) names.push_back(zone_name(structure, options.zones[z], z));
    const auto plan = plan_layers(options.zones, names, depths);
    if (!plan) return plan.why();
    for (std::size_t z = 0; z < names.size(); ++z) made.report.zones.push_back({names[z], plan->first[z], plan->first[z + 1] - 1});
    grid.dims = {net.cells[0], net.cells[1], plan->first.back()};
    made.report.joined_cells = fill_cells(net, split, depths, options, *plan, grid);
    add_regions(made.report, blocks, grid);
    made.report.faults = add_faults(structure, net, chains, split, depths, options.fault_sides_both, made.report.cell, grid);
    add_lean(lean, made.report.faults);
    measure_zones(grid, made.report.zones);
    made.report.active = active_count(grid);
    return made;
}

}  // namespace geomend::gridding
