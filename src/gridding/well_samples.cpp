// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/well_samples.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/vectors.h"
#include "grid/cell_geometry.h"
#include "gridding/place_finder.h"

namespace geomend::gridding {

namespace {

std::vector<double> depths_of_path(const Well& well) {
    if (well.measured_depth.size() == well.path.size()) return well.measured_depth;
    std::vector<double> along{0};
    for (std::size_t i = 1; i < well.path.size(); ++i) {
        const Vec3 step = minus(well.path[i], well.path[i - 1]);
        along.push_back(along.back() + std::sqrt(dot(step, step)));
    }
    return along;
}

std::optional<Vec3> place_at(const Well& well, const std::vector<double>& along, double depth) {
    const auto after = std::ranges::lower_bound(along, depth);
    if (after == along.end()) return std::nullopt;
    const auto next = static_cast<std::size_t>(after - along.begin());
    if (along[next] == depth) return well.path[next];
    if (next == 0) return std::nullopt;
    const double share = (depth - along[next - 1]) / (along[next] - along[next - 1]);
    Vec3 place{};
    for (std::size_t a = 0; a < 3; ++a) place[a] = (1 - share) * well.path[next - 1][a] + share * well.path[next][a];
    return place;
}

/// The active cells whose boxes meet that of a path, elevation-up.
std::vector<std::uint32_t> cells_around(const CornerPointGrid& grid, const std::vector<Vec3>& path) {
    Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (const Vec3& p : path) {
        for (std::size_t a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], p[a]);
            high[a] = std::max(high[a], p[a]);
        }
    }
    std::vector<std::uint32_t> cells;
    for (std::size_t c = 0; c < grid.cell_count(); ++c) {
        if (!grid.is_active(c)) continue;
        const auto [i, j, k] = grid.ijk(c);
        Vec3 least{1e300, 1e300, 1e300}, most{-1e300, -1e300, -1e300};
        for (const Vec3& corner : cell_corners(grid, i, j, k)) {
            const Vec3 p{corner[0], corner[1], -corner[2]};
            for (std::size_t a = 0; a < 3; ++a) {
                least[a] = std::min(least[a], p[a]);
                most[a] = std::max(most[a], p[a]);
            }
        }
        bool meets = true;
        for (std::size_t a = 0; a < 3; ++a) meets = meets && least[a] <= high[a] && most[a] >= low[a];
        if (meets) cells.push_back(static_cast<std::uint32_t>(c));
    }
    return cells;
}

struct InCell {
    std::vector<double> values, weights, distances;
};

double value_of(const InCell& in, Averaging how) {
    if (how == Averaging::nearest)
        return in.values[static_cast<std::size_t>(std::ranges::min_element(in.distances) - in.distances.begin())];
    if (how == Averaging::majority) return majority_of(in.values, in.weights);
    return how == Averaging::harmonic ? harmonic_of(in.values, in.weights) : mean_of(in.values, in.weights);
}

}  // namespace

std::vector<std::pair<std::uint32_t, double>> well_samples(const CornerPointGrid& grid, const Well& well, std::span<const double> depths,
                                                           std::span<const double> values, Averaging how) {
    std::vector<std::pair<std::uint32_t, double>> found;
    if (well.path.empty() || depths.size() != values.size()) return found;
    const auto along = depths_of_path(well);
    if (!std::ranges::is_sorted(along)) return found;
    const auto cells = cells_around(grid, well.path);
    const PlaceFinder finder = PlaceFinder::of_cells(grid, cells);
    std::map<std::uint32_t, InCell> by_cell;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i]) || !std::isfinite(depths[i])) continue;
        const auto place = place_at(well, along, depths[i]);
        if (!place) continue;
        const std::uint32_t cell = finder.at(*place).cell;
        if (cell == no_index) continue;
        const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, values.size() - 1);
        const auto [ci, cj, ck] = grid.ijk(cell);
        Vec3 middle = grid::centre(cell_corners(grid, ci, cj, ck));
        middle[2] = -middle[2];
        const Vec3 offset = minus(*place, middle);
        InCell& in = by_cell[cell];
        in.values.push_back(values[i]);
        const double way = std::abs(depths[after] - depths[before]);
        in.weights.push_back(way > 0 ? way : 1);
        in.distances.push_back(dot(offset, offset));
    }
    for (const auto& [cell, in] : by_cell) found.emplace_back(cell, value_of(in, how));
    return found;
}

}  // namespace geomend::gridding
