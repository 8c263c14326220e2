// SPDX-License-Identifier: AGPL-3.0-or-later
// One grid in several encodings: the same active cells in map coordinates, however they are numbered.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "grid/cell_geometry.h"
#include "grid/cell_mesh.h"
#include "grid/connections.h"
#include "grid/from_cells.h"
#include "grid/map_axes.h"
#include "pipeline/load.h"
#include "support/real_data.h"

namespace geomend {
namespace {

struct MapGrid {
    std::vector<std::array<Vec3, 8>> cells;  // active ones, in map coordinates
    double largest = 0;                      // stored coordinate by size
};

MapGrid read(const std::filesystem::path& file) {
    MapGrid result;
    auto dataset = load(file.string(), {});
    EXPECT_TRUE(dataset.ok()) << file << (dataset.ok() ? "" : dataset.why().error.message);
    if (!dataset) return result;
    auto& grid = std::get<CornerPointGrid>(dataset->objects.front());
    for (const double v : grid.pillars) result.largest = std::max(result.largest, std::abs(v));
    EXPECT_TRUE(grid::apply_map_axes(grid).ok());
    for (std::size_t c = 0; c < grid.cell_count(); ++c) {
        if (!grid.is_active(c)) continue;
        const auto [i, j, k] = grid.ijk(c);
        result.cells.push_back(cell_corners(grid, i, j, k));
    }
    return result;
}

// The largest difference of corners between the cells of two grids, after each cell has found its like; infinite where
// one has none.
double difference(const MapGrid& a, const MapGrid& b) {
    constexpr double box = 20;
    std::map<std::array<long, 3>, std::vector<std::size_t>> places;
    const auto place = [&](const Vec3& p) {
        return std::array<long, 3>{std::lround(p[0] / box), std::lround(p[1] / box), std::lround(p[2] / box)};
    };
    for (std::size_t c = 0; c < b.cells.size(); ++c) places[place(grid::centre(b.cells[c]))].push_back(c);
    const auto corner_distance = [](const std::array<Vec3, 8>& p, const std::array<Vec3, 8>& q) {
        double worst = 0;
        for (const Vec3& corner : p) {
            double best = 1e300;
            for (const Vec3& other : q)
                best = std::min(best,
                                std::max({std::abs(corner[0] - other[0]), std::abs(corner[1] - other[1]), std::abs(corner[2] - other[2])}));
            worst = std::max(worst, best);
        }
        return worst;
    };
    double worst = 0;
    for (const auto& cell : a.cells) {
        const auto at = place(grid::centre(cell));
        double best = 1e300;
        for (long x = -1; x <= 1; ++x)
            for (long y = -1; y <= 1; ++y)
                for (long z = -1; z <= 1; ++z) {
                    const auto found = places.find({at[0] + x, at[1] + y, at[2] + z});
                    if (found == places.end()) continue;
                    for (const std::size_t c : found->second) best = std::min(best, corner_distance(cell, b.cells[c]));
                }
        worst = std::max(worst, best);
    }
    return worst;
}

void expect_agreement(const std::string& folder, const std::vector<std::string>& files, std::size_t active, double own_step) {
    std::vector<MapGrid> grids;
    for (const std::string& name : files) {
        const auto file = test::real_data(folder + name);
        if (!file) GTEST_SKIP() << "no real data: " << name;
        grids.push_back(read(*file));
        EXPECT_EQ(grids.back().cells.size(), active) << name;
    }
    for (std::size_t g = 1; g < grids.size(); ++g) {
        const double step = std::max(own_step, std::max(grids[0].largest, grids[g].largest) * std::ldexp(1.0, -23));
        EXPECT_LE(difference(grids[0], grids[g]), 2 * step) << files[0] << " and " << files[g];
        EXPECT_LE(difference(grids[g], grids[0]), 2 * step) << files[g] << " and " << files[0];
    }
}

TEST(GridEncodings, reek_is_the_same_as_grdecl_egrid_and_roff) {
    // The GRDECL has three decimals.
    expect_agreement("cornerpoint/reek/", {"reek_sim_grid.grdecl", "REEK.EGRID", "reek_grid_fromegrid.roff"}, 35838, 0.0005);
}

TEST(GridEncodings, simpleb8_is_the_same_in_all_its_encodings) {
    expect_agreement("cornerpoint/simpleb8/", {"simpleb8.grdecl", "E100_BO.EGRID", "E100_BO.FEGRID", "E100_BO.GRID"}, 22, 0);
}

class CellsOfRealGrids : public ::testing::TestWithParam<const char*> {};

// Columns that wedge out hold no hexahedron; their pillars come from pinched cells.
TEST_P(CellsOfRealGrids, come_back_as_the_grid_that_they_are_of) {
    const auto file = test::real_data(std::string("cornerpoint/") + GetParam());
    if (!file) GTEST_SKIP() << "no real data: " << GetParam();
    auto dataset = load(file->string(), {});
    ASSERT_TRUE(dataset.ok());
    const auto& grid = std::get<CornerPointGrid>(dataset->objects.front());
    const auto back = grid::from_tagged_cells(grid::plain_cells(grid).mesh);
    ASSERT_TRUE(back.ok()) << back.why().error.message;
    const double volume = grid::volume(grid);
    EXPECT_NEAR(grid::volume(*back), volume, 1e-9 * volume);
    EXPECT_EQ(grid::connections(*back).internal, grid::connections(grid).internal);
    EXPECT_EQ(grid::connections(*back).others, grid::connections(grid).others);
}

INSTANTIATE_TEST_SUITE_P(Grids, CellsOfRealGrids,
                         ::testing::Values("pygrdecl/20X20X6.GRDECL", "small/gridqc1.roff", "reek/reek_sim_grid.grdecl",
                                           "simpleb8/simpleb8.grdecl", "small/banal6.grdecl", "pygrdecl/CP.GRDECL"));

}  // namespace
}  // namespace geomend
