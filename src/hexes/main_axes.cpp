// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/main_axes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "base/vectors.h"

namespace geomend::hexes {

namespace {

using Axes = std::array<Vec3, 3>;

/// A triangle by its normal of length 1 and its area.
struct Facing {
    Vec3 normal;
    double area;
};

std::vector<Facing> facings_of(const BrepData& brep) {
    std::vector<Facing> all;
    for (const auto& surface : brep.surfaces) {
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            const auto at = [&](std::size_t k) { return brep.vertices[surface.nodes[polygon[k]].value]; };
            for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
                const Vec3 n = cross(minus(at(k), at(0)), minus(at(k + 1), at(0)));
                const double twice = std::sqrt(dot(n, n));
                if (twice > 0) all.push_back({times(1 / twice, n), 0.5 * twice});
            }
        }
    }
    return all;
}

/// Sum over triangles of area times n(x)n(x)n(x)n, for their normals n.
struct NormalMoments {
    std::array<double, 81> sums{};
    double area = 0;

    void add(const Facing& f) {
        const Vec3& n = f.normal;
        area += f.area;
        for (std::size_t i = 0; i < 81; ++i) sums[i] += f.area * n[i / 27] * n[i / 9 % 3] * n[i / 3 % 3] * n[i % 3];
    }
    /// Sum of area times (n.a)^3 n.
    Vec3 pull(const Vec3& a) const {
        Vec3 sum{};
        for (std::size_t i = 0; i < 81; ++i) sum[i / 27] += sums[i] * a[i / 9 % 3] * a[i / 3 % 3] * a[i % 3];
        return sum;
    }
    double fit(const Axes& axes) const {
        double sum = 0;
        for (const Vec3& a : axes) sum += dot(a, pull(a));
        return sum;
    }
};

/// The rotation nearest to three directions (Newton's iteration for the polar decomposition). \pre they span space
Axes nearest_rotation(Axes m) {
    for (int round = 0; round < 60; ++round) {
        const Vec3 c0 = cross(m[1], m[2]), c1 = cross(m[2], m[0]), c2 = cross(m[0], m[1]);
        const double det = dot(m[0], c0);
        const Axes inverse{times(1 / det, c0), times(1 / det, c1), times(1 / det, c2)};
        double change = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 half = times(0.5, plus(m[k], inverse[k]));
            const Vec3 d = minus(half, m[k]);
            change = std::max(change, dot(d, d));
            m[k] = half;
        }
        if (change < 1e-30) break;
    }
    return m;
}

Axes climbed(const NormalMoments& moments, Axes axes) {
    for (int round = 0; round < 200; ++round) {
        Axes pulled;
        for (std::size_t k = 0; k < 3; ++k) pulled[k] = plus(times(1 / moments.area, moments.pull(axes[k])), times(1e-2, axes[k]));
        const Axes next = nearest_rotation(pulled);
        double change = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 d = minus(next[k], axes[k]);
            change = std::max(change, dot(d, d));
        }
        axes = next;
        if (change < 1e-26) break;
    }
    return axes;
}

Axes turned(double about_z, double tilt) {
    const double c = std::cos(about_z), s = std::sin(about_z), u = std::cos(tilt), w = std::sin(tilt);
    return {{{c, s, 0}, {-s * u, c * u, w}, {s * w, -c * w, u}}};
}

/// The axes in the order and with the signs that bring them closest to x, y and z.
Axes named(Axes axes) {
    const auto by_axis = [&](std::size_t k) { return [k](const Vec3& a, const Vec3& b) { return std::abs(a[k]) < std::abs(b[k]); }; };
    std::iter_swap(axes.begin() + 2, std::max_element(axes.begin(), axes.end(), by_axis(2)));
    if (std::abs(axes[1][0]) > std::abs(axes[0][0])) std::swap(axes[0], axes[1]);
    for (std::size_t k : {2, 0}) {
        if (axes[k][k] < 0) axes[k] = times(-1, axes[k]);
    }
    axes[1] = cross(axes[2], axes[0]);
    return axes;
}

/// Surfaces that are nearer to the third axis than to the plane of the others are no walls.
bool is_wall(const Vec3& normal, const Axes& axes) { return std::abs(dot(normal, axes[2])) < 0.7; }

