// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gridding/made_models.h"
#include "gridding/smooth.h"

namespace geomend::gridding {
namespace {

TEST(Smooth, B1_WeightsOfTriangles) {
    const auto right = half_cotangents({0, 0}, {1, 0}, {0, 1});
    EXPECT_NEAR(right[0], 0, 1e-15);
    EXPECT_NEAR(right[1], 0.5, 1e-15);
    EXPECT_NEAR(right[2], 0.5, 1e-15);
    const double h = std::sqrt(3) / 2;
    for (const double g : half_cotangents({0, 0}, {1, 0}, {0.5, h})) EXPECT_NEAR(g, 0.288675, 1e-6);
    const std::vector<Point> two{{0, 0}, {1, 0}, {0.5, h}, {0.5, -h}};
    const DirichletWeights weights(two, std::vector<PlanTriangle>{{0, 1, 2}, {1, 0, 3}});
    EXPECT_NEAR(weights.weight(0, 1), 0.577350, 1e-6);
    EXPECT_NEAR(weights.weight(1, 2), 0.288675, 1e-6);
    EXPECT_EQ(weights.weight(2, 3), 0);
}

std::vector<Point> lattice(std::uint32_t nx, std::uint32_t ny, double step) {
    std::vector<Point> places;
    for (std::uint32_t j = 0; j <= ny; ++j) {
        for (std::uint32_t i = 0; i <= nx; ++i) places.push_back({i * step, j * step});
    }
    return places;
}

TEST(Smooth, B2_ASquareNetHasTheFivePointStencil) {
    const DirichletWeights weights(lattice(4, 4, 1), net_triangles(4, 4));
    const std::uint32_t middle = 2 + 5 * 2;
    for (const std::uint32_t beside : {middle - 1, middle + 1, middle - 5, middle + 5})
        EXPECT_NEAR(weights.weight(middle, beside), 1, 1e-15);
    EXPECT_NEAR(weights.weight(middle, middle + 6), 0, 1e-15);
    EXPECT_NEAR(weights.weight(middle, middle - 6), 0, 1e-15);
    EXPECT_EQ(weights.negative(), 0u);
}

TEST(Smooth, B3_AffineMapsOfTheBorderGoOnInside) {
    auto places = lattice(9, 7, 3);
    for (std::size_t p = 0; p < places.size(); ++p) places[p][0] += 0.3 * std::sin(static_cast<double>(p));  // an uneven net
    const DirichletWeights weights(places, net_triangles(9, 7));
    std::vector<std::uint8_t> fixed(places.size(), 0);
    std::vector<double> values(places.size(), 0);
    const auto map = [](const Point& p) { return 4 + 0.7 * p[0] - 0.2 * p[1]; };
    for (std::uint32_t p = 0; p < places.size(); ++p) {
        fixed[p] = p % 10 == 0 || p % 10 == 9 || p < 10 || p >= 70 ? 1 : 0;
        if (fixed[p] != 0) values[p] = map(places[p]);
    }
    weights.make_harmonic(fixed, values);
    for (std::size_t p = 0; p < places.size(); ++p) EXPECT_NEAR(values[p], map(places[p]), 1e-11);
}

TEST(Smooth, B4_EnergyIsAreaTimesTheSquareOfTheGradient) {
    const auto places = lattice(5, 5, 0.2);
    const DirichletWeights weights(places, net_triangles(5, 5));
    std::vector<double> x, mixed;
    for (const Point& p : places) {
        x.push_back(p[0]);
        mixed.push_back(2 * p[0] - p[1]);
    }
    EXPECT_NEAR(weights.energy(x), 1, 1e-12);
    EXPECT_NEAR(weights.energy(mixed), 5, 1e-12);
}

TEST(Smooth, B5_ObtuseAnglesAreFlagged) {
    const double h = std::sqrt(3) / 2;
    const std::vector<Point> places{{0, 0}, {1, 0}, {-0.5, h}};
    const DirichletWeights weights(places, std::vector<PlanTriangle>{{0, 1, 2}});
    EXPECT_NEAR(weights.weight(1, 2), -0.288675, 1e-6);
    EXPECT_EQ(weights.negative(), 1u);
}

TEST(Smooth, B6_BordersMeetHalfwayAndFixedNodesStay) {
    Path square{{0, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {2, 4}, {0, 4}, {0, 2}};
    Path shifted = square;
    for (Point& p : shifted) p[0] += 0.4;
    std::vector<Path> levels{square, shifted};
    // Corners are fixed halfway; the node in the middle of the lower side lies on a fault.
    std::vector<std::uint8_t> fixed{1, 1, 1, 0, 1, 0, 1, 0};
    for (const std::size_t corner : {0u, 2u, 4u, 6u}) {
        for (Path& level : levels) level[corner][0] = square[corner][0] + 0.2;
    }
    const Path before = levels[1];
    EXPECT_GT(relax_border(levels, fixed, 0.5, 1e-12), 1u);
    for (const std::size_t free : {3u, 5u, 7u}) {
        EXPECT_NEAR(levels[0][free][0], square[free][0] + 0.2, 1e-10);
        EXPECT_NEAR(levels[1][free][0], square[free][0] + 0.2, 1e-10);
        EXPECT_NEAR(levels[0][free][1], square[free][1], 1e-10);
    }
    EXPECT_EQ(levels[1][1], before[1]);
    EXPECT_EQ(levels[0][1], square[1]);
}

TEST(Smooth, B7_RightAngles) {
    EXPECT_NEAR(right_angledness({Point{0, 0}, {2, 0}, {2, 1}, {0, 1}}), 1, 1e-12);
    EXPECT_NEAR(right_angledness({Point{0, 0}, {1, 0}, {2, 1}, {1, 1}}), 0.5, 1e-12);
    EXPECT_EQ(right_angledness({Point{0, 0}, {1, 0}, {1, 0}, {0, 0}}), 0);
    EXPECT_EQ(right_angledness({Point{0, 0}, {1, 0}, {0, 1}, {1, 1}}), 0);
}

/// A plane that dips towards +x: x = 500 + (depth - 1050) / slope.
Fault dipping(double slope) {
    Fault fault{"F", {{500, 0}, {500, 1000}}, {}, {}, {}};
    for (const double y : {0.0, 1000.0}) {
        for (const double depth : {800.0, 1300.0}) fault.sheet.vertices.push_back({500 + (depth - 1050) / slope, y, depth});
    }
    fault.sheet.triangles = {{0, 1, 2}, {1, 3, 2}};
    return fault;
}

TEST(Lean, ZonesOfADippingFaultHaveTheirVolumes) {
    // The west block at 1000 .. 1100, the east one 40 lower; both end on the fault, so that some volume is missing between them.
    const auto cut = [](double depth) { return 500 + (depth - 1050) / 2; };
    const auto sheet = [&](const std::string& name, double west, double east) {
        Horizon horizon{name, Sheet{}};
        auto& s = std::get<Sheet>(horizon.shape);
        for (const double y : {0.0, 1000.0}) {
            for (const double x : {0.0, cut(west)}) s.vertices.push_back({x, y, west});
            for (const double x : {cut(east), 1000.0}) s.vertices.push_back({x, y, east});
        }
        s.triangles = {{0, 1, 4}, {1, 5, 4}, {2, 3, 6}, {3, 7, 6}};
        return horizon;
    };
    const Structure structure{{sheet("top", 1000, 1040), sheet("base", 1100, 1140)}, {dipping(2)}};
    GridOptions options;
    options.zones = {test::proportional(2)};
    const double exact = 1000.0 * 100 * (cut(1050) + 1000 - cut(1090));
    for (const std::uint32_t n : {10u, 20u}) {
        const Net pillars = test::net(n, n, 1000.0 / n, 1000.0 / n);
        const auto upright = build_grid(structure, pillars, options);
        options.follow_faults = true;
        const auto leaning = build_grid(structure, pillars, options);
        options.follow_faults = false;
        ASSERT_TRUE(upright.ok() && leaning.ok());
        EXPECT_NEAR(upright->report.zones[0].volume, 1e8, 1);
        EXPECT_NEAR(leaning->report.zones[0].volume, exact, 1e-6 * exact) << n;
        EXPECT_NEAR(leaning->report.faults[0].max_lean, 70, 1e-9);
        EXPECT_EQ(leaning->report.faults[0].why_upright, "");
        EXPECT_EQ(misfit(leaning->grid), "");
    }
}

TEST(Lean, AFaultThatWouldTurnColumnsOverStaysUpright) {
    const auto flat = [](double depth) { return [depth](double, double) { return depth; }; };
    const Structure structure{{test::map("top", 11, 11, 100, flat(800)), test::map("base", 11, 11, 100, flat(1300))}, {dipping(0.5)}};
    GridOptions options;
    options.zones = {test::proportional(2)};
    options.follow_faults = true;
    const auto made = build_grid(structure, test::net(20, 20, 50, 50), options);
    ASSERT_TRUE(made.ok());
    EXPECT_EQ(made->report.faults[0].max_lean, 0);
    EXPECT_NE(made->report.faults[0].why_upright, "");
    for (std::size_t p = 0; p < made->grid.pillars.size(); p += 6) EXPECT_EQ(made->grid.pillars[p], made->grid.pillars[p + 3]);
}

}  // namespace
}  // namespace geomend::gridding
