// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "arrangement/cut_triangle.h"
#include "arrangement/near_features.h"
#include "arrangement/segment_contact.h"
#include "geometry/vectors.h"

namespace geomend::arrangement {

namespace {

/// A segment, or a point as one without length, by its extent along the axis in which the triangle is longest.
struct Span {
    double low, high;
    std::uint32_t index;  ///< of the segment; from `count` of segments on: of the point
};

std::size_t longest_axis(std::span<const Vec3> points, const Triangle& t) {
    std::size_t axis = 0;
    double longest = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax({points[t[0]][k], points[t[1]][k], points[t[2]][k]});
        if (high - low > longest) {
            longest = high - low;
            axis = k;
        }
    }
    return axis;
}

}  // namespace

void cross_segments(std::span<const Vec3> points, const Triangle& triangle, const LinkTable& links, std::span<const Link> segments,
                    std::span<const std::uint32_t> on_face, double distance, std::vector<NewPoint>& crossings,
                    std::vector<VertexOnEdge>& on_segments, CutScratch& scratch) {
    auto& vertices = scratch.way;
    vertices.assign(triangle.begin(), triangle.end());
    for (std::size_t i = 0; i < 3; ++i) links.append(triangle[i], triangle[(i + 1) % 3], vertices);
    vertices.insert(vertices.end(), on_face.begin(), on_face.end());
    for (const Link& s : segments) vertices.insert(vertices.end(), {s.a, s.b});
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

    const std::size_t axis = longest_axis(points, triangle);
    const auto count = static_cast<std::uint32_t>(segments.size());
    std::vector<Span> spans;
    spans.reserve(count + vertices.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto [low, high] = std::minmax(points[segments[i].a][axis], points[segments[i].b][axis]);
        spans.push_back({low - distance, high + distance, i});
    }
    for (std::uint32_t i = 0; i < vertices.size(); ++i) spans.push_back({points[vertices[i]][axis], points[vertices[i]][axis], count + i});
    std::sort(spans.begin(), spans.end(), [](const Span& p, const Span& q) { return p.low != q.low ? p.low < q.low : p.index < q.index; });

    const auto meet = [&](std::uint32_t i, std::uint32_t j) {
        if (i >= count && j >= count) return;
        if (i >= count) std::swap(i, j);
        const Link& s = segments[i];
        if (j >= count) {
            const std::uint32_t v = vertices[j - count];
            if (!s.has(v) && is_near_segment(points[v], points[s.a], points[s.b], distance)) on_segments.push_back({s, v});
            return;
        }
        const Link& t = segments[j];
        if (s.has(t.a) || s.has(t.b)) return;
        NewPoint made{std::min(s, t), std::max(s, t)};
        // Both lie within the distance of the triangle's plane, one maybe above it and one below.
        if (pass_near(points[made.edge.a], points[made.edge.b], points[made.other.a], points[made.other.b], 2 * distance, made.position))
            crossings.push_back(made);
    };
    std::vector<Span> open;
    for (const Span& next : spans) {
        std::erase_if(open, [&](const Span& o) { return o.high < next.low; });
        for (const Span& o : open) meet(o.index, next.index);
        open.push_back(next);
    }
}

}  // namespace geomend::arrangement
