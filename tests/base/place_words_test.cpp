// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/place_words.h"

#include <gtest/gtest.h>

namespace geomend {
namespace {

TEST(PlaceWords, FindAPlaceInMapCoordinates) {
    EXPECT_EQ(place_words({453001, 6780123.4567, -1999.62}), "(453001, 6780123.457, -1999.62)");
    EXPECT_EQ(place_words({1e6, 1e9, 0}), "(1000000, 1000000000, 0)");
    EXPECT_EQ(coordinate(6780123.4567), "6780123.457");
    EXPECT_EQ(coordinate(999999999999999), "999999999999999");
    EXPECT_EQ(coordinate(-1e15), "-1e+15");
}

TEST(PlaceWords, ShowSmallModelsAndNoErrorsOfRounding) {
    EXPECT_EQ(place_words({2, 1.5, 0.1F}), "(2, 1.5, 0.1)");
    EXPECT_EQ(place_words({1.0 / 3, -1e-17, 0.0}), "(0.33333333, 0, 0)");
    EXPECT_EQ(place_words({0.0, -0.0, 0.0}), "(0, 0, 0)");
    EXPECT_EQ(coordinate(0.0000123456), "0.0000123456");
    EXPECT_EQ(coordinate(-31.2), "-31.2");
}

}  // namespace
}  // namespace geomend
