// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/corner_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/cell_volume.h"
#include "grid/quality.h"

// What the shape of one cell says: C07, C08, C09 and C22.

namespace geomend::validators {

namespace {

using grid::Corners;

double edge_length(const Corners& p, unsigned a, unsigned b) {
    const Vec3 edge = minus(p[a], p[b]);
    return std::sqrt(dot(edge, edge));
}

// By how much a determinant may be off when corners are off by the tolerance.
double slack(const std::array<double, 3>& edges, double tolerance) {
    return tolerance * (edges[0] * edges[1] + edges[1] * edges[2] + edges[2] * edges[0]);
}

std::array<double, 3> mean_edges(const Corners& p) {
    std::array<double, 3> mean{};
    for (unsigned c = 0; c < 8; ++c) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            if ((c >> axis & 1u) == 0) mean[axis] += edge_length(p, c, c + (1u << axis)) / 4;
        }
    }
    return mean;
}

// Least determinant where it is to be positive, as a part of what the edges there would span; 0 where it is not
// negative beyond what the tolerance explains.
double most_negative(const Corners& p, double sign, double tolerance) {
    const std::array<double, 8> corner = grid::corner_jacobians(p);
    const double low = 0.5 - std::sqrt(3.0) / 6, high = 0.5 + std::sqrt(3.0) / 6;
    std::array<double, 8> gauss;
    for (unsigned g = 0; g < 8; ++g)
        gauss[g] = grid::jacobian(p, (g & 1u) != 0 ? high : low, (g & 2u) != 0 ? high : low, (g & 4u) != 0 ? high : low);
    const auto sound = [&](double determinant) { return sign * determinant >= 0; };
    if (std::ranges::all_of(corner, sound) && std::ranges::all_of(gauss, sound)) return 0;

    double worst = 0;
    const auto take = [&](double determinant, const std::array<double, 3>& edges) {
        if (determinant >= -slack(edges, tolerance)) return;
        worst = std::min(worst, determinant / (edges[0] * edges[1] * edges[2]));
    };
    for (unsigned c = 0; c < 8; ++c) {
        const std::array<double, 3> edges{edge_length(p, c, c ^ 1u), edge_length(p, c, c ^ 2u), edge_length(p, c, c ^ 4u)};
        if (std::ranges::any_of(edges, [&](double e) { return e <= tolerance; })) continue;
        take(sign * corner[c], edges);
    }
    const std::array<double, 3> mean = mean_edges(p);
    if (std::ranges::any_of(mean, [&](double e) { return e <= tolerance; })) return worst;
    for (const double determinant : gauss) take(sign * determinant, mean);
    return worst;
}

using Point = std::array<double, 2>;

double area2(const Point& a, const Point& b, const Point& c) { return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]); }

// How deep a point lies inside a triangle: its least distance from a side, negative outside, 0 for flat triangles.
double depth_inside(const Point& p, const std::array<Point, 3>& t) {
    const double turn = area2(t[0], t[1], t[2]);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < 3; ++n) {
        const Point &a = t[n], &b = t[(n + 1) % 3];
        const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
        if (length == 0 || turn == 0) return 0;
        least = std::min(least, (turn > 0 ? 1 : -1) * area2(a, b, p) / length);
    }
    return least;
}

// How far the worst corner of the top or the base lies inside the triangle of the other three, seen from above.
double concavity(const Corners& corners) {
    double worst = 0;
    for (unsigned from = 0; from < 8; from += 4) {
        std::array<Point, 4> q;
        for (unsigned c = 0; c < 4; ++c) q[c] = {corners[from + c][0], corners[from + c][1]};
        // Convex outlines turn the same way at all corners.
        const std::array<double, 4> turns{area2(q[2], q[0], q[1]), area2(q[0], q[1], q[3]), area2(q[1], q[3], q[2]),
                                          area2(q[3], q[2], q[0])};
        if (std::ranges::all_of(turns, [](double t) { return t > 0; }) || std::ranges::all_of(turns, [](double t) { return t < 0; }))
            continue;
        for (unsigned c = 0; c < 4; ++c) worst = std::max(worst, depth_inside(q[c], {q[(c + 1) % 4], q[(c + 2) % 4], q[(c + 3) % 4]}));
    }
    return worst;
}

