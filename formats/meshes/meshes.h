// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// The rows of the table of formats: Medit, TetGen, Abaqus.
std::span<const Format> formats();
/// What writes them.
std::span<const MeshFormat> mesh_formats();

}  // namespace geomend::meshes
