// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/triple_points.h"

#include <algorithm>
#include <array>

#include "base/disjoint_sets.h"
#include "geometry/vectors.h"
#include "model/objects.h"

namespace geomend::arrangement {

namespace {

/// The others that meet one triangle in a segment.
std::span<const SegmentInFace> at_segment(std::span<const SegmentInFace> segments, std::uint32_t triangle, const Link& segment) {
    const auto first = std::lower_bound(segments.begin(), segments.end(), SegmentInFace{triangle, segment, 0});
    const auto last = std::upper_bound(first, segments.end(), SegmentInFace{triangle, segment, 0xffffffffu});
    return {first, last};
}

struct OfThree {
    std::array<std::uint32_t, 3> triangles;  ///< ascending
    std::uint32_t crossing;
    auto operator<=>(const OfThree&) const = default;
};

std::vector<OfThree> triples_of(std::span<const SegmentInFace> segments, std::span<const std::uint32_t> triangles,
                                std::span<const NewPoint> crossings) {
    std::vector<OfThree> triples;
    for (std::uint32_t i = 0; i < crossings.size(); ++i) {
        const std::uint32_t own = triangles[i];
        for (const SegmentInFace& one : at_segment(segments, own, crossings[i].edge)) {
            for (const SegmentInFace& two : at_segment(segments, own, crossings[i].other)) {
                if (one.other == two.other || one.other == no_index || two.other == no_index) continue;
                OfThree triple{{own, one.other, two.other}, i};
                std::sort(triple.triangles.begin(), triple.triangles.end());
                triples.push_back(triple);
            }
        }
    }
    std::sort(triples.begin(), triples.end());
    return triples;
}

/// The square of the sine between two segments.
double steepness(std::span<const Vec3> points, const NewPoint& p) {
    const Vec3 u = minus(points[p.edge.b], points[p.edge.a]), v = minus(points[p.other.b], points[p.other.a]), n = cross(u, v);
    return dot(n, n) / (dot(u, u) * dot(v, v));
}

}  // namespace

void join_triple_points(std::span<const Vec3> points, std::span<const SegmentInFace> segments, std::span<const std::uint32_t> triangles,
                        std::span<NewPoint> crossings) {
    const auto triples = triples_of(segments, triangles, crossings);
    DisjointSets same(crossings.size());
    bool any = false;
    for (std::size_t i = 1; i < triples.size(); ++i) {
        if (triples[i].triangles != triples[i - 1].triangles) continue;
        same.join(triples[i].crossing, triples[i - 1].crossing);
        any = true;
    }
    if (!any) return;
    const auto root = std::move(same).roots();
    std::vector<std::uint32_t> best(crossings.size());
    std::vector<double> steepest(crossings.size(), -1);
    for (std::uint32_t i = 0; i < crossings.size(); ++i) {
        const double own = steepness(points, crossings[i]), most = steepest[root[i]];
        if (own < most || (own == most && crossings[best[root[i]]].key() <= crossings[i].key())) continue;
        steepest[root[i]] = own;
        best[root[i]] = i;
    }
    std::vector<Vec3> place(crossings.size());
    for (std::uint32_t i = 0; i < crossings.size(); ++i) place[i] = crossings[best[root[i]]].position;
    for (std::uint32_t i = 0; i < crossings.size(); ++i) crossings[i].position = place[i];
}

}  // namespace geomend::arrangement
