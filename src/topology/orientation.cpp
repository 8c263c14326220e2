// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/orientation.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace geomend::topology {

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

private:
    std::array<double, 256> part_{};
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

void add_triple(Expansion& sum, double x, double y, double z, double sign) {
    if (x == 0 || y == 0 || z == 0) return;
    const Pair xy = exact_product(x, y);
    for (const double part : {xy.high, xy.low}) {
        const Pair xyz = exact_product(part, z);
        sum.add(sign * xyz.high);
        sum.add(sign * xyz.low);
    }
}

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
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
                for (const double z : {m[2][k].high, m[2][k].low}) add_triple(sum, x, y, z, sign);
            }
        }
    }
    return sum.sign();
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]}, w{d[0] - a[0], d[1] - a[1], d[2] - a[2]};
    const double x1 = v[1] * w[2], x2 = v[2] * w[1], y1 = v[2] * w[0], y2 = v[0] * w[2], z1 = v[0] * w[1], z2 = v[1] * w[0];
    const double det = u[0] * (x1 - x2) + u[1] * (y1 - y2) + u[2] * (z1 - z2);
    const double size = std::abs(u[0]) * (std::abs(x1) + std::abs(x2)) + std::abs(u[1]) * (std::abs(y1) + std::abs(y2)) +
                        std::abs(u[2]) * (std::abs(z1) + std::abs(z2));
    constexpr double safety = 1e-15;  // above the 7 + 56e units of rounding that such a determinant may suffer
    if (det > safety * size) return 1;
    if (det < -safety * size) return -1;
    return exact_orientation(a, b, c, d);
}

}  // namespace geomend::topology
