// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/vec3.h"
#include "model/attribute.h"
#include "model/cell_network.h"
#include "model/coordinate_system.h"
#include "model/feature.h"
#include "model/objects.h"

namespace geomend {

/// The side of a surface that a face lies on. Of a fault that is neither vertical nor flat the side above is the hanging wall.
enum class FaceSide : std::uint8_t { none, front, back, hanging_wall, footwall };

/// "none", "front", "hanging wall", ...
const char* to_string(FaceSide side);

/// A face of a cell: local faces as in faces_of(), or the stated ones of a polyhedron.
struct CellFaceRef {
    std::uint32_t cell = no_index, face = no_index;
    auto operator<=>(const CellFaceRef&) const = default;
};

/// The mesh that every writer takes, as plain arrays; VolumeMesh::make() checks it.
struct VolumeMeshData {
    std::string name;
    CoordinateSystem crs;
    std::vector<Vec3> vertices;  ///< elevation-up

    /// Cells sorted by region, then by type: block after block. Corner order as in VTK.
    struct Block {
        std::uint32_t region = 0;
        CellType type = CellType::tetrahedron;
        std::uint32_t first = 0, count = 0;  ///< cells
    };
    std::vector<Block> blocks;
    std::vector<std::uint64_t> cell_offsets = {0};  ///< cell i has cell_nodes[cell_offsets[i] .. cell_offsets[i+1])
    std::vector<std::uint32_t> cell_nodes;
    /// Faces of polyhedra, as in CellMesh, wound outwards; empty when there are none.
    std::vector<std::uint64_t> cell_faces, face_offsets;
    std::vector<std::uint32_t> face_nodes;

    /// What the mesh was made from; face sets, blocks and vertices refer to it.
    std::vector<std::string> regions, surfaces, lines, corners;

    /// Faces on one side of one surface. Faces ascend.
    struct FaceSet {
        std::string name;
        FeatureRole role = FeatureRole::unknown;
        FaceSide side = FaceSide::none;
        std::uint32_t surface = no_index;  ///< index into surfaces
        std::vector<CellFaceRef> faces;
    };
    std::vector<FaceSet> face_sets;
    /// Chains of edges (wells, lines), in the order in which they run.
    struct EdgeSet {
        std::string name;
        std::vector<std::array<std::uint32_t, 2>> edges;
    };
    std::vector<EdgeSet> edge_sets;
    struct NodeSet {
        std::string name;
        std::vector<std::uint32_t> nodes;  ///< ascending
    };
    std::vector<NodeSet> node_sets;

    /// Where the mesh was split along a surface: two faces that were one, each with its side.
    struct SplitPair {
        std::array<CellFaceRef, 2> faces;
        std::array<FaceSide, 2> sides;
    };
    std::vector<SplitPair> split_pairs;
    std::vector<std::uint32_t>
        vertex_origins;  ///< the first vertex at the same place that it was doubled from, or itself; empty: none doubled

    /// The smallest entity that holds a vertex.
    enum class Place : std::uint8_t { region, surface, line, corner };
    struct VertexPlace {
        Place place = Place::region;
        std::uint32_t entity = 0;  ///< index into regions, surfaces, lines or corners
    };
    std::vector<VertexPlace> vertex_places;  ///< one per vertex, or empty where it is not known

    std::vector<Attribute> attributes;  ///< over vertices (point), cells (cell), or the whole (object)
    CellNetwork network;                ///< where a target asked for it; else empty

    std::size_t cell_count() const { return cell_offsets.size() - 1; }
    std::span<const std::uint32_t> nodes_of(std::size_t cell) const {
        return {cell_nodes.data() + cell_offsets[cell], static_cast<std::size_t>(cell_offsets[cell + 1] - cell_offsets[cell])};
    }
};

/// A mesh that keeps what VolumeMeshData promises.
class VolumeMesh {
public:
    /// Checks everything: sizes, ranges, finite positions; blocks that follow each other by region and type; cells with
    /// different nodes; closed polyhedra; faces of two cells at most, wound against each other; sets without repetition; pairs
    /// whose nodes have the same origins, at equal positions; places and attributes that fit. Positions of cells are not judged.
    /// Fails with FailureKind::internal and the first thing that is wrong. n log n in the number of cells.
    static Result<VolumeMesh> make(VolumeMeshData data);

    const VolumeMeshData* operator->() const { return &data_; }
    const VolumeMeshData& operator*() const { return data_; }

    /// The block of a cell. Logarithmic in the number of blocks. \pre cell < cell_count()
    const VolumeMeshData::Block& block_of(std::uint32_t cell) const;
    /// How many faces a cell has. \pre cell < cell_count()
    std::uint32_t face_count(std::uint32_t cell) const;
    /// The vertices of a face, wound outwards. \pre a face of this mesh
    std::vector<std::uint32_t> nodes_of(const CellFaceRef& face) const;

private:
    explicit VolumeMesh(VolumeMeshData data) : data_(std::move(data)) {}
    VolumeMeshData data_;
};

}  // namespace geomend
