// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "topology/frontiers.h"
#include "topology/line_graph.h"
#include "topology/stated_claims.h"
#include "topology/surface_complex.h"

namespace geomend::topology {

/// A boundary representation and what it was made from: what judges need.
struct JudgedModel {
    Brep brep;
    std::vector<FaceEdges> faces;  ///< per surface
    LineGraph graph;
    FoundRegions found;                  ///< by walking along the surfaces, whatever the file states
    bool stated = false;                 ///< the file states a model; false: put together from loose surfaces
    bool regions_stated = false;         ///< brep.regions are the file's own; false: they are those of `found`
    double tolerance = 0;                ///< the largest at which points were welded
    std::vector<double> tolerances;      ///< per surface the one at which its points were welded
    std::uint64_t points_welded = 0;     ///< vertices that gave way to another one that is near, but not equal
    std::vector<Vec3> welded_positions;  ///< where some of them were; at most 100
    /// Per surface and polygon its number in the object that it comes from; empty: one after the other from first_polygon.
    std::vector<std::vector<std::uint32_t>> source_polygons;
    /// Per loose surface the polygons that were turned over, being wound against their neighbours; empty: none anywhere.
    std::vector<std::vector<std::uint32_t>> turned_polygons;
    std::vector<std::uint64_t> first_polygon;  ///< per surface
    std::vector<Finding> findings;             ///< where the file's claims disagree with its geometry
    StatedClaims claims;                       ///< what else judges compare
    /// Per line 1 where both sides of each surface that it runs inside of have the same nodes in the file: nothing is cut there.
    std::vector<std::uint8_t> joined_lines;
};

/// Whether regions are looked for along the surfaces where the complex states its own: judges compare the two.
enum class RegionSearch : std::uint8_t { where_none_are_stated, always };

/// Lines, corners, sides, regions and contacts of surfaces: one surface for each face, in their order, or one for each piece
/// of it where the complex is to be taken apart. Without regions stated they are found by walking along the surfaces.
/// \pre nodes and polygons of faces are in range; so are the vertices of stated lines and corners, and faces of regions
/// Failure (internal) where the result is inconsistent. Cost: near-linear in polygons and cells.
Result<JudgedModel> assemble(SurfaceComplex complex, RegionSearch search);

}  // namespace geomend::topology
