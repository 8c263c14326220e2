// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "base/vec3.h"

namespace geomend::topology {

/// The length up to which half of the weight lies, or another share of it (0 to 1): pairs of a length and its weight.
/// \pre not empty, lengths are finite. Cost: linear where lengths are spread, n log n where nearly all are alike.
double weighted_quantile(std::span<const std::pair<double, double>> lengths, double share);

/// The shape of a set of triangles, seen along the direction that most of its area faces.
struct Slab {
    /// The width between the heights below and above which a twentieth of the area lies; 0: all area lies in one plane.
    double thickness = 0;
    /// How many sheets lie on top of one another: the area seen along the direction over that of a rectangle or ellipse with the
    /// same second moments. About 1 for a sheet, also one in several patches; 2 and more for a body.
    double sheets = 0;
};

/// The direction is that of the largest eigenvalue of the sum of area times n n^T. A part of less than a twentieth of the area,
/// wherever it lies near the others, hardly changes the result, nor does how something is triangulated or turned. Cost: linear.
Slab slab_of(std::span<const std::array<Vec3, 3>> triangles);

/// By how much lengths are shortened in what is flat, as a basin is: of a body of several sheets that is thinner than D/5
/// 5 T/D, down to 1/100; of a single sheet, whose thickness says nothing, 1; between one and one and a half sheets in between.
double flatness(const Slab& slab, double diameter);

}  // namespace geomend::topology
