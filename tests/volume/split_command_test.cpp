// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "support/program.h"
#include "support/temporary_folder.h"

// `mesh --split` as a user runs it.

namespace geomend {
namespace {

using nlohmann::json;
using test::run_geomend;
using test::TemporaryFolder;

const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml";

json mesh(const std::string& out, const std::string& split) {
    return json::parse(run_geomend({"mesh", sample, "-o", out, "--json", "--lossy", "--split", split}).out, nullptr, false);
}

std::uint64_t points_of(const std::string& file) { return test::info(file)["objects"][0]["counts"]["points"].get<std::uint64_t>(); }

TEST(MeshSplit, DoublesPointsAlongFaultsAndStaysValid) {
    const TemporaryFolder folder;
    for (const char* extension : {".vtu", ".msh"}) {
        const std::string whole = folder / (std::string("whole") + extension), split = folder / (std::string("split") + extension);
        EXPECT_EQ(mesh(whole, "none")["split"]["vertices"], 0);
        const json report = mesh(split, "faults")["split"];
        EXPECT_EQ(report["surfaces"], 5) << "the pieces of the fault";
        EXPECT_GT(report["vertices"].get<std::uint64_t>(), 0u);
        EXPECT_EQ(points_of(split), points_of(whole) + report["vertices"].get<std::uint64_t>()) << extension;
        EXPECT_EQ(run_geomend({"validate", split}).status, 0) << extension;
    }
}

TEST(MeshSplit, AlongAllSurfacesEachPairIsTwoFacesOfAbaqus) {
    const TemporaryFolder folder;
    const json report = mesh(folder / "m.vtu", "all")["split"];
    EXPECT_EQ(run_geomend({"convert", folder / "m.vtu", "-o", folder / "m.inp", "--lossy"}).status, 0);
    const auto again = run_geomend({"convert", folder / "m.inp", "-o", folder / "n.vtu", "--lossy"});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(points_of(folder / "m.vtu"), points_of(folder / "m.inp"));
    EXPECT_GT(report["pairs"].get<std::uint64_t>(), 0u);
}

TEST(MeshFormats, WhatTheyHoldOfASoundModelIsReadAsASoundModel) {
    const TemporaryFolder folder;
    const std::string solid = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.so";
    for (const char* name : {"m.inp", "m.mesh", "m.ele"}) {
        const std::string out = folder / name;
        ASSERT_EQ(run_geomend({"convert", solid, "-o", out, "--lossy"}).status, 0) << name;
        const auto judged = run_geomend({"validate", out});
        EXPECT_EQ(judged.status, 0) << judged.out;
        EXPECT_EQ(run_geomend({"mesh", out, "-o", folder / "again.vtu", "--lossy"}).status, 0) << name;
    }
    EXPECT_EQ(run_geomend({"convert", solid, "-o", folder / "x", "--to", "mesh", "--lossy"}).status, 0);
    EXPECT_TRUE(test::read_file(folder / "x").starts_with("MeshVersionFormatted"));
}

TEST(MeshSplit, ReachesItsTargetsWithoutALossOfItsOwn) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_geomend({"mesh", sample, "-o", folder / "m.msh", "--lossy", "--split", "faults"}).status, 0);
    const auto run = run_geomend({"convert", folder / "m.msh", "-o", folder / "m.inp", "--lossy", "--verbose"});
    EXPECT_EQ(run.err.find("doubled_from"), std::string::npos) << run.err;
}

TEST(MeshSplit, NamesThatAreNotThereAreNamedWithTheNearest) {
    const TemporaryFolder folder;
    const auto run = run_geomend({"mesh", sample, "-o", folder / "m.vtu", "--lossy", "--split", "fautl"});
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("'fault'"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "m.vtu"));
}

}  // namespace
}  // namespace geomend
