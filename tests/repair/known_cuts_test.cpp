// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/known_cuts.h"

#include <gtest/gtest.h>

namespace geomend {
namespace {

using repair::KnownCuts;

TEST(KnownCuts, AreThoseOfTheSameSoupAndTheSameLengthsThatTookLong) {
    TriangleSoup soup;
    soup.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}};
    soup.patches = {0};
    arrangement::ArrangeOptions options;
    options.tolerance = 1e-3;
    arrangement::Arrangement cut;
    cut.soup = soup;
    cut.rounds = 2;
    KnownCuts cuts;
    cuts.add(soup, options, cut);
    EXPECT_EQ(cuts.find(soup, options), nullptr) << "what is soon done again is not kept";
    cut.rounds = 40;
    cuts.add(soup, options, cut);
    ASSERT_NE(cuts.find(soup, options), nullptr);
    EXPECT_EQ(cuts.find(soup, options)->rounds, 40u);
    TriangleSoup moved = soup;
    moved.vertices[1][0] = 2;
    EXPECT_EQ(cuts.find(moved, options), nullptr);
    options.tolerance = 2e-3;
    EXPECT_EQ(cuts.find(soup, options), nullptr);
}

}  // namespace
}  // namespace geomend
