// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/vec3.h"

namespace geomend::test {

/// A sheet of n by n squares, each in two triangles, over a parallelogram; its points may be moved.
struct Sheet {
    std::string name;
    Vec3 corner{}, u{}, v{};  ///< a corner and its two sides
    int n = 4;
    std::string role;                         ///< a word of Gocad (fault, top, boundary); empty: none
    std::function<Vec3(const Vec3&)> move{};  ///< where a point goes
};

/// A sheet as a Gocad TSurf; numbers read back to the same value.
std::string tsurf_text(const Sheet& sheet);

/// A horizontal sheet across a box from the origin to (size, size), named and as fine as told; a horizon.
Sheet level(const std::string& name, double z, int n = 5, double size = 10);

/// The six sides of the box from the origin to (size, size, size), side_0 to side_5 (low and high of x, y, z), with the role
/// boundary unless told otherwise.
/// \param shaken largest random displacement of each coordinate of each point, each side by itself
std::string box_text(double shaken = 0, const std::string& role = "boundary", double size = 10);

}  // namespace geomend::test
