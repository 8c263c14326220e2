// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>

#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// Hexahedra as a user makes them.

namespace geomend {
namespace {

using nlohmann::json;
using test::run_geomend;
using test::TemporaryFolder;

std::map<std::string, double> volumes_in(const std::string& file) {
    std::map<std::string, double> all;
    const json info = test::info(file);
    if (!info.contains("brep")) return all;
    for (const json& r : info["brep"]["region_volumes"]) all[r["name"]] = r["volume"];
    return all;
}

TEST(RecombineCommand, KeepsRegionsAndIsTheSameForAnyNumberOfThreads) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml", tets = folder / "tets.vtu";
    ASSERT_EQ(run_geomend({"mesh", sample, "-o", tets, "--size", "60", "--lossy"}).status, 0);
    for (const char* threads : {"1", "2"}) {
        const auto run =
            run_geomend({"mesh", "--recombine", tets, "-o", folder / (std::string(threads) + ".msh"), "--threads", threads, "--lossy"});
        ASSERT_EQ(run.status, 0) << run.err;
    }
    EXPECT_EQ(test::read_file(folder / "1.msh"), test::read_file(folder / "2.msh"));
    EXPECT_EQ(run_geomend({"validate", folder / "1.msh"}).status, 0);
    const auto before = volumes_in(tets), after = volumes_in(folder / "1.msh");
    ASSERT_EQ(before.size(), 6u);
    ASSERT_EQ(after.size(), before.size());
    for (const auto& [name, volume] : before) EXPECT_NEAR(after.at(name), volume, 2e-3 * volume) << name;
}

TEST(RecombineCommand, WhatDoesNotGoTogetherIsRefused) {
    const TemporaryFolder folder;
    EXPECT_EQ(run_geomend({"mesh", "--recombine", "a.vtu", "-o", folder / "b.vtu", "--size", "5"}).status, 2);
    EXPECT_EQ(run_geomend({"mesh", "a.vtu", "-o", folder / "b.vtu", "--cells", "cubes"}).status, 2);
    const auto tet = run_geomend({"mesh", "--recombine", "a.vtu", "-o", folder / "b.vtu", "--cells", "tet"});
    EXPECT_EQ(tet.status, 2);
    EXPECT_NE(tet.err.find("--cells tet does not go with it"), std::string::npos) << tet.err;
    for (const char* option : {"--ratio", "--time-limit", "--memory-limit"}) {
        const auto run = run_geomend({"mesh", "--recombine", "a.vtu", "-o", folder / "b.vtu", option, "2"});
        EXPECT_EQ(run.status, 2);
        EXPECT_NE(run.err.find(std::string(option) + " is for filling regions"), std::string::npos) << run.err;
    }
    EXPECT_EQ(run_geomend({"mesh", "a.vtu", "-o", folder / "b.vtu", "--select", "GMax1"}).status, 2);
    EXPECT_EQ(run_geomend({"mesh", "--recombine", "a.vtu", "-o", folder / "b.vtu", "--select", "GMax9"}).status, 2);
}

TEST(RecombineCommand, KeepsLinesAndCornersAndReportsRegionsByType) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml", tets = folder / "tets.vtu";
    ASSERT_EQ(run_geomend({"mesh", sample, "-o", tets, "--size", "60", "--lossy"}).status, 0);
    const std::string out = folder / "out.vtu";
    const auto run = run_geomend({"mesh", "--recombine", tets, "-o", out, "--lossy", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json before = test::info(tets), after = test::info(out), report = json::parse(run.out);
    for (const char* kind : {"edges", "vertices"}) {
        ASSERT_GT(before["objects"][0]["counts"][kind].get<int>(), 0);
        EXPECT_EQ(after["objects"][0]["counts"][kind], before["objects"][0]["counts"][kind]) << kind;
    }
    ASSERT_EQ(report["regions"].size(), 6u);
    std::map<std::string, int> cells;
    double volume = 0;
    for (const json& region : report["regions"]) {
        for (const auto& [type, count] : region["cells"].items()) cells[type] += count.get<int>();
        volume += region["volume"].get<double>();
    }
    EXPECT_NEAR(volume, 8e8, 1e-9 * 8e8);
    EXPECT_EQ(cells["hexahedron"], after["objects"][0]["counts"]["cell_types"]["hexahedron"].get<int>());
    EXPECT_EQ(cells["tetrahedron"], after["objects"][0]["counts"]["cell_types"]["tetrahedron"].get<int>());
    EXPECT_EQ(after["objects"][0]["counts"]["cells"].get<int>(), cells["hexahedron"] + cells["pyramid"] + cells["tetrahedron"]);
    EXPECT_GE(report["recombine"]["first_share"].get<double>(), report["quality"]["shares"]["hexahedron"]["volume"].get<double>());
}

TEST(RecombineCommand, SelectsByAHeuristicOfANameForComparison) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml", tets = folder / "tets.vtu";
    ASSERT_EQ(run_geomend({"mesh", sample, "-o", tets, "--size", "60", "--lossy"}).status, 0);
    std::map<std::string, double> shares;
    for (const char* rule : {"search", "GMax1", "GTet", "CographMAX", "CompCographRAND"}) {
        const auto run = run_geomend({"mesh", "--recombine", tets, "-o", folder / "out.vtu", "--lossy", "--json", "--select", rule});
        ASSERT_EQ(run.status, 0) << run.err;
        shares[rule] = json::parse(run.out)["recombine"]["first_share"].get<double>();
        EXPECT_GT(shares[rule], 0.01) << rule;
        EXPECT_EQ(run_geomend({"validate", folder / "out.vtu"}).status, 0) << rule;
    }
    EXPECT_GT(shares["search"], shares["GMax1"]);
}

TEST(RecombineCommand, TetrahedraOfARealModelBecomeHexahedraThatConform) {
    const auto file = test::real_data("gocad/modelA4.so");
    if (!file) GTEST_SKIP() << "no real data";
    const TemporaryFolder folder;
    const std::string out = folder / "out.vtu";
    const auto run = run_geomend({"mesh", "--recombine", file->string(), "-o", out, "--lossy", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json report = json::parse(run.out, nullptr, false);
    ASSERT_TRUE(report.is_object());
    EXPECT_GT(report["quality"]["shares"]["hexahedron"]["volume"].get<double>(), 0.45);
    EXPECT_GE(report["quality"]["min_scaled_jacobian"].get<double>(), 0.3);
    EXPECT_EQ(report["recombine"]["folded"], 0);
    EXPECT_EQ(report["recombine"]["split"], 0);
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
}

}  // namespace
}  // namespace geomend
