// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <ostream>
#include <set>

#include "eclipse_testing.h"
#include "grid/cell_geometry.h"

namespace geomend::test {
namespace {

struct Expected {
    const char* file;
    std::array<std::uint32_t, 3> dims;
    std::size_t active;
    double volume;
    double relative;
};
void PrintTo(const Expected& o, std::ostream* out) { *out << o.file; }

class RealGrid : public testing::TestWithParam<Expected> {};

TEST_P(RealGrid, HasItsDimsActiveCellsAndVolume) {
    const Expected& e = GetParam();
    const auto path = real_data(std::string("cornerpoint/") + e.file);
    if (!path) GTEST_SKIP() << "no real data";
    const auto data = read_eclipse(*path);
    const CornerPointGrid& grid = grid_of(data);
    EXPECT_EQ(misfit(grid), "");
    EXPECT_EQ(grid.dims, e.dims);
    EXPECT_EQ(active_count(grid), e.active);
    if (e.volume > 0) {
        EXPECT_NEAR(grid::volume(grid), e.volume, e.relative * e.volume);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Files, RealGrid,
    testing::Values(Expected{"reek/REEK.EGRID", {40, 64, 14}, 35838, 2939630991.9, 1e-10},
                    Expected{"reek3/reek_sim.bgrdecl", {40, 64, 14}, 35812, 2957099105, 1e-5},
                    Expected{"simpleb8/E100_BO.EGRID", {4, 2, 3}, 22, 27851.5244, 1e-8},
                    Expected{"simpleb8/E100_BO.FEGRID", {4, 2, 3}, 22, 27851.5244, 1e-5},
                    Expected{"simpleb8/E100_BO.GRID", {4, 2, 3}, 22, 27851.5244, 1e-6},
                    Expected{"simpleb8/IX_BO.EGRID", {4, 2, 3}, 23, 29257.7744, 1e-8}, Expected{"small/TEST_SP.EGRID", {5, 3, 1}, 11, 0, 0},
                    Expected{"small/TEST_DP.EGRID", {5, 3, 1}, 13, 0, 0}, Expected{"small/TEST_DPDK.EGRID", {5, 3, 1}, 13, 0, 0},
                    Expected{"opm/CARFIN5.EGRID", {3, 3, 1}, 9, 1.8e8, 1e-9}, Expected{"opm/MAPAXES.EGRID", {2, 2, 2}, 6, 6, 1e-9},
                    Expected{"opm/SPE1CASE1.EGRID", {10, 10, 3}, 294, 9.88e9, 1e-9},
                    Expected{"opm/EGRID_NO_ACTNUM.FEGRID", {2, 2, 2}, 8, 8, 1e-9}));

TEST(RealEgrid, ReekHasItsConnectionsMapAndInactiveCell) {
    const auto path = real_data("cornerpoint/reek/REEK.EGRID");
    if (!path) GTEST_SKIP() << "no real data";
    const auto data = read_eclipse(*path);
    const CornerPointGrid& grid = grid_of(data);
    EXPECT_EQ(grid.connections.size(), 2874u);
    EXPECT_EQ(grid.connections[0].first, 2709u);
    EXPECT_EQ(grid.connections[0].second, 150u);
    EXPECT_FALSE(grid.is_active(grid.cell(12, 22, 5)));
    ASSERT_TRUE(grid.map_axes.has_value());
    EXPECT_EQ((*grid.map_axes)[3], 5938935.5);
    EXPECT_EQ(grid.map_unit, "METRES");
    EXPECT_EQ(grid.info.crs.axis_units[2], "METRES");
    EXPECT_EQ(grid.info.name, "REEK");
    EXPECT_EQ(grid.info.precision, CoordinatePrecision::single_precision);
}

TEST(RealEgrid, DualPorosityConnectsMatrixAndFracture) {
    const auto path = real_data("cornerpoint/small/TEST_DPDK.EGRID");
    if (!path) GTEST_SKIP() << "no real data";
    const auto data = read_eclipse(*path);
    const CornerPointGrid& grid = grid_of(data);
    EXPECT_EQ(grid.porosity, CornerPointGrid::Porosity::dual_permeability);
    ASSERT_EQ(grid.connections.size(), 9u);
    for (const auto& c : grid.connections) EXPECT_EQ(c.second, c.first + 15);
    EXPECT_EQ(grid.activity[3], 1);
    EXPECT_EQ(grid.activity[5], 2);
}

TEST(RealEgrid, LocalRefinementHasHostAndLinks) {
    const auto path = real_data("cornerpoint/opm/CARFIN5.EGRID");
    if (!path) GTEST_SKIP() << "no real data";
    const auto data = read_eclipse(*path);
    ASSERT_TRUE(data.ok());
    ASSERT_EQ(data->objects.size(), 2u);
    const CornerPointGrid& lgr = grid_of(data, 1);
    EXPECT_EQ(lgr.info.name, "LGR1");
    ASSERT_TRUE(lgr.host.has_value());
    EXPECT_EQ(lgr.host->grid, "");
    EXPECT_EQ(lgr.host->cells, std::vector<std::uint64_t>(9, 4));
    EXPECT_EQ(lgr.host->first, (std::array<std::uint32_t, 3>{1, 1, 0}));
    ASSERT_EQ(lgr.links.size(), 1u);
    EXPECT_EQ(lgr.links[0].connections.size(), 12u);
    EXPECT_EQ(lgr.links[0].connections[1].first, 3u);
    EXPECT_EQ(lgr.links[0].connections[1].second, 3u);
}

std::set<std::pair<std::uint64_t, std::uint64_t>> unordered(const CornerPointGrid& grid) {
    std::set<std::pair<std::uint64_t, std::uint64_t>> pairs;
    for (const auto& c : grid.connections) pairs.insert(std::minmax(c.first, c.second));
    return pairs;
}

TEST(RealEgrid, SimulatorsAgreeOnConnections) {
    const auto e100 = real_data("cornerpoint/simpleb8/E100_BO.EGRID"), ix = real_data("cornerpoint/simpleb8/IX_BO.EGRID"),
               text = real_data("cornerpoint/simpleb8/E100_BO.FEGRID");
    if (!e100 || !ix || !text) GTEST_SKIP() << "no real data";
    const std::set<std::pair<std::uint64_t, std::uint64_t>> expected = {{2, 9}, {2, 11}, {2, 14}};
    EXPECT_EQ(unordered(grid_of(read_eclipse(*e100))), expected);
    EXPECT_EQ(unordered(grid_of(read_eclipse(*ix))), expected);
    EXPECT_EQ(unordered(grid_of(read_eclipse(*text))), expected);
}

TEST(RealEgrid, EncodingsOfOneGridAgreeInEveryCorner) {
    const auto binary = real_data("cornerpoint/simpleb8/E100_BO.EGRID");
    if (!binary) GTEST_SKIP() << "no real data";
    const auto reference = read_eclipse(*binary);
    const CornerPointGrid& a = grid_of(reference);
    for (const char* name : {"E100_BO.FEGRID", "E100_BO.GRID"}) {
        const auto data = read_eclipse(binary->parent_path() / name);
        const CornerPointGrid& b = grid_of(data);
        for (std::uint32_t cell = 0; cell < 24; ++cell) {
            ASSERT_EQ(a.is_active(cell), b.is_active(cell)) << name << " cell " << cell;
            if (!a.is_active(cell)) continue;
            const auto [i, j, k] = a.ijk(cell);
            const auto p = cell_corners(a, i, j, k), q = cell_corners(b, i, j, k);
            for (std::size_t c = 0; c < 8; ++c) {
                for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(p[c][d], q[c][d], 2.5e-4) << name << " cell " << cell;
            }
        }
    }
}

TEST(RealInit, PropertiesStandOnTheGridBesideIt) {
    const auto path = real_data("cornerpoint/simpleb8/E100_BO.INIT");
    if (!path) GTEST_SKIP() << "no real data";
    const auto data = read_eclipse(*path);
    const CornerPointGrid& grid = grid_of(data);
    EXPECT_EQ(misfit(grid), "");
    EXPECT_EQ(active_count(grid), 22u);
    EXPECT_EQ(grid.unit_system, "METRIC");
    const Attribute* porv = find_attribute(grid.info.attributes, "PORV", AttributeLocation::cell);
    ASSERT_NE(porv, nullptr);
    EXPECT_EQ(porv->unit, "rm3");
    double sum = 0;
    for (std::size_t c = 0; c < 24; ++c) sum += value_as_double(*porv, c);
    EXPECT_NEAR(sum, 7120.694, 5e-4);
    const Attribute* permx = find_attribute(grid.info.attributes, "PERMX", AttributeLocation::cell);
    ASSERT_NE(permx, nullptr);
    EXPECT_TRUE(is_no_data(*permx, value_as_double(*permx, 8)));
    EXPECT_FLOAT_EQ(std::get<std::vector<float>>(permx->values)[0], 955.8656F);
    ASSERT_EQ(grid.connections.size(), 3u);
    EXPECT_NEAR(grid.connections[0].transmissibility.value_or(0), 3.202523946762085, 1e-12);
    EXPECT_EQ(data->findings.size(), 0u);
}

TEST(RealInit, WithoutItsGridPoreVolumesTellTheActiveCells) {
    const auto path = real_data("cornerpoint/simpleb8/E100_BO.INIT");
    if (!path) GTEST_SKIP() << "no real data";
    const auto input = Input::from_memory(read_file(*path), "alone.INIT");
    const auto data = sniffed(input).read(input, {});
    const CornerPointGrid& grid = grid_of(data);
    EXPECT_TRUE(grid.pillars.empty());
    EXPECT_TRUE(grid.depths.empty());
    EXPECT_EQ(grid.dims, (std::array<std::uint32_t, 3>{4, 2, 3}));
    EXPECT_EQ(active_count(grid), 22u);
    EXPECT_FALSE(grid.is_active(8));
    EXPECT_FALSE(grid.is_active(20));
}

TEST(RealInit, DualPorosityHasTwoSetsOfValues) {
    const auto path = real_data("cornerpoint/small/TEST_DP.INIT");
    if (!path) GTEST_SKIP() << "no real data";
    for (const bool alone : {false, true}) {
        const auto input = alone ? Input::from_memory(read_file(*path), "alone.INIT") : *Input::open(path->string());
        const auto data = sniffed(input).read(input, {});
        const CornerPointGrid& grid = grid_of(data);
        EXPECT_EQ(grid.dims, (std::array<std::uint32_t, 3>{5, 3, 1}));
        EXPECT_EQ(grid.activity, (std::vector<std::uint8_t>{3, 3, 0, 3, 3, 2, 3, 3, 3, 3, 3, 0, 3, 2, 3}));
        const Attribute* matrix = find_attribute(grid.info.attributes, "PORO", AttributeLocation::cell);
        const Attribute* fracture = find_attribute(grid.info.attributes, "PORO:fracture", AttributeLocation::cell);
        ASSERT_TRUE(matrix != nullptr && fracture != nullptr);
        EXPECT_FLOAT_EQ(std::get<std::vector<float>>(matrix->values)[1], 0.11F);
        EXPECT_TRUE(is_no_data(*matrix, value_as_double(*matrix, 5)));
        EXPECT_FALSE(is_no_data(*fracture, value_as_double(*fracture, 5)));
        const Attribute* porv = find_attribute(grid.info.attributes, "PORV:fracture", AttributeLocation::cell);
        ASSERT_NE(porv, nullptr);
        EXPECT_FLOAT_EQ(std::get<std::vector<float>>(porv->values)[0], 0.25F);
    }
}

TEST(RealBgrdecl, PropertiesComeAlong) {
    const auto path = real_data("cornerpoint/reek3/reek_sim_grid_withprops.bgrdecl");
    if (!path) GTEST_SKIP() << "no real data";
    const auto data = read_eclipse(*path);
    const CornerPointGrid& grid = grid_of(data);
    const Attribute* poro = find_attribute(grid.info.attributes, "PORO", AttributeLocation::cell);
    ASSERT_NE(poro, nullptr);
    EXPECT_FLOAT_EQ(std::get<std::vector<float>>(poro->values)[0], 0.10772665F);
    const Attribute* zone = find_attribute(grid.info.attributes, "Zone", AttributeLocation::cell);
    ASSERT_NE(zone, nullptr);
    EXPECT_TRUE(std::holds_alternative<std::vector<std::int32_t>>(zone->values));
}

}  // namespace
}  // namespace geomend::test
