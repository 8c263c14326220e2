// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "model/brep.h"
#include "repair/model_changes.h"
#include "report/changes.h"

namespace geomend {

/// Puts what a repair did into the scene of its result: points that moved get how far, triangles that were added and edges
/// at which surfaces were cut or joined become parts of their own, of the same kind and name. Points are found again by their positions, in
/// the surface of that name. \param scene as make_scene() makes it of these boundary representations, first. Cost: near-linear.
void mark_changes(Scene& scene, std::span<const Brep> breps, const repair::ModelChanges& changes);

/// What a report says of changes; the scene of what was read gets what was left out or erased as parts of their own.
ReportedChanges reported_changes(Scene before, const repair::ModelChanges& changes);

}  // namespace geomend
