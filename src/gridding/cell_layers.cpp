// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/cell_layers.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/parallel.h"
#include "grid/cell_geometry.h"

namespace geomend::gridding {

namespace {

/// The boundaries of all layers in one row of columns: boundary l of corner c of column i is number l + levels (c + 4 i).
class Row {
public:
    Row(const Net& net, const SplitPillars& split, std::span<const NodeDepths> depths, const GridOptions& options, const LayerPlan& plan)
        : net_(net), split_(split), depths_(depths), options_(options), plan_(plan), levels_(plan.first.back() + 1) {
        at_.resize(std::size_t{levels_} * 4 * net.cells[0]);
    }

    void load(std::size_t j) {
        j_ = j;
        for (std::size_t i = 0; i < net_.cells[0]; ++i) {
            for (unsigned c = 0; c < 4; ++c) load_corner(corner(i, c), corner_node(net_, split_, i, j, c));
        }
    }

    /// Joins what is too thin, zone by zone; the number of cells that went comes back.
    std::uint64_t join_thin(double least) {
        std::uint64_t joined = 0;
        for (std::size_t i = 0; i < net_.cells[0]; ++i) {
            for (std::size_t z = 0; z + 1 < plan_.first.size(); ++z) joined += join_thin(i, plan_.first[z], plan_.first[z + 1], least);
        }
        return joined;
    }

    void store(CornerPointGrid& grid) const {
        for (std::uint32_t k = 0; k + 1 < levels_; ++k) {
            for (unsigned c = 0; c < 8; ++c) {
                double* to = grid.depths.data() + corner_index(grid.dims, 0, j_, k, c);
                const double* from = at_.data() + std::size_t{levels_} * (c & 3u) + k + (c >> 2);
                for (std::size_t i = 0; i < net_.cells[0]; ++i) to[2 * i] = from[4 * i * levels_];
            }
        }
        for (std::size_t i = 0; i < net_.cells[0]; ++i) store_activity(i, grid);
    }

private:
    const Net& net_;
    const SplitPillars& split_;
    std::span<const NodeDepths> depths_;
    const GridOptions& options_;
    const LayerPlan& plan_;
    std::uint32_t levels_;
    std::size_t j_ = 0;
    std::vector<double> at_;

    double* corner(std::size_t i, unsigned c) { return at_.data() + std::size_t{levels_} * (c + 4 * i); }
    const double* corner(std::size_t i, unsigned c) const { return at_.data() + std::size_t{levels_} * (c + 4 * i); }

    void load_corner(double* to, std::uint32_t node) const {
        for (std::size_t z = 0; z + 1 < plan_.first.size(); ++z) {
            const double top = depths_[z].depths[node], base = depths_[z + 1].depths[node];
            const std::uint32_t first = plan_.first[z], n = plan_.first[z + 1] - first;
            for (std::uint32_t k = 0; k < n; ++k) to[first + k] = layer_depth(options_.zones[z], k, n, top, base);
        }
        to[levels_ - 1] = depths_.back().depths[node];
    }

    double thickness(std::size_t i, std::uint32_t k) const {
        double most = 0;
        for (unsigned c = 0; c < 4; ++c) most = std::max(most, corner(i, c)[k + 1] - corner(i, c)[k]);
        return most;
    }

    /// From the top of the zone down, boundaries under thin cells move up to their tops, so that the next cell takes what they had; what
    /// is left over at the base goes to the last cell that stays.
    std::uint64_t join_thin(std::size_t i, std::uint32_t first, std::uint32_t last, double least) {
        std::uint64_t joined = 0;
        std::uint32_t kept = no_index;
        for (std::uint32_t k = first; k + 1 < last; ++k) {
            const double thick = thickness(i, k);
            if (thick > 0 && thick < least) {
                for (unsigned c = 0; c < 4; ++c) corner(i, c)[k + 1] = corner(i, c)[k];
                ++joined;
            } else if (thick > 0) kept = k;
        }
        const double rest = thickness(i, last - 1);
        if (kept == no_index || !(rest > 0) || rest >= least) return joined;
        for (std::uint32_t k = kept + 1; k < last; ++k) {
            for (unsigned c = 0; c < 4; ++c) corner(i, c)[k] = corner(i, c)[last];
        }
        return joined + 1;
    }

