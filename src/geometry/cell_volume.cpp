// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cell_volume.h"

#include <algorithm>
#include <cmath>

#include "geometry/predicates.h"

namespace geomend {

double tetrahedron_volume(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
    const Vec3 u = minus(p1, p0), v = minus(p2, p0), w = minus(p3, p0);
    const double six = dot(u, cross(v, w));
    // Where rounding decides the sign, as in cells that are flat but for it, the exact one is asked for.
    constexpr double unsure = 1e-13;
    const double size = (std::abs(u[0]) + std::abs(u[1]) + std::abs(u[2])) * (std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2])) *
                        (std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]));
    return (std::abs(six) > unsure * size || !std::isfinite(size) ? six : six_volumes(p0, p1, p2, p3)) / 6;
}

double hexahedron_volume(const std::array<Vec3, 8>& corners) {
    std::array<Vec3, 8> p;
    for (std::size_t i = 0; i < 8; ++i) p[i] = minus(corners[i], corners[0]);
    // Of a face at corner 0, the origin, only one triangle has flux, in one of the two splits.
    const double at_origin = flux6(p[3], p[2], p[1]) + flux6(p[1], p[5], p[4]) + flux6(p[4], p[7], p[3]);
    return (0.5 * at_origin + flux6(p[4], p[5], p[6], p[7]) + flux6(p[1], p[2], p[6], p[5]) + flux6(p[2], p[3], p[7], p[6])) / 6;
}

double pyramid_volume(const std::array<Vec3, 5>& corners) {
    // Seen from the apex the four sides have no flux.
    std::array<Vec3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = minus(corners[i], corners[4]);
    return flux6(p[0], p[3], p[2], p[1]) / 6;
}

namespace {

/// Flux through the polygon corners[first .. first+n), split at its corner of lowest id.
double fan_flux6(std::span<const Vec3> p, std::span<const std::uint32_t> ids, std::size_t first, std::size_t n) {
    const auto begin = ids.begin() + static_cast<std::ptrdiff_t>(first);
    const auto lowest = static_cast<std::size_t>(std::min_element(begin, begin + static_cast<std::ptrdiff_t>(n)) - begin);
    double sum = 0;
    for (std::size_t k = 1; k + 1 < n; ++k) {
        sum += flux6(p[first + lowest], p[first + (lowest + k) % n], p[first + (lowest + k + 1) % n]);
    }
    return sum;
}

}  // namespace

double prism_volume(std::span<const Vec3> corners, std::span<const std::uint32_t> ids) {
    const std::size_t n = corners.size() / 2;
    std::array<Vec3, 12> p{};
    for (std::size_t i = 0; i < 2 * n; ++i) p[i] = minus(corners[i], corners[0]);
    double sum = fan_flux6(p, ids, n, n) - fan_flux6(p, ids, 0, n);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = (i + 1) % n;
        sum += flux6(p[i], p[next], p[n + next], p[n + i]);
    }
    return sum / 6;
}

}  // namespace geomend
