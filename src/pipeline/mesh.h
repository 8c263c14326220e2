// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hexes/recombine.h"
#include "pipeline/convert.h"
#include "pipeline/mesh_split.h"
#include "pipeline/mesh_wells.h"
#include "pipeline/remesh.h"
#include "pipeline/resize.h"
#include "validators/registry.h"
#include "volume/fill.h"

namespace geomend {

/// What the user wants of a mesh.
struct MeshRequest {
    ConvertRequest files;
    validators::CheckOptions checks;  ///< by which the model is judged before it is filled
    volumes::FillOptions fill;
    std::string split = "none";                           ///< along which surfaces, see split_mesh()
    std::string wells = "all";                            ///< which wells and lines become edges of cells, see chosen_wells()
    std::optional<remeshing::RemeshOptions> remesh;       ///< new triangles before regions are filled
    std::vector<std::pair<std::string, double>> size_of;  ///< sizes of regions, and with new triangles of surfaces and interfaces, by name
    std::vector<remeshing::SizeRule> size_by;             ///< of new triangles, if there are any, and of cells inside; with a size of cells
    std::optional<ResizeRequest> resize;                  ///< sizes by the error of a calculation
    /// Vertices inside of regions, and those of new triangles if there are any, are points of a lattice with the size of cells.
    bool on_lattice = false, remesh_on_lattice = false;
    std::optional<hexes::RecombineOptions> recombine;  ///< hexahedra of the tetrahedra
    std::uint64_t most_cells = 20'000'000;             ///< that sizes may make, by an estimate
    bool fills = true;                                 ///< false: the tetrahedra that are recombined are those of the inputs
};

/// A block of cells in the file: those of one region and type.
struct MeshBlock {
    std::string region;
    CellType type = CellType::tetrahedron;
    std::uint64_t first = 0, count = 0;
};

/// The triangles on one side of a surface, each a face of a cell.
struct MeshFaceSet {
    std::string name;
    FeatureRole role = FeatureRole::unknown;
    const char* side = "";  ///< front or back
    std::uint64_t count = 0;
};

/// The cells of a region where hexahedra were made, and their volume: that of their (tri)linear maps.
struct MeshRegion {
    std::string name;
    double volume = 0;
    std::vector<std::pair<CellType, std::uint64_t>> cells;  ///< how many of each type
};

/// What came of it.
struct MeshReport {
    ConvertReport written;
    std::vector<Finding> errors;           ///< of the model, for which it was not filled
    std::optional<RemeshReport> remeshed;  ///< where that was asked for
    std::optional<ResizeReport> resized;   ///< where that was asked for
    std::vector<volumes::FilledRegion> regions;
    std::vector<MeshFaceSet> face_sets;
    std::vector<MeshWell> wells;                       ///< that became edges
    std::vector<std::string> outside;                  ///< surfaces that lie in no region: their triangles are faces of no cell
    std::uint64_t surface_vertices = 0;                ///< added on lines and surfaces, since cells could not be made without
    std::optional<hexes::RecombineReport> recombined;  ///< where that was asked for
    std::vector<MeshRegion> mixed_regions;             ///< then, by region
    std::vector<MeshBlock> blocks;
    SplitReport split;
    bool is_written = false;
};

/// Reads all inputs as one model, checks it, fills its regions with tetrahedra, makes hexahedra of them where that is asked for, and
/// writes surfaces and cells. Where it does not fill, it takes the tetrahedra of the inputs, and judges no model. Nothing is written
/// where the model has errors or a region was not filled: the report says which, why and where.
/// Failure as of convert() and volumes::fill_regions(); (cannot_hold, F026) where there is not one model.
Result<MeshReport> mesh(const MeshRequest& request);

/// What INTERFACE states of `mesh --json`.
std::string mesh_json(const MeshReport& report);

}  // namespace geomend
