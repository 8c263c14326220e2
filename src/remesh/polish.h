// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>

#include "remesh/work_surface.h"

namespace geomend::remeshing {

/// Works on triangles with an angle below so many degrees: edges of them are turned, vertices inside of the surface move along it or
/// give way. What is done makes the least angle around it larger, so that it ends. Borders stay, nothing folds.
/// \return the number of changes. Cost: that of finding these triangles, and some 20 microseconds for each, for few rounds.
std::size_t polish_triangles(WorkSurface& work, double degrees);

}  // namespace geomend::remeshing
