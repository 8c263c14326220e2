// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/finding.h"
#include "model/brep.h"
#include "topology/line_graph.h"

namespace geomend::topology {

/// A region as it is stated, over the faces of a SurfaceComplex.
struct StatedRegion {
    std::string name;
    bool universe = false;
    std::vector<BrepData::Side> sides;  ///< SurfaceId: number of the face; front as the face's key triangle has it, where it has one
};

/// Surfaces over welded vertices, with all that is stated of lines, corners, sides and regions: what every front end makes and
/// assemble() turns into a boundary representation. Plain data; cells of regions stay in the meshes, which must outlive it.
struct SurfaceComplex {
    std::string name;
    CoordinateSystem crs;
    std::vector<Annotation> annotations;

    bool stated = true;       ///< false: put together from loose surfaces
    bool take_apart = false;  ///< faces become one surface for each piece between lines, wound one way where that can be

    std::vector<Vec3> vertices;
    std::uint64_t points_welded = 0;     ///< vertices that gave way to another one that is near, but not equal
    std::vector<Vec3> welded_positions;  ///< where some of them were; at most 100

    struct Face {
        /// Nodes (over vertices), polygons, attributes, name, role and source; what assemble() works out is still empty.
        BrepData::Surface surface;
        std::string interface_name;
        std::int64_t number = 0;          ///< the file's own; 0: none
        std::uint64_t first_polygon = 0;  ///< number in its object of its first polygon
        /// Per polygon its number in the object, from first_polygon on; empty: one after the other.
        std::vector<std::uint32_t> source_polygons;
        /// Vertices of the stated key triangle, whose normal names the front side; no_index where nothing is at its corner.
        std::optional<std::array<std::uint32_t, 3>> key;
        bool shared_nodes = false;  ///< its nodes cannot state a cut: a line inside it gives its two sides nodes of their own
        double tolerance = 0;       ///< at which its points were welded; polygons of a line that are no farther apart coincide
    };
    std::vector<Face> faces;

    StatedLines lines;
    std::vector<std::string> line_names;  ///< per stated line
    struct CornerName {
        std::uint32_t vertex;
        std::string name;
    };
    std::vector<CornerName> corner_names;  ///< of several at one vertex the first counts

    /// What is said of whole interfaces; of several with one name the last counts.
    struct Interface {
        std::string name, feature;
        std::vector<Annotation> annotations;
    };
    std::vector<Interface> interfaces;
    /// Geological features over faces.
    struct Feature {
        std::string name;
        std::vector<std::uint32_t> faces;
    };
    std::vector<Feature> features;

    std::vector<StatedRegion> regions;
    /// Layers and fault blocks over `regions`.
    struct RegionList {
        std::string name;
        std::vector<std::uint32_t> regions;
        std::vector<std::int64_t> unresolved;
    };
    std::vector<RegionList> layers, fault_blocks;

    /// Meshes whose cells fill regions.
    struct Mesh {
        const CellMesh* mesh = nullptr;
        std::uint32_t object = no_index;       ///< its number in the Dataset
        std::vector<std::uint32_t> vertex_of;  ///< per point its vertex
    };
    std::vector<Mesh> meshes;
    /// A volume entity of a mesh: its cells, or where there are none the faces that are stated to bound it.
    struct Volume {
        std::uint32_t mesh = 0;  ///< into meshes
        std::vector<std::uint32_t> cells;
        StatedRegion boundary;
    };
    std::vector<Volume> volumes;
    /// Cells of a mesh that fill the region of a name, where it is hollow.
    struct Filling {
        std::uint32_t mesh = 0;
        std::string region;
        std::vector<std::uint32_t> cells;
    };
    std::vector<Filling> fillings;

    std::vector<Finding> findings;      ///< of the front end
    std::vector<std::string> reported;  ///< codes of what the reader has found already, and is not reported again
};

}  // namespace geomend::topology
