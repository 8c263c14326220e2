// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/pillar_nodes.h"

#include <algorithm>

#include "base/parallel.h"

namespace geomend::grid {

namespace {

// Depths of the corners of present cells on one pillar of one set, sorted, each once.
void gather(const CornerPointGrid& grid, std::span<const std::uint8_t> present, std::size_t pillar, std::vector<double>& depths) {
    depths.clear();
    const std::size_t lines = std::size_t{grid.dims[0]} + 1, count = pillar_count(grid.dims);
    const std::size_t set = pillar / count, a = pillar % count % lines, b = pillar % count / lines;
    for (unsigned c = 0; c < 4; ++c) {
        const std::size_t di = c & 1u, dj = c >> 1;
        if (a < di || b < dj || a - di >= grid.dims[0] || b - dj >= grid.dims[1]) continue;
        const auto i = static_cast<std::uint32_t>(a - di), j = static_cast<std::uint32_t>(b - dj);
        for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
            if (present[grid.cell(i, j, k)] == 0 || (!grid.reservoirs.empty() && pillar_set(grid, k) != set)) continue;
            depths.push_back(grid.depths[corner_index(grid.dims, i, j, k, c)]);
            depths.push_back(grid.depths[corner_index(grid.dims, i, j, k, c + 4)]);
        }
    }
    std::ranges::sort(depths);
    depths.erase(std::ranges::unique(depths).begin(), depths.end());
}

}  // namespace

std::vector<std::uint8_t> present_cells(const CornerPointGrid& grid) {
    std::vector<std::uint8_t> present(grid.cell_count());
    parallel_blocks(present.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell < last; ++cell) {
            if (!grid.is_active(cell)) continue;
            const auto [i, j, k] = grid.ijk(cell);
            for (unsigned c = 0; c < 4 && present[cell] == 0; ++c)
                present[cell] = grid.depths[corner_index(grid.dims, i, j, k, c)] != grid.depths[corner_index(grid.dims, i, j, k, c + 4)];
        }
    });
    return present;
}

PillarNodes::PillarNodes(const CornerPointGrid& grid, std::span<const std::uint8_t> present) {
    const std::size_t pillars = grid.pillars.size() / 6;
    std::vector<std::vector<double>> parts(pillars);
    parallel_blocks(pillars, 64, [&](std::size_t first, std::size_t last) {
        std::vector<double> depths;
        for (std::size_t p = first; p < last; ++p) {
            gather(grid, present, p, depths);
            parts[p].assign(depths.begin(), depths.end());
        }
    });
    first_.reserve(pillars + 1);
    for (const std::vector<double>& part : parts) {
        first_.push_back(depths_.size());
        depths_.insert(depths_.end(), part.begin(), part.end());
    }
    first_.push_back(depths_.size());
}

std::uint32_t PillarNodes::id(std::size_t pillar, double depth) const {
    const auto all = on(pillar);
    return static_cast<std::uint32_t>(first_[pillar] + static_cast<std::size_t>(std::ranges::lower_bound(all, depth) - all.begin()));
}

std::vector<Vec3> PillarNodes::points(const CornerPointGrid& grid) const {
    std::vector<Vec3> all(depths_.size());
    parallel_blocks(first_.size() - 1, 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
            for (std::size_t n = first_[p]; n < first_[p + 1]; ++n) {
                const Vec3 at = pillar_point(grid.pillars.data() + 6 * p, depths_[n], grid.cylindrical);
                all[n] = {at[0], at[1], 0.0 - at[2]};
            }
        }
    });
    return all;
}

}  // namespace geomend::grid
