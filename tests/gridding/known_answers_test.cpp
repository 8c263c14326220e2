// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "grid/cell_geometry.h"
#include "grid/connections.h"
#include "gridding/chains.h"
#include "gridding/made_models.h"
#include "pipeline/load.h"
#include "support/real_data.h"

// Grids whose every number is known beforehand.

namespace geomend::gridding {
namespace {

using namespace test;

TEST(KnownAnswers, A_FlatLayersToTheLastDigit) {
    const Structure structure{
        {map("top", 5, 4, 100, [](double, double) { return 1000.0; }), map("base", 5, 4, 100, [](double, double) { return 1010.0; })}, {}};
    const auto made = grid(structure, net(4, 3, 100, 100), {proportional(4)});
    ASSERT_EQ(made.grid.dims, (std::array<std::uint32_t, 3>{4, 3, 4}));
    for (std::uint32_t j = 0; j <= 3; ++j) {
        for (std::uint32_t i = 0; i <= 4; ++i) {
            const double* p = made.grid.pillars.data() + 6 * (i + 5 * j);
            EXPECT_EQ((std::array{p[0], p[1], p[2], p[3], p[4], p[5]}),
                      (std::array{100.0 * i, 100.0 * j, 1000.0, 100.0 * i, 100.0 * j, 1010.0}));
        }
    }
    for (std::uint32_t k = 0; k < 4; ++k) {
        for (std::uint32_t j = 0; j < 3; ++j) {
            for (std::uint32_t i = 0; i < 4; ++i) {
                for (unsigned c = 0; c < 8; ++c)
                    EXPECT_EQ(made.grid.depths[corner_index(made.grid.dims, i, j, k, c)], 1000 + 2.5 * (k + (c >> 2)));
            }
        }
    }
    EXPECT_EQ(made.report.active, 48u);
    EXPECT_EQ(misfit(made.grid), "");
}

TEST(KnownAnswers, B_BlocksShiftedByHalfALayer) {
    constexpr std::uint32_t nx = 6, ny = 5, nz = 4;
    const auto shifted = [](double at) { return [at](double, double, int side) { return at + (side > 0 ? 5.0 : 0.0); }; };
    const Structure structure{{cut_sheet("top", nx, ny, 100, 3, shifted(1000)), cut_sheet("base", nx, ny, 100, 3, shifted(1040))},
                              {curtain("F", {300, 0}, {300, 500}, 900, 1100)}};
    const auto made = grid(structure, net(nx, ny, 100, 100), {proportional(nz)});
    const auto connections = grid::connections(made.grid);
    EXPECT_EQ(connections.others.size(), ny * (nz - 1));
    const std::uint64_t beside = (nx - 1) * ny * nz + nx * (ny - 1) * nz + nx * ny * (nz - 1);
    EXPECT_EQ(connections.internal, beside + ny * (nz - 1));  // ny nz of those across the fault join equal k
    EXPECT_EQ(made.report.blocks, 2u);
    ASSERT_EQ(made.grid.faults.size(), 1u);
    ASSERT_EQ(made.grid.faults[0].boxes.size(), 1u);
    const auto& box = made.grid.faults[0].boxes[0];
    EXPECT_EQ(box.first, (std::array<std::uint32_t, 3>{2, 0, 0}));
    EXPECT_EQ(box.last, (std::array<std::uint32_t, 3>{2, ny - 1, nz - 1}));
    EXPECT_EQ(box.face, CellFace::i_plus);
    EXPECT_EQ(made.report.faults[0].max_throw, 5);
}

TEST(KnownAnswers, C_AnUprightFaultBetweenPillarsIsTheNearestRow) {
    const Net pillars = net(10, 8, 100, 50);
    for (const double x : {420.0, 450.0, 470.0}) {
        const auto chains = make_chains(pillars, {{{x, -100}, {x, 900}}}, 0);
        ASSERT_EQ(chains.chains[0].pillars.size(), 9u) << x;
        for (std::uint32_t j = 0; j < 9; ++j) EXPECT_EQ(chains.chains[0].pillars[j], (x > 450 ? 5u : 4u) + 11 * j) << x;
        EXPECT_NEAR(chains.chains[0].max_deviation, x > 450 ? 500 - x : x - 400, 1e-9);
        EXPECT_LE(chains.chains[0].max_deviation, 50 + 1e-9);
    }
}

TEST(KnownAnswers, D_ATraceFromCornerToCorner) {
    for (const std::uint32_t n : {4u, 7u, 20u}) {
        const auto chains = make_chains(net(n, n, 30, 30), {{{0, 0}, {30.0 * n, 30.0 * n}}}, 0);
        const Chain& chain = chains.chains[0];
        EXPECT_EQ(chain.pillars.size(), 2 * n + 1);
        EXPECT_EQ(chain.pillars.front(), 0u);
        EXPECT_EQ(chain.pillars.back(), (n + 1) * (n + 1) - 1);
        EXPECT_NEAR(chain.max_deviation, 30 / std::sqrt(2), 1e-9);
        EXPECT_NEAR(chain.mean_deviation, 30 / (2 * std::sqrt(2)), 1e-9);
    }
}

TEST(KnownAnswers, E_PlanesAreMetOnBothSidesOfAFault) {
    // A fault in a direction of its own tears the plane apart by 30; around it, the map is ramped. The ring lies more than a step of the
    // map outside of the ramp.
    const Point a{130, 0}, b{870, 1000};
    const auto left_of = [&](double x, double y) { return ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / distance(a, b); };
    const auto plane = [](double x, double y) { return 2000 + 0.1 * x - 0.04 * y; };
    const auto torn = [&](double base) {
        return [&, base](double x, double y) { return plane(x, y) + base - 15 * std::min(1.0, std::max(-1.0, left_of(x, y) / 40)); };
    };
    const double nx = (b[1] - a[1]) / distance(a, b) * 55, ny = -(b[0] - a[0]) / distance(a, b) * 55;
    const Path ring{{a[0] + nx - 30, a[1] + ny - 54.5},
                    {b[0] + nx + 30, b[1] + ny + 54.5},
                    {b[0] - nx + 30, b[1] - ny + 54.5},
                    {a[0] - nx - 30, a[1] - ny - 54.5}};
    Fault fault{"F", {a, b}, {}, {ring, ring}, {}};
    const Structure structure{{map("top", 101, 101, 10, torn(0)), map("base", 101, 101, 10, torn(25))}, {fault}};
    const Net pillars = net(16, 14, 60, 70, 0, {10, 5});
    const auto made = grid(structure, pillars, {proportional(1)});
    ASSERT_EQ(made.report.blocks, 2u);
    const auto& blocks = std::get<std::vector<std::int32_t>>(made.grid.info.attributes[1].values);
    for (std::uint32_t j = 0; j < 14; ++j) {
        for (std::uint32_t i = 0; i < 16; ++i) {
            const auto corners = cell_corners(made.grid, i, j, 0);
            const double side = blocks[made.grid.cell(i, j, 0)] == blocks[0] ? -15 : 15;
            for (unsigned c = 0; c < 8; ++c)
                EXPECT_NEAR(corners[c][2], plane(corners[c][0], corners[c][1]) + side + (c > 3 ? 25 : 0), 1e-9)
                    << i << ' ' << j << ' ' << c;
        }
    }
}

TEST(KnownAnswers, F_ADyingFaultHasTheThrowOfTheModel) {
    constexpr std::uint32_t n = 8;
    constexpr double step = 50, most = 24;
    const auto torn = [](double at) {
        return [at](double x, double y, int side) {
            const double share = std::max(0.0, 1 - y / (n * step));
            return x == 500 ? at + side * most / 2 * share : at;
        };
    };
    const Structure structure{{cut_sheet("top", 20, 14, step, 10, torn(1000)), cut_sheet("base", 20, 14, step, 10, torn(1100))},
                              {curtain("F", {500, 0}, {500, n * step}, 800, 1300)}};
    const auto made = grid(structure, net(20, 14, step, step), {proportional(2)});
    EXPECT_EQ(made.report.blocks, 1u);
    EXPECT_EQ(made.report.faults[0].faces, n);
    for (std::uint32_t k = 0; k <= n; ++k) {
        const double left = made.grid.depths[corner_index(made.grid.dims, 9, k, 0, 1)];
        const double right = made.grid.depths[corner_index(made.grid.dims, 10, k, 0, 0)];
        EXPECT_NEAR(right - left, most * (1 - static_cast<double>(k) / n), 1e-9) << k;
    }
}

TEST(KnownAnswers, G_AWedgeLapsOntoItsBase) {
    const auto base = [](double x, double) { return 1050 - 0.1 * x; };
    Structure structure{{map("top", 11, 4, 100, [](double, double) { return 1000.0; }), map("base", 11, 4, 100, base)}, {}};
    structure.horizons[1].is_lapped = true;
    const auto made = grid(structure, net(10, 3, 100, 100), {{"", ZoneLayers::Rule::from_base, 0, 10}});
    ASSERT_EQ(made.grid.dims[2], 5u);
    // Column i is at most 50 - 10 i thick: so many layers of 10 have none of it.
    EXPECT_EQ(made.report.zones[0].without_thickness, 3u * (0 + 1 + 2 + 3 + 4 + 5 * 5));
    EXPECT_EQ(made.report.active, 3u * (5 + 4 + 3 + 2 + 1));
    double none = 0;
    for (std::size_t c = 0; c < made.grid.cell_count(); ++c) {
        const auto [i, j, k] = made.grid.ijk(c);
        if (!made.grid.is_active(c)) none += std::abs(grid::cell_volume(made.grid, i, j, k));
    }
    EXPECT_EQ(none, 0);
    EXPECT_NEAR(made.report.zones[0].volume, 300 * 500 * 25.0, 1e-6);
}

/// Triangles through the corners of one layer boundary, cell by cell.
Horizon boundary(const CornerPointGrid& grid, const std::string& name, std::uint32_t k, bool base) {
    Sheet sheet;
    for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
        for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
            const auto corners = cell_corners(grid, i, j, k);
            const auto first = static_cast<std::uint32_t>(sheet.vertices.size());
            for (unsigned c = 0; c < 4; ++c) sheet.vertices.push_back(corners[c + (base ? 4 : 0)]);
            sheet.triangles.push_back({first, first + 1, first + 3});
            sheet.triangles.push_back({first, first + 3, first + 2});
        }
    }
    return {name, std::move(sheet)};
}

