// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

#include "formats/format.h"

namespace geomend::meshes {

/// Whether a text begins as a Medit mesh.
int sniff_medit(std::string_view head, std::string_view base_name);

/// Medit text of dimension 3: vertices, edges, triangles, quadrilaterals, tetrahedra, pyramids, prisms and hexahedra, with entities by
/// their references; what references are called where comments as we write them say so. Corners, ridges, required entities, normals
/// and tangents say how to mesh, not what there is: they are listed as losses of style, other sections as losses of substance.
Result<Dataset> read_medit(const Input& input, const ReadOptions& options);

}  // namespace geomend::meshes
