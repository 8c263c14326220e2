// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "pipeline/load.h"
#include "support/real_data.h"
#include "validators/layered_model.h"
#include "validators/rewritten.h"

// What is wrong with a model does not depend on the order of its parts, on where it stands, how large it is, or how it is
// turned.

namespace geomend {
namespace {

using namespace testing;

void expect_one_verdict(const Dataset& data) {
    const Verdict known = verdict(data);
    for (unsigned seed = 0; seed < 5; ++seed) {
        std::mt19937 random(seed);
        EXPECT_EQ(verdict(shuffled(data, random)), known) << "in another order of triangles and points";
        EXPECT_EQ(verdict(turned(data, random)), known) << "turned over";
        EXPECT_EQ(verdict(other_order(data, random)), known) << "in another order of surfaces";
    }
    for (const double scale : {1e-3, 1e3}) {
        EXPECT_EQ(verdict(moved(data, [&](const Vec3& p) { return Vec3{scale * p[0], scale * p[1], scale * p[2]}; })), known) << scale;
    }
    EXPECT_EQ(verdict(moved(data, rotated)), known) << "rotated";
}

TEST(Verdict, OfASoundModelIsTheSameHoweverItIsWritten) {
    LayeredModel model;
    expect_one_verdict(model.data());
    EXPECT_EQ(verdict(on_the_map(model.data(), 1000)), verdict(model.data()));
}

TEST(Verdict, OfAnUnsoundModelIsTheSameHoweverItIsWritten) {
    LayeredModel model;
    Surface& lower = model.surface("lower");
    lower.points[7][2] += 1;  // through the next horizon
    Surface& east = model.surface("east");
    add_triangle(east, east.polygons.corners[0], east.polygons.corners[1], east.polygons.corners[1]);
    auto& corners = model.surface("west").polygons.corners;
    corners.erase(corners.begin(), corners.begin() + 3);
    for (auto& part : model.surface("west").parts) part.first_polygon -= part.first_polygon > 0 ? 1 : 0;
    const Verdict known = verdict(model.data());
    EXPECT_GE(known.findings.size(), 5u) << known;
    expect_one_verdict(model.data());
    EXPECT_EQ(verdict(on_the_map(model.data(), 1000)), known);
}

TEST(Verdict, OfRealModelsIsTheSameHoweverTheyAreWritten) {
    const auto file = test::real_data("gocad/modelA1.ml");
    if (!file) GTEST_SKIP() << "no real data here";
    const auto data = load(file->string(), {});
    ASSERT_TRUE(data);
    expect_one_verdict(*data);
    EXPECT_EQ(verdict(on_the_map(*data, 1)), verdict(*data));
}

}  // namespace
}  // namespace geomend
