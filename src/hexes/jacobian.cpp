// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/jacobian.h"

#include <algorithm>
#include <cmath>

#include "geometry/corner_frames.h"

namespace geomend::hexes {

namespace {

/// What makes 1 of the best cell's least determinant.
double scale_of(CellType type) {
    if (type == CellType::tetrahedron) return std::sqrt(2.0);
    return type == CellType::wedge ? 2 / std::sqrt(3.0) : 1;
}

/// Coefficients of a polynomial of degree 2 along each of three axes; halved at the middle of one axis.
using Cubic = std::array<double, 27>;

std::array<Cubic, 2> halves(const Cubic& c, std::size_t axis) {
    constexpr std::array<std::size_t, 3> stride{1, 3, 9};
    std::array<Cubic, 2> half{c, c};
    const std::size_t s = stride[axis];
    for (std::size_t i = 0; i < 27; ++i) {
        if (i / s % 3 != 0) continue;
        const double low = 0.5 * (c[i] + c[i + s]), high = 0.5 * (c[i + s] + c[i + 2 * s]), middle = 0.5 * (low + high);
        half[0][i + s] = low;
        half[0][i + 2 * s] = half[1][i] = middle;
        half[1][i + s] = high;
    }
    return half;
}

/// The values at the eight ends are the polynomial's own.
bool is_positive(const Cubic& c, double zero, unsigned depth) {
    for (const std::size_t end : {0u, 2u, 6u, 8u, 18u, 20u, 24u, 26u}) {
        if (!(c[end] > zero)) return false;
    }
    if (std::ranges::all_of(c, [&](double x) { return x > zero; })) return true;
    if (depth == 0) return false;
    const auto both = halves(c, depth % 3);
    return is_positive(both[0], zero, depth - 1) && is_positive(both[1], zero, depth - 1);
}

/// Determinants below this are not told from 0.
double zero_of(std::span<const Vec3> corners) {
    double longest = 0;
    for (const Vec3& p : corners) {
        const Vec3 d = minus(p, corners[0]);
        longest = std::max(longest, dot(d, d));
    }
    return 1e-12 * longest * std::sqrt(longest);
}

bool is_hexahedron_valid(std::span<const Vec3, 8> p) { return is_positive(bezier_coefficients(p), zero_of(p), 9); }

/// A prism's determinant has degree 1 over its triangles and 2 along its edges: three coefficients above each corner.
bool is_wedge_valid(std::span<const Vec3> p) {
    const double zero = zero_of(p);
    const Vec3 u0 = minus(p[2], p[0]), v0 = minus(p[1], p[0]), u1 = minus(p[5], p[3]), v1 = minus(p[4], p[3]);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 w = minus(p[i + 3], p[i]);
        const double low = dot(cross(u0, v0), w), high = dot(cross(u1, v1), w);
        const double middle = 0.5 * (dot(cross(u0, v1), w) + dot(cross(u1, v0), w));
        // A quadratic with positive ends is positive where its coefficient is not below minus their geometric mean.
        if (!(low > zero && high > zero && middle > zero - std::sqrt(low * high))) return false;
    }
    return true;
}

/// The determinant is the same at all corners of a tetrahedron: the least scaled one is that where edges are longest.
double least_of_tetrahedron(std::span<const Vec3> p) {
    const Vec3 u = minus(p[1], p[0]), v = minus(p[2], p[0]), w = minus(p[3], p[0]);
    const Vec3 uv = minus(v, u), vw = minus(w, v), wu = minus(u, w);
    const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w), a = dot(uv, uv), b = dot(vw, vw), c = dot(wu, wu);
    const double determinant = dot(u, cross(v, w)), at_0 = uu * vv * ww, at_1 = uu * a * c, at_2 = vv * a * b, at_3 = ww * b * c;
    const double product = determinant > 0 ? std::max({at_0, at_1, at_2, at_3}) : std::min({at_0, at_1, at_2, at_3});
    return product > 0 ? determinant / std::sqrt(product) : 0;
}

}  // namespace

double scaled_jacobian(CellType type, std::span<const Vec3> corners) {
    if (type == CellType::tetrahedron) return scale_of(type) * least_of_tetrahedron(corners);
    double least = 1e30;
    for (const auto& f : corner_frames(type))
        least = std::min(least, scaled_determinant(corners[f[0]], corners[f[1]], corners[f[2]], corners[f[3]]));
    return scale_of(type) * least;
}

bool is_valid(CellType type, std::span<const Vec3> corners) {
    if (type == CellType::hexahedron) return is_hexahedron_valid(corners.first<8>());
    if (type == CellType::wedge) return is_wedge_valid(corners);
    // The determinants of a pyramid's map, and of a tetrahedron's, are least at corners.
    const double zero = zero_of(corners);
    for (const auto& f : corner_frames(type)) {
        const Vec3& o = corners[f[0]];
        if (!(dot(minus(corners[f[1]], o), cross(minus(corners[f[2]], o), minus(corners[f[3]], o))) > zero)) return false;
    }
    return true;
}

std::array<double, 27> bezier_coefficients(std::span<const Vec3, 8> p) {
    // Edges along each axis, by the two other coordinates.
    const std::array<std::array<Vec3, 2>, 2> x{{{minus(p[1], p[0]), minus(p[5], p[4])}, {minus(p[2], p[3]), minus(p[6], p[7])}}};  // y, z
    const std::array<std::array<Vec3, 2>, 2> y{{{minus(p[3], p[0]), minus(p[7], p[4])}, {minus(p[2], p[1]), minus(p[6], p[5])}}};  // x, z
    const std::array<std::array<Vec3, 2>, 2> z{{{minus(p[4], p[0]), minus(p[7], p[3])}, {minus(p[5], p[1]), minus(p[6], p[2])}}};  // x, y
    std::array<double, 27> c{};
    for (std::size_t i = 0; i < 16; ++i) {
        const std::size_t y_x = i & 1, y_z = i >> 1 & 1, z_x = i >> 2 & 1, z_y = i >> 3;
        const Vec3 yz = cross(y[y_x][y_z], z[z_x][z_y]);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t x_y = k & 1, x_z = k >> 1;
            c[y_x + z_x + 3 * (x_y + z_y) + 9 * (x_z + y_z)] += dot(x[x_y][x_z], yz);
        }
    }
    // Of two ways to each middle coefficient along an axis the mean.
    for (std::size_t i = 0; i < 27; ++i) {
        for (const std::size_t along : {i % 3, i / 3 % 3, i / 9}) {
            if (along == 1) c[i] *= 0.5;
        }
    }
    return c;
}

}  // namespace geomend::hexes
