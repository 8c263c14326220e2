// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/vec3.h"

namespace geomend::remeshing {

/// What sizes depend on beside the part of the model that they are of. After A. Botella, thesis (2016), section 2.4.1, with the cases of
/// its equation 2.2 in the order that its text states.
struct SizeRule {
    enum class Kind : unsigned char {
        distance,   ///< from a surface or interface
        curvature,  ///< of surfaces
        property,   ///< of surfaces, at their nodes
        field       ///< any, by places
    };
    Kind kind = Kind::distance;
    std::string name;                            ///< of the surface or interface, or of the property
    double size = 0;                             ///< distance: at the surface; property: where its value is least
    double largest = 0;                          ///< property: where its value is largest
    double thickness = 0;                        ///< distance: so far from the surface the size stays
    double ratio = 0.8;                          ///< distance: sizes of neighbours differ by so much, above 0 and below 1
    double exponent = 1;                         ///< distance: how sizes change between that zone and the rest
    double degrees = 15;                         ///< curvature: an edge turns by no more
    std::function<double(const Vec3&)> field{};  ///< field: the size at a place
};

/// Over which way a size becomes another one: the sum of sizes that change by a ratio until the next one would not be nearer to it.
/// \param ratio above 0 and below 1  \pre sizes above 0
double influence_zone(double from_size, double to_size, double ratio);

/// The size at a distance from a surface with a rule, where it is `elsewhere` far from it.
double size_at_distance(const SizeRule& rule, double distance, double elsewhere);

}  // namespace geomend::remeshing
