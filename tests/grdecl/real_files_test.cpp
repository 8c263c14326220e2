// SPDX-License-Identifier: AGPL-3.0-or-later
// Real files: dims, active cells and volumes as they are known of them, and there and back without a bit changed.
#include <cmath>

#include "grdecl/grdecl_support.h"
#include "grid/cell_geometry.h"

namespace geomend::test {
namespace {

struct Known {
    const char* file;
    std::array<std::uint32_t, 3> dims;
    std::size_t active;
    double volume;  ///< 0: not known
    double half_digit;
};

void PrintTo(const Known& k, std::ostream* out) { *out << k.file; }

class RealGrid : public testing::TestWithParam<Known> {};

TEST_P(RealGrid, IsReadAsItIsKnown) {
    const Known& known = GetParam();
    const auto path = real_data(std::string("cornerpoint/") + known.file);
    if (!path) GTEST_SKIP() << "no real data";
    const auto d = read_path(*path);
    ASSERT_TRUE(d) << why(d);
    const CornerPointGrid& g = grid_of(*d);
    EXPECT_EQ(misfit(g), "");
    EXPECT_EQ(g.dims, known.dims);
    EXPECT_EQ(active_count(g), known.active);
    if (known.volume > 0) {
        EXPECT_NEAR(grid::volume(g), known.volume, known.half_digit);
    }
}

TEST_P(RealGrid, ComesBackBitByBit) {
    const auto path = real_data(std::string("cornerpoint/") + GetParam().file);
    if (!path) GTEST_SKIP() << "no real data";
    const auto d = read_path(*path);
    ASSERT_TRUE(d) << why(d);
    const TemporaryFolder folder;
    for (const char* name : {"back.grdecl", "back.DATA"}) {
        const Written written = write(*d, folder / name);
        EXPECT_FALSE(loses_substance(written.losses));
        const auto again = read_path(written.path);
        ASSERT_TRUE(again) << why(again);
        expect_same(grid_of(*d), grid_of(*again));
        EXPECT_TRUE(again->findings.size() <= d->findings.size());
        if (std::string_view(name) == "back.DATA" && d->variant == "DATA deck") {
            ASSERT_EQ(d->annotations.size(), again->annotations.size());
            for (std::size_t i = 0; i < d->annotations.size(); ++i) EXPECT_EQ(d->annotations[i].value, again->annotations[i].value);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, RealGrid,
    testing::Values(
        Known{"reek/reek_sim_grid.grdecl", {40, 64, 14}, 35838, 2939630953, 0.5},
        Known{"reek3/reek_sim.grdecl", {40, 64, 14}, 35812, 2957099105, 0.5}, Known{"spe9/SPE9.GRDECL", {24, 25, 15}, 9000, 1.9386e10, 5e5},
        Known{"spe9/SPE9.DATA", {24, 25, 15}, 9000, 1.9386e10, 5e5}, Known{"spe9/SPE9_CP.DATA", {24, 25, 15}, 9000, 1.9386e10, 5e5},
        Known{"spe9/SPE9_CP_GROUP.DATA", {24, 25, 15}, 9000, 1.9386e10, 5e5}, Known{"spe1/SPE1CASE1.DATA", {10, 10, 3}, 300, 1e10, 1},
        Known{"spe1/SPE1CASE2_ACTNUM.DATA", {10, 10, 3}, 278, 0, 0}, Known{"spe1/SPE1CASE2_THERMAL.DATA", {10, 10, 3}, 300, 1e10, 1},
        Known{"pygrdecl/20X20X6.GRDECL", {20, 20, 6}, 2400, 3.071534408e12, 5e2},
        Known{"pygrdecl/40X48x1_3fatults.GRDECL", {20, 30, 3}, 1800, 4112851223, 0.5},
        Known{"pygrdecl/CP.GRDECL", {20, 5, 10}, 1000, 5.94e9, 5e6},
        Known{"pygrdecl/Simple20x20x5_Fault.grdecl", {20, 20, 5}, 2000, 0.2425246017, 5e-11},
        Known{"pygrdecl/Simple10x10x3_Fault.grdecl", {10, 10, 3}, 300, 0.2425141793, 5e-11},
        Known{"simpleb8/simpleb8.grdecl", {4, 2, 3}, 22, 27851.5625, 5e-5}, Known{"small/banal1.grdecl", {1, 1, 3}, 3, 30000, 1e-9},
        Known{"small/banal3.grdecl", {1, 1, 3}, 3, 30000, 1e-9}, Known{"small/banal4.grdecl", {1, 1, 3}, 3, 27500, 1e-9},
        Known{"small/banal6.grdecl", {4, 2, 3}, 24, 29921.875, 5e-4}, Known{"small/concave.grdecl", {1, 1, 3}, 3, 17336.11111, 5e-6},
        Known{"small/sixcells2_described_zoverlap.grdecl", {2, 1, 3}, 6, 233583333.3, 0.05},
        Known{"small/sixcells_described_hdr1.grdecl", {1, 2, 3}, 5, 5082.4658, 5e-5},
        Known{"small/sixcells_lefthanded_hdr1.grdecl", {1, 2, 3}, 5, 5082.4658, 5e-5},
        Known{"small/dual_distorted1.grdecl", {5, 3, 1}, 13, 14.75, 5e-3}, Known{"small/twocell.grdecl", {1, 2, 1}, 2, 6114.208863, 5e-7},
        Known{"opm/FIVE.DATA", {1, 1, 5}, 5, 5, 1e-12}, Known{"opm/FIVE_ACTNUM.DATA", {1, 1, 5}, 4, 4, 1e-12},
        Known{"opm/FIVE_PINCH_NOGAP3.DATA", {1, 1, 5}, 5, 4, 1e-12}, Known{"opm/CORNERPOINT_ACTNUM.DATA", {10, 10, 5}, 100, 0, 0},
        Known{"resinsight/regular27cell.grdecl", {3, 3, 3}, 27, 3.375, 1e-12},
        Known{"upscaling/27cellsIso.grdecl", {3, 3, 3}, 27, 1, 1e-12}, Known{"upscaling/EightCells.grdecl", {2, 2, 2}, 8, 1, 1e-12}));

TEST(RealFragments, PropertiesNeedTheDims) {
    const auto path = real_data("cornerpoint/norne/ACTNUM_0704.prop");
    if (!path) GTEST_SKIP() << "no real data";
    const auto without = read_path(*path);
    ASSERT_FALSE(without);
    EXPECT_EQ(without.why().error.code, "F024");
    const auto d = read_path(*path, {{"dims", "46,112,22"}});
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(grid_of(*d).depths.empty());
    EXPECT_EQ(active_count(grid_of(*d)), 44927U);
    EXPECT_EQ(grid_of(*d).cell_count(), 113344U);
}

TEST(RealFragments, FaultsSayHowLargeTheirGridIsAtLeast) {
    const auto path = real_data("cornerpoint/norne/FAULT_JUN_05.INC");
    if (!path) GTEST_SKIP() << "no real data";
    const auto d = read_path(*path);
    ASSERT_TRUE(d) << why(d);
    std::size_t boxes = 0;
    for (const auto& f : grid_of(*d).faults) boxes += f.boxes.size();
    EXPECT_EQ(boxes, 977U);
    EXPECT_EQ(grid_of(*d).dims, (std::array<std::uint32_t, 3>{46, 112, 22}));
    EXPECT_TRUE(has_finding(*d, "F141"));
}

TEST(RealFragments, FaultsOfReek) {
    const auto path = real_data("cornerpoint/reek3/reek_sim_faults.grdecl");
    if (!path) GTEST_SKIP() << "no real data";
    const auto d = read_path(*path);
    ASSERT_TRUE(d) << why(d);
    std::size_t boxes = 0;
    for (const auto& f : grid_of(*d).faults) boxes += f.boxes.size();
    EXPECT_EQ(boxes, 136U);
    EXPECT_EQ(grid_of(*d).faults.size(), 6U);
}

TEST(RealFragments, AMissingIncludeIsToldWithThePathThatWasTried) {
    const auto path = real_data("cornerpoint/norne/NORNE_ATW2013.DATA");
    if (!path) GTEST_SKIP() << "no real data";
    const auto d = read_path(*path);
    ASSERT_FALSE(d);
    EXPECT_EQ(d.why().error.code, "F010");
    EXPECT_EQ(d.why().error.where.line, 148U);
    EXPECT_NE(d.why().error.message.find("IRAP_1005.GRDECL"), std::string::npos);
}

TEST(RealFragments, NorneWithoutWhatIsMissing) {
    const auto path = real_data("cornerpoint/norne/NORNE_ATW2013.DATA");
    if (!path) GTEST_SKIP() << "no real data";
    const auto d = read_path(*path, {{"includes", "skip"}});
    ASSERT_TRUE(d) << why(d);
    const CornerPointGrid& g = grid_of(*d);
    EXPECT_EQ(active_count(g), 44927U);
    EXPECT_EQ(g.faults.size(), 61U);
    EXPECT_EQ(g.region_multipliers.size(), 190U);
    EXPECT_EQ(g.least_pore_volume, 500.0);
    EXPECT_TRUE(has_finding(*d, "F131"));
    EXPECT_TRUE(loses_substance(d->losses));
    // PERMZ is PERMX times the factor of its layer.
    const auto x = values(g, "PERMX"), z = values(g, "PERMZ");
    const std::size_t layer = 46 * 112;
    for (std::size_t cell = 0; cell < layer; ++cell) {
        EXPECT_EQ(z[cell], x[cell] * 0.2);
        EXPECT_EQ(z[cell + 3 * layer], 0);
        EXPECT_EQ(z[cell + 21 * layer], x[cell + 21 * layer]);
    }
    EXPECT_EQ(values(g, "SATNUM"), std::vector<double>(113344, 1));
}

}  // namespace
}  // namespace geomend::test
