// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "base/sanitisers.h"
#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// The command mesh as a user runs it.

namespace geomend {
namespace {

using nlohmann::json;
using test::run_geomend;
using test::TemporaryFolder;

std::string sample(const std::string& name) { return std::string(GEOMEND_SOURCE_DIR) + "/samples/" + name; }

json mesh(const std::string& in, const std::string& out, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"mesh", in, "-o", out, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return json::parse(run_geomend(arguments).out, nullptr, false);
}

std::map<std::string, double> volumes(const json& info) {
    std::map<std::string, double> all;
    if (!info.contains("brep")) return all;
    for (const json& r : info["brep"]["region_volumes"]) all[r["name"]] = r["volume"];
    return all;
}

TEST(Mesh, FillsASampleInEveryFormatThatHoldsCells) {
    const TemporaryFolder folder;
    const auto before = volumes(test::info(sample("layered_box.ml")));
    ASSERT_EQ(before.size(), 6u);
    for (const char* extension : {".vtu", ".msh", ".vtm", ".vtk"}) {
        const std::string out = folder / (std::string("out") + extension);
        const json report = mesh(sample("layered_box.ml"), out);
        ASSERT_TRUE(report.is_object() && report["written"] == true) << extension;
        double sum = 0;
        std::uint64_t cells = 0;
        for (const json& region : report["regions"]) {
            sum += region["volume"].get<double>();
            cells += region["cells"]["tetrahedron"].get<std::uint64_t>();
            EXPECT_NEAR(region["volume"].get<double>(), before.at(region["name"]), 1e-9 * before.at(region["name"]));
        }
        EXPECT_NEAR(sum, 8e8, 1e-9 * 8e8) << extension;
        EXPECT_EQ(report["blocks"].back()["first"].get<std::uint64_t>() + report["blocks"].back()["count"].get<std::uint64_t>(), cells);
        const json info = test::info(out);
        for (const auto& [name, volume] : volumes(info)) EXPECT_NEAR(volume, before.at(name), 1e-9 * volume) << extension << ' ' << name;
        std::uint64_t read = 0;
        for (const json& object : info["objects"]) {
            if (object["counts"].contains("cell_types")) read += object["counts"]["cell_types"].value("tetrahedron", std::uint64_t{0});
        }
        EXPECT_EQ(read, cells) << extension;
        EXPECT_EQ(run_geomend({"validate", out}).status, 0) << extension;
    }
}

TEST(Mesh, NoCellLiesFlatOnTwoTrianglesOfAFold) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--size", "100"}, {"--size", "150"}}) {
        const json report = mesh(sample("layered_box.ml"), folder / "out.vtu", more);
        ASSERT_TRUE(report.is_object());
        for (const json& region : report["regions"]) {
            EXPECT_EQ(region["below_5_degrees"]["cells"], 0) << region["name"];
            EXPECT_GT(region["min_dihedral"].get<double>(), 5) << region["name"];
        }
    }
}

TEST(Mesh, GivesTheSameBytesForAnyNumberOfThreads) {
    const TemporaryFolder folder;
    for (const char* threads : {"1", "2"}) {
        ASSERT_EQ(
            run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / (std::string(threads) + ".msh"), "--threads", threads}).status,
            0);
    }
    EXPECT_EQ(test::read_file(folder / "1.msh"), test::read_file(folder / "2.msh"));
}

/// The number behind a word of a message, or 0.
double number_behind(const std::string& text, const std::string& word) {
    const auto at = text.find(word);
    return at == std::string::npos ? 0 : std::strtod(text.c_str() + at + word.size(), nullptr);
}

