// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/pillar_nodes.h"

#include <algorithm>

#include "base/big_array.h"
#include "base/parallel.h"

namespace geomend::grid {

namespace {

// Puts the depths from `run` on in order, after those before, which are; each once.
void merge_run(std::vector<double>& depths, std::size_t run) {
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(run);
    if (!std::is_sorted(middle, depths.end())) std::sort(middle, depths.end());
    std::inplace_merge(depths.begin(), middle, depths.end());
    depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
}

// Depths of the corners of present cells on one pillar of one set, sorted, each once.
void gather(const CornerPointGrid& grid, std::span<const std::uint8_t> present, std::size_t pillar, std::vector<double>& depths) {
    depths.clear();
    const std::size_t lines = std::size_t{grid.dims[0]} + 1, count = pillar_count(grid.dims);
    const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1], plane = 4 * layer;
    const std::size_t set = pillar / count, a = pillar % count % lines, b = pillar % count / lines;
    for (unsigned c = 0; c < 4; ++c) {
        const std::size_t di = c & 1u, dj = c >> 1, run = depths.size();
        if (a < di || b < dj || a - di >= grid.dims[0] || b - dj >= grid.dims[1]) continue;
        const std::size_t column = (a - di) + grid.dims[0] * (b - dj);
        const double* at = grid.depths.data() + corner_index(grid.dims, a - di, b - dj, 0, c);
        for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
            if (present[column + k * layer] == 0 || (!grid.reservoirs.empty() && pillar_set(grid, k) != set)) continue;
            const double top = at[2 * k * plane], bottom = at[(2 * k + 1) * plane];
            if (depths.size() == run || depths.back() != top) depths.push_back(top);
            if (depths.back() != bottom) depths.push_back(bottom);
        }
        merge_run(depths, run);
    }
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
    constexpr std::size_t at_once = 1024;  // so that depths hardly lie in memory twice
    std::vector<std::vector<double>> parts(std::min(at_once, pillars));
    first_.reserve(pillars + 1);
    depths_.reserve(pillars * (std::size_t{grid.dims[2]} + 1));
    for (std::size_t start = 0; start < pillars; start += at_once) {
        const std::size_t count = std::min(at_once, pillars - start);
        parallel_blocks(count, 32, [&](std::size_t first, std::size_t last) {
            for (std::size_t p = first; p < last; ++p) gather(grid, present, start + p, parts[p]);
        });
        for (std::size_t p = 0; p < count; ++p) {
            first_.push_back(depths_.size());
            depths_.insert(depths_.end(), parts[p].begin(), parts[p].end());
        }
    }
    first_.push_back(depths_.size());
}

std::uint32_t PillarNodes::id(std::size_t pillar, double depth) const {
    const auto all = on(pillar);
    return static_cast<std::uint32_t>(first_[pillar] + static_cast<std::size_t>(std::ranges::lower_bound(all, depth) - all.begin()));
}

std::vector<Vec3> PillarNodes::points(const CornerPointGrid& grid) const {
    std::vector<Vec3> all;
    add_points(grid, all);
    return all;
}

void PillarNodes::add_points(const CornerPointGrid& grid, std::vector<Vec3>& all) const {
    make_big(all, depths_.size());
    parallel_blocks(first_.size() - 1, 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
            for (std::size_t n = first_[p]; n < first_[p + 1]; ++n) {
                const Vec3 at = pillar_point(grid.pillars.data() + 6 * p, depths_[n], grid.cylindrical);
                all[n] = {at[0], at[1], 0.0 - at[2]};
            }
        }
    });
}

}  // namespace geomend::grid
