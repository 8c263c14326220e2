// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "support/program.h"

// What people expect of a command line.

namespace geomend::test {
namespace {

const char* const one_triangle = "GOCAD TSurf 1\nHEADER {\nname:t\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";

bool says(const ProgramRun& run, const std::string& text) { return run.err.find(text) != std::string::npos; }

TEST(CommandLine, AMisspelledOptionWithoutACommandNamesTheNearest) {
    const ProgramRun run = run_geomend({"--verion"});
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("the nearest is '--version'"), std::string::npos) << run.err;
    EXPECT_EQ(run_geomend({"-V"}).status, 0);
    EXPECT_EQ(run_geomend({"-h"}).status, 0);
}

TEST(CommandLine, AnOutputThatIsAFolderOrHasNoExtensionIsSaidToBeThat) {
    const TemporaryFolder folder;
    const std::string input = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml";
    const ProgramRun to_folder = run_geomend({"convert", input, "-o", folder.path().string()});
    EXPECT_EQ(to_folder.status, 2);
    EXPECT_NE(to_folder.err.find("a folder"), std::string::npos) << to_folder.err;
    const ProgramRun bare = run_geomend({"convert", input, "-o", (folder / "bare").string()});
    EXPECT_EQ(bare.status, 2);
    EXPECT_NE(bare.err.find("no extension"), std::string::npos) << bare.err;
}

TEST(CommandLine, NamesTheNearestCommandAndOption) {
    ProgramRun run = run_geomend({"valdate", "x.ts"});
    EXPECT_EQ(run.status, 2);
    EXPECT_TRUE(says(run, "no such command 'valdate'; the nearest is 'validate'; there are ")) << run.err;
    run = run_geomend({"validate", "x.ts", "--tolerence", "3"});
    EXPECT_EQ(run.status, 2);
    EXPECT_TRUE(says(run, "no such option '--tolerence'; the nearest is '--tolerance'")) << run.err;
}

TEST(CommandLine, AReaderThatHasEnoughEndsAConversionQuietly) {
    const TemporaryFolder folder;
    std::string text = "GOCAD TSurf 1\nHEADER {\nname:t\n}\nTFACE\n";
    for (int i = 0; i < 30000; ++i)
        text += "VRTX " + std::to_string(i + 1) + " " + std::to_string(i) + " " + std::to_string(i % 7) + " 0\n";
    for (int i = 0; i + 2 < 30000; i += 3)
        text += "TRGL " + std::to_string(i + 1) + " " + std::to_string(i + 2) + " " + std::to_string(i + 3) + "\n";
    write_file(folder / "t.ts", text + "END\n");
    const std::string log = (folder / "log").string();
    const std::string line = "bash -o pipefail -c '\"" GEOMEND_PROGRAM "\" convert \"" + (folder / "t.ts").string() +
                             "\" -o - --to ts 2>\"" + log + "\" | true'";
    EXPECT_EQ(std::system(line.c_str()), 0);
    EXPECT_EQ(read_file(log), "");
}

TEST(CommandLine, ANumberBelowZeroIsNoLimit) {
    const std::string box = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml";
    EXPECT_EQ(run_geomend({"validate", box, "--max-findings", "-1"}).status, 2);
    EXPECT_EQ(run_geomend({"validate", box, "--max-findings", "0"}).status, 0);
}

TEST(CommandLine, WithoutACommandPrintsTheHelp) {
    const ProgramRun run = run_geomend({});
    EXPECT_EQ(run.status, 2);
    EXPECT_TRUE(says(run, "validate") && says(run, "convert")) << run.err;
}

TEST(CommandLine, TakesOptionsBeforeTheCommandAndShortOnes) {
    const TemporaryFolder folder;
    write_file(folder / "t.ts", one_triangle);
    const std::string file = (folder / "t.ts").string();
    EXPECT_EQ(run_geomend({"--quiet", "--threads", "1", "info", file}).status, 0);
    EXPECT_EQ(run_geomend({"--threads=1", "info", file}).out, run_geomend({"info", "-j", "1", file}).out);
    EXPECT_EQ(run_geomend({"-q", "validate", file}).out, "");
    EXPECT_EQ(run_geomend({"-V"}).out, run_geomend({"--version"}).out);
    EXPECT_EQ(run_geomend({"nonsense", "info", file}).status, 2);
}

TEST(CommandLine, TablesTakeNames) {
    EXPECT_EQ(run_geomend({"checks", "b12"}).out.substr(0, 3), "B12");
    const auto family = nlohmann::json::parse(run_geomend({"checks", "--json", "G"}).out);
    ASSERT_GT(family.size(), 3u);
    for (const auto& row : family) EXPECT_EQ(row["code"].get<std::string>()[0], 'G');
    const auto formats = nlohmann::json::parse(run_geomend({"formats", "--json", "vtu", ".ml"}).out);
    ASSERT_EQ(formats.size(), 2u);
    const ProgramRun none = run_geomend({"checks", "B77"});
    EXPECT_EQ(none.status, 2);
    EXPECT_TRUE(says(none, "no such code 'B77'; the nearest is 'B07'")) << none.err;
    EXPECT_EQ(run_geomend({"formats", "docx"}).status, 2);
}

TEST(CommandLine, AnExtensionNamesAFormat) {
    const TemporaryFolder folder;
    write_file(folder / "t.ts", one_triangle);
    const ProgramRun run = run_geomend({"convert", (folder / "t.ts").string(), "-o", "-", "--to", "vtp"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run_geomend({"convert", (folder / "t.ts").string(), "-o", (folder / "a.out").string(), "--to", "ts"}).status, 0);
    const ProgramRun unknown = run_geomend({"convert", (folder / "t.ts").string(), "-o", (folder / "a.docx").string()});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_FALSE(says(unknown, "--from")) << unknown.err;
}

TEST(CommandLine, AFormatThatGoesOneWayOnlyIsSaidToBeThat) {
    const TemporaryFolder folder;
    write_file(folder / "t.ts", one_triangle);
    const ProgramRun written = run_geomend({"convert", (folder / "t.ts").string(), "-o", (folder / "a.csv").string()});
    EXPECT_EQ(written.status, 2);
    EXPECT_TRUE(says(written, "'.csv' is read only")) << written.err;
    write_file(folder / "script.geo", "Point(1) = {0, 0, 0, 1};\n");
    const ProgramRun read = run_geomend({"info", (folder / "script.geo").string()});
    EXPECT_EQ(read.status, 3);
    EXPECT_TRUE(says(read, "'.geo' is written only")) << read.err;
}

TEST(CommandLine, WhatTheTargetCannotHoldAtAllIsToldFromALossThatCanBeAccepted) {
    const TemporaryFolder folder;
    write_file(folder / "t.ts", one_triangle);
    const ProgramRun no_cells = run_geomend({"convert", (folder / "t.ts").string(), "-o", (folder / "a.inp").string()});
    EXPECT_EQ(no_cells.status, 4);
    EXPECT_TRUE(says(no_cells, "a.inp: there are no cells")) << no_cells.err;
    EXPECT_TRUE(says(no_cells, "geomend mesh fills")) << no_cells.err;
    const std::string model = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml";
    const ProgramRun lossy = run_geomend({"convert", model, "-o", (folder / "a.stl").string()});
    EXPECT_EQ(lossy.status, 4);
    EXPECT_TRUE(says(lossy, "accept the loss with --lossy")) << lossy.err;
}

TEST(CommandLine, FormatsSayWhatIsKeptOfCornerPointGridsAndFaults) {
    const ProgramRun run = run_geomend({"formats", "grdecl"});
    EXPECT_EQ(run.status, 0);
    EXPECT_NE(run.out.find("keeps: corner_point_grids, fault_faces, connections"), std::string::npos) << run.out;
}

TEST(CommandLine, APipeThatAPatternMatchesIsPassedOver) {
    const TemporaryFolder folder;
    write_file(folder / "t.ts", one_triangle);
    ASSERT_EQ(::mkfifo((folder / "p.ts").c_str(), 0600), 0);
    const ProgramRun run = run_geomend({"validate", (folder.path() / "*.ts").string()});
    EXPECT_EQ(run.status, 0) << run.err;
}

TEST(CommandLine, AReaderThatHasEnoughIsNoError) {
    const TemporaryFolder folder;
    write_file(folder / "try", std::string("'") + GEOMEND_PROGRAM + "' checks 2> '" + (folder / "err").string() +
                                   "' | head -1 > /dev/null\nexit ${PIPESTATUS[0]}\n");
    EXPECT_EQ(std::system(("bash '" + (folder / "try").string() + "'").c_str()), 0);
    EXPECT_EQ(read_file(folder / "err"), "");
}

TEST(CommandLine, ShellsCompleteEveryCommandAndOption) {
    const TemporaryFolder folder;
    write_file(folder / "completion", run_geomend({"completion", "bash"}).out);
    const auto completed = [&](const std::string& words, int at) {
        write_file(folder / "try", "source '" + (folder / "completion").string() + "'\nCOMP_WORDS=(" + words +
                                       "); COMP_CWORD=" + std::to_string(at) + "\n_geomend\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
        EXPECT_EQ(std::system(("bash '" + (folder / "try").string() + "' > '" + (folder / "out").string() + "'").c_str()), 0);
        return read_file(folder / "out");
    };
    EXPECT_EQ(completed("geomend val", 1), "validate\n");
    EXPECT_EQ(completed("geomend validate --toler", 2), "--tolerance\n");
    for (const char* shell : {"zsh", "fish"}) {
        const std::string text = run_geomend({"completion", shell}).out;
        for (const char* word : {"validate", "repair", "tolerance", "max-gap"})
            EXPECT_NE(text.find(word), std::string::npos) << shell << word;
    }
    EXPECT_EQ(run_geomend({"completion", "tcsh"}).status, 2);
}

}  // namespace
}  // namespace geomend::test
