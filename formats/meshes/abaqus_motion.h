// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/vec3.h"

namespace geomend::meshes {

/// Where an INSTANCE of an input deck of Abaqus puts a part: it is shifted first, then turned by the right hand around an axis.
struct AbaqusMotion {
    Vec3 shift{};
    Vec3 on_axis{}, axis{0, 0, 1};  ///< a point of the axis and its direction, of any length but none
    double degrees = 0;

    /// Turns by multiples of 90 degrees around an axis of coordinates add no errors of sines.
    Vec3 moved(const Vec3& p) const;
};

}  // namespace geomend::meshes
