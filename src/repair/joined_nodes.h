// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "model/brep.h"
#include "repair/surface_model.h"

// A surface states by its nodes whether a line inside it cuts it: the two sides of a cut have nodes of their own. A repair keeps what is
// stated so, though its soup has one vertex at each place.

namespace geomend::repair {

/// What was found of faces that double nodes where nothing cuts them.
struct LoneTwins {
    std::uint64_t nodes = 0;           ///< doubled ones that become one with another
    std::vector<std::uint32_t> faces;  ///< patches that they are in, ascending
    Vec3 where{};                      ///< a place where one is doubled and nothing cuts
};

/// Nodes of a stated face that are at one place, and no border of the face runs through it twice: the face touches itself there, and
/// doubles its nodes without a cut. Then doubling states no cuts in it, and all its nodes at one place become one, unless their values
/// differ: model.counts_as is set. Cost: n log n in the nodes of stated faces.
LoneTwins join_lone_twins(SurfaceModel& model);

/// Nodes of surfaces on lines inside of them, which were given to the two sides of a cut, become one again where the file has one node
/// there (see SurfaceModel::counts_as), and all that meets there was read there. Loose surfaces state this only where they double nodes
/// elsewhere. \param triangles per surface and polygon its triangle of the soup  \return whether there are any. Cost: n log n.
bool join_nodes_as_read(const SurfaceModel& model, const std::vector<std::vector<std::uint32_t>>& triangles, BrepData& brep);

}  // namespace geomend::repair
