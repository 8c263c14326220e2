// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/vec3.h"

namespace geomend::topology {

/// Sign of the volume of the tetrahedron a, b, c, d, exactly: +1 where d lies on the side that the normal of a, b, c
/// (right-hand rule) points into, -1 on the other, 0 in the plane. \pre finite, and no product of three differences
/// overflows or underflows. Cost: a filter that nearly always decides; else a sum of 192 terms.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace geomend::topology