TEST(Mesh, SizesThatMakeTooManyCellsAreRefusedAtOnceWithTheirNumberAndSizesThatDo) {
    const TemporaryFolder folder;
    const std::string out = folder / "out.vtu";
    const std::vector<std::vector<std::string>> hopeless = {{"--size", "1e-9"},
                                                            {"--size", "1e-300"},
                                                            {"--size", "1e-9", "--method", "isotropic"},
                                                            {"--size", "0.01", "--method", "lattice"},
                                                            {"--size", "0.01", "--cells", "hex-dominant", "--lossy"},
                                                            {"--size", "0.01", "--cells", "hybrid", "--lossy"},
                                                            {"--size", "50", "--size-of", "west_1=1e-6"},
                                                            {"--size", "50", "--size-by", "distance=fault:1e-6"},
                                                            {"--size", "50", "--size-by", "distance=fault:0.01:0.1"}};
    const auto begin = std::chrono::steady_clock::now();
    for (auto arguments : hopeless) {
        arguments.insert(arguments.begin(), {"mesh", sample("layered_box.ml"), "-o", out});
        const auto run = run_geomend(arguments);
        EXPECT_EQ(run.status, 5) << run.err;
        EXPECT_GT(number_behind(run.err, " make about "), 2e7) << run.err;
        EXPECT_NE(run.err.find("--max-cells"), std::string::npos) << run.err;
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
    const auto refused =
        run_geomend({"mesh", sample("layered_box.ml"), "-o", out, "--size", "60", "--method", "isotropic", "--max-cells", "9000"});
    const double number = number_behind(refused.err, " make about "), larger = number_behind(refused.err, "are allowed: edges of ");
    ASSERT_GT(larger, 60) << refused.err;
    const auto cells = [](const json& report) {
        std::uint64_t all = 0;
        for (const json& region : report["regions"]) all += region["cells"]["tetrahedron"].get<std::uint64_t>();
        return static_cast<double>(all);
    };
    const json as_asked = mesh(sample("layered_box.ml"), out, {"--size", "60", "--method", "isotropic"});
    EXPECT_NEAR(cells(as_asked), number, 0.2 * number);
    const json coarser =
        mesh(sample("layered_box.ml"), out, {"--size", std::to_string(larger), "--method", "isotropic", "--max-cells", "9000"});
    ASSERT_TRUE(coarser.is_object()) << "the size that was offered was refused";
    EXPECT_EQ(coarser["written"], true);
}

TEST(Mesh, AModelWithErrorsIsNotFilledAndAnOlderOutputStays) {
    const TemporaryFolder folder;
    const std::string out = folder / "out.vtu";
    test::write_file(out, "old");
    const auto run = run_geomend({"mesh", sample("layered_box_gap.ml"), "-o", out});
    EXPECT_EQ(run.status, 6) << run.err;
    EXPECT_NE(run.err.find("geomend repair"), std::string::npos) << run.err;
    EXPECT_EQ(test::read_file(out), "old");
    const json report = mesh(sample("layered_box_gap.ml"), out);
    EXPECT_EQ(report["written"], false);
    EXPECT_FALSE(report["errors"].empty());
    EXPECT_EQ(test::read_file(out), "old");
}

TEST(Mesh, ATryThatHitsItsLimitLeavesTheOlderOutputAndNamesRegionsAndReason) {
    const TemporaryFolder folder;
    const std::string out = folder / "out.vtu";
    test::write_file(out, "old");
    const auto run = run_geomend({"mesh", sample("layered_box.ml"), "-o", out, "--time-limit", "0.0001"});
    EXPECT_EQ(run.status, 5) << "a limit was hit";
    EXPECT_NE(run.err.find("--time-limit"), std::string::npos) << run.err;
    EXPECT_NE(run.out.find("did not end"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("'west_1'"), std::string::npos) << run.out;
    EXPECT_EQ(test::read_file(out), "old");
    if (with_address_sanitiser) GTEST_SKIP() << "the address sanitiser reserves terabytes";
    const auto small = run_geomend({"mesh", sample("layered_box.ml"), "-o", out, "--size", "30", "--memory-limit", "1"});
    EXPECT_EQ(small.status, 5) << "a limit was hit";
    EXPECT_NE(small.err.find("--memory-limit"), std::string::npos) << small.err;
    EXPECT_NE(small.out.find("needs more than 1 MB"), std::string::npos) << small.out;
}

TEST(Mesh, CellsHaveTheSizeThatIsAskedForInEveryRegion) {
    const TemporaryFolder folder;
    const double size = 40, regular = size * size * size / (6 * std::sqrt(2.0));
    const json made = mesh(sample("layered_box.ml"), folder / "box.vtu", {"--size", "40"});
    ASSERT_TRUE(made.is_object() && made["written"] == true);
    for (const json& r : made["regions"]) {
        EXPECT_GT(r["cells"]["tetrahedron"].get<double>(), 0.25 * r["volume"].get<double>() / regular) << r["name"];
        EXPECT_EQ(r["as_asked"], true) << r["name"];
    }
}

TEST(Mesh, SurfacesOutsideOfAllRegionsAreNamed) {
    const TemporaryFolder folder;
    test::write_file(folder / "finned.ts",
                     "GOCAD TSurf 1\nHEADER {\nname:box\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 1 1 0\nVRTX 4 0 1 0\nVRTX 5 0 0 1\n"
                     "VRTX 6 1 0 1\nVRTX 7 1 1 1\nVRTX 8 0 1 1\nTRGL 1 3 2\nTRGL 1 4 3\nTRGL 5 6 7\nTRGL 5 7 8\nTRGL 1 2 6\nTRGL 1 6 5\n"
                     "TRGL 2 3 7\nTRGL 2 7 6\nTRGL 3 4 8\nTRGL 3 8 7\nTRGL 4 1 5\nTRGL 4 5 8\nEND\n"
                     "GOCAD TSurf 1\nHEADER {\nname:fin\n}\nTFACE\nVRTX 1 1 0 0\nVRTX 2 1 0 1\nVRTX 3 2 -1 0.5\nTRGL 1 3 2\nEND\n");
    const std::string in = (folder / "finned.ts").string();
    const json report = mesh(in, (folder / "a.vtu").string());
    ASSERT_TRUE(report["written"]) << report;
    ASSERT_EQ(report["surfaces_outside_regions"].size(), 1u) << report;
    EXPECT_EQ(report["surfaces_outside_regions"][0], "fin");
    const auto said = run_geomend({"mesh", in, "-o", (folder / "b.vtu").string()});
    EXPECT_NE(said.out.find("1 surface lies outside of all regions"), std::string::npos) << said.out;
}

TEST(Mesh, AdviceFitsTheReasonWhyThereIsNothingToFill) {
    const TemporaryFolder folder;
    const auto words = [&](const std::string& file) {
        const auto run = run_geomend({"mesh", file, "-o", folder / "out.vtu"});
        EXPECT_EQ(run.status, 4) << file;
        return run.err;
    };
    for (const char* name : {"wells.wl", "h1_grid.zmap", "h1_picks.vs"})
        EXPECT_NE(words(sample(name)).find("there are no surfaces"), std::string::npos) << name;
    EXPECT_NE(words(sample("faulted_grid.grdecl")).find("a grid has its cells"), std::string::npos);
    EXPECT_NE(words(sample("open_layers.ts")).find("geomend repair closes gaps"), std::string::npos);
    const std::string box = test::read_file(sample("layered_box.ml"));
    std::string other = box;
    other.replace(other.find("name:layered_box"), 16, "name:layered_too");
    test::write_file(folder / "two.ml", box + other);
    const std::string two = words(folder / "two.ml");
    EXPECT_NE(two.find("2 models with regions"), std::string::npos) << two;
    EXPECT_NE(two.find("one by one"), std::string::npos) << two;
}

TEST(Mesh, AReportThatCannotBePrintedSaysThatTheMeshIsWritten) {
    const TemporaryFolder folder;
    const std::string out = folder / "out.vtu";
    const std::string words = folder / "err";
    const std::string line =
        std::string(GEOMEND_PROGRAM) + " mesh " + sample("layered_box.ml") + " -o " + out + " --json >/dev/full 2>" + words;
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 4);
    EXPECT_NE(test::read_file(words).find("out.vtu is written all the same"), std::string::npos) << test::read_file(words);
    EXPECT_TRUE(std::filesystem::exists(out));
}

TEST(Mesh, TheRoleOfOneSurfaceIsNotThatOfTheMesh) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "out.vtu"}).status, 0);
    const json read = test::info(folder / "out.vtu");
    ASSERT_FALSE(read["objects"].empty());
    for (const json& object : read["objects"]) {
        EXPECT_TRUE(object["kind"] != "cell-mesh" || !object.contains("role")) << object;
    }
}

