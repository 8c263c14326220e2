// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "base/output.h"
#include "formats/format.h"
#include "model/dataset.h"

// One writer per kind of object. Each writes a complete `GOCAD <Type> 1 ... END` and adds what it cannot hold to
// `losses`; it fails only with FailureKind::usage (wrong option) or cannot_hold (nothing sensible can be written).

namespace geomend::gocad {

/// Where the objects of one file go.
struct GocadOutput {
    OutputSet& files;  ///< for companion files
    OutputFile& out;
    const WriteOptions& options;
    const Dataset& dataset;
    std::vector<Loss>& losses;
};

Result<void> write_vset(const PointSet& points, GocadOutput& to);
Result<void> write_pline(const PolylineSet& lines, GocadOutput& to);
Result<void> write_tsurf(const Surface& surface, GocadOutput& to);
/// A TSolid, or a LightTSolid. \param model what is stated over this mesh (its MODEL section), or nullptr
Result<void> write_solid(const CellMesh& mesh, const StatedModel* model, bool light, GocadOutput& to);
/// A Voxet, or a 2D grid where the raster is a horizon grid.
Result<void> write_raster(const Raster& raster, GocadOutput& to);
Result<void> write_sgrid(const StructuredGrid& grid, GocadOutput& to);
Result<void> write_well(const Well& well, GocadOutput& to);

}  // namespace geomend::gocad
