// SPDX-License-Identifier: AGPL-3.0-or-later
#include "horizon/horizon_test.h"

namespace geomend::test {
namespace {

const PolylineSet& lines_of(const Dataset& d) { return std::get<PolylineSet>(d.objects.at(0)); }

constexpr std::string_view two =
    "0 0 -1\n"
    "1 0 -1\n"
    "1 1 -1\n"
    "0 0 -1\n"
    "999.0 999.0 999.0\n"
    "5 5 0.1\n"
    "6 6 0.2\n"
    "999.0 999.0 999.0\n";

TEST(IrapPolygons, OpenAndClosedOnesGoOutAndComeBack) {
    const Dataset d = good("irap-polygons", two);
    ASSERT_EQ(lines_of(d).parts.size(), 2);
    EXPECT_EQ(lines_of(d).points.size(), 5);
    using Edges = std::vector<std::array<std::uint32_t, 2>>;
    EXPECT_EQ(lines_of(d).edges, (Edges{{0, 1}, {1, 2}, {2, 0}, {3, 4}}));
    EXPECT_EQ(well_written("irap-polygons", d).bytes, two);
}

TEST(IrapPolygons, TheLastSeparatorMayBeMissing) {
    const Dataset d = good("irap-polygons", two.substr(0, two.size() - 18));
    EXPECT_EQ(lines_of(d).parts.size(), 2);
    EXPECT_EQ(well_written("irap-polygons", d).bytes, two);
}

TEST(IrapPolygons, DepthsAreNegatedAndSeparatorsAreNot) {
    const Dataset d = good("irap-polygons", two, {{"z", "depth"}});
    EXPECT_EQ(lines_of(d).points[0][2], 1);
    EXPECT_EQ(well_written("irap-polygons", d).bytes, two);
}

TEST(IrapPolygons, EmptyOnesAreTold) {
    EXPECT_TRUE(has_finding(good("irap-polygons", std::string(two) + "999.0 999.0 999.0\n"), "F119"));
    EXPECT_EQ(read("irap-polygons", "999 999 999\n").why().error.code, "F017");
    EXPECT_EQ(read("irap-polygons", "\n").why().error.code, "F017");
}

TEST(IrapPolygons, WrongRowsAreTold) {
    EXPECT_EQ(read("irap-polygons", "1 2\n").why().error.code, "F012");
    EXPECT_EQ(read("irap-polygons", "1 2 3 4\n").why().error.code, "F012");
    EXPECT_EQ(read("irap-polygons", "1 2 1.#INF\n").why().error.code, "F006");
}

TEST(IrapPolygons, BranchesAndLonePointsBecomeLinesOfTheirOwn) {
    PolylineSet set;
    set.info.name = "Top_A";
    set.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {7, 7, 7}};
    set.edges = {{0, 1}, {1, 2}, {1, 3}};
    Dataset d;
    d.objects.emplace_back(set);
    const Written w = well_written("irap-polygons", d);
    EXPECT_EQ(w.bytes, "0 0 0\n1 0 0\n2 0 0\n999.0 999.0 999.0\n1 0 0\n1 1 0\n999.0 999.0 999.0\n7 7 7\n999.0 999.0 999.0\n");
    EXPECT_TRUE(has_loss(w.losses, LossClass::identity, "which lines make a part"));
}

TEST(IrapPolygons, APointThatLooksLikeASeparatorIsALoss) {
    PolylineSet set;
    set.points = {{999, 999, 999}, {1, 1, 1}};
    set.edges = {{0, 1}};
    Dataset d;
    d.objects.emplace_back(set);
    EXPECT_EQ(substance(well_written("irap-polygons", d).losses), 1);
    EXPECT_EQ(substance(well_written("cps3-lines", d).losses), 0);
}

}  // namespace
}  // namespace geomend::test
