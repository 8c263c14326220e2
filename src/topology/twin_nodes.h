// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "model/brep.h"

// A surface may have several nodes at one vertex: twins, which state where it is cut. A mesh has one point there;
// CellMesh::twins says which corners of which polygons stand on twins.

namespace geomend::topology {

/// Polygons in an order that formats keep which write cells type by type: triangles, quadrangles, others. Twins are
/// counted in it.
std::vector<std::uint32_t> polygons_by_size(const Polygons& polygons);

/// The nodes of a surface at vertices where it has another node before.
std::vector<TwinCorners> twins_of(const BrepData::Surface& surface);

/// How many nodes of all surfaces have another node of their surface at their vertex.
std::uint64_t count_twins(const BrepData& brep);

/// Gives twins nodes of their own; what does not fit the surface is passed over.
/// \return per new node the node that it stands beside
std::vector<std::uint32_t> make_twins(const std::vector<TwinCorners>& twins, BrepData::Surface& surface);

}  // namespace geomend::topology
