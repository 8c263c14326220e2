// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "model/brep.h"
#include "model/loss.h"
#include "remesh/line_plan.h"
#include "remesh/surface_job.h"

namespace geomend::remeshing {

/// The triangles of new surfaces over common vertices, by the names that lines gave.
struct NewVertices {
    std::vector<Vec3> places;
    std::vector<std::uint32_t> number;           ///< per name; no_index: not used
    std::vector<std::vector<std::uint32_t>> of;  ///< per surface and vertex of it
};
/// Named vertices that anything uses, ascending, then those inside of surfaces, surface by surface.
NewVertices new_vertices(const BrepData& brep, const LinePlan& lines, std::span<const NewSurface> surfaces);

/// The model with these lines and surfaces. Cells of its regions are gone, which `losses` then says.
BrepData new_brep(const BrepData& brep, const LinePlan& lines, std::span<const NewSurface> surfaces, std::vector<Loss>& losses);

}  // namespace geomend::remeshing
