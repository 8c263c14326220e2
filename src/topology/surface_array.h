// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "model/objects.h"

namespace geomend::topology {

/// Whether an array of a surface, called after surfaces, says to which one each polygon belongs, be it one for all (mesh_surfaces.h).
bool has_surface_array(const Surface& surface);

}  // namespace geomend::topology
