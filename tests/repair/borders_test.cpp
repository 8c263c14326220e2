// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>

#include "support/program.h"

// Lines of several surfaces in their coarsest common discretisation.

namespace geomend {
namespace {

using test::run_geomend;
using test::TemporaryFolder;

const std::string layered_box = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml";

std::vector<int> sizes(const nlohmann::json& brep) {
    std::vector<int> all;
    for (const char* key : {"corners", "lines", "surfaces", "regions"}) all.push_back(brep[key].get<int>());
    return all;
}

// N. Euler's acceptance test 22, from file to file.
TEST(Borders, ACutModelGetsCoarserLinesAndKeepsItsRegions) {
    const TemporaryFolder folder;
    // A fault that was moved cuts the others at their edges: its lines have more nodes than any surface needs.
    test::write_file(folder / "move.toml", "[[edit]]\naction = \"move\"\nsurface = \"fault\"\nby = [7, 0, 0]\n");
    ASSERT_EQ(run_geomend({"repair", layered_box, "--recipe", folder / "move.toml", "-o", folder / "moved.ml"}).status, 0);
    const auto run = run_geomend({"repair", folder / "moved.ml", "-o", folder / "out.ml", "--steps", "borders"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(run.out.find("undone"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find(" 0 lines resampled"), std::string::npos) << run.out;
    const auto before = test::info(folder / "moved.ml")["brep"], after = test::info(folder / "out.ml")["brep"];
    EXPECT_EQ(sizes(after), sizes(before));
    EXPECT_LT(after["triangles"].get<int>(), before["triangles"].get<int>());
    double sum = 0;
    for (const auto& region : after["region_volumes"]) sum += region["volume"].get<double>();
    EXPECT_NEAR(sum, 8e8, 1e-2) << "the sides of the box are planar";
    const auto again = run_geomend({"repair", folder / "moved.ml", "-o", folder / "again.ml", "--steps", "borders", "--threads", "2"});
    EXPECT_EQ(again.status, 0);
    EXPECT_EQ(test::read_file(folder / "out.ml"), test::read_file(folder / "again.ml"));
}

}  // namespace
}  // namespace geomend
