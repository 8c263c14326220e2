// SPDX-License-Identifier: AGPL-3.0-or-later
// What is expected here was read from the files of flow 2022.10 (tests/clients compare with it where it is installed).
#include "grid/simulated_cells.h"

#include <gtest/gtest.h>

#include "grid/connections.h"
#include "grid/transmissibility.h"
#include "support/corner_point_grids.h"

namespace geomend::grid {
namespace {

using Bridges = std::vector<std::array<std::size_t, 2>>;

// One column of 100 x 100; porosity 0.2, so that a layer of 1 m holds 2000.
CornerPointGrid column(const std::vector<double>& thickness, const std::vector<std::uint8_t>& activity = {}) {
    CornerPointGrid grid = testing::brick_grid(1, 1, static_cast<std::uint32_t>(thickness.size()));
    testing::reshape(grid, [&](auto, auto, std::uint32_t k, unsigned c, double) {
        double depth = 1000;
        for (std::uint32_t m = 0; m < k + (c >> 2); ++m) depth += thickness[m];
        return depth;
    });
    grid.activity = activity;
    testing::add_constant(grid, "PORO", 0.2);
    testing::add_constant(grid, "PERMX", 20);
    grid.least_pore_volume = 2000;
    return grid;
}

CornerPointGrid with_pinch(CornerPointGrid grid, double threshold, bool gap = true) {
    grid.pinch = CornerPointGrid::Pinch{};
    grid.pinch->threshold = threshold;
    grid.pinch->gap = gap;
    return grid;
}

TEST(SimulatedCells, below_minpv_are_left_out_and_bridged_without_pinch) {
    const SimulatedCells cells = simulated_cells(column({10, 10, 0.5, 10, 10}));
    EXPECT_EQ(cells.present, (std::vector<std::uint8_t>{1, 1, 0, 1, 1}));
    EXPECT_EQ(cells.below_minpv, std::vector<std::size_t>{2});
    EXPECT_EQ(cells.bridges, (Bridges{{1, 3}}));
}

TEST(SimulatedCells, several_below_minpv_make_one_bridge_but_not_with_nogap_where_they_are_thick) {
    EXPECT_EQ(simulated_cells(column({10, 0.5, 0.4, 10, 10})).bridges, (Bridges{{0, 3}}));
    EXPECT_EQ(simulated_cells(with_pinch(column({10, 0.5, 0.4, 10, 10}), 0.001, false)).bridges, Bridges{});
    EXPECT_EQ(simulated_cells(with_pinch(column({10, 0.5, 0.4, 10, 10}), 0.6, false)).bridges, (Bridges{{0, 3}}));
}

TEST(SimulatedCells, inactive_ones_are_passed_where_they_are_thin) {
    const std::vector<double> layers{10, 10, 0.5, 0.5, 10, 10};
    EXPECT_EQ(simulated_cells(column(layers, {1, 1, 1, 0, 1, 1})).bridges, Bridges{});
    EXPECT_EQ(simulated_cells(with_pinch(column(layers, {1, 1, 1, 0, 1, 1}), 1)).bridges, (Bridges{{1, 4}}));
    EXPECT_EQ(simulated_cells(with_pinch(column(layers, {1, 1, 0, 1, 1, 1}), 1)).bridges, (Bridges{{1, 4}}));
    EXPECT_EQ(simulated_cells(with_pinch(column(layers, {1, 1, 0, 1, 1, 1}), 0.1)).bridges, Bridges{});
}

TEST(SimulatedCells, at_the_ends_of_a_column_are_not_bridged) {
    const SimulatedCells cells = simulated_cells(column({0.5, 10, 10, 0.5}));
    EXPECT_EQ(cells.below_minpv.size(), 2u);
    EXPECT_TRUE(cells.bridges.empty());
}

TEST(SimulatedCells, without_pores_are_as_inactive) {
    CornerPointGrid grid = column({10, 0.5, 10});
    std::get<std::vector<double>>(grid.info.attributes[0].values)[1] = 0;
    const SimulatedCells cells = simulated_cells(grid);
    EXPECT_EQ(cells.without_pores, std::vector<std::size_t>{1});
    EXPECT_TRUE(cells.bridges.empty());
    grid.least_pore_volume.reset();
    EXPECT_EQ(simulated_cells(grid).without_pores, std::vector<std::size_t>{1});
}

TEST(SimulatedCells, are_all_where_pore_volumes_are_not_known) {
    CornerPointGrid grid = column({10, 0.5, 10});
    std::erase_if(grid.info.attributes, [](const Attribute& a) { return a.name == "PORO"; });
    EXPECT_EQ(simulated_cells(grid).present, (std::vector<std::uint8_t>{1, 1, 1}));
    CornerPointGrid dual = column({10, 0.5, 10});
    dual.porosity = CornerPointGrid::Porosity::dual_porosity;
    EXPECT_EQ(simulated_cells(dual).present, (std::vector<std::uint8_t>{1, 1, 1}));
}

TEST(SimulatedCells, are_joined_with_the_multipliers_that_pinch_asks_for) {
    CornerPointGrid grid = column({10, 10, 0.5, 10, 10});
    Attribute multz;
    multz.name = "MULTZ";
    multz.location = AttributeLocation::cell;
    multz.values = std::vector<double>{0.5, 0.25, 0.125, 2, 3};
    grid.info.attributes.push_back(multz);
    const auto bridged = [&] {
        const Connections found = connections(grid, simulated_cells(grid));
        EXPECT_EQ(found.internal, 3u);
        return transmissibilities(grid, found)->z[1];
    };
    constexpr double plain = 0.00852701702442635 * 20 * 10000 / 10;
    EXPECT_NEAR(bridged(), plain * 0.25, 1e-9);
    grid = with_pinch(grid, 1);
    grid.pinch->multiplier_of_all = true;
    EXPECT_NEAR(bridged(), plain * 0.125, 1e-9);
}

}  // namespace
}  // namespace geomend::grid
