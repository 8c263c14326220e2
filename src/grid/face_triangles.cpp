// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/face_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/cell_volume.h"

namespace geomend::grid {

namespace {

// Three points on a line, but for the rounding of their coordinates.
bool straight(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = minus(b, a), v = minus(c, a), w = minus(c, b);
    const double longest = std::sqrt(std::max({dot(u, u), dot(v, v), dot(w, w)}));
    double largest = 0;
    for (const Vec3* p : {&a, &b, &c}) {
        for (const double x : *p) largest = std::max(largest, std::abs(x));
    }
    const Vec3 n = cross(u, v);
    return std::sqrt(dot(n, n)) <= 8 * std::numeric_limits<double>::epsilon() * largest * longest;
}

// A polygon turned so that its corner of lowest number is the first.
struct Fan {
    std::span<const std::uint32_t> polygon;
    std::span<const Vec3> points;
    std::size_t apex;
    std::vector<std::array<std::uint32_t, 3>>& triangles;

    std::size_t size() const { return polygon.size(); }
    std::uint32_t node(std::size_t n) const { return polygon[(apex + n) % polygon.size()]; }
    const Vec3& at(std::size_t n) const { return points[node(n)]; }
    bool in_line_with_apex(std::size_t n, std::size_t m) const { return straight(at(0), at(n), at(m)); }

    void add(std::size_t a, std::size_t b, std::size_t c) {
        if (at(a) == at(b) || at(b) == at(c) || at(c) == at(a)) return;
        triangles.push_back({node(a), node(b), node(c)});
    }
};

}  // namespace

void face_triangles(std::span<const std::uint32_t> polygon, std::span<const Vec3> points,
                    std::vector<std::array<std::uint32_t, 3>>& triangles) {
    triangles.clear();
    Fan fan{polygon, points, static_cast<std::size_t>(std::ranges::min_element(polygon) - polygon.begin()), triangles};
    const std::size_t n = fan.size();
    if (n < 3) return;
    // Corners 1 .. first lie on one edge at the apex, corners last .. n-1 on the other.
    std::size_t first = 1, last = n - 1;
    while (first + 1 < n && fan.in_line_with_apex(first, first + 1)) ++first;
    if (first + 1 == n) {  // no area at all
        for (std::size_t k = 1; k + 1 < n; ++k) fan.add(0, k, k + 1);
        return;
    }
    while (last - 1 > first && fan.in_line_with_apex(last, last - 1)) --last;
    if (first + 1 == last) {  // one triangle with points on two of its edges
        for (std::size_t k = 1; k < first; ++k) fan.add(k, k + 1, last);
        for (std::size_t k = last; k + 1 < n; ++k) fan.add(1, k, k + 1);
        fan.add(1, n - 1, 0);
        return;
    }
    for (std::size_t k = 0; k < first; ++k) fan.add(k, k + 1, first + 1);
    for (std::size_t k = first + 1; k + 1 < last; ++k) fan.add(0, k, k + 1);
    for (std::size_t k = last; k + 1 < n; ++k) fan.add(last - 1, k, k + 1);
    fan.add(last - 1, n - 1, 0);
}

}  // namespace geomend::grid
