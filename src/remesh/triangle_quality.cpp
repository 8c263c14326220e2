// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/triangle_quality.h"

#include <cmath>
#include <numbers>

#include "base/vectors.h"

namespace geomend::remeshing {

void TriangleQuality::add(const std::array<Vec3, 3>& t, bool is_between_lines) {
    const Vec3 u = minus(t[1], t[0]), v = minus(t[2], t[1]), w = minus(t[0], t[2]), n = cross(u, v);
    const double twice = std::sqrt(dot(n, n));
    const auto angle = [&](const Vec3& in, const Vec3& out) { return std::atan2(twice, -dot(in, out)); };
    std::array<double, 3> angles{angle(u, v), angle(v, w), angle(w, u)};
    for (double& a : angles) {
        a *= 180 / std::numbers::pi;
        small_angles += a < 30 ? 1 : 0;
    }
    const double least = std::min({angles[0], angles[1], angles[2]});
    const double a = std::sqrt(dot(u, u)), b = std::sqrt(dot(v, v)), c = std::sqrt(dot(w, w));
    ++triangles;
    if (least >= 30) ++above_30;
    else if (is_between_lines) ++between_lines;
    least_angle = std::min(least_angle, least);
    // 2 r / R with r = twice / (a + b + c) and R = a b c / (2 twice)
    if (twice > 0) sum_shape += 6 * twice / (std::sqrt(3.0) * std::max({a, b, c}) * (a + b + c));
    if (a * b * c > 0) sum_quality += 4 * twice * twice / ((a + b + c) * a * b * c);
}

}  // namespace geomend::remeshing
