// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// MODFLOW 6, input of the package DISU: OPTIONS, DIMENSIONS, GRIDDATA (TOP, BOT, AREA), CONNECTIONDATA (IAC, JA, IHC, CL12, HWVA).
/// A cell reaches from its lowest to its highest point, with the area that gives its volume. All connections are written as
/// level ones, as wide as makes width times mean thickness the area of the face: cells that are not in layers have no order from top
/// to base. Right for confined flow. \pre the mesh was prepared for "modflow-disu"
Result<std::vector<Loss>> write_modflow(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
