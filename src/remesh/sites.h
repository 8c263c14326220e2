// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "remesh/remesh.h"

namespace geomend::remeshing {

/// Gives all models new triangles: with the size of the options, or, where they ask for a number of vertices, with one that is found for
/// it: first that which as many equilateral triangles have on the same area, then larger or smaller ones until sizes with too many and
/// with too few vertices are known, and sizes between them, until the number is within a twentieth, or no size is left to try (lines that
/// are close need vertices beside them whatever the size): what came nearest is taken. Vertices of
/// lines come on top, as a site at a line has a vertex on the line and one beside it in J. Pellerin's thesis (2014). Sizes by names hold.
/// \param options their size is set then \return what comes of each model. Failures as of remesh_model(), or (cannot_hold, F026) without
/// area. Cost: that of remesh_model(), up to fourteen times for a number of vertices.
Result<std::vector<Remeshed>> remesh_models(std::span<const BrepData* const> models, RemeshOptions& options);

/// The vertices of surfaces, each once.
struct VertexCounts {
    std::uint64_t all = 0, inside = 0;  ///< inside: on no line
};
VertexCounts vertices_of_surfaces(const BrepData& brep);

}  // namespace geomend::remeshing
