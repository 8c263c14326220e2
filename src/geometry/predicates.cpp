// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/vectors.h"

namespace geomend {

namespace {

/// A sum of doubles without rounding, as non-overlapping components that grow in size (Shewchuk's expansions).
class Expansion {
public:
    void add(double x) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const double sum = x + part_[i];
            const double b = sum - x;
            const double rest = (x - (sum - b)) + (part_[i] - b);
            x = sum;
            if (rest != 0) part_[kept++] = rest;
        }
        if (x != 0) part_[kept++] = x;
        size_ = kept;
    }
    int sign() const {
        if (size_ == 0) return 0;
        return part_[size_ - 1] > 0 ? 1 : -1;
    }
    double rounded() const {
        double sum = 0;
        for (std::size_t i = 0; i < size_; ++i) sum += part_[i];
        return sum;
    }

private:
    std::array<double, 200> part_;  // six products of three pairs: 6 * 8 * 4 components at most
    std::size_t size_ = 0;
};

struct Pair {
    double high, low;
};

Pair exact_difference(double a, double b) {
    const double d = a - b;
    const double bb = a - d;
    const double aa = d + bb;
    return {d, (a - aa) + (bb - b)};
}

Pair exact_product(double a, double b) {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
}

void add_product(Expansion& sum, double x, double y) {
    if (x == 0 || y == 0) return;
    const Pair xy = exact_product(x, y);
    sum.add(xy.high);
    sum.add(xy.low);
}

void add_product(Expansion& sum, double x, double y, double z) {
    if (x == 0 || y == 0 || z == 0) return;
    const Pair xy = exact_product(x, y);
    add_product(sum, xy.high, z);
    add_product(sum, xy.low, z);
}

Expansion exact_six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    std::array<std::array<Pair, 3>, 3> m{};
    const std::array<const Vec3*, 3> rows{&b, &c, &d};
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t k = 0; k < 3; ++k) m[r][k] = exact_difference((*rows[r])[k], a[k]);
    }
    static constexpr std::array<std::array<std::size_t, 3>, 6> columns{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
    Expansion sum;
    for (std::size_t t = 0; t < columns.size(); ++t) {
        const auto& [i, j, k] = columns[t];
        const double sign = t < 3 ? 1 : -1;
        for (const double x : {m[0][i].high, m[0][i].low}) {
            for (const double y : {m[1][j].high, m[1][j].low}) {
                for (const double z : {m[2][k].high, m[2][k].low}) add_product(sum, sign * x, y, z);
            }
        }
    }
    return sum;
}

int exact_orientation_2d(const Vec3& a, const Vec3& b, const Vec3& c, std::size_t i, std::size_t j) {
    const std::array<Pair, 2> u{exact_difference(b[i], a[i]), exact_difference(b[j], a[j])};
    const std::array<Pair, 2> v{exact_difference(c[i], a[i]), exact_difference(c[j], a[j])};
    Expansion sum;
    for (const double x : {u[0].high, u[0].low}) {
        for (const double y : {v[1].high, v[1].low}) add_product(sum, x, y);
    }
    for (const double x : {u[1].high, u[1].low}) {
        for (const double y : {v[0].high, v[0].low}) add_product(sum, -x, y);
    }
    return sum.sign();
}

/// The determinant as plain arithmetic gives it, and the sum of its terms without their signs.
struct Rounded {
    double value, size;
};

Rounded rounded_six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = minus(b, a), v = minus(c, a), w = minus(d, a);
    const double x1 = v[1] * w[2], x2 = v[2] * w[1], y1 = v[2] * w[0], y2 = v[0] * w[2], z1 = v[0] * w[1], z2 = v[1] * w[0];
    return {u[0] * (x1 - x2) + u[1] * (y1 - y2) + u[2] * (z1 - z2), std::abs(u[0]) * (std::abs(x1) + std::abs(x2)) +
                                                                        std::abs(u[1]) * (std::abs(y1) + std::abs(y2)) +
                                                                        std::abs(u[2]) * (std::abs(z1) + std::abs(z2))};
}

// Each term suffers three differences, two products and three sums or differences: eight roundings of 2^-53, 9e-16 of the sum
// of sizes; that sum itself is short by no more than as much. No term is lost to underflow in the range that the header promises.
constexpr double volume_error = 1e-15;

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Rounded det = rounded_six_volumes(a, b, c, d);
    if (std::abs(det.value) > volume_error * det.size) return sign_of(det.value);
    if (det.size == 0) return 0;  // each term has a factor that is exactly 0
    return exact_six_volumes(a, b, c, d).sign();
}

double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Rounded det = rounded_six_volumes(a, b, c, d);
    if (std::abs(det.value) > 1e8 * volume_error * det.size || det.size == 0) return det.value;
    return exact_six_volumes(a, b, c, d).rounded();
}

int orientation_2d(const Vec3& a, const Vec3& b, const Vec3& c, unsigned axis) {
    const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double left = (b[i] - a[i]) * (c[j] - a[j]), right = (b[j] - a[j]) * (c[i] - a[i]);
    const double det = left - right, size = std::abs(left) + std::abs(right);
    if (std::abs(det) > 5e-16 * size) return sign_of(det);  // four roundings of 2^-53 in each term
    if (size == 0) return 0;
    return exact_orientation_2d(a, b, c, i, j);
}

unsigned main_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = cross(minus(b, a), minus(c, a));
    std::array<unsigned, 3> axes{0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](unsigned i, unsigned j) { return std::abs(n[i]) > std::abs(n[j]); });
    for (const unsigned axis : axes) {
        if (orientation_2d(a, b, c, axis) != 0) return axis;
    }
    return axes[0];
}

bool in_line(const Vec3& a, const Vec3& b, const Vec3& c) {
    return orientation_2d(a, b, c, 0) == 0 && orientation_2d(a, b, c, 1) == 0 && orientation_2d(a, b, c, 2) == 0;
}

}  // namespace geomend
