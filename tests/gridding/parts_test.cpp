// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "gridding/fault_trace.h"
#include "gridding/layers.h"
#include "gridding/made_models.h"

namespace geomend::gridding {
namespace {

using namespace test;

TEST(Plan, NearestPlaceKnowsItsSideAndWhetherItIsBeyondAnEnd) {
    const Path path{{0, 0}, {10, 0}, {10, 10}};
    EXPECT_EQ(nearest_on(path, {4, 3}).distance, 3);
    EXPECT_GT(nearest_on(path, {4, 3}).left, 0);
    EXPECT_LT(nearest_on(path, {4, -3}).left, 0);
    EXPECT_TRUE(nearest_on(path, {-2, 1}).before_first);
    EXPECT_TRUE(nearest_on(path, {10, 12}).after_last);
    EXPECT_FALSE(nearest_on(path, {12, -2}).after_last);
    EXPECT_LT(nearest_on(path, {12, -2}).left, 0);  // outside of the corner
    EXPECT_EQ(nearest_on(path, {12, 5}).along, 15);
}

TEST(Plan, ThePartOfAPathWithinARing) {
    const Path ring{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    const Path inside = longest_inside(Path{{-5, 5}, {4, 5}, {4, 12}}, ring);
    ASSERT_EQ(inside.size(), 3u);
    EXPECT_EQ(inside[0], (Point{0, 5}));
    EXPECT_EQ(inside[2], (Point{4, 10}));
    EXPECT_TRUE(longest_inside(Path{{-5, 5}, {-4, 5}}, ring).empty());
    EXPECT_EQ(longest_inside(Path{{1, 1}, {2, 2}}, ring), (Path{{1, 1}, {2, 2}}));
}

TEST(Plan, HullBoxAndStrike) {
    EXPECT_EQ(convex_hull({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}}).size(), 4u);
    const auto box = smallest_box({{0, 0}, {3, 3}, {2, 4}, {-1, 1}});
    EXPECT_NEAR(box.rotation, 45, 1e-9);
    EXPECT_NEAR(box.share, 1, 1e-12);
    EXPECT_NEAR(dominant_strike({{{0, 0}, {100, 100}}, {{0, 0}, {-50, 50}}}), 45, 1e-9);
    EXPECT_EQ(dominant_strike({{{0, 0}, {100, 0}}, {{0, 0}, {0, 50}}}), 0);
}

TEST(FaultTrace, TheMiddleOfARingLeadsFromTipToTip) {
    Path ring;
    for (int k = 0; k <= 10; ++k) ring.push_back({10.0 * k, 4 * std::sin(k * 3.14159265358979 / 10)});
    for (int k = 9; k > 0; --k) ring.push_back({10.0 * k, -2 * std::sin(k * 3.14159265358979 / 10)});
    const Path line = centreline(ring);
    EXPECT_EQ(line.front(), ring[0]);
    EXPECT_EQ(line.back(), ring[10]);
    for (const Point& p : line) EXPECT_NEAR(p[1], std::sin(p[0] * 3.14159265358979 / 100), 0.1);
}

TEST(FaultTrace, TheLevelLineOfADippingSheet) {
    Sheet sheet;
    for (int j = 0; j <= 4; ++j) {
        for (int i = 0; i <= 2; ++i) sheet.vertices.push_back({10.0 * i, 25.0 * j, 100.0 * i});
    }
    for (std::uint32_t j = 0; j < 4; ++j) {
        for (std::uint32_t i = 0; i < 2; ++i) {
            const std::uint32_t a = i + 3 * j;
            sheet.triangles.push_back({a, a + 1, a + 3});
            sheet.triangles.push_back({a + 1, a + 4, a + 3});
        }
    }
    const Path line = level_line(sheet, 50);
    EXPECT_NEAR(length(line), 100, 1e-9);
    for (const Point& p : line) EXPECT_NEAR(p[0], 5, 1e-9);
    EXPECT_TRUE(level_line(sheet, 500).empty());
}

TEST(Layers, WithoutEndAreRefusedWithTheirNumber) {
    for (const auto& [rule, number] :
         {std::pair{"from-top:1e-9", "4e+10"}, {"from-base:1e-9", "4e+10"}, {"from-top:1e-320", "without number"}}) {
        const auto rules = parse_layers(rule);
        ASSERT_TRUE(rules.ok()) << rule;
        const auto count = layer_count(rules->front(), 40, "upper");
        ASSERT_FALSE(count.ok()) << rule;
        EXPECT_EQ(count.why().kind, FailureKind::usage);
        const std::string& message = count.why().error.message;
        EXPECT_NE(message.find(number), std::string::npos) << message;
        EXPECT_NE(message.find("zone 'upper' is 40 thick"), std::string::npos) << message;
    }
    const auto counted_rule = parse_layers("from-top:1e-9:5");
    EXPECT_EQ(*layer_count(counted_rule->front(), 40, "upper"), 5u) << "a number of layers is an end";
    const auto most = parse_layers("from-top:1e-6");
    EXPECT_EQ(*layer_count(most->front(), 1, "upper"), most_layers);
}

TEST(Layers, RulesAreReadAndWrongOnesNamed) {
    const auto rules = parse_layers("upper=proportional:10,from-top:2.5,lower=from-base:4:3");
    ASSERT_TRUE(rules.ok());
    ASSERT_EQ(rules->size(), 3u);
    EXPECT_EQ((*rules)[0].zone, "upper");
    EXPECT_EQ((*rules)[0].count, 10u);
    EXPECT_EQ((*rules)[1].rule, ZoneLayers::Rule::from_top);
    EXPECT_EQ(*layer_count((*rules)[1], 10, "upper"), 4u);
    EXPECT_EQ(*layer_count((*rules)[1], 10.1, "upper"), 5u);
    EXPECT_EQ((*rules)[2].count, 3u);
    for (const char* wrong :
         {"", "a=", "proportional", "proportional:0", "proportional:x", "from-top:-1", "from-top:inf", "top:3", "a=from-base:1:2:3"}) {
        const auto refused = parse_layers(wrong);
        ASSERT_FALSE(refused.ok()) << wrong;
        EXPECT_EQ(refused.why().kind, FailureKind::usage) << wrong;
    }
}

TEST(Layers, HorizonsInOrder) {
    const auto order = [](std::vector<double> depths, std::vector<std::uint8_t> erodes, std::vector<std::uint8_t> lapped) {
        put_in_order(depths, erodes, lapped);
        return depths;
    };
    EXPECT_EQ(order({1, 5, 3}, {0, 0, 0}, {0, 0, 0}), (std::vector<double>{1, 5, 5}));
    EXPECT_EQ(order({1, 5, 3}, {0, 0, 0}, {0, 0, 1}), (std::vector<double>{1, 3, 3}));
    EXPECT_EQ(order({4, 2, 3}, {1, 0, 0}, {0, 0, 0}), (std::vector<double>{4, 4, 4}));
    EXPECT_EQ(order({4, 2, 3}, {0, 0, 0}, {0, 1, 0}), (std::vector<double>{2, 2, 3}));
}

TEST(Cells, ThinOnesAreJoinedWithinTheirZone) {
    const Structure structure{{map("top", 11, 3, 100, [](double, double) { return 1000.0; }),
                               map("base", 11, 3, 100, [](double x, double) { return 1040 - 0.03 * x; })},
                              {}};
    GridOptions options;
    options.zones = {proportional(4)};
    options.min_thickness = 5;
    const auto made = build_grid(structure, net(10, 2, 100, 100), options);
    ASSERT_TRUE(made.ok());
    EXPECT_GT(made->report.joined_cells, 0u);
    EXPECT_NEAR(made->report.zones[0].volume, 200 * 1000 * 25.0, 1e-6);
    for (std::size_t c = 0; c < made->grid.cell_count(); ++c) {
        const auto [i, j, k] = made->grid.ijk(c);
        const auto corners = cell_corners(made->grid, i, j, k);
        double most = 0;
        for (unsigned q = 0; q < 4; ++q) most = std::max(most, corners[q + 4][2] - corners[q][2]);
        EXPECT_TRUE(most == 0 || most >= 5) << i << ' ' << k << ' ' << most;
        EXPECT_EQ(made->grid.is_active(c), most > 0);
        if (k == 3) {
            EXPECT_NEAR(corners[4][2], 1040 - 0.03 * corners[4][0], 1e-9);
        }
    }
}

TEST(Chains, ABranchEndsOnItsMainFaultAndChainsShareNoEdge) {
    const auto chains = make_chains(net(20, 20, 50, 50), {{{500, 300}, {880, 620}}, {{480, -10}, {510, 1010}}}, 0);
    const auto& branch = chains.chains[0];
    const auto& main = chains.chains[1];
    ASSERT_FALSE(branch.pillars.empty());
    EXPECT_EQ(branch.ends_on, std::vector<std::uint32_t>{1});
    EXPECT_NE(std::ranges::find(main.pillars, branch.pillars.front()), main.pillars.end());
    EXPECT_EQ(branch.shared_edges, 0u);
    EXPECT_EQ(std::ranges::count(chains.edges.along_i, 0) + std::ranges::count(chains.edges.along_j, 0),
              static_cast<std::ptrdiff_t>(branch.pillars.size()) - 1);
}

TEST(Chains, ABranchAtASmallAngleEndsWhereItReachesItsMainFault) {
    // For its last 300 the branch runs less than a cell beside the main fault.
    const auto chains = make_chains(net(30, 20, 50, 50), {{{0, 505}, {1500, 505}}, {{300, 900}, {700, 540}, {1000, 508}}}, 0);
    const auto& main = chains.chains[0].pillars;
    const auto& branch = chains.chains[1];
    ASSERT_GT(branch.pillars.size(), 5u);
    EXPECT_EQ(branch.shared_edges, 0u);
    EXPECT_LT(branch.max_deviation, 0.75 * 50);
    const auto on_main = [&](std::uint32_t p) { return std::ranges::find(main, p) != main.end(); };
    EXPECT_EQ(std::ranges::count_if(branch.pillars, on_main), 1);
    EXPECT_TRUE(on_main(branch.pillars.back()));
}

TEST(Chains, WhatIsNotInTheGridSaysWhy) {
    const auto chains = make_chains(net(5, 5, 100, 100), {{{900, 0}, {900, 500}}, {}, {{210, 205}, {220, 215}}}, 0);
    EXPECT_EQ(chains.chains[0].why_not, "it lies outside of the grid");
    EXPECT_EQ(chains.chains[1].why_not, "it has no trace");
    EXPECT_EQ(chains.chains[2].why_not, "it is shorter than a cell");
}

}  // namespace
}  // namespace geomend::gridding