TEST(Mesh, ATargetWithoutCellsRefusesThem) {
    const TemporaryFolder folder;
    EXPECT_EQ(run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "out.ml"}).status, 4);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.ml"));
}

TEST(Mesh, CellsOfASolidGiveWayAndTheirValuesAreLostOnlyWhenAllowed) {
    const TemporaryFolder folder;
    const std::string out = folder / "out.vtu";
    const auto refused = run_geomend({"mesh", sample("layered_box.so"), "-o", out});
    EXPECT_EQ(refused.status, 4) << refused.err;
    EXPECT_NE(refused.err.find("porosity"), std::string::npos) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(out));
    const json report = mesh(sample("layered_box.so"), out, {"--lossy"});
    ASSERT_TRUE(report.is_object() && report["written"] == true);
    EXPECT_FALSE(report["loss"].empty());
    const auto judged = run_geomend({"validate", out, "--fail-on", "warning"});  // no point that nothing uses
    EXPECT_EQ(judged.status, 0) << judged.out;
}

TEST(Mesh, OptionsThatAreNoNumbersAreRefused) {
    const TemporaryFolder folder;
    for (const char* option : {"--size", "--ratio", "--time-limit", "--memory-limit"}) {
        for (const char* value : {"nan", "-1", "x"})
            EXPECT_EQ(run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "out.vtu", option, value}).status, 2)
                << option << ' ' << value;
    }
    EXPECT_EQ(run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "out.vtu", "--size", "0"}).status, 2);
    EXPECT_EQ(run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "out.vtu", "--ratio", "0.5"}).status, 2) << "no cell has less";
}

