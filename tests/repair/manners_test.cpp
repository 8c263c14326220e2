// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>

#include "made_boxes.h"
#include "support/program.h"

// How repair speaks with who runs it: what is a mistake, and where.

namespace geomend {
namespace {

using test::box_text;
using test::level;
using test::run_geomend;
using test::TemporaryFolder;
using test::tsurf_text;
using test::write_file;

class Manners : public ::testing::Test {
protected:
    Manners() { write_file(folder_ / "in.ts", box_text() + tsurf_text(level("H", 5))); }

    auto repair(std::vector<std::string> options, const std::string& in = "in.ts") {
        std::vector<std::string> words{"repair", folder_ / in, "-o", folder_ / "out.ml"};
        words.insert(words.end(), options.begin(), options.end());
        auto run = run_geomend(words);
        EXPECT_FALSE(run.status != 0 && std::filesystem::exists(folder_ / "out.ml"));
        return run;
    }
    void expect_refused(const std::vector<std::string>& options, const std::string& word) {
        const auto run = repair(options);
        EXPECT_EQ(run.status, 2) << run.err;
        EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
    }

    TemporaryFolder folder_;
};

TEST_F(Manners, AnUnknownStepIsRefusedWithTheNearestAndAllOthers) {
    for (const char* word : {"nearest is 'close'", "tails", "close-gaps"}) expect_refused({"--step", "clsoe"}, word);
    expect_refused({"--steps", "cut,,tails"}, "between two commas");
}

TEST_F(Manners, LengthsAreNumbers) {
    for (const char* option : {"--max-gap", "--max-displacement", "--tolerance", "--near"}) {
        for (const char* value : {"nan", "inf", "-1", "1e30", "x"}) expect_refused({option, value}, option);
    }
}

TEST_F(Manners, ABoxBesideTheModelIsRefused) {
    expect_refused({"--box", "100,101,0,10,0,10"}, "x from 100 to 101, and theirs from 0 to 10");
}

TEST_F(Manners, OptionsThatNoStepTakesAreRefused) {
    expect_refused({"--steps", "cut", "--max-gap", "1"}, "--max-gap");
    expect_refused({"--steps", "cut", "--box", "auto"}, "--box");
    expect_refused({"--option", "gap=1"}, "gap");
}

TEST_F(Manners, WhatIsForSurfacesIsRefusedForGrids) {
    const std::string grid = std::string(GEOMEND_SOURCE_DIR) + "/samples/faulted_grid.grdecl";
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"--box", "auto"}, {"--max-gap", "1"}, {"--max-displacement", "1"}, {"--step", "cut"}}) {
        std::vector<std::string> words{"repair", grid, "-o", folder_ / "out.grdecl"};
        words.insert(words.end(), options.begin(), options.end());
        const auto run = run_geomend(words);
        EXPECT_EQ(run.status, 2) << run.err;
        EXPECT_NE(run.err.find("faulted_grid.grdecl"), std::string::npos) << run.err;
    }
}

TEST_F(Manners, ContactsOfUnknownSurfacesAreRefusedWhereTheyStand) {
    write_file(folder_ / "r.toml", "max_gap = 1.0\n\n[[contact]]\nborder = \"H\"\non = \"sid_3\"\n");
    expect_refused({"--recipe", folder_ / "r.toml"}, "r.toml:3:1: there is no surface 'sid_3'; the nearest is 'side_3'");
}

TEST_F(Manners, AnUnknownKeyOfARecipeIsNamedWhereItStands) {
    write_file(folder_ / "r.toml", "steps = [\"cut\"]\nmax_gapp = 3\n");
    expect_refused({"--recipe", folder_ / "r.toml"}, "r.toml:2:1: no recipe has 'max_gapp'; the nearest is 'max_gap'");
}

TEST_F(Manners, AFileWithoutSurfacesIsNamed) {
    const std::string wells = std::string(GEOMEND_SOURCE_DIR) + "/samples/wells.wl";
    const auto run = run_geomend({"repair", wells, "-o", folder_ / "out.ml"});
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("wells.wl: there is no surface"), std::string::npos) << run.err;
}

TEST_F(Manners, AFolderThatIsNotThereIsReportedBeforeAnythingIsDone) {
    for (const char* option : {"--write-recipe", "--report"}) {
        const auto run = repair({option, folder_ / "none/r.json"});
        EXPECT_EQ(run.status, 4) << run.err;
        EXPECT_NE(run.err.find("there is no folder"), std::string::npos) << run.err;
        EXPECT_EQ(run.out, "");
    }
}

TEST_F(Manners, TextNeverNamesANamelessSurfaceOrAGapOfNothing) {
    write_file(folder_ / "in.ts", box_text() + tsurf_text({"H", {-1, -1, 5}, {12, 0, 0}, {0, 12, 0}, 5, "top", {}}));
    const auto run = repair({"--max-gap", "2"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("trimmed"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("near ''"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("gap 0:"), std::string::npos) << run.out;
}

TEST_F(Manners, SurfacesBesideAGridAreSaidToBeLeft) {
    const std::string grid = std::string(GEOMEND_SOURCE_DIR) + "/samples/faulted_grid.grdecl";
    const auto run = run_geomend(
        {"repair", grid, folder_ / "in.ts", "-o", folder_ / "out.grdecl", "--lossy", "--option", "crs=ignore", "--keep-invalid"});
    EXPECT_NE(run.out.find("7 surfaces beside the grid"), std::string::npos) << run.out << run.err;
}

}  // namespace
}  // namespace geomend
