// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/pillar_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"

namespace geomend::grid {

PillarFit::PillarFit(std::array<std::uint32_t, 3> dims, double rounding) : rounding_(rounding) {
    grid_.dims = dims;
    grid_.info.crs.z_positive = ZPositive::depth;
    grid_.pillars.assign(6 * pillar_count(dims), 0.0);
    grid_.depths.assign(8 * grid_.cell_count(), 0.0);
    grid_.activity.assign(grid_.cell_count(), 0);
    known_.assign(pillar_count(dims), 0);
}

std::size_t PillarFit::pillar(std::size_t cell, unsigned corner) const {
    const auto at = grid_.ijk(cell);
    return at[0] + (corner & 1u) + (std::size_t{grid_.dims[0]} + 1) * (std::size_t{at[1]} + ((corner >> 1) & 1u));
}

void PillarFit::add(std::size_t cell, const std::array<Vec3, 8>& corners) {
    cells_.push_back(cell);
    corners_.push_back(corners);
}

void PillarFit::add_points(std::size_t cell, std::vector<Vec3> points, bool loose) { pinched_.push_back({cell, std::move(points), loose}); }

// A pillar runs from the highest to the lowest of its corners.
void PillarFit::fit_pillars() {
    for (std::size_t n = 0; n < cells_.size(); ++n) {
        for (unsigned c = 0; c < 8; ++c) {
            const std::size_t p = pillar(cells_[n], c);
            double* line = grid_.pillars.data() + 6 * p;
            const Vec3& point = corners_[n][c];
            if (known_[p] == 0 || point[2] < line[2]) std::ranges::copy(point, line);
            if (known_[p] == 0 || point[2] > line[5]) std::ranges::copy(point, line + 3);
            known_[p] = 1;
        }
    }
}

double PillarFit::distance(std::size_t p, const Vec3& point) const {
    const Vec3 on = pillar_point(grid_.pillars.data() + 6 * p, point[2]);
    return std::hypot(on[0] - point[0], on[1] - point[1]);
}

double PillarFit::allowed(std::size_t p, const Vec3& point) const {
    const double* line = grid_.pillars.data() + 6 * p;
    const double length = std::hypot(line[3] - line[0], line[4] - line[1], line[5] - line[2]);
    return 1e-6 * length + 8 * rounding_ * std::max(std::abs(point[0]), std::abs(point[1]));
}

Failure PillarFit::misfit_of(std::size_t cell, const std::string& what) const {
    const auto [i, j, k] = grid_.ijk(cell);
    Failure why = failure(FailureKind::cannot_hold, "F021", {},
                          "cell (" + std::to_string(i + 1) + "," + std::to_string(j + 1) + "," + std::to_string(k + 1) +
                              ") does not fit a corner-point grid: " + what);
    return why;
}

// The points beside the three known pillars of a cell, if they can be corners of the fourth. \param unknown its number
std::vector<Vec3> PillarFit::points_of_unknown_pillar(const Pinched& pinched, std::size_t& unknown) const {
    unsigned count = 0;
    for (unsigned c = 0; c < 4; ++c) {
        if (known_[pillar(pinched.cell, c)] != 0) continue;
        unknown = pillar(pinched.cell, c);
        ++count;
    }
    std::vector<Vec3> left;
    if (count != 1) return left;
    for (const Vec3& point : pinched.points) {
        bool elsewhere = false;
        for (unsigned c = 0; c < 4; ++c) {
            const std::size_t p = pillar(pinched.cell, c);
            elsewhere = elsewhere || (p != unknown && distance(p, point) <= allowed(p, point));
        }
        if (!elsewhere) left.push_back(point);
    }
    if (left.size() > 2) left.clear();
    return left;
}

// One round over the pinched cells. \returns whether a pillar was found
bool PillarFit::fit_pillars_of_pinched() {
    std::vector<std::pair<std::size_t, Vec3>> found;
    for (const Pinched& pinched : pinched_) {
        std::size_t unknown = 0;
        for (const Vec3& point : points_of_unknown_pillar(pinched, unknown)) found.emplace_back(unknown, point);
    }
    for (const auto& [p, point] : found) {
        double* line = grid_.pillars.data() + 6 * p;
        if (known_[p] == 0 || point[2] < line[2]) std::ranges::copy(point, line);
        if (known_[p] == 0 || point[2] > line[5]) std::ranges::copy(point, line + 3);
        known_[p] = 1;
    }
    return !found.empty();
}

// The highest and the lowest point on each pillar become top and bottom.
bool PillarFit::sort_onto_pillars(const Pinched& pinched) {
    std::array<double, 4> top, bottom;
    top.fill(std::numeric_limits<double>::infinity());
    bottom.fill(-std::numeric_limits<double>::infinity());
    for (const Vec3& point : pinched.points) {
        unsigned best = 0;
        for (unsigned c = 1; c < 4; ++c) {
            if (distance(pillar(pinched.cell, c), point) < distance(pillar(pinched.cell, best), point)) best = c;
        }
        const std::size_t p = pillar(pinched.cell, best);
        if (known_[p] == 0) return false;
        if (distance(p, point) > allowed(p, point)) {
            if (pinched.loose) continue;
            return false;
        }
        top[best] = std::min(top[best], point[2]);
        bottom[best] = std::max(bottom[best], point[2]);
    }
    const auto [i, j, k] = grid_.ijk(pinched.cell);
    for (unsigned c = 0; c < 4; ++c) {
        if (top[c] > bottom[c]) return false;
        grid_.depths[corner_index(grid_.dims, i, j, k, c)] = top[c];
        grid_.depths[corner_index(grid_.dims, i, j, k, c + 4)] = bottom[c];
    }
    grid_.activity[pinched.cell] = 1;
    return true;
}

Result<CornerPointGrid> PillarFit::finish() {
    fit_pillars();
    for (std::size_t n = 0; n < cells_.size(); ++n) {
        const auto [i, j, k] = grid_.ijk(cells_[n]);
        for (unsigned c = 0; c < 8; ++c) {
            const std::size_t p = pillar(cells_[n], c);
            const double off = distance(p, corners_[n][c]);
            if (off > allowed(p, corners_[n][c]))
                return misfit_of(cells_[n], "a corner at depth " + number_text(corners_[n][c][2]) + " lies " + number_text(off) +
                                                " beside the straight line through the other corners of its column");
            grid_.depths[corner_index(grid_.dims, i, j, k, c)] = corners_[n][c][2];
        }
        grid_.activity[cells_[n]] = 1;
    }
    while (!pinched_.empty() && fit_pillars_of_pinched()) {
    }
    for (const Pinched& pinched : pinched_) {
        if (!sort_onto_pillars(pinched))
            return misfit_of(pinched.cell, "its points do not lie on four pillars that the cells beside it define");
    }
    fill_missing_pillars();
    fill_missing_cells();
    if (std::ranges::all_of(grid_.activity, [](std::uint8_t a) { return a == 1; })) grid_.activity.clear();
    return std::move(grid_);
}

// Pillars that no cell uses: upright, at the next pillar known in their row, else anywhere. Only inactive cells use them.
void PillarFit::fill_missing_pillars() {
    const std::size_t row = std::size_t{grid_.dims[0]} + 1;
    const auto copy_from = [&](std::size_t p, std::size_t from) {
        std::copy_n(grid_.pillars.data() + 6 * from, 6, grid_.pillars.data() + 6 * p);
        known_[p] = 1;
    };
    for (std::size_t p = 1; p < known_.size(); ++p) {
        if (known_[p] == 0 && known_[p - 1] != 0 && p % row != 0) copy_from(p, p - 1);
        else if (known_[p] == 0 && p >= row && known_[p - row] != 0) copy_from(p, p - row);
    }
    for (std::size_t p = known_.size() - 1; p-- > 0;) {
        if (known_[p] == 0) copy_from(p, p + 1);
    }
}

// Inactive cells fill nothing: they lie, without thickness, at the bottom of the cell above or the top of that below.
void PillarFit::fill_missing_cells() {
    const auto [nx, ny, nz] = grid_.dims;
    for (std::uint32_t j = 0; j < ny; ++j) {
        for (std::uint32_t i = 0; i < nx; ++i) {
            for (unsigned c = 0; c < 4; ++c) {
                double depth = grid_.pillars[6 * pillar(grid_.cell(i, j, 0), c) + 2];
                for (std::uint32_t k = 0; k < nz; ++k) {
                    if (grid_.activity[grid_.cell(i, j, k)] == 0) continue;
                    depth = grid_.depths[corner_index(grid_.dims, i, j, k, c)];
                    break;
                }
                for (std::uint32_t k = 0; k < nz; ++k) {
                    double& top = grid_.depths[corner_index(grid_.dims, i, j, k, c)];
                    double& bottom = grid_.depths[corner_index(grid_.dims, i, j, k, c + 4)];
                    if (grid_.activity[grid_.cell(i, j, k)] == 0) top = bottom = depth;
                    else depth = bottom;
                }
            }
        }
    }
}

}  // namespace geomend::grid