TEST(Mesh, CellsNearASurfaceAreSmallWhereADistanceFromItSaysSoAndSurfacesStay) {
    const TemporaryFolder folder;
    const std::string size = "150";
    const json even = mesh(sample("layered_box.ml"), folder / "even.vtu", {"--size", size});
    const json near = mesh(sample("layered_box.ml"), folder / "near.vtu", {"--size", size, "--size-by", "distance=fault:25:30"});
    ASSERT_TRUE(even.is_object() && even["written"] == true && near.is_object() && near["written"] == true);
    std::uint64_t few = 0, many = 0;
    for (const json& r : even["regions"]) few += r["cells"]["tetrahedron"].get<std::uint64_t>();
    for (const json& r : near["regions"]) {
        many += r["cells"]["tetrahedron"].get<std::uint64_t>();
        EXPECT_EQ(r["rung"], "tetgen pYqam") << r["name"];
        EXPECT_EQ(r["as_asked"], true);
    }
    EXPECT_GT(many, 3 * few);
    EXPECT_EQ(even["face_sets"], near["face_sets"]);
    EXPECT_EQ(run_geomend({"validate", folder / "near.vtu"}).status, 0);
    const auto wrong =
        run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "no.vtu", "--size", size, "--size-by", "distance=fautl:25"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("'fault'"), std::string::npos) << wrong.err;
    EXPECT_EQ(run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "no.vtu", "--size-by", "distance=fault:25"}).status, 2);
}

