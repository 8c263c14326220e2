// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "topology/regions.h"
#include "topology/surface_complex.h"

namespace geomend::topology {

/// The regions of a model, by what says most of them: cells of volume entities, else stated lists of sides, else walking along
/// the surfaces. Adds layers and fault blocks over them, settles the Universe, and reports where claims disagree.
/// \pre lines and interfaces of the assembly are made
void make_regions(const SurfaceComplex& complex, Assembly& assembly);

}  // namespace geomend::topology
