// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/triangle_sheets.h"

#include <gtest/gtest.h>

#include <set>

namespace geomend {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

grid::TriangleSheets sheets(const Triangles& triangles, bool may_turn = true, std::vector<std::uint64_t> planes = {}) {
    planes.resize(triangles.size());
    return grid::triangle_sheets(triangles, planes, may_turn);
}

TEST(TriangleSheets, HangTogetherAcrossEdgesAndNotAcrossPoints) {
    EXPECT_EQ(sheets({{0, 1, 2}, {2, 1, 3}}).count, 1u);
    const auto apart = sheets({{0, 1, 2}, {2, 3, 4}});
    EXPECT_EQ(apart.count, 2u);
    EXPECT_EQ(apart.sheet, (std::vector<std::uint32_t>{0, 1}));
}

TEST(TriangleSheets, TurnTheFewerOrEndWhereWindingChanges) {
    const Triangles strip{{0, 1, 2}, {2, 1, 3}, {2, 4, 3}};  // the last one against the others
    const auto turned = sheets(strip);
    EXPECT_EQ(turned.count, 1u);
    EXPECT_EQ(turned.turned, (std::vector<std::uint8_t>{0, 0, 1}));
    const auto kept = sheets(strip, false);
    EXPECT_EQ(kept.sheet, (std::vector<std::uint32_t>{0, 0, 1}));
    EXPECT_EQ(kept.turned, (std::vector<std::uint8_t>{0, 0, 0}));
}

TEST(TriangleSheets, EndWhereThreeMeet) { EXPECT_EQ(sheets({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}).count, 3u); }

// A strip that comes round and ends on its own middle, as faults between columns can: a wall between points (p, p + 100).
TEST(TriangleSheets, ThatMeetThemselvesArePartedByPlanes) {
    Triangles triangles;
    std::vector<std::uint64_t> planes;
    const auto wall = [&](std::uint32_t a, std::uint32_t b, std::uint64_t plane) {
        triangles.push_back({a, b, b + 100});
        triangles.push_back({a, b + 100, a + 100});
        planes.insert(planes.end(), {plane, plane});
    };
    wall(0, 1, 0);
    wall(1, 2, 0);
    wall(2, 3, 1);
    wall(3, 4, 2);
    wall(4, 1, 3);  // back to where the first two meet
    const auto parted = sheets(triangles, true, planes);
    // What comes from wall (0,1) ends at the edge; the loop from (1,2) to (4,1) ends there with both of its ends.
    EXPECT_GE(parted.count, 2u);
    EXPECT_NE(parted.sheet[0], parted.sheet[2]);
    // Two walls in a row and the way back, all of one sheet: (0,1) joins the loop by a bridge around the edge.
    wall(0, 5, 4);
    wall(5, 2, 5);
    const auto ring = sheets(triangles, true, planes);
    std::set<std::uint32_t> around{ring.sheet[0], ring.sheet[2], ring.sheet[8]};
    EXPECT_GT(around.size(), 1u) << "three triangles at one edge are not all of one sheet";
}

TEST(TriangleSheets, OfAMoebiusStripStayAsTheyAre) {
    Triangles strip;
    constexpr std::uint32_t n = 5;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = i, b = i + n, c = i + 1 < n ? i + 1 : n, d = i + 1 < n ? i + 1 + n : 0;
        strip.push_back({a, c, b});
        strip.push_back({b, c, d});
    }
    EXPECT_EQ(sheets(strip).count, 1u);
}

}  // namespace
}  // namespace geomend