TEST(Mesh, ARegionHasASizeOfItsOwn) {
    const TemporaryFolder folder;
    const json even = mesh(sample("layered_box.ml"), folder / "even.vtu", {"--size", "150"});
    const std::string name = even["regions"][1]["name"];  // the first one has too few triangles around for smaller cells
    const json one = mesh(sample("layered_box.ml"), folder / "one.vtu", {"--size", "150", "--size-of", name + "=40"});
    ASSERT_TRUE(one.is_object() && one["written"] == true);
    for (std::size_t r = 0; r < one["regions"].size(); ++r) {
        const auto before = even["regions"][r]["cells"]["tetrahedron"].get<std::uint64_t>(),
                   after = one["regions"][r]["cells"]["tetrahedron"].get<std::uint64_t>();
        if (r == 1) EXPECT_GT(after, 3 * before);
        else EXPECT_EQ(after, before);
    }
    const auto wrong = run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "no.vtu", "--size-of", "fautl=40"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("'fault'"), std::string::npos) << wrong.err;
    EXPECT_EQ(run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "no.vtu", "--size-of", "fault=40"}).status, 2);
}

TEST(Mesh, AResultWithoutStressIsRefused) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "cells.vtu"}).status, 0);
    const auto no_stress = run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "no.vtu", "--resize-by", folder / "cells.vtu"});
    EXPECT_EQ(no_stress.status, 4);
    EXPECT_NE(no_stress.err.find("six components"), std::string::npos) << no_stress.err;
    const auto no_cells = run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "no.vtu", "--resize-by", sample("layered_box.ml")});
    EXPECT_EQ(no_cells.status, 4);
    const auto no_file = run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "no.vtu", "--resize-by", folder / "none.vtu"});
    EXPECT_EQ(no_file.status, 3);
    EXPECT_NE(no_stress.err.find("leave out --resize-by"), std::string::npos) << no_stress.err;
}

TEST(Mesh, NumbersThatAreNoneAreRefusedForResults) {
    const TemporaryFolder folder;
    for (const auto& [option, value] : {std::pair("--error", "nan"), {"--error", "0"}, {"--poisson", "nan"}, {"--poisson", "0.5"}}) {
        const auto run = run_geomend(
            {"mesh", sample("layered_box.ml"), "-o", folder / "no.vtu", "--resize-by", sample("layered_box.ml"), option, value});
        EXPECT_EQ(run.status, 2) << option << ' ' << value;
    }
    const auto lattice = run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "no.vtu", "--size", "100", "--method", "lattice",
                                      "--resize-by", sample("layered_box.ml")});
    EXPECT_EQ(lattice.status, 2) << lattice.err;
}

TEST(Mesh, SurfacesWithoutARegionAreRefused) {
    const TemporaryFolder folder;
    const auto run = run_geomend({"mesh", sample("open_layers.ts"), "-o", folder / "out.vtu"});
    EXPECT_NE(run.status, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.vtu"));
}

TEST(Mesh, SealedRealModelsAreFilledToTheVolumesOfTheirSurfaces) {
    const TemporaryFolder folder;
    for (const char* name : {"gocad/modelA1.ml", "gocad/CloudSpin_fixed.ml", "gocad/modelA4.ml", "gocad/split_cube.ml"}) {
        const auto real = test::real_data(name);
        if (!real) GTEST_SKIP() << "no real data";
        const std::string out = folder / "out.vtu";
        const auto before = volumes(test::info(*real));
        const json report = mesh(real->string(), out);
        ASSERT_TRUE(report.is_object() && report["written"] == true) << name << report.dump(1);
        EXPECT_EQ(report["regions"].size(), before.size());
        for (const json& region : report["regions"])
            EXPECT_NEAR(region["volume"].get<double>(), before.at(region["name"]), 1e-9 * before.at(region["name"])) << name;
        double cells = 0, narrow = 0;  // those below 5 degrees that no surfaces force
        for (const json& region : report["regions"]) {
            cells += region["cells"]["tetrahedron"].get<double>();
            const json& below = region["below_5_degrees"];
            narrow += below["cells"].get<double>() - below["forced_by_surfaces"].get<double>();
        }
        EXPECT_LE(narrow, 5e-4 * cells) << name;
        EXPECT_EQ(run_geomend({"validate", out}).status, 0) << name;
    }
}

}  // namespace
}  // namespace geomend
