// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "support/program.h"

namespace geomend::test {
namespace {

const char* const triangle = "GOCAD TSurf 1\nHEADER {\nname:t\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";

TEST(ExitStatus, IsTwoForAWrongCommandLine) {
    EXPECT_EQ(run_geomend({}).status, 2);
    EXPECT_EQ(run_geomend({"info"}).status, 2);
    EXPECT_EQ(run_geomend({"info", "--no-such-option", "x"}).status, 2);
    EXPECT_EQ(run_geomend({"no-such-command"}).status, 2);
    EXPECT_EQ(run_geomend({"info", "--threads", "0", "x"}).status, 2);
    EXPECT_EQ(run_geomend({"info", "--option", "novalue", "x"}).status, 2);
}

TEST(ExitStatus, IsZeroForHelpAndVersion) {
    EXPECT_EQ(run_geomend({"--help"}).status, 0);
    EXPECT_EQ(run_geomend({"--version"}).out, "geomend 0.1.0\n");
    for (const char* command : {"info", "convert", "formats"}) EXPECT_EQ(run_geomend({command, "--help"}).status, 0) << command;
}

TEST(ExitStatus, IsThreeForAnInputThatCannotBeRead) {
    const TemporaryFolder folder;
    write_file(folder / "empty.ts", "");
    write_file(folder / "letter.ts", "Dear Sir,\nplease find enclosed\n");
    EXPECT_EQ(run_geomend({"info", (folder / "none.ts").string()}).status, 3);
    EXPECT_EQ(run_geomend({"info", (folder / "empty.ts").string()}).status, 3);
    EXPECT_EQ(run_geomend({"info", (folder / "letter.ts").string()}).status, 3);
    EXPECT_EQ(run_geomend({"info", folder.path().string()}).status, 3);
    EXPECT_EQ(run_geomend({"convert", (folder / "none.ts").string(), "-o", (folder / "a.vtp").string()}).status, 3);
}

TEST(ExitStatus, IsTheWorstOfSeveralFilesAndAllAreLookedAt) {
    const TemporaryFolder folder;
    write_file(folder / "good.ts", triangle);
    const ProgramRun run = run_geomend({"info", "--json", (folder / "none.ts").string(), (folder / "good.ts").string()});
    EXPECT_EQ(run.status, 3);
    const auto all = nlohmann::json::parse(run.out, nullptr, false);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_TRUE(all[0].contains("error"));
    EXPECT_EQ(all[1]["objects"][0]["counts"]["triangles"], 1);
}

TEST(ExitStatus, IsFourWhereTheOutputCannotBeWritten) {
    const TemporaryFolder folder;
    write_file(folder / "good.ts", triangle);
    const ProgramRun run = run_geomend({"convert", (folder / "good.ts").string(), "-o", (folder / "no/such/folder.vtp").string()});
    EXPECT_EQ(run.status, 4) << run.err;
    EXPECT_EQ(run_geomend({"convert", (folder / "good.ts").string(), "--to", "vtp", "-o", folder.path().string()}).status, 4);
}

// What is said to be written is there, and whole.
TEST(ExitStatus, IsFourWhereOnlyTheReportOfAnOutputCannotBePrinted) {
    const std::string box = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml";
    const std::vector<std::vector<std::string>> commands{
        {"convert"}, {"repair"}, {"mesh"}, {"remesh", "--size", "50"}, {"grid", "--cells", "4x4"}};
    for (const auto& command : commands) {
        const TemporaryFolder folder;
        const std::string output = (folder / (command[0] == "grid" ? "a.grdecl" : "a.vtm")).string();
        std::string line = GEOMEND_PROGRAM;
        for (const std::string& word : command) line += " " + word;
        line += " '" + box + "' -o '" + output + "' --json > /dev/full 2> '" + (folder / "said").string() + "'";
        EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 4) << line;
        EXPECT_NE(read_file(folder / "said").find(output + " is written all the same"), std::string::npos) << read_file(folder / "said");
        EXPECT_EQ(run_geomend({"info", output}).status, 0) << line;
    }
}

TEST(ExitStatus, IsFourWhereSubstanceWouldBeLostAndNothingIsWritten) {
    const TemporaryFolder folder;
    write_file(folder / "faces.vtk",
               "# vtk DataFile Version 3.0\nfaces\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n0 0 0 1 0 0 1 1 0 0 1 0 2 0 0\n"
               "POLYGONS 2 9\n4 0 1 2 3\n3 1 4 2\n");
    write_file(folder / "old.ts", "old");
    const auto in = (folder / "faces.vtk").string(), out = (folder / "old.ts").string();
    const ProgramRun refused = run_geomend({"convert", in, "-o", out});
    EXPECT_EQ(refused.status, 4) << refused.err;
    EXPECT_EQ(read_file(out), "old");
    const ProgramRun lossy = run_geomend({"convert", in, "-o", out, "--lossy", "--json"});
    EXPECT_EQ(lossy.status, 0) << lossy.err;
    const auto result = nlohmann::json::parse(lossy.out, nullptr, false);
    ASSERT_TRUE(result["loss"].is_array() && !result["loss"].empty());
    EXPECT_EQ(result["loss"][0]["class"], "substance");
    EXPECT_EQ(info(out)["objects"][0]["counts"]["triangles"], 1);
}

TEST(StandardStreams, AreInputAndOutput) {
    const TemporaryFolder folder;
    write_file(folder / "good.ts", triangle);
    const ProgramRun run = run_geomend({"convert", "-", "-o", "-", "--to", "gocad-ts"}, folder / "good.ts");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out.substr(0, 12), "GOCAD TSurf ");
    write_file(folder / "back.ts", run.out);
    EXPECT_EQ(info(folder / "back.ts")["objects"][0]["counts"]["triangles"], 1);
}

