// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/grid_scope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "validators/unset_corners.h"

namespace geomend::validators {

namespace {

constexpr std::size_t block = 8192;

// What each block of cells adds; blocks are joined in their order, so that threads make no difference.
struct Sums {
    std::uint64_t cells = 0;
    double volume = 0;                      // of either sign
    Vec3 sum{};                             // of corners
    Vec3 weighted{};                        // of corners, by the volumes of their cells
    double largest = 0, largest_depth = 0;  // as stored
    std::int64_t votes = 0;
};

template <class Body>
void each_block(std::size_t cells, const Body& body) {
    parallel_for_each_index((cells + block - 1) / block, [&](std::size_t b) { body(b, b * block, std::min(cells, (b + 1) * block)); });
}

}  // namespace

double step_above(double value, bool single) {
    if (single) {
        const auto v = static_cast<float>(value);
        return static_cast<double>(std::nextafter(v, std::numeric_limits<float>::infinity())) - static_cast<double>(v);
    }
    return std::nextafter(value, std::numeric_limits<double>::infinity()) - value;
}

GridScope::GridScope(const CornerPointGrid& grid, const CheckOptions& options)
    : grid_(grid),
      monitor_(options.monitor),
      all_cells_(options.all_cells),
      asked_regions_(options.grid_model ? options.grid_model->regions : std::string()) {
    if (!has_geometry(grid)) {
        judged_.assign(grid.cell_count(), 0);
        return;
    }
    choose_cells();
    measure(options);
}

void GridScope::choose_cells() {
    const std::size_t lines = std::size_t{grid_.dims[0]} + 1, set = pillar_count(grid_.dims);
    const UnsetValues unset = unset_values(grid_, all_cells_);
    std::vector<std::uint8_t> sound_pillar(grid_.pillars.size() / 6);
    for (std::size_t p = 0; p < sound_pillar.size(); ++p) sound_pillar[p] = unset.is_set_pillar(grid_.pillars.data() + 6 * p) ? 1 : 0;
    judged_.assign(grid_.cell_count(), 0);
    each_block(judged_.size(), [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell < last; ++cell) {
            if (!in_scope(cell)) continue;
            const auto [i, j, k] = grid_.ijk(cell);
            const std::size_t from = grid_.reservoirs.empty() ? 0 : set * pillar_set(grid_, k);
            bool all = true;
            for (unsigned c = 0; c < 8 && all; ++c) {
                const std::size_t pillar = from + i + (c & 1u) + lines * (std::size_t{j} + ((c >> 1) & 1u));
                all = sound_pillar[pillar] != 0 && unset.is_set_depth(depth(i, j, k, c));
            }
            judged_[cell] = all ? 1 : 0;
        }
    });
}

void GridScope::measure(const CheckOptions& options) {
    std::vector<Sums> parts((judged_.size() + block - 1) / block);
    const Vec3& around = grid_.info.stored_around;
    each_block(judged_.size(), [&](std::size_t b, std::size_t first, std::size_t last) {
        Sums& part = parts[b];
        for (std::size_t cell = first; cell < last; ++cell) {
            if (judged_[cell] == 0) continue;
            const auto [i, j, k] = grid_.ijk(cell);
            ++part.cells;
            const double v = grid::cell_volume(corners(i, j, k));
            part.volume += std::abs(v);
            part.votes += v > 0 ? 1 : v < 0 ? -1 : 0;
            for (const Vec3& p : cell_corners(grid_, i, j, k)) {
                for (std::size_t d = 0; d < 3; ++d) {
                    part.sum[d] += p[d];
                    part.weighted[d] += std::abs(v) * p[d];
                    part.largest = std::max(part.largest, std::abs(p[d] - around[d]));
                }
                part.largest_depth = std::max(part.largest_depth, std::abs(p[2] - around[2]));
            }
        }
    });
    Sums all;
    for (const Sums& part : parts) {
        all.cells += part.cells;
        all.votes += part.votes;
        all.volume += part.volume;
        for (std::size_t d = 0; d < 3; ++d) {
            all.sum[d] += part.sum[d];
            all.weighted[d] += part.weighted[d];
        }
        all.largest = std::max(all.largest, part.largest);
        all.largest_depth = std::max(all.largest_depth, part.largest_depth);
    }
    judged_count_ = all.cells;
    right_handed_ = all.votes >= 0;
    if (all.cells > 0) {
        const Vec3& sum = all.volume > 0 ? all.weighted : all.sum;
        const double corners = 8 * (all.volume > 0 ? all.volume : static_cast<double>(all.cells));
        const Vec3 centroid{sum[0] / corners, sum[1] / corners, sum[2] / corners};
        std::vector<double> farthest(parts.size(), 0.0);
        each_block(judged_.size(), [&](std::size_t b, std::size_t first, std::size_t last) {
            for (std::size_t cell = first; cell < last; ++cell) {
                if (judged_[cell] == 0) continue;
                const auto [i, j, k] = grid_.ijk(cell);
                for (const Vec3& p : cell_corners(grid_, i, j, k)) {
                    const double x = p[0] - centroid[0], y = p[1] - centroid[1], z = p[2] - centroid[2];
                    farthest[b] = std::max(farthest[b], x * x + y * y + z * z);
                }
            }
        });
        lengths_.diameter = 2 * std::sqrt(*std::ranges::max_element(farthest));
    }
    const bool single = grid_.info.precision == CoordinatePrecision::single_precision;
    const auto rule = [&](double largest) {  // where no cell is judged there is no length
        return all.cells == 0 ? 0.0 : std::max(1e-7 * lengths_.diameter, 4 * step_above(largest, single));
    };
    lengths_.tolerance = options.tolerance >= 0 ? options.tolerance : rule(all.largest);
    depth_tolerance_ = options.tolerance >= 0 ? options.tolerance : rule(all.largest_depth);
    lengths_.near = options.near >= 0 ? options.near : 1e-3 * lengths_.diameter;
}

grid::Corners GridScope::corners(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    if (!grid_.cylindrical) return cell_corners(grid_, i, j, k);
    const std::size_t lines = std::size_t{grid_.dims[0]} + 1;
    const double* set = grid_.pillars.data() + 6 * pillar_count(grid_.dims) * (grid_.reservoirs.empty() ? 0 : pillar_set(grid_, k));
    grid::Corners all;
    for (unsigned c = 0; c < 8; ++c) {
        const std::size_t pillar = i + (c & 1u) + lines * (std::size_t{j} + ((c >> 1) & 1u));
        all[c] = pillar_point(set + 6 * pillar, depth(i, j, k, c));
    }
    return all;
}

const grid::Connections& GridScope::connections() const {
    if (!connections_) connections_ = std::make_unique<grid::Connections>(grid::connections(grid_));
    return *connections_;
}

}  // namespace geomend::validators
