// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "model/brep.h"

namespace geomend::topology {

/// Gives each side of a cut nodes of its own: where a line runs inside the surface, a node there becomes one node
/// per fan of neighbouring polygons, with the same vertex and values. Lines that are only embedded are no cuts: both of their sides keep
/// the same nodes. Cost: linear in the surface's corners.
/// \param embedded per line of the model whether it is stated inside of one surface, is used by no other one, and nothing is open there
void split_nodes_along_cuts(const BrepData& brep, std::span<const std::uint8_t> embedded, BrepData::Surface& surface);

}  // namespace geomend::topology
