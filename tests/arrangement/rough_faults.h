// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

#include "arrangement/sheets.h"
#include "base/vec3.h"
#include "model/triangle_soup.h"

// Rough faults through a rough topography: what is cut by hand for days when it is imported.

namespace geomend::test {

/// A number between -1 and 1 that two whole numbers and a seed always give.
inline double lattice_noise(std::int64_t i, std::int64_t j, std::uint64_t seed) {
    std::uint64_t x = static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15u ^ static_cast<std::uint64_t>(j) * 0xc2b2ae3d27d4eb4fu ^ seed;
    x = (x ^ x >> 31) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return static_cast<double>(x >> 11) * 0x1p-52 - 1;
}

/// Roughness that halves from octave to octave: about -1 to 1 over the unit square.
inline double roughness(double u, double v, std::uint64_t seed) {
    double sum = 0, size = 0.5;
    for (double n = 4; n < 600; n *= 2, size /= 2) {
        const double x = u * n, y = v * n, i = std::floor(x), j = std::floor(y), s = x - i, t = y - j;
        const auto at = [&](int a, int b) {
            return lattice_noise(static_cast<std::int64_t>(i) + a, static_cast<std::int64_t>(j) + b, seed);
        };
        sum += size * ((1 - s) * (1 - t) * at(0, 0) + s * (1 - t) * at(1, 0) + (1 - s) * t * at(0, 1) + s * t * at(1, 1));
    }
    return sum;
}

/// A topography of 2 n n triangles over 30 km with a relief of some 800 m, and five rough faults of 2 m m triangles each, two of
/// them across the others, that stick out of it.
inline TriangleSoup rough_faults_through_topography(std::uint32_t n, std::uint32_t m) {
    TriangleSoup soup;
    add_sheet(soup, n, n, [](double u, double v) { return Vec3{30000 * u, 30000 * v, 400 * roughness(u, v, 1)}; });
    for (std::uint64_t f = 0; f < 5; ++f) {
        add_sheet(soup, m, m, [&](double u, double v) {
            const double along = 1500 + 27000 * u, up = -9000 + 10500 * v;
            const double across = 4000 + 5500 * static_cast<double>(f % 3) + 0.4 * up + 300 * roughness(u, v, 7 + f);
            return f < 3 ? Vec3{across, along, up} : Vec3{along, across + 5000, up};
        });
    }
    return soup;
}

/// Twice the area, along the normal.
inline Vec3 area_vector_of(const TriangleSoup& soup, std::size_t triangle) {
    const auto& t = soup.triangles[triangle];
    const Vec3 &p = soup.vertices[t[0]], &q = soup.vertices[t[1]], &r = soup.vertices[t[2]];
    const Vec3 a{q[0] - p[0], q[1] - p[1], q[2] - p[2]}, b{r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace geomend::test
