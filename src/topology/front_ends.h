// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "topology/surface_complex.h"
#include "topology/welded_points.h"

// From what a Dataset holds to surfaces over welded vertices. One function, and one file, for each kind of source; the Dataset
// must outlive what they give.

namespace geomend::topology {

/// A model that the file states over surfaces and entities of any number of cell meshes. Claims about things that are not there
/// are passed over. The boundary of a grid (grid/boundary_model) comes in this form, too.
/// \param groups the objects of objects_of(), each in one group
/// Cost: linear in the objects.
SurfaceComplex complex_of_stated_model(const Dataset& dataset, const StatedModel& model, std::span<const WeldGroup> groups);

/// The objects that a stated model is about, ascending: those of its faces, and meshes whose cells fill a region of their name.
std::vector<std::uint32_t> objects_of(const Dataset& dataset, const StatedModel& model);

/// A cell mesh whose entities say all. \pre the group is one CellMesh. Cost: linear.
SurfaceComplex complex_of_tagged_mesh(const Dataset& dataset, const WeldGroup& group);

/// Whether arrays that are called after surfaces tell the surfaces of one object apart (surfaces_by_array()).
enum class Arrays : std::uint8_t { are_values, tell_apart };

/// Surfaces that belong to no model: one face for each part. Surfaces whose triangles have points of their own, as STL files
/// have it, are joined where points are equal (M08). \pre all are surfaces. Cost: linear.
SurfaceComplex complex_of_loose_surfaces(const Dataset& dataset, std::span<const WeldGroup> groups, Arrays arrays);

}  // namespace geomend::topology
