// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "support/program.h"

// Regions smaller than a limit, merged into their neighbours.

namespace geomend {
namespace {

using test::run_geomend;
using test::TemporaryFolder;
using test::write_file;

std::string plane_of(const std::string& name, const std::string& type, const std::array<std::array<double, 3>, 4>& corners) {
    std::string text = "GOCAD TSurf 1\nHEADER {\nname:" + name + "\n}\nGEOLOGICAL_TYPE " + type + "\nTFACE\n";
    for (std::size_t i = 0; i < 4; ++i) {
        text += "VRTX " + std::to_string(i + 1);
        for (const double x : corners[i]) text += ' ' + std::to_string(x);
        text += '\n';
    }
    return text + "TRGL 1 2 3\nTRGL 1 3 4\nEND\n";
}

/// A box of 10 with a flat horizon at half its height and a fault at a slope of 1 to 20 that reaches it 0.1 before the eastern side:
/// above the horizon and below the fault lies a wedge of 0.0025.
std::string wedge() {
    return plane_of("west", "boundary", {{{0, 0, 0}, {0, 10, 0}, {0, 10, 10}, {0, 0, 10}}}) +
           plane_of("east", "boundary", {{{10, 0, 0}, {10, 10, 0}, {10, 10, 10}, {10, 0, 10}}}) +
           plane_of("south", "boundary", {{{0, 0, 0}, {10, 0, 0}, {10, 0, 10}, {0, 0, 10}}}) +
           plane_of("north", "boundary", {{{0, 10, 0}, {10, 10, 0}, {10, 10, 10}, {0, 10, 10}}}) +
           plane_of("base", "boundary", {{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}}) +
           plane_of("roof", "boundary", {{{0, 0, 10}, {10, 0, 10}, {10, 10, 10}, {0, 10, 10}}}) +
           plane_of("horizon", "top", {{{0, 0, 5}, {10, 0, 5}, {10, 10, 5}, {0, 10, 5}}}) +
           plane_of("listric", "normal_fault", {{{0, 0, 4.505}, {10, 0, 5.005}, {10, 10, 5.005}, {0, 10, 4.505}}});
}

std::vector<double> volumes(const nlohmann::json& brep) {
    std::vector<double> all;
    for (const auto& region : brep["region_volumes"]) all.push_back(region["volume"].get<double>());
    std::ranges::sort(all);
    return all;
}

// N. Euler's acceptance test 27.
TEST(MicroRegions, BetweenAHorizonAndAListricFaultTheHorizonsFaceGoes) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", wedge());
    write_file(folder / "recipe.toml", "micro_volume = 0.01\n");
    ASSERT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "sealed.ml"}).status, 0);
    const auto before = volumes(test::info(folder / "sealed.ml")["brep"]);
    ASSERT_EQ(before.size(), 4u);
    EXPECT_NEAR(before[0], 0.0025, 1e-9);
    const auto run =
        run_geomend({"repair", folder / "sealed.ml", "-o", folder / "out.ml", "--recipe", folder / "recipe.toml", "--steps", "micro"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("across 'horizon'"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("regions lost"), std::string::npos) << run.out;
    const auto after = volumes(test::info(folder / "out.ml")["brep"]);
    ASSERT_EQ(after.size(), 3u);
    double sum = 0;
    for (const double v : after) sum += v;
    EXPECT_NEAR(sum, 1000, 1e-9);
    EXPECT_NEAR(after[0], 0.5 * 9.9 * 0.495 * 10, 1e-6) << "the larger wedge stays";
}

TEST(MicroRegions, WithoutALimitOnlyWhatIsLessThanAMillionthGoes) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", wedge());
    ASSERT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "sealed.ml"}).status, 0);
    const auto run = run_geomend({"repair", folder / "sealed.ml", "-o", folder / "out.ml", "--steps", "micro"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(volumes(test::info(folder / "out.ml")["brep"]).size(), 4u);
}

TEST(MicroRegions, FacesOfTheBoxNeverGo) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", wedge());
    write_file(folder / "recipe.toml", "steps = [\"micro\"]\nmicro_volume = 1e9\n");
    ASSERT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "sealed.ml"}).status, 0);
    run_geomend({"repair", folder / "sealed.ml", "-o", folder / "out.ml", "--recipe", folder / "recipe.toml", "--keep-invalid"});
    const auto after = volumes(test::info(folder / "out.ml")["brep"]);
    ASSERT_EQ(after.size(), 1u) << "all are one, and the box is whole";
    EXPECT_NEAR(after[0], 1000, 1e-9);
}

}  // namespace
}  // namespace geomend