TEST(Convert, RefusesInputsThatDisagree) {
    const TemporaryFolder folder;
    const auto with_sign = [](const char* sign) {
        return std::string("GOCAD VSet 1\nHEADER {\nname:v\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nZPOSITIVE ") + sign +
               "\nEND_ORIGINAL_COORDINATE_SYSTEM\nVRTX 1 0 0 5\nEND\n";
    };
    write_file(folder / "up.vs", with_sign("Elevation"));
    write_file(folder / "down.vs", with_sign("Depth"));
    const std::vector<std::string> both{"convert", (folder / "up.vs").string(), (folder / "down.vs").string(), "-o",
                                        (folder / "o.vs").string()};
    EXPECT_NE(run_geomend(both).status, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "o.vs"));
    auto anyway = both;
    anyway.insert(anyway.end(), {"--option", "crs=ignore"});
    EXPECT_EQ(run_geomend(anyway).status, 0);
    EXPECT_EQ(info(folder / "o.vs")["objects"].size(), 2u);
}

TEST(Convert, NeedsLeaveForAnUnterminatedObject) {
    const TemporaryFolder folder;
    std::string text = triangle;
    text.resize(text.size() - 4);
    write_file(folder / "open.ts", text);
    const auto in = (folder / "open.ts").string(), out = (folder / "o.ts").string();
    const ProgramRun look = run_geomend({"info", in});
    EXPECT_EQ(look.status, 0);
    EXPECT_NE(look.err.find("F101"), std::string::npos) << look.err;
    EXPECT_EQ(run_geomend({"convert", in, "-o", out}).status, 3);
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_EQ(run_geomend({"convert", in, "-o", out, "--accept-unterminated"}).status, 0);
}

TEST(Convert, WritesOverItsOwnInput) {
    const TemporaryFolder folder;
    write_file(folder / "a.ts", triangle);
    const auto path = (folder / "a.ts").string();
    EXPECT_EQ(run_geomend({"convert", path, "-o", path}).status, 0);
    EXPECT_EQ(info(path)["objects"][0]["counts"]["triangles"], 1);
}

}  // namespace
}  // namespace geomend::test
