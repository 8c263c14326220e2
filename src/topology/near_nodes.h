// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "model/dataset.h"

namespace geomend::topology {

/// For each node of a mesh of cells the first one of its cluster, as clusters_within() has it; but nodes of one cell are in one cluster
/// only where they are within 1e-7 of the mesh's size of each other: a cell that is thinner than a tolerance, as that of single
/// precision far from the origin, is a cell. Nodes around such a cell are in one cluster within that smaller length, too.
/// \param tolerance > 0. \pre positions are finite. Cost: that of clusters_within(), twice where there are such cells.
std::vector<std::uint32_t> near_nodes(const CellMesh& mesh, double tolerance);

}  // namespace geomend::topology
