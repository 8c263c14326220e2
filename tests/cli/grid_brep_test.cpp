// SPDX-License-Identifier: AGPL-3.0-or-later
// validate --option as=brep, as a user calls it.
#include <gtest/gtest.h>

#include "support/program.h"

namespace geomend::test {
namespace {

using Json = nlohmann::json;

// Columns of bricks along a line on the ground that crosses itself: column 8 lies across column 2.
std::string crossing_grid() {
    const double line[][2] = {{0, 0}, {300, 0}, {600, 0}, {900, 100}, {1000, 400}, {800, 700}, {500, 700}, {400, 400}, {400, -200}};
    std::string text = "SPECGRID\n 8 1 1 1 F /\nCOORD\n";
    for (const double away : {-20.0, 20.0}) {
        for (const auto& [x, y] : line) {
            const std::string at = std::to_string(x + away) + ' ' + std::to_string(y + away) + ' ';
            text += at + "1000 " + at + "1010\n";
        }
    }
    text += "/\nZCORN\n 32*1000 32*1010 /\n";
    return text;
}

class GridAsModel : public ::testing::Test {
protected:
    GridAsModel() {
        write_file(folder_ / "crossing.grdecl", crossing_grid());
        write_file(folder_ / "again.grdecl", crossing_grid());
    }
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    TemporaryFolder folder_;
};

TEST_F(GridAsModel, IsJudgedWhenAskedFor) {
    EXPECT_EQ(run_geomend({"validate", at("crossing.grdecl"), "--checks", "C27"}).status, 0);
    const ProgramRun run = run_geomend({"validate", at("crossing.grdecl"), "--checks", "C27", "--option", "as=brep", "--json"});
    EXPECT_EQ(run.status, 1) << run.err;
    const Json found = Json::parse(run.out)["files"][0]["findings"];
    ASSERT_EQ(found.size(), 1u) << run.out;
    EXPECT_EQ(found[0]["elements"], Json::parse("[[2,1,1],[8,1,1]]"));
    EXPECT_EQ(found[0]["entities"][0]["kind"], "corner-point-grid");
}

TEST_F(GridAsModel, IsJudgedByTheProcessesOfManyFiles) {
    const ProgramRun run =
        run_geomend({"validate", at("crossing.grdecl"), at("again.grdecl"), "--checks", "C27", "--option", "as=brep", "--json"});
    EXPECT_EQ(run.status, 1) << run.err;
    const Json report = Json::parse(run.out);
    ASSERT_EQ(report["files"].size(), 2u);
    for (const Json& file : report["files"]) EXPECT_EQ(file["findings"].size(), 1u);
}

TEST_F(GridAsModel, NeedsOptionsThatItKnows) {
    for (const char* option : {"as=mesh", "horizons=x"}) {
        const ProgramRun run = run_geomend({"validate", at("crossing.grdecl"), "--option", "as=brep", "--option", option});
        EXPECT_EQ(run.status, 2) << option << ' ' << run.out;
    }
}

TEST_F(GridAsModel, SaysWhatAGridHasNot) {
    const ProgramRun run =
        run_geomend({"validate", at("crossing.grdecl"), "--checks", "C27", "--option", "as=brep", "--option", "regions=NONE", "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    const Json found = Json::parse(run.out)["files"][0]["findings"];
    ASSERT_EQ(found.size(), 1u) << run.out;
    EXPECT_EQ(found[0]["code"], "F162");
    EXPECT_NE(found[0]["message"].get<std::string>().find("NONE"), std::string::npos);
}

TEST_F(GridAsModel, WritesDebrisOfWhatRunsIntoEachOther) {
    const ProgramRun run =
        run_geomend({"validate", at("crossing.grdecl"), "--checks", "C27", "--option", "as=brep", "--debris", at("debris")});
    EXPECT_EQ(run.status, 1) << run.err;
    const Json debris = info(folder_ / "debris" / "0001-C27-crossing.vtp");
    EXPECT_TRUE(debris.is_object());
}

}  // namespace
}  // namespace geomend::test
