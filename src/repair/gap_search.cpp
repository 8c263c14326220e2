// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/gap_search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/vectors.h"
#include "geometry/closest_points.h"
#include "model/objects.h"
#include "repair/soup_measures.h"

namespace geomend::repair {

namespace {

constexpr double sine_of_grazing = 0.1736;  // 10 degrees

BoxTree::Corners box_around(const Vec3& a, const Vec3& b, double margin) {
    BoxTree::Corners box;
    for (std::size_t k = 0; k < 3; ++k) {
        box[0][k] = std::min(a[k], b[k]) - margin;
        box[1][k] = std::max(a[k], b[k]) + margin;
    }
    return box;
}

}  // namespace

GapSearch::GapSearch(const TriangleSoup& soup, std::vector<double> limits)
    : soup_(soup), limits_(std::move(limits)), tree_(triangle_boxes(soup)) {}

GapHit GapSearch::ahead(const Vec3& from, const Vec3& direction, std::uint32_t own_patch, std::uint32_t only) const {
    GapHit best;
    const double limit = limits_[own_patch], farthest = 2 * limit;
    const Vec3 to = plus(from, times(farthest, direction));
    tree_.visit(box_around(from, to, limit), -1e-9 * limit, [&](std::uint32_t i) {
        if (soup_.patches[i] == own_patch || (only != no_index && soup_.patches[i] != only)) return;
        const Triangle& t = soup_.triangles[i];
        const std::array<Vec3, 3> corners{soup_.vertices[t[0]], soup_.vertices[t[1]], soup_.vertices[t[2]]};
        Vec3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        const double size = std::sqrt(dot(normal, normal));
        if (!(size > 0)) return;
        normal = times(1 / size, normal);
        const double slope = dot(direction, normal);
        if (std::abs(slope) < sine_of_grazing) return;
        const double along = dot(minus(corners[0], from), normal) / slope;
        if (along < 0 || along > farthest || along * std::abs(slope) > limit) return;
        const double off = closest_points(plus(from, times(along, direction)), corners).distance;
        if (off > limit) return;
        const bool within = off <= 1e-6 * limit;
        const bool better = !best.found() || (within && !best.within) || (within == best.within && along < best.along);
        if (better) best = {soup_.patches[i], along, within};
    });
    return best;
}

NearestHit GapSearch::nearest(const std::array<Vec3, 2>& edge, const Vec3& direction, std::uint32_t own_patch) const {
    NearestHit best;
    const double limit = limits_[own_patch];
    best.distance = limit;
    tree_.visit(box_around(edge[0], edge[1], limit), -1e-9 * limit, [&](std::uint32_t i) {
        if (soup_.patches[i] == own_patch) return;
        const Triangle& t = soup_.triangles[i];
        const std::array<Vec3, 3> corners{soup_.vertices[t[0]], soup_.vertices[t[1]], soup_.vertices[t[2]]};
        const Closest there = closest_points(edge, corners);
        if (there.distance > best.distance || (best.found() && there.distance == best.distance)) return;
        const Vec3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        const double size = std::sqrt(dot(normal, normal));
        best.patch = soup_.patches[i];
        best.distance = there.distance;
        best.ahead = there.distance > 0 ? dot(there.apart, direction) / there.distance : 0;
        best.grazing = std::abs(dot(direction, normal)) < sine_of_grazing * size;
        best.normal = size > 0 ? times(1 / size, normal) : Vec3{};
    });
    return best;
}

}  // namespace geomend::repair
