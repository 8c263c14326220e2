// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "model/brep.h"

namespace geomend::topology {

/// Gives each side of a cut nodes of its own: where a line runs inside the surface, a node there becomes one node
/// per fan of neighbouring polygons, with the same vertex and values. Cost: linear in the surface's corners.
void split_nodes_along_cuts(const BrepData& brep, BrepData::Surface& surface);

}  // namespace geomend::topology
