// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/origin.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/vectors.h"

namespace geomend {

namespace {

Failure bad_origin(const char* what, std::size_t at) {
    return failure(FailureKind::internal, "", {}, std::string("origin: ") + what + " " + std::to_string(at));
}

bool are_shares(const Weights& w) {
    const auto in_range = [](double x) { return x >= 0 && x <= 1; };
    return std::all_of(w.begin(), w.end(), in_range) && std::abs(w[0] + w[1] + w[2] - 1) <= 1e-9;
}

/// The share of q in the point of the segment p, q nearest to a point.
double share_on_segment(const Vec3& p, const Vec3& q, const Vec3& point) {
    const Vec3 along = minus(q, p);
    const double length = dot(along, along);
    return length > 0 ? std::clamp(dot(minus(point, p), along) / length, 0.0, 1.0) : 0.0;
}

/// The shares at the nearest point of the border.
Weights weights_on_border(const std::array<const Vec3*, 3>& corners, const Vec3& point) {
    Weights best{1, 0, 0};
    double least = INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const double t = share_on_segment(*corners[i], *corners[j], point);
        Weights w{};
        w[i] = 1 - t;
        w[j] = t;
        Vec3 away{};
        for (std::size_t k = 0; k < 3; ++k) away[k] = (1 - t) * (*corners[i])[k] + t * (*corners[j])[k] - point[k];
        if (dot(away, away) < least) {
            least = dot(away, away);
            best = w;
        }
    }
    return best;
}

/// The shares of the corners of a source triangle in a vertex that has an origin and a position.
Weights weights_of(const Origin::Vertex& vertex, const Vec3& position, const TriangleSoup& source, std::uint32_t triangle) {
    const Triangle& t = source.triangles[triangle];
    for (std::size_t i = 0; i < 3; ++i) {
        if (vertex.vertex != t[i]) continue;
        Weights w{};
        w[i] = 1;
        return w;
    }
    if (vertex.triangle == triangle) return vertex.weights;
    return weights_in(source.vertices[t[0]], source.vertices[t[1]], source.vertices[t[2]], position);
}

}  // namespace

Origin identity_origin(const TriangleSoup& soup) {
    Origin o;
    o.vertices.resize(soup.vertices.size());
    for (std::uint32_t i = 0; i < o.vertices.size(); ++i) o.vertices[i].vertex = i;
    o.triangles.resize(soup.triangles.size());
    std::iota(o.triangles.begin(), o.triangles.end(), 0u);
    return o;
}

Result<void> check(const Origin& origin, const TriangleSoup& source, const TriangleSoup& result) {
    if (origin.vertices.size() != result.vertices.size()) return bad_origin("vertices do not match the result:", origin.vertices.size());
    if (origin.triangles.size() != result.triangles.size()) {
        return bad_origin("triangles do not match the result:", origin.triangles.size());
    }
    for (std::size_t i = 0; i < origin.vertices.size(); ++i) {
        const Origin::Vertex& v = origin.vertices[i];
        if (v.vertex != no_index && v.triangle != no_index) return bad_origin("two origins: vertex", i);
        if (v.vertex != no_index && v.vertex >= source.vertices.size()) return bad_origin("source vertex out of range: vertex", i);
        if (v.triangle != no_index && v.triangle >= source.triangles.size()) return bad_origin("source triangle out of range: vertex", i);
        const bool right = v.triangle != no_index ? are_shares(v.weights) : v.weights == Weights{};
        if (!right) return bad_origin("weights are no shares: vertex", i);
    }
    for (std::size_t i = 0; i < origin.triangles.size(); ++i) {
        if (origin.triangles[i] != no_index && origin.triangles[i] >= source.triangles.size()) {
            return bad_origin("source triangle out of range: triangle", i);
        }
    }
    return {};
}

Weights weights_in(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point) {
    if (point == a) return {1, 0, 0};
    if (point == b) return {0, 1, 0};
    if (point == c) return {0, 0, 1};
    const Vec3 u = minus(b, a), v = minus(c, a), d = minus(point, a);
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), du = dot(d, u), dv = dot(d, v);
    const double area = uu * vv - uv * uv;
    const std::array<const Vec3*, 3> corners{&a, &b, &c};
    if (!(area > 1e-14 * uu * vv)) return weights_on_border(corners, point);
    const double of_b = (vv * du - uv * dv) / area, of_c = (uu * dv - uv * du) / area;
    const double of_a = 1 - of_b - of_c;
    if (of_a < 0 || of_b < 0 || of_c < 0) return weights_on_border(corners, point);
    return {of_a, of_b, of_c};
}

Weights corner_weights(const Origin& origin, const TriangleSoup& source, const TriangleSoup& result, std::uint32_t triangle,
                       unsigned corner) {
    const std::uint32_t v = result.triangles[triangle][corner];
    return weights_of(origin.vertices[v], result.vertices[v], source, origin.triangles[triangle]);
}

Origin composed(const Origin& first, const Origin& second, const TriangleSoup& source, const TriangleSoup& middle) {
    Origin both;
    both.triangles.reserve(second.triangles.size());
    for (const std::uint32_t t : second.triangles) both.triangles.push_back(t == no_index ? no_index : first.triangles[t]);

    both.vertices.reserve(second.vertices.size());
    for (const Origin::Vertex& v : second.vertices) {
        Origin::Vertex from;
        if (v.vertex != no_index) from = first.vertices[v.vertex];
        else if (v.triangle != no_index && first.triangles[v.triangle] != no_index) {
            from.triangle = first.triangles[v.triangle];
            for (unsigned i = 0; i < 3; ++i) {
                const Weights corner = corner_weights(first, source, middle, v.triangle, i);
                for (std::size_t k = 0; k < 3; ++k) from.weights[k] += v.weights[i] * corner[k];
            }
            for (double& w : from.weights) w = std::min(w, 1.0);  // a sum of shares may round up
        }
        both.vertices.push_back(from);
    }
    return both;
}

}  // namespace geomend
