// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "base/vec3.h"
#include "geometry/triangle_pair.h"

namespace geomend::arrangement {

/// Two vertex numbers, the smaller one first: an edge or a segment, whatever triangles it is in.
struct Link {
    std::uint32_t a = 0, b = 0;
    Link() = default;
    Link(std::uint32_t u, std::uint32_t v) : a(u < v ? u : v), b(u < v ? v : u) {}
    auto operator<=>(const Link&) const = default;
    bool has(std::uint32_t v) const { return a == v || b == v; }
};

/// A triangle with its corners at hand and its unit normal; null where it has no area.
struct FlatTriangle {
    std::array<Vec3, 3> corner;
    Vec3 normal;
    Triangle vertex;

    FlatTriangle(std::span<const Vec3> points, const Triangle& t);
    Link edge(std::size_t i) const { return {vertex[i], vertex[(i + 1) % 3]}; }
};

/// A vertex within reach of an edge that it does not end.
struct VertexOnEdge {
    Link edge;
    std::uint32_t vertex;
    auto operator<=>(const VertexOnEdge&) const = default;
};
/// A vertex within reach of a triangle's inside, away from its edges.
struct VertexOnFace {
    std::uint32_t triangle, vertex;
    auto operator<=>(const VertexOnFace&) const = default;
};
/// A point to be made: where two edges pass within reach of each other, or an edge pierces a triangle.
struct NewPoint {
    Link edge;
    Link other;  ///< the second edge, or the triangle's number twice where `pierces`
    bool pierces = false;
    Vec3 position{};  ///< on the grid; the same to the bit whichever pair of triangles finds it
    auto key() const { return std::tuple(pierces, edge, other); }
};

/// What pairs of triangles have in common within a distance, apart from what they share already. Points of a pair are vertex
/// numbers, or from first_new on numbers of new points in the list beside.
struct NearFeatures {
    static constexpr std::uint32_t first_new = 0x80000000u;
    struct Pair {
        std::uint32_t first, second;  ///< triangles
        std::uint32_t begin, end;     ///< of its common points, shared vertices too, in `common`
    };
    std::vector<VertexOnEdge> on_edges;
    std::vector<VertexOnFace> on_faces;
    std::vector<NewPoint> points;
    std::vector<Pair> pairs;  ///< that have at least two points in common and something new among them
    std::vector<std::uint32_t> common;
    std::vector<std::array<std::uint32_t, 2>> same;  ///< triangles over the same three vertices, the lower number first
};

/// True only where nothing of two triangles is within the distance of each other but what they share. Cheap.
bool keep_clear(const FlatTriangle& a, const FlatTriangle& b, double distance);

/// Adds what two triangles have in common, decided for each two features by themselves: so that all triangles around an
/// edge hear the same of it. In this order: a vertex near an edge, two edges near each other where neither ends, a vertex near
/// a face away from its edges, an edge through a face.
/// \param number_a, number_b of the triangles. \pre different triangles, coordinates on the grid, both with area
void add_near_features(const FlatTriangle& a, std::uint32_t number_a, const FlatTriangle& b, std::uint32_t number_b, double distance,
                       NearFeatures& to);

/// Adds the corner of a triangle that lies within the distance of the edge opposite, where there is one.
void add_flat_corner(const FlatTriangle& t, double distance, NearFeatures& to);

}  // namespace geomend::arrangement
