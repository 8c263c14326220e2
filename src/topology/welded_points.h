// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "model/dataset.h"
#include "topology/surface_complex.h"
#include "topology/weld.h"

namespace geomend::topology {

/// Objects that lie near one another, whose points are welded at one tolerance.
struct WeldGroup {
    std::vector<std::uint32_t> objects;  ///< surfaces and cell meshes of a Dataset, ascending
    double tolerance = 0;                ///< in the unit of the coordinates; 0: only equal positions
    Vec3 shares{1, 1, 1};                ///< along each axis the part of the tolerance that holds there, above 0
};

/// The points of some objects as vertices.
struct WeldedPoints {
    Welder welder{0};
    std::vector<std::uint32_t> near;                         ///< per position of the welder its vertex; empty: itself
    std::map<std::uint32_t, std::vector<std::uint32_t>> of;  ///< per object and point the vertex
    std::map<std::uint32_t, double> tolerance;               ///< per object
    std::uint64_t points = 0;                                ///< of all objects
    std::uint64_t aliases = 0;                               ///< points that are stated to be at another one
    std::uint64_t near_welded = 0;                           ///< vertices that gave way to another one near them
    std::vector<Vec3> near_positions;                        ///< where some of them were; at most 100

    /// The vertex at a position, or no_index.
    std::uint32_t at(const Vec3& position) const;
};

/// Equal positions are one vertex, in all groups; within a group vertices nearer than its tolerance are one, too: the one that
/// comes first. Cost: linear.
WeldedPoints weld_points(const Dataset& dataset, std::span<const WeldGroup> groups);

/// Hands vertices and counts over; `points.at` serves no more.
void give_vertices(WeldedPoints& points, SurfaceComplex& complex);

/// F111, where points were welded at zero distance.
void report_welding(const WeldedPoints& points, SurfaceComplex& complex);

}  // namespace geomend::topology
