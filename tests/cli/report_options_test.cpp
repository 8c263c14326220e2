// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "support/corner_point_grids.h"
#include "support/program.h"

namespace geomend::test {
namespace {

using Json = nlohmann::json;

void write_grid(const CornerPointGrid& grid, const std::filesystem::path& path) {
    std::string text = "SPECGRID\n " + std::to_string(grid.dims[0]) + ' ' + std::to_string(grid.dims[1]) + ' ' +
                       std::to_string(grid.dims[2]) + " 1 F /\nCOORD\n";
    for (const double v : grid.pillars) text += std::to_string(v) + '\n';
    text += "/\nZCORN\n";
    for (const double v : grid.depths) text += std::to_string(v) + '\n';
    write_file(path, text + "/\n");
}

// Bricks; the bottoms of the cells given lie above their tops.
CornerPointGrid with_inverted(std::initializer_list<std::uint32_t> columns) {
    CornerPointGrid grid = testing::brick_grid(4, 3, 2);
    for (const std::uint32_t i : columns) {
        for (unsigned c = 4; c < 8; ++c) grid.depths[corner_index(grid.dims, i, 1, 0, c)] -= 15;
    }
    return grid;
}

class ReportOptions : public ::testing::Test {
protected:
    ReportOptions() {
        write_grid(with_inverted({1}), folder_ / "old.grdecl");
        write_grid(with_inverted({1, 3}), folder_ / "worse.grdecl");
        write_grid(with_inverted({}), folder_ / "good.grdecl");
        EXPECT_EQ(run_geomend({"validate", "--quiet", at("old.grdecl"), "--report", at("old.json")}).status, 1);
    }
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    // The file's part of validate --json.
    Json judged(std::vector<std::string> arguments, int status) const {
        arguments.insert(arguments.begin(), {"validate", "--json"});
        const ProgramRun run = run_geomend(arguments);
        EXPECT_EQ(run.status, status) << run.err;
        const Json all = Json::parse(run.out, nullptr, false);
        return all.is_object() ? all["files"].back() : Json();
    }
    TemporaryFolder folder_;
};

TEST_F(ReportOptions, WhatTheBaselineHasIsLeftOutAndDoesNotFail) {
    const Json file = judged({at("old.grdecl"), "--baseline", at("old.json")}, 0);
    EXPECT_EQ(file["findings"].size(), 0u) << file;
    EXPECT_EQ(file["valid"], false) << "what is left out is still wrong";
    EXPECT_GE(file["known"]["error"], 1);
    const ProgramRun text = run_geomend({"validate", at("old.grdecl"), "--baseline", at("old.json")});
    EXPECT_NE(text.out.find("of the baseline left out"), std::string::npos) << text.out;
    EXPECT_EQ(judged({at("old.grdecl")}, 1)["valid"], false);
}

TEST_F(ReportOptions, SeveralReportsComeOfOneRun) {
    const ProgramRun run = run_geomend(
        {"validate", "--quiet", "--report", at("r.json"), "--report", at("r.html"), at("old.grdecl"), "--report", at("r.sarif")});
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_EQ(Json::parse(read_file(at("r.json")))["files"].size(), 1u);
    EXPECT_EQ(Json::parse(read_file(at("r.sarif")))["version"], "2.1.0");
    EXPECT_NE(read_file(at("r.html")).find("C03"), std::string::npos);
    EXPECT_EQ(run_geomend({"validate", at("old.grdecl"), "--report", at("a.json"), "--report", at("b.doc")}).status, 2);
}

TEST_F(ReportOptions, ANewCellOfTheSameGridIsNewAgainstTheBaseline) {
    std::filesystem::copy_file(at("worse.grdecl"), at("old.grdecl"), std::filesystem::copy_options::overwrite_existing);
    const Json file = judged({at("old.grdecl"), "--baseline", at("old.json")}, 1);
    ASSERT_EQ(file["findings"][0]["code"], "C03") << file;
    EXPECT_EQ(file["findings"][0]["elements"], Json::parse("[[2,2,1],[4,2,1]]"));
    // Mended, nothing is new.
    std::filesystem::copy_file(at("good.grdecl"), at("old.grdecl"), std::filesystem::copy_options::overwrite_existing);
    EXPECT_EQ(judged({at("old.grdecl"), "--baseline", at("old.json")}, 0)["valid"], true);
}

TEST_F(ReportOptions, ABaselineThatIsNoneIsRefusedAndAnUnknownFileIsTold) {
    EXPECT_EQ(run_geomend({"validate", at("old.grdecl"), "--baseline", at("none.json")}).status, 3);
    EXPECT_EQ(run_geomend({"validate", at("old.grdecl"), "--baseline", at("old.grdecl")}).status, 3);
    const ProgramRun run = run_geomend({"validate", at("old.grdecl"), at("worse.grdecl"), "--baseline", at("old.json")});
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("worse.grdecl"), std::string::npos) << run.err;
}

TEST_F(ReportOptions, DebrisIsWrittenListedAndNeverMixed) {
    const Json file = judged({at("old.grdecl"), at("worse.grdecl"), "--debris", at("debris")}, 1);
    std::size_t written = 0;
    for (const Json& f : file["findings"]) {
        for (const Json& path : f.value("debris", Json::array())) {
            EXPECT_TRUE(std::filesystem::exists(path.get<std::string>())) << path;
            ++written;
        }
    }
    EXPECT_GE(written, 2u);
    const Json vtp = info(file["findings"][0]["debris"][0].get<std::string>());
    EXPECT_EQ(vtp["objects"][0]["counts"]["triangles"], 24) << "two cells of twelve";
    EXPECT_EQ(run_geomend({"validate", at("old.grdecl"), "--debris", at("debris")}).status, 4);
    EXPECT_EQ(run_geomend({"validate", at("good.grdecl"), "--debris", at("old.grdecl")}).status, 4) << "a file is no folder";
}

TEST_F(ReportOptions, APageIsWrittenByValidateAndByRepair) {
    EXPECT_EQ(run_geomend({"validate", "--quiet", at("old.grdecl"), "--report", at("page.html")}).status, 1);
    const std::string page = read_file(at("page.html"));
    EXPECT_NE(page.find("<!doctype html>"), std::string::npos);
    EXPECT_NE(page.find("\"scene\":"), std::string::npos);
    EXPECT_NE(page.find("\"mark\":"), std::string::npos);
    const ProgramRun run = run_geomend(
        {"repair", "--quiet", at("old.grdecl"), "-o", at("mended.grdecl"), "--report", at("mended.html"), "--debris", at("after")});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(read_file(at("mended.html")).find("\"steps\":"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_directory(at("after")));
    EXPECT_EQ(run_geomend({"validate", at("old.grdecl"), "--report", at("page.htm")}).status, 2);
}

TEST_F(ReportOptions, AFileThatCannotBeReadIsOnThePageToo) {
    write_file(folder_ / "broken.grdecl", "SPECGRID\n 2 2 x 1 F /\n");
    EXPECT_EQ(run_geomend({"validate", "--quiet", at("broken.grdecl"), at("old.grdecl"), "--report", at("page.html")}).status, 3);
    const std::string page = read_file(at("page.html"));
    EXPECT_NE(page.find("broken.grdecl"), std::string::npos);
    EXPECT_NE(page.find("\"scene\":"), std::string::npos);
}

}  // namespace
}  // namespace geomend::test