    bool has_zone(std::size_t i, std::size_t z) const {
        for (unsigned c = 0; c < 4; ++c) {
            const std::uint32_t node = corner_node(net_, split_, i, j_, c);
            if (depths_[z].sources[node] == DepthSource::filled || depths_[z + 1].sources[node] == DepthSource::filled) return false;
        }
        return true;
    }

    bool is_in_area(std::size_t i, double level) const {
        if (options_.area.empty()) return true;
        Point middle{};
        for (unsigned c = 0; c < 4; ++c) {
            const Point p = net_.at(net_.pillar(i + (c & 1u), j_ + (c >> 1)), level);
            middle = {middle[0] + p[0] / 4, middle[1] + p[1] / 4};
        }
        return is_inside(options_.area, middle);
    }

    void store_activity(std::size_t i, CornerPointGrid& grid) const {
        const bool wanted = is_in_area(i, corner(i, 0)[0]);
        for (std::size_t z = 0; z + 1 < plan_.first.size(); ++z) {
            const bool there = wanted && has_zone(i, z);
            for (std::uint32_t k = plan_.first[z]; k < plan_.first[z + 1]; ++k) {
                const double scale = std::abs(corner(i, 0)[k]);
                grid.activity[i + std::size_t{net_.cells[0]} * (j_ + std::size_t{net_.cells[1]} * k)] =
                    there && thickness(i, k) > 1e-9 * (1 + scale) ? 1 : 0;
            }
        }
    }
};

}  // namespace

Result<LayerPlan> plan_layers(std::span<const ZoneLayers> zones, std::span<const std::string> names, std::span<const NodeDepths> depths) {
    LayerPlan plan{{0}};
    for (std::size_t z = 0; z < zones.size(); ++z) {
        double thickest = 0;
        for (std::size_t n = 0; n < depths[z].depths.size(); ++n) {
            if (depths[z].sources[n] == DepthSource::filled || depths[z + 1].sources[n] == DepthSource::filled) continue;
            thickest = std::max(thickest, depths[z + 1].depths[n] - depths[z].depths[n]);
        }
        const auto count = layer_count(zones[z], thickest, names[z]);
        if (!count) return count.why();
        if (*count > std::numeric_limits<std::uint32_t>::max() - plan.first.back())
            return failure(FailureKind::usage, "F018", {}, "--layers: more layers than cells can be counted");
        plan.first.push_back(plan.first.back() + *count);
    }
    return plan;
}

std::uint64_t fill_cells(const Net& net, const SplitPillars& split, std::span<const NodeDepths> depths, const GridOptions& options,
                         const LayerPlan& plan, CornerPointGrid& grid) {
    grid.depths.resize(8 * grid.cell_count());
    grid.activity.resize(grid.cell_count());
    std::atomic<std::uint64_t> joined = 0;
    parallel_blocks(net.cells[1], 1, [&](std::size_t first, std::size_t last) {
        Row row(net, split, depths, options, plan);
        for (std::size_t j = first; j < last; ++j) {
            row.load(j);
            if (options.min_thickness > 0) joined += row.join_thin(options.min_thickness);
            row.store(grid);
        }
    });
    return joined;
}

void measure_zones(const CornerPointGrid& grid, std::span<ZoneReport> zones) {
    for (ZoneReport& zone : zones) {
        // One sum a layer, added in order: the same for any number of threads.
        struct Sum {
            double volume = 0;
            std::uint64_t active = 0, flat = 0;
        };
        std::vector<Sum> sums(zone.last_layer - zone.first_layer + 1);
        parallel_for_each_index(sums.size(), [&](std::size_t n) {
            const auto k = static_cast<std::uint32_t>(zone.first_layer + n);
            for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
                for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
                    const auto corners = cell_corners(grid, i, j, k);
                    if (grid.is_active(grid.cell(i, j, k))) {
                        sums[n].volume += std::abs(grid::cell_volume(corners));
                        ++sums[n].active;
                    } else if (!(grid::thickness(corners) > 1e-9 * (1 + std::abs(corners[0][2])))) ++sums[n].flat;
                }
            }
        });
        for (const Sum& sum : sums) {
            zone.volume += sum.volume;
            zone.active += sum.active;
            zone.without_thickness += sum.flat;
        }
    }
}

}  // namespace geomend::gridding
