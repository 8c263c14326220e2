// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec3.h"
#include "model/attribute.h"
#include "model/coordinate_system.h"
#include "model/feature.h"
#include "model/object_info.h"
#include "model/objects.h"
#include "model/polygons.h"

namespace geomend {

/// A 32-bit index of one kind of thing, so that a surface is not taken for a region.
template <class Tag>
struct Id {
    std::uint32_t value = no_index;
    constexpr Id() = default;
    constexpr explicit Id(std::uint32_t v) : value(v) {}
    constexpr explicit Id(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}
    constexpr bool valid() const { return value != no_index; }
    constexpr auto operator<=>(const Id&) const = default;
};
using VertexId = Id<struct VertexTag>;
using CornerId = Id<struct CornerTag>;
using LineId = Id<struct LineTag>;
using SurfaceId = Id<struct SurfaceTag>;
using RegionId = Id<struct RegionTag>;
using InterfaceId = Id<struct InterfaceTag>;
using ContactId = Id<struct ContactTag>;

/// A boundary representation as plain arrays. Positions live on model vertices; a surface has nodes of its
/// own, so that two surfaces on one contact carry different values. Two surfaces conform along a line exactly
/// when they use the same model vertices. It may be broken: judging it is the validators' matter.
struct BrepData {
    std::string name;
    CoordinateSystem crs;
    std::vector<Annotation> annotations;

    std::vector<Vec3> vertices;                ///< elevation-up
    std::vector<Attribute> vertex_attributes;  ///< location point, over vertices (cell meshes); may be empty

    struct Corner {
        std::string name;
        VertexId vertex;
    };
    std::vector<Corner> corners;

    struct Line {
        std::string name;
        std::vector<VertexId> vertices;   ///< in order, at least 2; a closed line repeats its first vertex at the end
        std::array<CornerId, 2> corners;  ///< at its ends; equal for a closed line
        ContactId contact;
        bool closed() const { return corners[0] == corners[1]; }
    };
    std::vector<Line> lines;

    /// Where a surface's border (or a slit in it) runs along a line; both sides of a slit are two entries.
    struct SurfaceLine {
        LineId line;
        bool internal = false;  ///< the surface lies on both sides of the line
    };
    struct Surface {
        std::string name;
        InterfaceId interface_id;
        FeatureRole role = FeatureRole::unknown;
        std::string role_text;
        std::vector<VertexId> nodes;  ///< node -> model vertex
        Polygons polygons;            ///< over nodes
        /// Like polygons.corners: the polygon across the edge corner i -> i+1; no_index at a border or on a line.
        std::vector<std::uint32_t> neighbours;
        std::vector<Attribute> attributes;  ///< over nodes (point) or polygons (polygon)
        std::vector<SurfaceLine> lines;
        std::array<RegionId, 2> regions;  ///< behind [0] and in front [1] of the normals; invalid: none or Universe
        std::uint32_t source_object = no_index, source_part = no_index;
        std::vector<Annotation> annotations;
    };
    std::vector<Surface> surfaces;

    struct Side {
        SurfaceId surface;
        bool front = true;  ///< the region lies on the side the normals point into
    };
    struct Region {
        std::string name;
        std::vector<Side> sides;
        double volume = 0;  ///< positive when its sides close around it; NaN where it is not known
        bool volume_known = false;
        /// Cells that fill it; none for a hollow region.
        std::vector<VertexId> nodes;  ///< node -> model vertex; two regions on one surface have nodes of their own
        std::vector<CellType> cell_types;
        std::vector<std::uint64_t> cell_offsets = {0};
        std::vector<std::uint32_t> cell_nodes;  ///< over nodes
        /// Faces of polyhedra, as in CellMesh but over nodes; empty when there are none.
        std::vector<std::uint64_t> cell_faces, face_offsets;
        std::vector<std::uint32_t> face_nodes;
        std::vector<Attribute> attributes;       ///< over nodes (point), cells (cell) or for the whole (object)
        std::uint32_t source_object = no_index;  ///< the object that its cells come from
        std::vector<Annotation> annotations;
    };
    std::vector<Region> regions;
    std::vector<Side> universe;  ///< the exterior's sides; empty where it is not known
    double universe_volume = 0;

    struct Interface {
        std::string name;
        FeatureRole role = FeatureRole::unknown;
        std::string role_text;
        std::string feature;
        std::vector<SurfaceId> surfaces;
        std::vector<Annotation> annotations;  ///< of the object that it comes from
    };
    std::vector<Interface> interfaces;
    /// Geological features over surfaces of any interfaces (Gocad SURFACE lists).
    struct Feature {
        std::string name;
        std::vector<SurfaceId> surfaces;
    };
    std::vector<Feature> features;
    /// All lines bordered by the same set of interfaces.
    struct Contact {
        std::string name;
        std::vector<InterfaceId> interfaces;  ///< ascending
        std::vector<LineId> lines;
    };
    std::vector<Contact> contacts;
    struct RegionList {
        std::string name;
        std::vector<RegionId> regions;
        std::vector<std::int64_t> unresolved;  ///< numbers without a region, kept for the way back
    };
    std::vector<RegionList> layers;
    std::vector<RegionList> fault_blocks;

    std::uint32_t internal_lines_of_regions = 0;   ///< lines inside a region (ends of internal surfaces)
    std::uint32_t internal_lines_of_surfaces = 0;  ///< lines inside a surface
};

/// An immutable boundary representation whose indices are known to be in range and whose adjacency is reciprocal.
class Brep {
public:
    /// Checks that every index is in range (contact and interfaces of a surface and regions may be none); that offsets begin at
    /// 0, do not descend and end at the size of their array; that cells have as many nodes as their type; that lines end at the
    /// vertices of their corners; that across an edge with neighbours each polygon names the other, over the same two nodes;
    /// that the interfaces of a contact ascend; and that attributes of points, polygons and cells have a value for each. A
    /// violation is a programming mistake and fails with FailureKind::internal and the first thing that is wrong.
    /// Cost: linear in corners (times the corners of a neighbour); small beside making the data.
    static Result<Brep> make(BrepData data);

    const BrepData* operator->() const { return &data_; }
    const BrepData& operator*() const { return data_; }

private:
    explicit Brep(BrepData data) : data_(std::move(data)) {}
    BrepData data_;
};

}  // namespace geomend
