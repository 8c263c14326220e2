// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/vec3.h"
#include "model/corner_point.h"
#include "model/object_info.h"
#include "model/polygons.h"

// What a file can hold. Plain arrays: readers fill them, writers read them. Positions of point sets, polylines,
// surfaces, cell meshes, structured grids and wells are elevation-up, whatever the file's sign; corner-point grids
// are depth-down.

namespace geomend {

inline constexpr std::uint32_t no_index = 0xffffffffu;

struct PointSet {
    ObjectInfo info;
    std::vector<Vec3> points;
    Labels labels;
    std::vector<std::uint32_t> part_first;  ///< first point of each part after the first one; mostly empty
    std::vector<std::uint32_t> alias;       ///< as in Surface
};

struct PolylineSet {
    ObjectInfo info;
    std::vector<Vec3> points;
    Labels labels;
    std::vector<std::array<std::uint32_t, 2>> edges;
    /// Parts in file order; part i owns points [first_point of i .. of i+1) and edges likewise.
    struct Part {
        std::uint32_t first_point = 0;
        std::uint64_t first_edge = 0;
        std::string name;
    };
    std::vector<Part> parts;
    std::vector<std::uint32_t> alias;  ///< as in Surface
};

struct Surface {
    ObjectInfo info;
    std::vector<Vec3> points;
    Labels labels;
    Polygons polygons;

    /// Parts (Gocad TFACE) in file order; part i owns points and polygons up to those of part i+1. Polygons of
    /// a part may use points of other parts. Empty: the whole is one part.
    struct Part {
        std::uint32_t first_point = 0;
        std::uint64_t first_polygon = 0;
    };
    std::vector<Part> parts;

    /// Stated twins (Gocad ATOM): alias[i] is the point whose position point i takes, or no_index. Empty where
    /// there is none. points[i] holds the position either way.
    std::vector<std::uint32_t> alias;

    /// Stated border corners (BSTONE) and starts of border arcs (BORDER): hints, in file order.
    std::vector<std::uint32_t> border_corners;
    struct BorderStart {
        std::int64_t id;
        std::uint32_t corner, next;
    };
    std::vector<BorderStart> border_starts;
};

/// The numbers are those of VTK. Corner order as in VTK, too; pixel and voxel are turned into quad and
/// hexahedron, strips into triangles when read.
enum class CellType : std::uint8_t {
    vertex = 1,
    poly_vertex = 2,
    line = 3,
    poly_line = 4,
    triangle = 5,
    polygon = 7,
    quad = 9,
    tetrahedron = 10,
    hexahedron = 12,
    wedge = 13,
    pyramid = 14,
    pentagonal_prism = 15,
    hexagonal_prism = 16,
    quadratic_edge = 21,
    quadratic_triangle = 22,
    quadratic_quad = 23,
    quadratic_tetrahedron = 24,
    quadratic_hexahedron = 25,
    quadratic_wedge = 26,
    quadratic_pyramid = 27,
    biquadratic_quad = 28,
    triquadratic_hexahedron = 29,
    biquadratic_wedge = 32,
    polyhedron = 42,
};

/// "tetrahedron", "wedge", ...
const char* to_string(CellType type);
/// 0 point-like, 1 line-like, 2 surface-like, 3 volume-like.
int dimension(CellType type);
/// Number of nodes, or 0 where it varies (poly_vertex, poly_line, polygon, polyhedron).
std::uint32_t node_count(CellType type);
/// True for the second-order types.
bool is_second_order(CellType type);
/// The first-order type with the same corners (itself for first-order types).
CellType linear_type(CellType type);

/// The polygon corners on one twin of a surface: pairs of polygon and corner. Polygons are counted triangles first, then
/// quadrangles, then others, each in order, as formats keep them that write cells type by type.
using TwinCorners = std::vector<std::array<std::uint32_t, 2>>;
/// The twins of the surfaces that have any, by the tag of the surface's entity.
using Twins = std::map<std::int64_t, std::vector<TwinCorners>>;

/// Cells of any dimension over one array of points: tagged meshes (MSH), solids (Gocad), VTK unstructured grids.
struct CellMesh {
    ObjectInfo info;
    std::vector<Vec3> points;
    Labels point_labels;
    std::vector<std::uint32_t> alias;  ///< as in Surface (ATOM, SHAREDVRTX)

    std::vector<CellType> types;
    std::vector<std::uint64_t> offsets = {0};  ///< cell i has nodes[offsets[i] .. offsets[i+1]); polyhedra list their distinct points
    std::vector<std::uint32_t> nodes;
    Labels cell_labels;

    /// Faces of polyhedra; empty arrays when there are none. Cell i has the faces
    /// [cell_faces[i] .. cell_faces[i+1]) (none for other types); face f has
    /// face_nodes[face_offsets[f] .. face_offsets[f+1]).
    std::vector<std::uint64_t> cell_faces, face_offsets;
    std::vector<std::uint32_t> face_nodes;

    /// What the file groups cells by: MSH entities, Gocad volumes (dim 3) and MODEL faces (dim 2), ...
    struct Entity {
        int dimension = 3;
        std::int64_t tag = 0;
        std::string name;  ///< region or surface name; may repeat
        FeatureRole role = FeatureRole::unknown;
        std::string role_text;
        std::vector<std::int64_t> boundary;  ///< tags of entities one dimension lower, signed by orientation
        std::vector<std::uint32_t> groups;   ///< indices into `groups`
        std::optional<std::array<Vec3, 2>> bounds;
    };
    std::vector<Entity> entities;
    std::vector<std::uint32_t> cell_entity;  ///< per cell an index into entities or no_index; empty when there are no entities

