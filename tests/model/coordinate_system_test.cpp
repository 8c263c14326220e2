// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/coordinate_system.h"

#include <gtest/gtest.h>

namespace geomend {
namespace {

TEST(CoordinateSystem, WhatIsNotStatedAgreesWithAnything) {
    CoordinateSystem a, b;
    a.name = "UTM 31N";
    EXPECT_EQ(disagreement(a, b, true), "");
    b.name = "Default";
    EXPECT_EQ(disagreement(a, b, true), "");
    b.name = "UTM 32N";
    EXPECT_NE(disagreement(a, b, true), "");
}

TEST(CoordinateSystem, UnitsAndSignsMayDisagree) {
    CoordinateSystem a, b;
    a.axis_units = {"m", "m", "m"};
    b.axis_units = {"m", "m", "ft"};
    EXPECT_NE(disagreement(a, b, false), "");
    b.axis_units = a.axis_units;
    b.z_positive = ZPositive::depth;
    EXPECT_EQ(disagreement(a, b, false), "");
    EXPECT_NE(disagreement(a, b, true), "");
}

}  // namespace
}  // namespace geomend
