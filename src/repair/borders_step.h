// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "repair/surface_steps.h"

namespace geomend::repair {

/// Gives lines at which several surfaces end their coarsest common discretisation, after N. Euler (thesis, 4.4 to 4.7): a row of the
/// table of steps.
Result<StepOutcome> simplify_borders(SurfaceModel&, const SurfaceStepOptions&);

}  // namespace geomend::repair
