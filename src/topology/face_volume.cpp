// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/face_volume.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace geomend::topology {

void PreciseSum::add(double x) {
    const double t = sum_ + x;
    rest_ += std::abs(sum_) >= std::abs(x) ? (sum_ - t) + x : (x - t) + sum_;
    sum_ = t;
}

namespace {

Vec3 box_middle(const std::vector<Vec3>& points) {
    if (points.empty()) return {};
    Vec3 low = points[0], high = points[0];
    for (const Vec3& p : points) {
        for (std::size_t a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], p[a]);
            high[a] = std::max(high[a], p[a]);
        }
    }
    return {0.5 * low[0] + 0.5 * high[0], 0.5 * low[1] + 0.5 * high[1], 0.5 * low[2] + 0.5 * high[2]};
}

Vec3 relative(const Vec3& p, const Vec3& origin) { return {p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]}; }

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

double cone_volume(const BrepData& brep, const BrepData::Surface& surface, const FaceEdges& face, const Vec3& middle) {
    PreciseSum sum;
    auto duplicate = face.duplicate.begin();
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        if (duplicate != face.duplicate.end() && *duplicate == p) {
            ++duplicate;
            continue;
        }
        const auto polygon = surface.polygons[p];
        const std::size_t n = polygon.size();
        const auto vertex = [&](std::size_t i) { return surface.nodes[polygon[i % n]].value; };
        std::size_t lowest = 0;
        for (std::size_t i = 1; i < n; ++i) {
            if (vertex(i) < vertex(lowest)) lowest = i;
        }
        const auto point = [&](std::size_t i) { return relative(brep.vertices[vertex(lowest + i)], middle); };
        for (std::size_t i = 1; i + 1 < n; ++i) sum.add(determinant(point(0), point(i), point(i + 1)));
    }
    return sum.value() / 6;
}

}  // namespace

std::vector<double> cone_volumes(const BrepData& brep, std::span<const FaceEdges> faces) {
    const Vec3 middle = box_middle(brep.vertices);
    std::vector<double> volumes(brep.surfaces.size());
    parallel_for_each_index(volumes.size(), [&](std::size_t s) { volumes[s] = cone_volume(brep, brep.surfaces[s], faces[s], middle); });
    return volumes;
}

}  // namespace geomend::topology