TEST(KnownAnswers, H_AGridIsMadeAgainFromItsHorizonsAndItsFault) {
    const auto file = geomend::test::real_data("cornerpoint/pygrdecl/Simple20x20x5_Fault.grdecl");
    if (!file) GTEST_SKIP() << "no real data";
    const auto read = load(file->string(), {});
    ASSERT_TRUE(read.ok());
    const auto& before = std::get<CornerPointGrid>(read->objects.at(0));
    ASSERT_EQ(before.dims, (std::array<std::uint32_t, 3>{20, 20, 5}));
    // The one row of pillars on which cells side by side differ.
    std::uint32_t cut = 0;
    for (std::uint32_t i = 1; i < 20; ++i) {
        if (before.depths[corner_index(before.dims, i, 3, 0, 0)] != before.depths[corner_index(before.dims, i - 1, 3, 0, 1)]) cut = i;
    }
    ASSERT_GT(cut, 0u);
    Structure structure{{boundary(before, "h0", 0, false)}, {{"F", {}, {}, {}, {}}}};
    for (std::uint32_t k = 0; k < 5; ++k) structure.horizons.push_back(boundary(before, "h" + std::to_string(k + 1), k, true));
    Fault& fault = structure.faults[0];
    for (std::uint32_t j = 0; j <= 20; ++j) {
        const double* p = before.pillars.data() + 6 * (cut + 21 * j);
        for (const double depth : {-1.0, 2.0}) fault.sheet.vertices.push_back(pillar_point(p, depth));
        const Vec3 mid = pillar_point(p, mid_level(structure));
        fault.trace.push_back({mid[0], mid[1]});
        if (j == 0) continue;
        fault.sheet.triangles.push_back({2 * j - 2, 2 * j - 1, 2 * j});
        fault.sheet.triangles.push_back({2 * j - 1, 2 * j + 1, 2 * j});
    }
    Net pillars;
    pillars.cells = {20, 20};
    pillars.lines = before.pillars;
    const auto made = grid(structure, pillars, std::vector<ZoneLayers>(5, proportional(1)));
    ASSERT_EQ(made.grid.depths.size(), before.depths.size());
    double most = 0;
    for (std::size_t z = 0; z < before.depths.size(); ++z) most = std::max(most, std::abs(made.grid.depths[z] - before.depths[z]));
    EXPECT_LT(most, 1e-9);
    EXPECT_EQ(made.report.faults[0].faces, 20u);
}

