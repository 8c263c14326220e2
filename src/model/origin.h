// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "model/objects.h"
#include "model/triangle_soup.h"

namespace geomend {

/// Shares of the three corners of a triangle in a point of it: each from 0 to 1, sum 1 up to rounding.
using Weights = std::array<double, 3>;

/// Where the vertices and triangles of a soup (the result) come from in another one (the source).
struct Origin {
    /// Either `vertex` is a vertex of the source, and the vertex is that one; or `triangle` is a triangle of the source and
    /// the vertex was made in it, at `weights` of its corners; or neither: it was made from nothing.
    /// A source vertex may have been moved, and several may have become one (then the lowest is named).
    struct Vertex {
        std::uint32_t vertex = no_index;
        std::uint32_t triangle = no_index;
        Weights weights{};  ///< all 0 unless there is a triangle
        bool operator==(const Vertex&) const = default;
    };
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> triangles;  ///< per triangle the one it is a piece of; no_index: made from nothing

    static Vertex from_vertex(std::uint32_t v) { return {v, no_index, {}}; }
    static Vertex from_triangle(std::uint32_t t, const Weights& w) { return {no_index, t, w}; }
};

/// The origin of a soup that is its own source. Linear.
Origin identity_origin(const TriangleSoup& soup);

/// Whether an origin fits its source and result: sizes, ranges, no vertex with two origins, weights as they should be.
/// Fails with FailureKind::internal and the first thing that is wrong. Linear.
Result<void> check(const Origin& origin, const TriangleSoup& source, const TriangleSoup& result);

/// The origin in `source` of the result of two steps one after the other: `first` leads from source to middle, `second` from
/// middle to the result. A vertex that is a middle vertex has that one's origin, to the bit.
/// \pre both pass check()
Origin composed(const Origin& first, const Origin& second, const TriangleSoup& source, const TriangleSoup& middle);

/// The shares of the corners of a triangle in a point, which is projected onto its plane, and onto its border where it lies
/// outside. Exactly 0 and 1 where the point is at a corner; a degenerate triangle gives its nearest corner.
Weights weights_in(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point);

/// The shares of the corners of its source triangle in a corner (0..2) of a triangle of the result. A vertex on a contact
/// has one origin but lies in triangles of several surfaces; this tells its place in the surface that is asked for.
/// \pre the triangle has an origin
Weights corner_weights(const Origin& origin, const TriangleSoup& source, const TriangleSoup& result, std::uint32_t triangle,
                       unsigned corner);

}  // namespace geomend
