// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/format.h"
#include "formats/vtk/vtk_cells.h"
#include "formats/vtk/xml_arrays.h"

namespace geomend::vtk {

enum class DatasetKind : std::uint8_t { unstructured, poly, structured, image, rectilinear };

/// Element name of a serial file ("UnstructuredGrid", ...); parallel files have a "P" before it.
const char* element_name(DatasetKind kind);
/// Kind behind a VTKFile type, e.g. "PolyData" or "PPolyData"; nothing for others.
std::optional<DatasetKind> kind_of_type(std::string_view type, bool& parallel);

/// First and last point number in each direction.
using Extent = std::array<std::int64_t, 6>;

/// One Piece of a dataset, decoded and checked: every corner is the number of one of its points.
struct Piece {
    std::vector<Vec3> points;  ///< unstructured, poly, structured
    bool single_precision = false;
    CellMesh mesh;                                   ///< unstructured: cells only
    PolyData poly;                                   ///< poly: cells only
    Extent extent{};                                 ///< structured, image, rectilinear
    std::array<std::vector<double>, 3> coordinates;  ///< rectilinear
    std::vector<Attribute> attributes;               ///< location point or cell, per cell as in mesh or poly
    std::size_t empty_cells = 0;
    CornerCells corner_cells;
};

/// What reading gathers besides geometry.
struct ReadNotes {
    std::vector<Finding> findings;
    std::vector<Loss> losses;
};

/// Reads all Piece elements of a dataset element and appends them. Failures as in decode_array, and F006, F007 for
/// coordinates that are not finite and corners that are no points.
Result<void> read_pieces(const XmlDocument& document, DatasetKind kind, const ReadOptions& options, std::vector<Piece>& pieces,
                         ReadNotes& notes);

/// Reads a FieldData element (may be nullptr) as attributes at location object.
Result<std::vector<Attribute>> read_field_data(const XmlDocument& document, const XmlElement* field_data);

/// Six integers of an extent; F012 where there are not six, F014 where they are no extent of at most 2^32 points.
Result<Extent> read_extent(const XmlDocument& document, const XmlElement& element, std::string_view attribute);
std::array<std::uint32_t, 3> dims_of(const Extent& extent);

/// One unstructured mesh of all pieces; ghost cells of neighbours are left out, and told in the notes. The pieces are used up.
CellMesh join_meshes(std::vector<Piece>& pieces, const std::string& file, ReadNotes& notes);
PolyData join_polydata(std::vector<Piece>& pieces, const std::string& file, ReadNotes& notes);
/// Puts lattice pieces together. Failure F008 where they leave gaps in the whole extent.
Result<Piece> join_lattices(std::vector<Piece>& pieces, DatasetKind kind, const Extent& whole, const std::string& file, ReadNotes& notes);

}  // namespace geomend::vtk
