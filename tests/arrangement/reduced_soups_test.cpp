// SPDX-License-Identifier: AGPL-3.0-or-later
// Soups that were cut wrongly once, each shrunk by hunt_soups; what they stand for is named.
#include <gtest/gtest.h>

#include <utility>

#include "arrangement/soup_faults.h"
#include "arrangement/soup_kinds.h"
#include "arrangement/soup_of.h"

namespace geomend::test {
namespace {

// Three triangles that meet in one point and are next to parallel: each of them placed it for itself, and the lens between the places was
// cut again and again.
TEST(ReducedSoups, TriplePointsOfTrianglesNextToParallelAreOne) {
    const auto one = soup_of({{0, 0, 0},
                              {-0.7601, -0.4007, 0.35853},
                              {-0.5907, 0.3977, 0.49136},
                              {0.1736, -0.6311, -0.29867},
                              {-0.73084, -0.0029, 0.45945},
                              {0.636, 0.06, -0.383},
                              {-0.8, 0.5, 0.7},
                              {0.13, -0.55, -0.25},
                              {-0.8, 0, 0.5}},
                             {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
    EXPECT_EQ(to_string(fault_in_child(one, 1e-7, 60)), "none");
    const auto other = soup_of({{0.1573, -0.2519, -0.2217},
                                {0.7607, -0.332, -0.806},
                                {-0.8109, -0.72513, 0.53555},
                                {-0.8325, 0.9377, 1.0546},
                                {0.32856, -0.74447, -0.52845},
                                {-0.0479, -0.9448, -0.239},
                                {-0.55, -0.96, 0.2},
                                {0, 0, -1},
                                {0.3, 0, 0}},
                               {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
    EXPECT_EQ(to_string(fault_in_child(other, 1e-5, 60)), "none");
}

// Four points of one triangle in a chain that bends by less than the tolerance: each diagonal between them passes by the next point, and
// whichever was drawn, the next look put that point on it.
TEST(ReducedSoups, ChainsNextToStraightDoNotGoRoundInCircles) {
    const auto soup = soup_of({{0.19853, -0.12267, 0.41204},
                               {0.06022, -0.83542, -0.80615},
                               {0, -1, -1},
                               {0.15017, -0.37188, -0.01389},
                               {0, -0.7, -0.6},
                               {0.116, -0.5355, -0.2943}},
                              {{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(to_string(fault_in_child(soup, 1e-6, 60)), "none");
}

// Two triangles next to parallel: late rounds made points one that were far apart, and two thirds of the second triangle went with them, in
// a cut that was called clean.
TEST(ReducedSoups, ACutThatLosesAreaIsMadeAnew) {
    const auto soup = soup_of({{-0.93, -0.464, 0.3695},
                               {0.0719, 0.2375, 0.03202},
                               {0.8354, -0.3152, -0.5514},
                               {0.693, 0.43703, -0.2482},
                               {0.70793, -0.23193, -0.45673},
                               {0.7754, -0.9465, -0.70799}},
                              {{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(to_string(fault_in_child(soup, 1e-3, 60)), "none");
}

// Many points a few tolerances apart: whatever was cut brought other pieces near, in ever more of them, and no sheet held them. They do not
// shrink: with a triangle less most of them end.
TEST(ReducedSoups, WhatGoesOnForEverIsShakenUntilItEnds) {
    for (const auto& [kind, seed] : {std::pair{"near_contacts", 1110u},
                                     {"clusters", 1007u},
                                     {"clusters", 1152u},
                                     {"clusters", 2090u},
                                     {"clusters", 2110u},
                                     {"clusters", 2116u},
                                     {"clusters", 2141u},
                                     {"flat_box", 1152u}}) {
        const auto [soup, tolerance] = random_soup(kind, seed);
        EXPECT_EQ(to_string(fault_in_child(soup, tolerance, 60)), "none") << kind << ' ' << seed;
    }
}

}  // namespace
}  // namespace geomend::test
