// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/abaqus_motion.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/vectors.h"

namespace geomend::meshes {

Vec3 AbaqusMotion::moved(const Vec3& p) const {
    const Vec3 shifted = plus(p, shift);
    if (degrees == 0) return shifted;
    const double quarters = degrees / 90, turn = degrees * std::numbers::pi / 180;
    double cosine = std::cos(turn), sine = std::sin(turn);
    if (quarters == std::nearbyint(quarters)) {
        constexpr std::array<double, 4> sines{0, 1, 0, -1};
        const auto quarter = static_cast<std::size_t>(std::fmod(std::fmod(quarters, 4) + 4, 4));
        sine = sines[quarter];
        cosine = sines[(quarter + 1) % 4];
    }
    const Vec3 unit = times(1 / std::sqrt(dot(axis, axis)), axis), arm = minus(shifted, on_axis);
    const Vec3 along = times(dot(unit, arm), unit);
    return plus(on_axis, plus(along, plus(times(cosine, minus(arm, along)), times(sine, cross(unit, arm)))));
}

}  // namespace geomend::meshes
