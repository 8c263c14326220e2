// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/loss.h"
#include "model/objects.h"

namespace geomend::ringmesh {

/// A mesh as GeoGram stores it: points, and over them edges, facets and cells.
struct GeogramMesh {
    std::vector<Vec3> points;
    CoordinatePrecision precision = CoordinatePrecision::double_precision;
    std::vector<std::array<std::uint32_t, 2>> edges;
    Polygons facets;
    std::vector<CellType> cell_types;
    std::vector<std::uint64_t> cell_offsets{0};
    std::vector<std::uint32_t> cell_nodes;  ///< corners in VTK order
    std::vector<Attribute> attributes;      ///< on points, edges, polygons and cells
};

/// Reads a binary .geogram file, compressed or not: a row of chunks, each with a name of four letters, its length and its content.
/// \param name  of the file, for messages
/// \param losses  gets what has no place in a GeogramMesh
/// Failures: F004, F005, F006, F007, F008, F012, F013, F014, F015. Linear.
Result<GeogramMesh> read_geogram_mesh(std::string_view bytes, const std::string& name, std::vector<Loss>& losses);

}  // namespace geomend::ringmesh
