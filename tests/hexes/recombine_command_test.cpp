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
