// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/unset_corners.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "base/usual_no_data.h"

namespace geomend::validators {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// The least and the largest of some values, and how often some suspected ones stand there.
struct Extent {
    double low = none, high = -none;
    std::uint64_t count = 0;

    void add(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
        ++count;
    }
    void add(const Extent& other) {
        low = std::min(low, other.low);
        high = std::max(high, other.high);
        count += other.count;
    }
};

/// Suspected numbers that lie far from all values that are not suspected. \param extent_without the extent of all values but some
template <class ExtentWithout>
std::vector<double> far_off(const ExtentWithout& extent_without, bool also_round) {
    const auto is_suspect = [&](double v) { return is_odd_no_data(v) || (also_round && is_round_no_data(v)); };
    std::vector<double> suspects;
    const Extent all = extent_without(suspects);
    Extent rest = all;
    while (rest.count > 0) {
        const bool low = is_suspect(rest.low), high = is_suspect(rest.high);
        if (!low && !high) break;
        if (low) suspects.push_back(rest.low);
        if (high && rest.high != rest.low) suspects.push_back(rest.high);
        rest = extent_without(suspects);
    }
    if (rest.count == 0) return {};
    std::erase_if(suspects, [&](double v) {
        const double beyond = std::max(rest.low - v, v - rest.high);
        return !(beyond > 0 && beyond >= rest.high - rest.low);
    });
    if (suspects.empty()) return {};
    const std::uint64_t unset = all.count - extent_without(suspects).count;
    const bool only_round = std::ranges::none_of(suspects, is_odd_no_data);
    return (only_round ? 10 : 2) * unset < all.count ? suspects : std::vector<double>{};
}

Extent extent_of_depths(const CornerPointGrid& grid, bool all_cells, const std::vector<double>& without) {
    constexpr std::size_t block = 8192;
    const std::size_t cells = grid.cell_count();
    std::vector<Extent> parts((cells + block - 1) / block);
    parallel_for_each_index(parts.size(), [&](std::size_t b) {
        for (std::size_t cell = b * block; cell < std::min(cells, (b + 1) * block); ++cell) {
            if (!all_cells && !grid.is_active(cell)) continue;
            const auto [i, j, k] = grid.ijk(cell);
            for (unsigned c = 0; c < 8; ++c) {
                const double depth = grid.depths[corner_index(grid.dims, i, j, k, c)];
                if (UnsetValues::is_huge(depth) || (!without.empty() && UnsetValues::holds(without, depth))) continue;
                parts[b].add(depth);
            }
        }
    });
    Extent all;
    for (const Extent& part : parts) all.add(part);
    return all;
}

Extent extent_of_pillars(const CornerPointGrid& grid, std::size_t axis, const std::vector<double>& without) {
    Extent all;
    for (std::size_t p = axis; p < grid.pillars.size(); p += 3) {
        const double v = grid.pillars[p];
        if (!UnsetValues::is_huge(v) && (without.empty() || !UnsetValues::holds(without, v))) all.add(v);
    }
    return all;
}

}  // namespace

UnsetValues unset_values(const CornerPointGrid& grid, bool all_cells) {
    UnsetValues unset;
    unset.depths = far_off([&](const std::vector<double>& without) { return extent_of_depths(grid, all_cells, without); }, true);
    for (std::size_t axis = 0; axis < 2 && !grid.cylindrical; ++axis) {
        for (const double v : far_off([&](const std::vector<double>& without) { return extent_of_pillars(grid, axis, without); }, false)) {
            if (!UnsetValues::holds(unset.across, v)) unset.across.push_back(v);
        }
    }
    return unset;
}

}  // namespace geomend::validators