TEST(KnownAnswers, RepeatedBedsAreRefusedWithTheirPlace) {
    Horizon fold{"fold", Sheet{}};
    auto& sheet = std::get<Sheet>(fold.shape);
    // In section: from (0,1000) to (600,1000), back to (400,1050), on to (1000,1050).
    for (const auto& [x, z] : {std::pair{0.0, 1000.0}, {600.0, 1000.0}, {400.0, 1050.0}, {1000.0, 1050.0}}) {
        sheet.vertices.push_back({x, 0, z});
        sheet.vertices.push_back({x, 300, z});
    }
    for (std::uint32_t s = 0; s < 3; ++s) {
        sheet.triangles.push_back({2 * s, 2 * s + 2, 2 * s + 1});
        sheet.triangles.push_back({2 * s + 2, 2 * s + 3, 2 * s + 1});
    }
    const Structure structure{{fold, map("base", 11, 4, 100, [](double, double) { return 1200.0; })}, {}};
    GridOptions options;
    options.zones = {proportional(2)};
    const auto refused = build_grid(structure, net(10, 3, 100, 100), options);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.why().error.code, "F027");
    ASSERT_EQ(refused.why().also.size(), 1u);
    EXPECT_EQ(refused.why().also[0].count, 12u);  // at x 400, 500 and 600
    EXPECT_NE(refused.why().also[0].message.find("'fold'"), std::string::npos);
    EXPECT_NE(refused.why().also[0].message.find("x 400 .. 600, y 0 .. 300"), std::string::npos) << refused.why().also[0].message;
    options.allow_repeated = true;
    EXPECT_TRUE(build_grid(structure, net(10, 3, 100, 100), options).ok());
}

}  // namespace
}  // namespace geomend::gridding
