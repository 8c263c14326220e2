// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "model/dataset.h"

namespace geomend::gmsh {

/// All objects of a Dataset as one mesh.
struct Combined {
    CellMesh mesh;
    std::vector<std::uint8_t> left_out;         ///< per cell, 1 where it does not go out (blanked cells); empty: none
    std::vector<std::uint8_t> left_out_points;  ///< per point, 1 where it has no height; empty: none
};

/// Puts the objects after one another: each becomes an entity per dimension with a named physical group, cell meshes
/// keep their entities. Lattices become cells. What has no place is added to `losses`. Coordinates stay as they are.
Combined combine(const Dataset& dataset, std::vector<Loss>& losses);

}  // namespace geomend::gmsh
