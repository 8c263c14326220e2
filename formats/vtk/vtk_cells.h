// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/finding.h"
#include "model/annotations.h"
#include "model/loss.h"
#include "model/objects.h"

// How cells of VTK become ours and back, for the legacy and the XML formats alike. Nothing here reads or writes
// bytes, and no header of the VTK library is needed.

namespace geomend::vtk {

/// Annotation of an object: the kind of dataset that held it ("PolyData", "UnstructuredGrid", ...).
inline constexpr std::string_view dataset_key = "vtk.dataset";
/// Annotation of an attribute: "Scalars", "Vectors", "Normals", "TCoords", "Tensors", "GlobalIds", "PedigreeIds".
inline constexpr std::string_view attribute_role_key = "vtk.role";
/// Annotation of an edge attribute whose values stood on whole polylines ("polyline").
inline constexpr std::string_view attribute_per_key = "vtk.per";

/// Lists of point numbers: cell i has corners[offsets[i] .. offsets[i+1]).
struct CellList {
    std::vector<std::uint64_t> offsets = {0};
    std::vector<std::uint32_t> corners;

    std::size_t size() const { return offsets.size() - 1; }
    std::span<const std::uint32_t> operator[](std::size_t i) const {
        return {corners.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
    }
    void add(std::span<const std::uint32_t> cell) {
        corners.insert(corners.end(), cell.begin(), cell.end());
        offsets.push_back(corners.size());
    }
};

/// How many cells of each higher-order VTK type are held by their corners only.
using CornerCells = std::map<std::int64_t, std::uint64_t>;

/// Lists the further points of such cells as lost, one finding a type. \param where their types stand
void drop_further_points(const CornerCells& cells, const Location& where, std::vector<Finding>& findings, std::vector<Loss>& losses);

enum class CellProblem : std::uint8_t { none, unknown_type, wrong_size, bad_faces };

/// Fills a mesh with cells as VTK numbers and orders them: pixels become quads, voxels hexahedra, strips
/// triangles, empty cells nothing; cells of higher order that have no place here (Lagrange, Bezier, cubic) become those of
/// their corners, which come first. The mesh's points are filled by the caller.
class MeshBuilder {
public:
    /// \param mesh empty; outlives the builder
    explicit MeshBuilder(CellMesh& mesh) : mesh_(mesh) {}
    void reserve(std::size_t cells, std::size_t corners);

    /// Adds the next cell of the file. \pre every corner is the number of a point. Polyhedra go to add_polyhedron.
    CellProblem add(std::int64_t vtk_type, std::span<const std::uint32_t> corners);

    /// Adds a polyhedron.
    /// \param corners its distinct points in the file's order; empty: in the order in which faces name them
    /// \param faces number of points of each face and then these points, one face after another
    /// \pre every point number in `faces` is the number of a point; the sizes are checked here
    CellProblem add_polyhedron(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> faces);

    /// Repeats or drops the values of cell attributes, given per cell of the file, where a cell became several
    /// or none. Call once, after the last cell.
    void fit(std::vector<Attribute>& attributes) const;
    /// Number of cells of the file so far, and how many of them were empty.
    std::size_t cells_added() const { return added_; }
    std::size_t empty_cells() const { return empty_; }
    const CornerCells& corner_cells() const { return corner_cells_; }
    /// True when cell i of the mesh is cell i of the file.
    bool one_to_one() const { return source_.empty(); }
    /// The file's cell behind each cell of the mesh; empty when one_to_one().
    const std::vector<std::uint32_t>& sources() const { return source_; }

private:
    void note_sources(std::size_t first_new);
    CellMesh& mesh_;
    std::size_t added_ = 0;
    std::size_t empty_ = 0;
    CornerCells corner_cells_;
    std::vector<std::uint32_t> source_;
};

/// The name of a VTK cell type that has no place here ("Lagrange tetrahedron", ...) or "cell type 99".
std::string unknown_cell_name(std::int64_t vtk_type);

/// Takes the values of the things `source[0], source[1], ...` of an attribute, in place.
/// \pre every source is less than the number of things
void take_values(Attribute& attribute, std::span<const std::uint32_t> source);

/// The content of a PolyData dataset. Cell attributes (location cell) run over verts, lines, polys, strips.
struct PolyData {
    ObjectInfo info;
    std::vector<Vec3> points;
    CellList verts, lines, polys, strips;

    std::size_t cell_count() const { return verts.size() + lines.size() + polys.size() + strips.size(); }
};

/// What a PolyData dataset is to a geologist: a PointSet (each point in one vertex cell, in order, or no cell at
/// all), a PolylineSet (lines only; one part per line unless all are single edges), a Surface (polygons
/// and strips only), else a CellMesh of mixed dimensions. Cell attributes follow (location edge, polygon, cell).
/// \pre every corner is the number of a point; cell attributes have one value per cell
Object object_from_polydata(PolyData data);

/// The way back. \return false (and data is unspecified) where the object has cells that are not points, lines or
/// polygons (volumes, second-order cells), or is a grid, a raster or a well.
bool polydata_from_object(const Object& object, PolyData& data);

/// The object as cells (for unstructured grids): points as vertices, lines, polygons; a mesh as it is.
/// Attributes come along at locations point, cell, object. \return false for grids, rasters and wells.
bool mesh_from_object(const Object& object, CellMesh& mesh);

/// The polylines of a set, for writing: edges that run on from one to the next within a part are one line. A line whose end is
/// its start repeats the point. \param first_edge the first edge of each line
CellList polylines_of(const PolylineSet& set, std::vector<std::uint64_t>& first_edge);

/// Turns a mesh that holds one kind of cell only (points, lines or polygons) into the object that it was before
/// mesh_from_object. \param kind kind_name() of that object. The mesh itself comes back where it does not fit.
Object object_of_kind(CellMesh mesh, std::string_view kind);

}  // namespace geomend::vtk
