// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "support/program.h"
#include "support/real_data.h"
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

/// Errors and triangles of the model that a file is found to hold.
std::pair<int, std::uint64_t> judged(const std::string& file) {
    return {run_geomend({"validate", file}).status, test::info(file)["brep"]["triangles"].get<std::uint64_t>()};
}

TEST(MeshSplit, ASurfaceThatIsStatedFromBothSidesIsOneWhenReadBack) {
    const TemporaryFolder folder;
    std::vector<std::string> models{sample};
    if (const auto real = test::real_data("gocad/modelA4.so")) models.push_back(real->string());  // faults end in regions
    for (const std::string& model : models) {
        std::uint64_t triangles = 0;
        for (const char* extension : {".vtu", ".msh", ".mesh", ".meshb", ".inp"}) {
            SCOPED_TRACE(model + extension);
            const std::string whole = folder / (std::string("whole") + extension), split = folder / (std::string("split") + extension);
            ASSERT_EQ(run_geomend({"mesh", model, "-o", whole, "--lossy", "--split", "none"}).status, 0);
            ASSERT_EQ(run_geomend({"mesh", model, "-o", split, "--lossy", "--split", "all"}).status, 0);
            if (triangles == 0) triangles = judged(whole).second;
            EXPECT_EQ(judged(whole), (std::pair<int, std::uint64_t>(0, triangles)));
            EXPECT_EQ(judged(split), (std::pair<int, std::uint64_t>(0, triangles)));
        }
    }
}

/// The sample with a word in place of another, everywhere.
std::string changed_sample(const std::string& to, const std::vector<std::pair<std::string, std::string>>& words) {
    std::string text = test::read_file(sample);
    for (const auto& [word, other] : words) {
        for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += other.size()) text.replace(at, word.size(), other);
    }
    std::ofstream(to) << text;
    return to;
}

TEST(MeshSplit, NamesMayHaveCommas) {
    const TemporaryFolder folder;
    const std::string model = changed_sample(folder / "comma.ml", {{"TSURF fault", "TSURF f,1"},
                                                                   {"normal_fault fault", "normal_fault f,1"},
                                                                   {"SURFACE fault", "SURFACE f,1"},
                                                                   {"name:fault", "name:f,1"}});
    const auto status = [&](const std::string& names) {
        const auto ran = run_geomend({"mesh", model, "-o", folder / "m.vtu", "--json", "--lossy", "--split", names});
        return ran.status != 0 ? -ran.status : json::parse(ran.out)["split"]["surfaces"].get<int>();
    };
    EXPECT_EQ(status("f,1"), 5);
    EXPECT_GT(status("f,1,H1"), 5);
    EXPECT_EQ(status("H1,f,1"), status("f,1,H1"));
    EXPECT_EQ(status("f"), -2);
    EXPECT_EQ(status("1,f"), -2);
}

TEST(MeshSplit, AModelWithoutFaultsSaysThatNothingIsSplit) {
    const TemporaryFolder folder;
    const std::string model =
        changed_sample(folder / "plain.ml", {{"normal_fault", "top"}, {"GEOLOGICAL_TYPE normal_fault", "GEOLOGICAL_TYPE top"}});
    const auto ran = run_geomend({"mesh", model, "-o", folder / "m.vtu", "--lossy", "--split", "faults"});
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("nothing is split: no surface is a fault"), std::string::npos) << ran.out;
}

std::string shape_of(const std::string& file) { return test::info(file)["objects"][0]["counts"].dump(); }

TEST(MeshFormats, BinaryMeditHoldsWhatItsTextHolds) {
    const TemporaryFolder folder;
    const std::string solid = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.so";
    const std::string text = folder / "m.mesh", binary = folder / "m.meshb", again = folder / "again.mesh", twice = folder / "twice.meshb";
    ASSERT_EQ(run_geomend({"convert", solid, "-o", text, "--lossy"}).status, 0);
    ASSERT_EQ(run_geomend({"convert", solid, "-o", binary, "--lossy"}).status, 0);
    EXPECT_TRUE(test::read_file(binary).starts_with(std::string("\1\0\0\0", 4)));
    EXPECT_EQ(run_geomend({"validate", binary}).status, 0);
    EXPECT_EQ(shape_of(text), shape_of(binary));
    ASSERT_EQ(run_geomend({"convert", binary, "-o", again, "--lossy"}).status, 0);
    ASSERT_EQ(run_geomend({"convert", again, "-o", twice, "--lossy"}).status, 0);
    EXPECT_EQ(shape_of(again), shape_of(binary));
    EXPECT_EQ(shape_of(twice), shape_of(binary));
    EXPECT_EQ(run_geomend({"validate", twice}).status, 0);
}

TEST(MeshFormats, DamagedBinaryMeditIsRefused) {
    const TemporaryFolder folder;
    const std::string solid = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.so", binary = folder / "m.meshb";
    ASSERT_EQ(run_geomend({"convert", solid, "-o", binary, "--lossy"}).status, 0);
    const std::string whole = test::read_file(binary), damaged = folder / "d.meshb";
    for (const std::size_t size : {9ul, 100ul, whole.size() / 2, whole.size() - 20}) {
        std::ofstream(damaged, std::ios::binary) << whole.substr(0, size);
        EXPECT_EQ(run_geomend({"info", damaged}).status, 3) << size;
    }
    for (const std::size_t at : {12ul, 20ul, 24ul, 28ul, 32ul, 36ul, 40ul}) {
        std::string bytes = whole;
        bytes[at + 3] = '\x7f';
        std::ofstream(damaged, std::ios::binary) << bytes;
        const int status = run_geomend({"info", damaged}).status;
        EXPECT_TRUE(status == 3 || status == 0) << at << ": " << status;  // a coordinate may be any
    }
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
