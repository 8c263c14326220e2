// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "model/dataset.h"
#include "topology/frontiers.h"
#include "topology/line_graph.h"

namespace geomend::topology {

/// Builds the boundary representations of everything in a Dataset that states one: each StatedModel over
/// surfaces, and each CellMesh with entities. Bit-equal positions are one model vertex (zero distance, no
/// tolerance). Fills dataset.breps and adds findings where the file's claims disagree with its geometry.
/// Loose surfaces without a StatedModel make none. Cost: near-linear in triangles and cells.
void build_breps(Dataset& dataset);

/// A model put together to be judged: the boundary representation and what it was made from.
struct JudgedModel {
    Brep brep;
    std::vector<FaceEdges> faces;  ///< per surface
    LineGraph graph;
    FoundRegions found;                  ///< by walking along the surfaces, whatever the file states
    bool stated = false;                 ///< the file states a model; false: put together from loose surfaces
    bool regions_stated = false;         ///< brep.regions are the file's own; false: they are those of `found`
    double tolerance = 0;                ///< at which points were welded
    std::uint64_t points_welded = 0;     ///< vertices that gave way to another one that is near, but not equal
    std::vector<Vec3> welded_positions;  ///< where some of them were; at most 100
    /// Per surface and polygon its number in the object that it comes from; empty: one after the other from first_polygon.
    std::vector<std::vector<std::uint32_t>> source_polygons;
    /// Per loose surface the polygons that were turned over, being wound against their neighbours; empty: none anywhere.
    std::vector<std::vector<std::uint32_t>> turned_polygons;
    std::vector<std::uint64_t> first_polygon;  ///< per surface
    std::vector<Finding> findings;             ///< where the file's claims disagree with its geometry
};

/// Builds what checks judge: each model that the file states, and one model of all surfaces that belong to none. Points
/// closer than the tolerance are one vertex: they take the position of the one that comes first. Loose surfaces are taken
/// apart where lines cut them and where they do not hang together, and wound one way.
/// \param tolerance in the unit of the coordinates; 0: only equal positions
/// Failure (internal) where indices are out of range. Cost: near-linear in triangles and cells.
Result<std::vector<JudgedModel>> models_to_judge(const Dataset& dataset, double tolerance);

}  // namespace geomend::topology