// Whether some angle between edges that meet at a corner of a face may be beyond the bounds: their cosine is then near 1
// or -1. Quick, because hardly any cell has one.
bool may_be_sharp(const Corners& p) {
    static const double cosine = std::cos(std::max(least_angle, 180 - greatest_angle) * std::numbers::pi / 180);
    const double least = cosine * cosine * (1 - 1e-12);
    for (unsigned c = 0; c < 8; ++c) {
        const std::array<Vec3, 3> edge{minus(p[c ^ 1u], p[c]), minus(p[c ^ 2u], p[c]), minus(p[c ^ 4u], p[c])};
        const auto sharp = [&](const Vec3& a, const Vec3& b) {
            const double d = dot(a, b);
            return d * d >= least * dot(a, a) * dot(b, b);
        };
        if (sharp(edge[0], edge[1]) || sharp(edge[0], edge[2]) || sharp(edge[1], edge[2])) return true;
        if (sharp({edge[0][0], edge[0][1], 0}, {edge[1][0], edge[1][1], 0})) return true;
    }
    return false;
}

}  // namespace

void check_inside_out(const GridScope& scope, std::vector<Finding>& findings) {
    const double sign = scope.right_handed() ? 1 : -1;
    // Edges on pillars are compared by depth; the finer tolerance serves for all where the two differ.
    const double tolerance = std::min(scope.tolerance(), scope.depth_tolerance());
    const auto found = find_cells(scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const double worst = most_negative(scope.corners(i, j, k), sign, tolerance);
        return Judgement{worst < 0, -worst};
    });
    if (found.count == 0) return;
    Finding f = cells_finding(scope, "C07",
                              counted(found.count, "cell is", "cells are") +
                                  " turned inside out at a corner or within: det J is negative, at worst " + rounded(-found.worst) +
                                  " of the product of the edges in " + cell_text(scope.grid(), found.worst_cell),
                              found);
    f.measures = {{"least_scaled_jacobian", -found.worst}};
    findings.push_back(std::move(f));
}

void check_concave(const GridScope& scope, std::vector<Finding>& findings) {
    if (scope.grid().cylindrical) return;
    const auto found = find_cells(scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const double inside = concavity(scope.corners(i, j, k));
        return Judgement{inside > scope.tolerance(), inside};
    });
    if (found.count == 0) return;
    Finding f = cells_finding(scope, "C08",
                              counted(found.count, "cell is", "cells are") +
                                  " concave seen from above: a corner of top or base lies within the triangle of the others, at most by " +
                                  rounded(found.worst) + " in " + cell_text(scope.grid(), found.worst_cell),
                              found);
    f.measures = {{"depth_of_corner", found.worst}};
    findings.push_back(std::move(f));
}

void check_angles(const GridScope& scope, std::vector<Finding>& findings) {
    if (scope.grid().cylindrical) return;
    const auto found = find_cells(scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const Corners corners = scope.corners(i, j, k);
        if (!may_be_sharp(corners)) return Judgement{};
        const grid::CellQuality q = grid::cell_quality(corners, scope.depth_tolerance());
        const double least = std::min({q.least_top_base, q.least_projected, q.least_side});
        const double greatest = std::max({q.greatest_top_base, q.greatest_projected, q.greatest_side});
        Judgement of;
        of.measure = std::max(least_angle - least, greatest - greatest_angle);
        of.found = of.measure > 0;
        of.kind = std::min(q.least_side, 180 - q.greatest_side) < std::min(least_angle, 180 - greatest_angle) ? 1 : 0;
        return of;
    });
    if (found.count == 0) return;
    Finding f = cells_finding(scope, "C09",
                              counted(found.count, "cell has", "cells have") + " angles below " + rounded(least_angle) + " or above " +
                                  rounded(greatest_angle) + " degrees (" + std::to_string(found.by_kind[1]) +
                                  " of them at a side), the worst beyond by " + rounded(found.worst) + " in " +
                                  cell_text(scope.grid(), found.worst_cell),
                              found);
    f.measures = {{"beyond_by", found.worst}, {"at_sides", static_cast<double>(found.by_kind[1])}};
    findings.push_back(std::move(f));
}

void check_flat_cells(const GridScope& scope, std::vector<Finding>& findings) {
    if (scope.grid().cylindrical) return;
    const auto found = find_cells(scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const std::array<double, 3> edges = mean_edges(scope.corners(i, j, k));
        const double low = std::min({edges[0], edges[1], edges[2]}), high = std::max({edges[0], edges[1], edges[2]});
        return Judgement{low > scope.depth_tolerance() && high > largest_aspect * low, high / low};
    });
    if (found.count == 0) return;
    Finding f = cells_finding(scope, "C22",
                              counted(found.count, "cell is", "cells are") + " more than " + rounded(largest_aspect) +
                                  " times as long as thick, the worst " + rounded(found.worst) +
                                  " times: " + cell_text(scope.grid(), found.worst_cell),
                              found);
    f.measures = {{"aspect", found.worst}};
    findings.push_back(std::move(f));
}

}  // namespace geomend::validators
