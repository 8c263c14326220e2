// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <ostream>

#include "formats/eclipse/eclipse.h"
#include "grid/cell_geometry.h"
#include "roff_testing.h"

namespace geomend::test {
namespace {

struct Expected {
    const char* file;
    std::array<std::uint32_t, 3> dims;
    std::size_t active;
    double volume, relative;
};
void PrintTo(const Expected& o, std::ostream* out) { *out << o.file; }

class RealRoff : public testing::TestWithParam<Expected> {};

TEST_P(RealRoff, HasItsDimsActiveCellsAndVolume) {
    const Expected& e = GetParam();
    const auto path = real_data(std::string("cornerpoint/") + e.file);
    if (!path) GTEST_SKIP() << "no real data";
    auto data = read_roff(*path);
    const CornerPointGrid& grid = grid_of(data);
    EXPECT_EQ(misfit(grid), "");
    EXPECT_EQ(grid.dims, e.dims);
    EXPECT_EQ(active_count(grid), e.active);
    EXPECT_NEAR(grid::volume(grid), e.volume, e.relative * e.volume);
    EXPECT_TRUE(data->findings.empty());
}

INSTANTIATE_TEST_SUITE_P(Files, RealRoff,
                         testing::Values(Expected{"reek/reek_sim_grid.roff", {40, 64, 14}, 35838, 2939630953, 2e-8},
                                         Expected{"reek/reek_grid_fromegrid.roff", {40, 64, 14}, 35838, 2939630953, 1e-6},
                                         Expected{"reek/reek_grd_w_props.roffasc", {40, 64, 14}, 35838, 2939630953, 1e-6},
                                         Expected{"small/banal6.roff", {4, 2, 3}, 24, 29921.875, 1e-8},
                                         Expected{"small/banal6.roffasc", {4, 2, 3}, 24, 29921.875, 1e-8},
                                         Expected{"small/twocell.roff_asc", {1, 2, 1}, 2, 6114.208863, 2e-4}));

TEST(RealRoff, BulkVolumesAreThoseOfTheProgramThatWroteTheFile) {
    const auto path = real_data("cornerpoint/small/gridqc1.roff"), bulk = real_data("cornerpoint/small/gridqc1_totbulk.roff");
    if (!path || !bulk) GTEST_SKIP() << "no real data";
    auto data = read_roff(*path), parameter = read_roff(*bulk);
    const CornerPointGrid &grid = grid_of(data), &with = grid_of(parameter);
    EXPECT_TRUE(with.pillars.empty());
    ASSERT_EQ(with.dims, grid.dims);
    const Attribute* a = find_attribute(with.info.attributes, "Total_bulk", AttributeLocation::cell);
    ASSERT_NE(a, nullptr);
    const auto volumes = grid::cell_volumes(grid);
    std::size_t compared = 0;
    for (std::size_t c = 0; c < grid.cell_count(); ++c) {
        const double expected = value_as_double(*a, c);
        if (!grid.is_active(c) || is_no_data(*a, expected)) continue;
        EXPECT_NEAR(std::abs(volumes[c]), expected, 1e-4 * std::abs(expected) + 1) << c;
        ++compared;
    }
    EXPECT_GT(compared, 300u);
}

TEST(RealRoff, ParametersHaveTypesCodesAndOrder) {
    const auto zone_path = real_data("cornerpoint/reek/reek_sim_zone.roff"), poro_path = real_data("cornerpoint/reek/reek_sim_poro.roff"),
               all_path = real_data("cornerpoint/reek/reek_grd_w_props.roffasc");
    if (!zone_path || !poro_path || !all_path) GTEST_SKIP() << "no real data";
    auto zone = read_roff(*zone_path), poro = read_roff(*poro_path), all = read_roff(*all_path);
    const auto& z = grid_of(zone).info.attributes;
    ASSERT_EQ(z.size(), 1u);
    EXPECT_EQ(z[0].code_names,
              (std::vector<std::pair<int, std::string>>{{1, "Below_Top_reek"}, {2, "Below_Mid_reek"}, {3, "Below_Low_reek"}}));
    const auto& codes = std::get<std::vector<std::int32_t>>(z[0].values);
    EXPECT_EQ(codes[0], 1);                // top of the first column: the last of its values in the file
    EXPECT_EQ(codes[40 * 64 * 13], -999);  // bottom of it
    EXPECT_TRUE(is_no_data(z[0], codes[40 * 64 * 13]));
    const Attribute* p = find_attribute(grid_of(all).info.attributes, "PORO", AttributeLocation::cell);
    ASSERT_NE(p, nullptr);
    const auto &a = std::get<std::vector<float>>(grid_of(poro).info.attributes[0].values), &b = std::get<std::vector<float>>(p->values);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(find_attribute(grid_of(all).info.attributes, "FIPNUM", AttributeLocation::cell)->code_names.size(), 2u);
}

/// A point of a grid in map coordinates.
Vec3 on_map(const CornerPointGrid& grid, const Vec3& p) {
    if (!grid.map_axes) return p;
    const auto& m = *grid.map_axes;
    const double lx = std::hypot(m[4] - m[2], m[5] - m[3]), ly = std::hypot(m[0] - m[2], m[1] - m[3]);
    return {m[2] + p[0] * (m[4] - m[2]) / lx + p[1] * (m[0] - m[2]) / ly, m[3] + p[0] * (m[5] - m[3]) / lx + p[1] * (m[1] - m[3]) / ly,
            p[2]};
}

TEST(RealRoff, ReekAgreesWithItsEgridOnTheMap) {
    const auto roff_path = real_data("cornerpoint/reek/reek_sim_grid.roff"), egrid_path = real_data("cornerpoint/reek/REEK.EGRID");
    if (!roff_path || !egrid_path) GTEST_SKIP() << "no real data";
    auto a_data = read_roff(*roff_path);
    auto b_data = eclipse::formats()[0].read(*Input::open(egrid_path->string()), {});
    const CornerPointGrid &a = grid_of(a_data), &b = grid_of(b_data);
    ASSERT_EQ(a.dims, b.dims);
    double worst = 0;
    for (std::size_t cell = 0; cell < a.cell_count(); ++cell) {
        ASSERT_EQ(a.is_active(cell), b.is_active(cell));
        if (!a.is_active(cell)) continue;
        const auto [i, j, k] = a.ijk(cell);
        const auto p = cell_corners(a, i, j, k), q = cell_corners(b, i, j, k);
        for (std::size_t c = 0; c < 8; ++c) {
            const Vec3 m = on_map(b, q[c]);
            for (std::size_t d = 0; d < 3; ++d) worst = std::max(worst, std::abs(p[c][d] - m[d]));
        }
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(worst, 0.002);  // the EGRID has its coordinates printed with three digits before they became floats
}

}  // namespace
}  // namespace geomend::test
