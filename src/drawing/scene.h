// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "model/dataset.h"
#include "report/scene.h"

namespace geomend {

/// What a report may draw of a dataset: surfaces, lines and corners of the B-Reps, and the objects that no B-Rep is built
/// from (loose surfaces, the outside of meshes of cells, outside and faults of corner-point grids, points, lines, wells).
/// Elevation-up, complete: nothing is thinned. No marks yet. Cost: near-linear.
Scene make_scene(const Dataset& dataset, std::span<const Brep> breps);
inline Scene make_scene(const Dataset& dataset) { return make_scene(dataset, dataset.breps); }

/// Gives the scene a mark for each finding: its points and lines, and the elements behind its `index`, which count in the
/// arrays of its first entity. That one is found by kind and name, and by id where it has one: a surface, line, corner or
/// region of a B-Rep, else an object of that name. What cannot be found, or is out of range, is left out.
void mark_findings(Scene& scene, const Dataset& dataset, std::span<const Brep> breps, std::span<const Finding> findings);
inline void mark_findings(Scene& scene, const Dataset& dataset, std::span<const Finding> findings) {
    mark_findings(scene, dataset, dataset.breps, findings);
}

}  // namespace geomend
