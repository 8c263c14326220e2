// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::surfaces {

// TetGen's piecewise linear complexes: a list of nodes, a list of facets with markers, points in holes, points in regions. In .smesh a
// facet is one polygon, in .poly several polygons and points in their holes.

int sniff_smesh(std::string_view head, std::string_view base_name);
/// A surface for each marker, named where comments as written here do ("# marker 2: Top"); a list of no nodes is that of the .node file
/// beside it. Points of holes and regions, and holes in facets, are listed as lost. Cost: linear.
Result<Dataset> read_smesh(const Input& input, const ReadOptions& options);
/// All surfaces, markers from 1 in their order; the very same position is one node. Extension .poly gives that form.
Result<std::vector<Loss>> write_smesh(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::surfaces
