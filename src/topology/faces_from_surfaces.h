// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "model/dataset.h"
#include "topology/welded_points.h"

namespace geomend::topology {

/// The values of an attribute for some of its things, in the order of `indices`. \pre each index is in range
Attribute restricted(const Attribute& attribute, const std::vector<std::uint32_t>& indices, AttributeLocation location);

/// Adds one B-Rep surface for a part of a Surface: all points of the part are its nodes, in their order, then
/// those of other parts that its polygons use. Attributes are cut to the part.
/// \param vertex_of per point of the surface its model vertex
BrepData::Surface surface_of_part(const Surface& surface, std::uint32_t part, const std::vector<std::uint32_t>& vertex_of);

/// The same as a face, without names and role. \pre the surface is object `object` of the Dataset that the points are of
SurfaceComplex::Face face_of_part(const Surface& surface, std::uint32_t object, std::uint32_t part, const WeldedPoints& points);

/// Some polygons of a Surface as a face, without names and role; its nodes are the points that they use, ascending.
/// \param polygons ascending numbers of polygons; \pre as of face_of_part(). Cost: n log n in the polygons.
SurfaceComplex::Face face_of_polygons(const Surface& surface, std::uint32_t object, const std::vector<std::uint32_t>& polygons,
                                      const WeldedPoints& points);

/// Adds the border corners that a surface states, as hints where closed lines have their corners.
void add_corner_hints(const Object& object, const std::vector<std::uint32_t>& vertex_of, SurfaceComplex& complex);

/// Number of parts: at least 1.
std::size_t part_count(const Surface& surface);

}  // namespace geomend::topology
