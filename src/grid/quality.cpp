// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/length.h"
#include "base/parallel.h"
#include "geometry/cell_volume.h"
#include "grid/cell_mesh.h"

namespace geomend::grid {

namespace {

using Face = std::array<unsigned, 4>;  // corners in the order of a walk around it
constexpr std::array<Face, 2> top_and_base{{{0, 1, 3, 2}, {4, 5, 7, 6}}};
constexpr std::array<Face, 4> sides{{{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}}};

Vec3 difference(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

void take_angles(const Corners& p, const Face& face, double zero, double& least, double& greatest) {
    for (std::size_t n = 0; n < 4; ++n) {
        const Vec3 &at = p[face[n]], a = difference(p[face[(n + 3) % 4]], at), b = difference(p[face[(n + 1) % 4]], at);
        if (length(a) <= zero || length(b) <= zero) continue;
        // atan2 keeps its digits near 0 and 180 degrees, where acos loses them.
        const double angle = std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
        least = std::min(least, angle);
        greatest = std::max(greatest, angle);
    }
}

double mean_edge(const Corners& p, unsigned axis) {
    double sum = 0;
    for (unsigned c = 0; c < 8; ++c) {
        if ((c >> axis & 1u) == 0) sum += length(difference(p[c + (1u << axis)], p[c]));
    }
    return sum / 4;
}

double least_jacobian(const Corners& p, double zero) {
    const std::array<double, 8> all = corner_jacobians(p);
    double least = std::numeric_limits<double>::infinity();
    for (unsigned c = 0; c < 8; ++c) {
        double product = 1;
        bool collapsed = false;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const double edge = length(difference(p[c ^ (1u << axis)], p[c]));
            collapsed = collapsed || edge <= zero;
            product *= edge;
        }
        if (!collapsed) least = std::min(least, all[c] / product);
    }
    return std::isfinite(least) ? least : 0;
}

}  // namespace

CellQuality cell_quality(const Corners& corners, double zero_length) {
    CellQuality q;
    Corners flat = corners;
    for (Vec3& p : flat) p[2] = 0;
    for (const Face& face : top_and_base) {
        take_angles(corners, face, zero_length, q.least_top_base, q.greatest_top_base);
        take_angles(flat, face, zero_length, q.least_projected, q.greatest_projected);
    }
    for (const Face& face : sides) take_angles(corners, face, zero_length, q.least_side, q.greatest_side);
    const auto [low, high] = std::minmax({mean_edge(corners, 0), mean_edge(corners, 1), mean_edge(corners, 2)});
    q.aspect = low > 0 ? high / low : std::numeric_limits<double>::infinity();
    q.least_jacobian = least_jacobian(corners, zero_length);
    return q;
}

std::vector<Attribute> quality_attributes(const CornerPointGrid& grid) {
    struct Row {
        const char* name;
        double CellQuality::*value;
    };
    constexpr std::array rows{Row{"minangle_topbase", &CellQuality::least_top_base},
                              Row{"maxangle_topbase", &CellQuality::greatest_top_base},
                              Row{"minangle_topbase_proj", &CellQuality::least_projected},
                              Row{"maxangle_topbase_proj", &CellQuality::greatest_projected},
                              Row{"minangle_sides", &CellQuality::least_side},
                              Row{"maxangle_sides", &CellQuality::greatest_side},
                              Row{"aspect", &CellQuality::aspect},
                              Row{"min_jacobian", &CellQuality::least_jacobian}};
    constexpr double no_data = -999;
    const double sign = right_handed(grid) ? 1 : -1;
    std::array<std::vector<double>, rows.size()> values;
    for (auto& v : values) v.resize(grid.cell_count());
    parallel_blocks(grid.cell_count(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell < last; ++cell) {
            const auto [i, j, k] = grid.ijk(cell);
            CellQuality q = cell_quality(cell_corners(grid, i, j, k));
            q.least_jacobian *= sign;
            for (std::size_t r = 0; r < rows.size(); ++r) {
                const double value = q.*rows[r].value;
                values[r][cell] = std::isfinite(value) ? value : no_data;
            }
        }
    });
    std::vector<Attribute> all;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        Attribute a;
        a.name = rows[r].name;
        a.location = AttributeLocation::cell;
        if (r < 6) a.unit = "degrees";
        if (std::ranges::find(values[r], no_data) != values[r].end()) a.no_data = no_data;
        a.values = std::move(values[r]);
        all.push_back(std::move(a));
    }
    return all;
}

}  // namespace geomend::grid