    /// Named (physical) groups of entities.
    struct Group {
        int dimension = 3;
        std::int64_t tag = 0;
        std::string name;
    };
    std::vector<Group> groups;

    /// Stated surface behind each facet of a tetrahedron (Gocad CTETRA); 4 per cell for the tetrahedra in cell
    /// order, or empty. Facet i is opposite to node i.
    struct FacetTag {
        std::uint32_t name = no_index;  ///< index into facet_names
        std::int8_t sign = 0;           ///< +1, -1 as stated; 0 none
        bool boundary = false;
    };
    std::vector<FacetTag> facet_tags;
    std::vector<std::string> facet_names;

    /// Stated twins: corners of surface entities that stand on nodes of their own, although the mesh has one point there,
    /// because the surface is cut. Nothing: the mesh does not say; empty: it says that there are none.
    std::optional<Twins> twins;

    std::size_t cell_count() const { return types.size(); }
    std::span<const std::uint32_t> cell_nodes(std::size_t i) const {
        return {nodes.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
    }
    /// Adds a cell that is not a polyhedron.
    void add_cell(CellType type, std::span<const std::uint32_t> cell) {
        types.push_back(type);
        nodes.insert(nodes.end(), cell.begin(), cell.end());
        offsets.push_back(nodes.size());
        if (!cell_faces.empty()) cell_faces.push_back(cell_faces.back());
    }
};

/// A curvilinear grid: points (i fastest, then j, k), hexahedra between them (quads where one dim is 1).
struct StructuredGrid {
    ObjectInfo info;
    std::array<std::uint32_t, 3> dims{1, 1, 1};  ///< numbers of points, each at least 1
    std::vector<Vec3> points;
    std::vector<std::uint8_t> dead_cells;  ///< per cell, 1 where blanked; empty: none

    /// Stated duplicate nodes at faults (Gocad SPLIT): node, position, and which of the eight cells around use it.
    struct Split {
        std::array<std::uint32_t, 3> node;
        Vec3 position;
        std::int64_t id;
        std::uint8_t cells;
    };
    std::vector<Split> splits;
    /// Named sets of faces: (point index, direction 0 U, 1 V, 2 W).
    struct FaceSet {
        std::string name;
        std::vector<std::array<std::uint32_t, 2>> faces;
    };
    std::vector<FaceSet> face_sets;
};

/// A regular lattice of samples in 1 to 3 directions: Gocad Voxet and 2D grid, VTK image and rectilinear grid,
/// IRAP, ZMAP+, CPS-3 horizon grids. Sample (i,j,k) stands at origin + i*step[0] + j*step[1] + k*step[2], or, where
/// `coordinates` are given (rectilinear), at those. i runs fastest in attribute arrays.
struct Raster {
    ObjectInfo info;
    std::array<std::uint32_t, 3> dims{1, 1, 1};  ///< numbers of samples, each at least 1
    Vec3 origin{};
    std::array<Vec3, 3> step{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::array<std::vector<double>, 3> coordinates;  ///< all empty, or dims[a] values each
    /// Index of the point attribute that is the height (elevation-up) of a horizon grid, or no_index.
    std::uint32_t height_attribute = no_index;
};

struct Well {
    ObjectInfo info;
    Vec3 head{};  ///< reference point (WREF), elevation-up
    double kelly_bushing = 0;
    std::vector<Vec3> path;              ///< elevation-up
    std::vector<double> measured_depth;  ///< one per path point, or empty

    struct Marker {
        std::string name;
        double measured_depth = 0;
        std::vector<std::string> lines;  ///< further records (UNIT, DIP, ...), verbatim
    };
    std::vector<Marker> markers;
    struct Zone {
        std::string name;
        double from = 0, to = 0;  ///< measured depths
        std::string rest;         ///< what else stands on the line
    };
    std::vector<Zone> zones;
    /// A log: values along measured depth.
    struct Curve {
        std::vector<double> measured_depth;
        Attribute values;
    };
    std::vector<Curve> curves;
};

/// One named thing of a file.
using Object = std::variant<PointSet, PolylineSet, Surface, CellMesh, StructuredGrid, Raster, Well, CornerPointGrid>;

/// "point-set", "polyline-set", "surface", "cell-mesh", "structured-grid", "raster", "well", "corner-point-grid".
const char* kind_name(const Object& object);
ObjectInfo& info_of(Object& object);
const ObjectInfo& info_of(const Object& object);

/// Position of sample (i,j,k), elevation-up; for horizon grids without the height.
Vec3 sample_position(const Raster& raster, std::uint32_t i, std::uint32_t j, std::uint32_t k);
/// dims[0]*dims[1]*dims[2]
std::uint64_t sample_count(const std::array<std::uint32_t, 3>& dims);
/// Product of max(dim-1, 1) over the directions with more than one sample; 0 where there is only one sample.
std::uint64_t lattice_cell_count(const std::array<std::uint32_t, 3>& dims);

}  // namespace geomend
