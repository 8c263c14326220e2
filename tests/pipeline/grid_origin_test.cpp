// SPDX-License-Identifier: AGPL-3.0-or-later
// A grid in map coordinates goes into files of single precision by way of a local origin, and comes back.
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/convert.h"
#include "pipeline/load.h"
#include "support/program.h"

namespace geomend {
namespace {

// Four columns at a UTM northing, as text.
std::string deck() {
    std::string text = "SPECGRID\n 2 2 1 1 F /\nGRIDUNIT\n METRES /\nCOORD\n";
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            const std::string x = std::to_string(461234.567 + 103.3 * i), y = std::to_string(5932109.876 + 97.7 * j);
            text += x + ' ' + y + " 1500 " + x + ' ' + y + " 1600\n";
        }
    }
    return text + "/\nZCORN\n 16*1510.5 16*1530.25 /\n";
}

CornerPointGrid read(const std::filesystem::path& file) {
    auto dataset = load(file.string(), {});
    EXPECT_TRUE(dataset.ok());
    return std::get<CornerPointGrid>(std::move(dataset->objects.front()));
}

TEST(GridOrigin, lets_a_grid_in_utm_go_to_egrid_and_back_without_loss) {
    const test::TemporaryFolder folder;
    test::write_file(folder / "utm.grdecl", deck());
    const auto utm = (folder / "utm.grdecl").string(), egrid = (folder / "g.egrid").string(), back = (folder / "back.grdecl").string();
    const auto refused = test::run_geomend({"convert", utm, "-o", egrid});
    EXPECT_EQ(refused.status, 4);
    EXPECT_NE((refused.out + refused.err).find("--option origin=local"), std::string::npos) << refused.err;
    const auto run = test::run_geomend({"convert", utm, "-o", egrid, "--option", "origin=local"});
    EXPECT_EQ(run.status, 0) << run.err;
    const CornerPointGrid stored = read(egrid);
    ASSERT_TRUE(stored.map_axes.has_value());
    EXPECT_EQ((*stored.map_axes)[2], 461300);
    EXPECT_EQ((*stored.map_axes)[3], 5932200);
    ASSERT_EQ(test::run_geomend({"convert", egrid, "-o", back, "--option", "map=apply"}).status, 0);
    const CornerPointGrid first = read(utm), last = read(back);
    for (std::size_t i = 0; i < first.pillars.size(); ++i) EXPECT_NEAR(last.pillars[i], first.pillars[i], 1e-5);
    EXPECT_EQ(last.depths, first.depths);
}

TEST(GridOrigin, is_refused_for_formats_without_map_axes) {
    const test::TemporaryFolder folder;
    test::write_file(folder / "utm.grdecl", deck());
    const auto run = test::run_geomend(
        {"convert", (folder / "utm.grdecl").string(), "-o", (folder / "g.roff").string(), "--lossy", "--option", "origin=local"});
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("map axes"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace geomend
