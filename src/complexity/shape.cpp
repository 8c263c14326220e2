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
