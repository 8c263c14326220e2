// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "model/brep.h"

// A surface may have several nodes at one vertex: twins, which state where it is cut. A mesh has one point there; an
// annotation of the mesh tells which corners of which polygons stand on twins.

namespace geomend::topology {

/// The polygon corners on one twin: pairs of polygon and corner. Polygons are counted in the order of polygons_by_size().
using TwinCorners = std::vector<std::array<std::uint32_t, 2>>;
/// The twins of the surfaces that have any, by the tag of the surface's entity.
using Twins = std::map<std::int64_t, std::vector<TwinCorners>>;

/// Polygons in an order that formats keep which write cells type by type: triangles, quadrangles, others.
std::vector<std::uint32_t> polygons_by_size(const Polygons& polygons);

/// The nodes of a surface at vertices where it has another node before.
std::vector<TwinCorners> twins_of(const BrepData::Surface& surface);

/// How many nodes of all surfaces have another node of their surface at their vertex.
std::uint64_t count_twins(const BrepData& brep);

/// The annotation that says it; a mesh without any twins says so, too.
Annotation twins_annotation(const Twins& twins);

/// What the mesh says of twins; nothing where it does not say.
std::optional<Twins> stated_twins(const CellMesh& mesh);

/// Gives twins nodes of their own; what does not fit the surface is passed over.
/// \return per new node the node that it stands beside
std::vector<std::uint32_t> make_twins(const std::vector<TwinCorners>& twins, BrepData::Surface& surface);

}  // namespace geomend::topology
