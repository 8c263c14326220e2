// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/cell_corners_grid.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"

namespace geomend::eclipse {

namespace {

constexpr float unit_of_last_place = 1.1920929e-7f;

/// Number of the pillar at corner c of cell (i,j,k).
std::size_t pillar_of(const CornerPointGrid& grid, const std::array<std::uint32_t, 3>& ijk, unsigned c) {
    return ijk[0] + (c & 1u) + (std::size_t{grid.dims[0]} + 1) * (std::size_t{ijk[1]} + ((c >> 1) & 1u));
}

template <class Body>
void for_each_corner(const CornerCells& known, const CornerPointGrid& grid, const Body& body) {
    for (std::size_t n = 0; n < known.cells.size(); ++n) {
        const auto ijk = grid.ijk(known.cells[n]);
        for (unsigned c = 0; c < 8; ++c) body(n, ijk, c, known.corners.data() + 24 * n + 3 * c);
    }
}

/// Pillars from the highest to the lowest of the corners on them; says which have any.
std::vector<std::uint8_t> take_pillars(const CornerCells& known, CornerPointGrid& grid) {
    std::vector<std::uint8_t> has(pillar_count(grid.dims), 0);
    for_each_corner(known, grid, [&](std::size_t, const auto& ijk, unsigned c, const float* p) {
        const std::size_t number = pillar_of(grid, ijk, c);
        double* pillar = grid.pillars.data() + 6 * number;
        const auto put = [&](double* to) { std::copy_n(p, 3, to); };
        if (has[number] == 0 || p[2] < pillar[2]) put(pillar);
        if (has[number] == 0 || p[2] > pillar[5]) put(pillar + 3);
        has[number] = 1;
    });
    return has;
}

/// How far a corner may be from its line: rounding to single precision of the corner and of the line's two ends.
bool on_line(const double* pillar, const float* p) {
    const Vec3 expected = pillar_point(pillar, static_cast<double>(p[2]));
    for (std::size_t d = 0; d < 2; ++d) {
        const double size = std::max({std::abs(pillar[d]), std::abs(pillar[3 + d]), std::abs(static_cast<double>(p[d]))});
        // A short pillar that leans: the depth's rounding moves the point along the line, too.
        const double lean = pillar[5] > pillar[2] ? std::abs((pillar[3 + d] - pillar[d]) / (pillar[5] - pillar[2])) : 0;
        const double slack = unit_of_last_place * (4 * size + 2 * lean * std::abs(static_cast<double>(p[2])));
        if (std::abs(expected[d] - static_cast<double>(p[d])) > slack) return false;
    }
    return true;
}

std::optional<std::string> first_off_line(const CornerCells& known, const CornerPointGrid& grid) {
    std::optional<std::string> text;
    for_each_corner(known, grid, [&](std::size_t, const auto& ijk, unsigned c, const float* p) {
        if (text || on_line(grid.pillars.data() + 6 * pillar_of(grid, ijk, c), p)) return;
        text = "corner " + std::to_string(c + 1) + " of cell (" + std::to_string(ijk[0] + 1) + "," + std::to_string(ijk[1] + 1) + "," +
               std::to_string(ijk[2] + 1) + ") at " + number_text(static_cast<double>(p[0])) + " " +
               number_text(static_cast<double>(p[1])) + " " + number_text(static_cast<double>(p[2]));
    });
    return text;
}

/// Unknown pillars, outwards from the known ones: on the line of two known ones, else beside one.
void fill_pillars(CornerPointGrid& grid, std::vector<std::uint8_t>& has) {
    const auto nx = static_cast<std::ptrdiff_t>(grid.dims[0]) + 1, ny = static_cast<std::ptrdiff_t>(grid.dims[1]) + 1;
    const auto inside = [&](std::ptrdiff_t i, std::ptrdiff_t j) { return i >= 0 && i < nx && j >= 0 && j < ny; };
    const auto known = [&](std::ptrdiff_t i, std::ptrdiff_t j) { return inside(i, j) && has[static_cast<std::size_t>(i + nx * j)] != 0; };
    const auto at = [&](std::ptrdiff_t i, std::ptrdiff_t j) { return grid.pillars.data() + 6 * (i + nx * j); };
    constexpr std::array<std::array<std::ptrdiff_t, 2>, 4> steps = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    std::vector<std::size_t> queue;
    for (std::size_t n = 0; n < has.size(); ++n) {
        if (has[n] != 0) queue.push_back(n);
    }
    for (std::size_t q = 0; q < queue.size(); ++q) {
        const auto i = static_cast<std::ptrdiff_t>(queue[q]) % nx, j = static_cast<std::ptrdiff_t>(queue[q]) / nx;
        for (const auto [di, dj] : steps) {
            const std::ptrdiff_t ti = i + di, tj = j + dj;
            if (!inside(ti, tj) || known(ti, tj)) continue;
            double* to = at(ti, tj);
            const double* near = at(i, j);
            const bool between = known(ti + di, tj + dj), beyond = !between && known(i - di, j - dj);
            for (std::size_t v = 0; v < 6; ++v) {
                to[v] = near[v];
                if (between) to[v] = (near[v] + at(ti + di, tj + dj)[v]) / 2;
                if (beyond && v % 3 != 2) to[v] = 2 * near[v] - at(i - di, j - dj)[v];
            }
            has[static_cast<std::size_t>(ti + nx * tj)] = 1;
            queue.push_back(static_cast<std::size_t>(ti + nx * tj));
        }
    }
}

/// Depths of the unknown cells of a column along one of its four lines: spread evenly between the known ones.
void fill_line(CornerPointGrid& grid, const std::vector<std::uint8_t>& has, std::uint32_t i, std::uint32_t j, unsigned c) {
    const std::uint32_t nz = grid.dims[2];
    const double* pillar = grid.pillars.data() + 6 * pillar_of(grid, {i, j, 0}, c);
    const auto depth = [&](std::uint32_t k, unsigned corner) -> double& { return grid.depths[corner_index(grid.dims, i, j, k, corner)]; };
    for (std::uint32_t k = 0; k < nz;) {
        if (has[grid.cell(i, j, k)] != 0) {
            ++k;
            continue;
        }
        std::uint32_t end = k;
        while (end < nz && has[grid.cell(i, j, end)] == 0) ++end;
        const bool whole = k == 0 && end == nz;
        const double below = end < nz ? depth(end, c) : whole ? pillar[5] : depth(k - 1, c + 4);
        const double above = k > 0 ? depth(k - 1, c + 4) : whole ? pillar[2] : below;
        for (std::uint32_t u = k; u < end; ++u) {
            const double count = end - k;
            depth(u, c) = above + (below - above) * ((u - k) / count);
            depth(u, c + 4) = above + (below - above) * ((u - k + 1) / count);
        }
        k = end;
    }
}

}  // namespace

std::optional<std::string> set_geometry(const CornerCells& known, CornerPointGrid& grid) {
    grid.pillars.assign(6 * pillar_count(grid.dims), 0);
    grid.depths.assign(8 * grid.cell_count(), 0);
    std::vector<std::uint8_t> has_pillar = take_pillars(known, grid);
    if (auto off = first_off_line(known, grid)) return off;
    fill_pillars(grid, has_pillar);
    std::vector<std::uint8_t> has_cell(grid.cell_count(), 0);
    for_each_corner(known, grid, [&](std::size_t n, const auto& ijk, unsigned c, const float* p) {
        grid.depths[corner_index(grid.dims, ijk[0], ijk[1], ijk[2], c)] = static_cast<double>(p[2]);
        has_cell[known.cells[n]] = 1;
    });
    for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
        for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
            for (unsigned c = 0; c < 4; ++c) fill_line(grid, has_cell, i, j, c);
        }
    }
    return std::nullopt;
}

}  // namespace geomend::eclipse
