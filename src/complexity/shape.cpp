// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "complexity/parts.h"

// Shape: how much of an element's size is left when it is projected on its mean line or plane.

namespace geomend::complexity {

namespace {

// Second moments about the mean, summed piece by piece with a weight: a piece of a line by its two ends, a triangle by
// the middles of its edges. Both are exact: Simpson's rule for the line, the midpoint rule for the triangle.
class Moments {
public:
    void add(const Vec3& p, double weight) {
        for (std::size_t a = 0; a < 3; ++a) first_[a] += weight * p[a];
        second_[0] += weight * p[0] * p[0];
        second_[1] += weight * p[0] * p[1];
        second_[2] += weight * p[0] * p[2];
        second_[3] += weight * p[1] * p[1];
        second_[4] += weight * p[1] * p[2];
        second_[5] += weight * p[2] * p[2];
        weight_ += weight;
    }
    std::array<Vec3, 3> axes() const {
        std::array<double, 6> m = second_;
        std::size_t k = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t b = a; b < 3; ++b) m[k++] -= first_[a] * first_[b] / weight_;
        }
        return principal_axes(m);
    }

private:
    Vec3 first_{};
    std::array<double, 6> second_{};
    double weight_ = 0;
};

Vec3 middle(const Vec3& a, const Vec3& b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}; }

}  // namespace

std::array<Vec3, 3> principal_axes(const std::array<double, 6>& m) {
    double a[3][3] = {{m[0], m[1], m[2]}, {m[1], m[3], m[4]}, {m[2], m[4], m[5]}};
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int sweep = 0; sweep < 30; ++sweep) {
        for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
            if (a[p][q] == 0) continue;
            const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::hypot(theta, 1.0)), c = 1 / std::hypot(t, 1.0), s = t * c;
            for (int k = 0; k < 3; ++k) {
                const double kp = a[k][p], kq = a[k][q];
                a[k][p] = c * kp - s * kq;
                a[k][q] = s * kp + c * kq;
            }
            for (int k = 0; k < 3; ++k) {
                const double pk = a[p][k], qk = a[q][k];
                a[p][k] = c * pk - s * qk;
                a[q][k] = s * pk + c * qk;
                const double vp = v[k][p], vq = v[k][q];
                v[k][p] = c * vp - s * vq;
                v[k][q] = s * vp + c * vq;
            }
        }
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return a[i][i]; });
    std::array<Vec3, 3> axes;
    for (std::size_t i = 0; i < 3; ++i) axes[i] = {v[0][order[i]], v[1][order[i]], v[2][order[i]]};
    return axes;
}

double surface_shape(const MeasuredModel& model, std::size_t surface) {
    Moments moments;
    double whole = 0;
    const auto& triangles = model.surfaces[surface].triangles;
    for (const auto& t : triangles) {
        const double area = model.area(t);
        whole += area;
        for (std::size_t i = 0; i < 3; ++i) moments.add(middle(model.points[t[i]], model.points[t[(i + 1) % 3]]), area / 3);
    }
    if (!(whole > 0)) return 0;
    const Vec3 normal = moments.axes()[0];
    double projected = 0;
    for (const auto& t : triangles) projected += std::abs(dot(model.area_vector(t), normal));
    return std::max(0.0, 1 - projected / whole);
}

double line_shape(const MeasuredModel& model, std::size_t line) {
    Moments moments;
    double whole = 0;
    const auto& vertices = model.brep.lines[line].vertices;
    const auto at = [&](std::size_t i) -> const Vec3& { return model.points[vertices[i].value]; };
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
        const double l = length(minus(at(i + 1), at(i)));
        whole += l;
        moments.add(at(i), l / 6);
        moments.add(middle(at(i), at(i + 1)), 4 * l / 6);
        moments.add(at(i + 1), l / 6);
    }
    if (!(whole > 0)) return 0;
    const Vec3 direction = moments.axes()[2];
    double projected = 0;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) projected += std::abs(dot(minus(at(i + 1), at(i)), direction));
    return std::max(0.0, 1 - projected / whole);
}

}  // namespace geomend::complexity
