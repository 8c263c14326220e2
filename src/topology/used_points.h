// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vectors.h"
#include "model/dataset.h"

namespace geomend::topology {

/// The points that elements of surfaces and cell meshes use, equal positions as one vertex, with triangles that say what hangs
/// together and how much of it there is.
struct UsedPoints {
    std::vector<Vec3> positions;                          ///< of vertices
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< object by object
    std::vector<std::uint32_t> first_triangle;            ///< per object, and the end
    std::vector<std::uint32_t> object;                    ///< per triangle
    /// Per object the first triangle that only says what hangs together: cells of a mesh that has triangles, too.
    std::vector<std::uint32_t> first_unweighted;
    /// Per object with cells of three dimensions only and triangle its share of the volume of its cell; else empty: the area counts.
    std::vector<std::vector<double>> volumes;
    std::vector<double> weights;  ///< per triangle its area, or its share of a volume; 0 where it only says what hangs together

    std::array<Vec3, 3> corners(std::uint32_t t) const {
        return {positions[triangles[t][0]], positions[triangles[t][1]], positions[triangles[t][2]]};
    }
    bool is_weighted(std::uint32_t t) const { return t < first_unweighted[object[t]]; }
};

/// Cost: linear.
UsedPoints used_points(const Dataset& dataset);

/// What hangs together by triangles: parts, numbered from 0.
struct HangingParts {
    std::vector<std::uint32_t> of_vertex;         ///< per vertex its part
    std::vector<std::uint32_t> triangles, first;  ///< those of part p: triangles[first[p]] to before triangles[first[p + 1]], ascending

    std::size_t size() const { return first.size() - 1; }
    std::span<const std::uint32_t> operator[](std::size_t p) const {
        return std::span(triangles).subspan(first[p], first[p + 1] - first[p]);
    }
};

/// Cost: linear.
HangingParts hanging_parts(const UsedPoints& used);

}  // namespace geomend::topology