/// How much a triangle counts that is `off` the others: much less where it is farther off than `width` (Geman and McClure).
double trust(double off, double width) {
    const double r = 1 + (off / width) * (off / width);
    return 1 / (r * r);
}

constexpr double widest = 0.3, narrowest = 2e-4;  // of trust: radians

/// The third axis made perpendicular to the walls, to those most of all that agree with each other.
Axes upright(std::span<const Facing> all, Axes axes) {
    for (double width = widest; width > narrowest; width *= 0.7) {
        // The third axis moves by x and y along the others.
        double xx = 0, xy = 0, yy = 0, x = 0, y = 0, sum = 0;
        for (const Facing& f : all) {
            if (!is_wall(f.normal, axes)) continue;
            const double a = dot(f.normal, axes[0]), b = dot(f.normal, axes[1]), off = dot(f.normal, axes[2]);
            const double weight = f.area * trust(off, width);
            xx += weight * a * a, xy += weight * a * b, yy += weight * b * b;
            x -= weight * a * off, y -= weight * b * off;
            sum += weight;
        }
        xx += 1e-6 * sum, yy += 1e-6 * sum;  // walls in one direction say nothing about the other
        const double det = xx * yy - xy * xy;
        if (!(det > 0)) return axes;
        axes[2] = plus(axes[2], plus(times((x * yy - y * xy) / det, axes[0]), times((y * xx - x * xy) / det, axes[1])));
        axes[2] = times(1 / std::sqrt(dot(axes[2], axes[2])), axes[2]);
        axes[0] = across(axes[0], axes[2]);
        axes[0] = times(1 / std::sqrt(dot(axes[0], axes[0])), axes[0]);
        axes[1] = cross(axes[2], axes[0]);
    }
    return axes;
}

/// The first two axes turned about the third to the normals of walls, to those most of all that agree with each other.
Axes along_walls(std::span<const Facing> all, Axes axes) {
    constexpr double quarter = std::numbers::pi / 2;
    for (double width = widest; width > narrowest; width *= 0.7) {
        double turn = 0, sum = 0;
        for (const Facing& f : all) {
            if (!is_wall(f.normal, axes)) continue;
            const double angle = std::atan2(dot(f.normal, axes[1]), dot(f.normal, axes[0]));
            const double off = angle - quarter * std::round(angle / quarter);
            const double weight = f.area * trust(off, width) * trust(dot(f.normal, axes[2]), width);
            turn += weight * off;
            sum += weight;
        }
        if (!(sum > 0)) return axes;
        const double c = std::cos(turn / sum), s = std::sin(turn / sum);
        axes[0] = plus(times(c, axes[0]), times(s, axes[1]));
        axes[1] = cross(axes[2], axes[0]);
    }
    return axes;
}

/// The area of triangles that face along an axis. Those along the third count less: layers follow what lies there.
double area_along(std::span<const Facing> all, const Axes& axes) {
    constexpr double enough = 0.99995;  // half a degree
    double sum = 0;
    for (const Facing& f : all) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::abs(dot(f.normal, axes[k])) > enough) sum += (k == 2 ? 0.5 : 1) * f.area;
        }
    }
    return sum;
}

}  // namespace

std::array<Vec3, 3> main_axes(const BrepData& brep) {
    const std::vector<Facing> all = facings_of(brep);
    NormalMoments moments;
    for (const Facing& f : all) moments.add(f);
    Axes best{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (!(moments.area > 0)) return best;
    best = climbed(moments, best);
    double most = moments.fit(best);
    for (int turn = 0; turn < 6; ++turn) {
        for (int tilt = 0; tilt < 3; ++tilt) {
            const Axes axes = climbed(moments, turned(turn * std::numbers::pi / 12 + 0.01, tilt * std::numbers::pi / 6));
            const double fit = moments.fit(axes);
            if (fit <= most * (1 + 1e-9)) continue;
            most = fit;
            best = axes;
        }
    }
    best = named(best);
    // Layers that dip pull the axes with them: the walls around them may do better.
    const Axes by_walls = along_walls(all, upright(all, best));
    return area_along(all, by_walls) > area_along(all, best) ? named(by_walls) : best;
}

}  // namespace geomend::hexes
