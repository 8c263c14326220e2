// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "support/program.h"
#include "support/temporary_folder.h"

// The commands validate and repair as a user runs them.

namespace geomend {
namespace {

using test::run_geomend;
using test::TemporaryFolder;

// One column of three cells; each gives the depths of its top and its bottom.
std::string column_deck(const std::vector<std::array<double, 2>>& cells) {
    std::string text = "SPECGRID\n1 1 " + std::to_string(cells.size()) + " 1 F /\nCOORD\n";
    for (const char* xy : {"0 0", "100 0", "0 100", "100 100"}) text += std::string(xy) + " 1000 " + xy + " 1100\n";
    text += "/\nZCORN\n";
    for (const auto& cell : cells) {
        for (const double z : cell) text += "4*" + std::to_string(z) + "\n";
    }
    return text + "/\n";
}

nlohmann::json json_of(const test::ProgramRun& run) { return nlohmann::json::parse(run.out, nullptr, false); }

TEST(Validate, CallsASoundGridValid) {
    const TemporaryFolder folder;
    test::write_file(folder / "good.grdecl", column_deck({{1000, 1010}, {1010, 1020}}));
    const auto run = run_geomend({"validate", "--json", folder / "good.grdecl"});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto report = json_of(run);
    ASSERT_EQ(report["files"].size(), 1u);
    EXPECT_EQ(report["files"][0]["valid"], true) << run.out;
}

TEST(Repair, SaysWhereThereWasNothingToMendAndWhyItsResultIsNotFullyChecked) {
    const TemporaryFolder folder;
    const std::string head = "GOCAD TSurf 1\nHEADER {\nname:a\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\n";
    test::write_file(folder / "sound.ts", head + "END\n");
    test::write_file(folder / "twice.ts", head + "TRGL 1 2 3\nEND\n");
    const auto sound = run_geomend({"repair", folder / "sound.ts", "-o", folder / "o.ts"});
    EXPECT_EQ(sound.status, 0) << sound.err;
    EXPECT_NE(sound.out.find("nothing to mend"), std::string::npos) << sound.out;
    const auto twice = run_geomend({"repair", folder / "twice.ts", "-o", folder / "o.ts"});
    EXPECT_EQ(twice.status, 0) << twice.err;
    EXPECT_EQ(twice.out.find("nothing to mend"), std::string::npos) << twice.out;
    EXPECT_NE(twice.out.find("not fully checked"), std::string::npos) << twice.out;
    EXPECT_NE(twice.out.find("the surfaces enclose no region"), std::string::npos) << twice.out;
}

TEST(Validate, TellsByItsStatusWhatItFound) {
    const TemporaryFolder folder;
    test::write_file(folder / "good.grdecl", column_deck({{1000, 1010}, {1010, 1020}}));
    test::write_file(folder / "gap.grdecl", column_deck({{1000, 1010}, {1012, 1020}}));
    test::write_file(folder / "overlap.grdecl", column_deck({{1000, 1013}, {1010, 1020}}));
    test::write_file(folder / "short.grdecl", "SPECGRID\n1 1 2 1 F /\nCOORD\n1 2 3 /\n");
    const auto status = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "validate");
        return run_geomend(arguments).status;
    };
    const std::string good = folder / "good.grdecl", gap = folder / "gap.grdecl", overlap = folder / "overlap.grdecl",
                      cut = folder / "short.grdecl";
    EXPECT_EQ(status({good}), 0);
    EXPECT_EQ(status({gap}), 0);
    EXPECT_EQ(status({gap, "--fail-on", "warning"}), 1);
    EXPECT_EQ(status({overlap}), 1);
    EXPECT_EQ(status({overlap, "--fail-on", "never"}), 0);
    EXPECT_EQ(status({overlap, "--skip", "C04"}), 0);
    EXPECT_EQ(status({overlap, "--checks", "C03,C05"}), 0);
    EXPECT_EQ(status({overlap, "--checks", "C77"}), 2);
    EXPECT_EQ(status({overlap, "--tolerance", "5"}), 0);
    EXPECT_EQ(status({good, cut, overlap}), 3);
    EXPECT_EQ(status({good, "--report", folder / "report.doc"}), 2);
}

TEST(Validate, ReportsInTheSchemaOfTheInterface) {
    const TemporaryFolder folder;
    test::write_file(folder / "overlap.grdecl", column_deck({{1000, 1010}, {1010, 1023}, {1020, 1030}}));
    const auto run = run_geomend({"validate", "--json", folder / "overlap.grdecl", "--report", folder / "r.sarif"});
    EXPECT_EQ(run.status, 1);
    const auto j = json_of(run);
    ASSERT_TRUE(j.is_object()) << run.out << run.err;
    EXPECT_EQ(j["schema"], 1);
    EXPECT_GT(j["tolerance"], 0);
    const auto& file = j["files"].at(0);
    EXPECT_EQ(file["valid"], false);
    EXPECT_EQ(file["counts"]["error"], 1);
    const auto& f = file["findings"].at(0);
    EXPECT_EQ(f["code"], "C04");
    EXPECT_EQ(f["severity"], "error");
    EXPECT_EQ(f["elements"], nlohmann::json::parse("[[1,1,2]]"));
    EXPECT_EQ(f["index"], nlohmann::json::parse("[1]"));
    EXPECT_EQ(f["element_kind"], "cell");
    EXPECT_EQ(f["count"], 1);
    EXPECT_DOUBLE_EQ(f["measures"]["overlap"], 3);
    EXPECT_EQ(f["entities"][0]["kind"], "corner-point-grid");
    const auto sarif = nlohmann::json::parse(test::read_file(folder / "r.sarif"), nullptr, false);
    ASSERT_TRUE(sarif.is_object());
    EXPECT_EQ(sarif["version"], "2.1.0");
    EXPECT_EQ(sarif["runs"][0]["results"][0]["ruleId"], "C04");
}

TEST(Validate, DoesNotCallValidWhatItCannotJudge) {
    const TemporaryFolder folder;
    test::write_file(folder / "w.wl", "GOCAD Well 1\nHEADER {\nname:w\n}\nWREF 1 2 3\nEND\n");
    const auto run = run_geomend({"validate", "--json", folder / "w.wl"});
    EXPECT_EQ(run.status, 0);
    const auto j = json_of(run);
    EXPECT_FALSE(j["files"][0].contains("valid"));
    EXPECT_NE(run.out.find("F160"), std::string::npos);
}

TEST(Validate, ChoosesAmongAllCodes) {
    const TemporaryFolder folder;
    test::write_file(folder / "p.vs", "GOCAD VSet 1\nHEADER {\nname:p\n}\nVRTX 1 0 0 0\nVRTX 2 0 0 0\nEND\n");
    test::write_file(folder / "cut.vs", "GOCAD VSet 1\nHEADER {\nname:p\n}\nVRTX 1 0 0");
    test::write_file(folder / "open.vs", "GOCAD VSet 1\nHEADER {\nname:p\n}\nVRTX 1 0 0 0\n");
    const std::string points = folder / "p.vs", cut = folder / "cut.vs", open = folder / "open.vs";
    const auto run = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "validate");
        return run_geomend(arguments);
    };
    const auto status = [&](std::vector<std::string> arguments) { return run(std::move(arguments)).status; };
    EXPECT_EQ(status({points, "--fail-on", "warning"}), 1) << "M10";
    EXPECT_EQ(status({points, "--fail-on", "warning", "--skip", "M"}), 0);
    EXPECT_EQ(status({points, "--fail-on", "warning", "--skip", "M1*,F1*"}), 0);
    EXPECT_EQ(status({points, "--fail-on", "warning", "--checks", "B*"}), 0);
    EXPECT_EQ(status({open, "--fail-on", "warning"}), 1);
    EXPECT_EQ(status({open, "--fail-on", "warning", "--skip", "F101"}), 0);
    EXPECT_EQ(status({open, "--fail-on", "warning", "--checks", "F101"}), 1);
    EXPECT_EQ(status({open, "--fail-on", "warning", "--checks", "F10?", "--skip", "F1*"}), 0);
    EXPECT_EQ(status({open, "--fail-on", "warning", "--checks", "B02"}), 0);
    EXPECT_EQ(status({cut, "--skip", "F"}), 3);
    EXPECT_EQ(status({cut, points, "--skip", "F"}), 3);
    const auto refused = run({cut, "--skip", "F004"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("cannot be left out"), std::string::npos) << refused.err;
    const auto unknown = run({points, "--checks", "m10"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("did you mean M10?"), std::string::npos) << unknown.err;
}

TEST(Repair, MendsWithTheUsualStepsAndTellsWhatItDid) {
    const TemporaryFolder folder;
    test::write_file(folder / "in.grdecl", column_deck({{1000, 1010}, {1010, 1004}, {1004, 1020}}));
    const auto run = run_geomend({"repair", folder / "in.grdecl", "-o", folder / "out.grdecl", "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    const auto j = json_of(run);
    ASSERT_EQ(j["steps"].size(), 3u) << run.out;
    EXPECT_EQ(j["steps"][0]["step"], "monotone");
    EXPECT_EQ(j["steps"][0]["elements"], nlohmann::json::parse("[[1,1,2]]"));
    EXPECT_EQ(j["steps"][2]["count"], 1) << "the inverted cell has no thickness now";
    EXPECT_EQ(run_geomend({"validate", "--fail-on", "warning", folder / "out.grdecl"}).status, 0);
}

TEST(Repair, WritesNothingThatIsNotValidUnlessAsked) {
    const TemporaryFolder folder;
    test::write_file(folder / "in.grdecl", column_deck({{1000, 1013}, {1010, 1020}}));
    const std::string in = folder / "in.grdecl", out = folder / "out.grdecl";
    EXPECT_EQ(run_geomend({"repair", in, "-o", out}).status, 6) << "3 is more than the tolerance";
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_EQ(run_geomend({"repair", in, "-o", out, "--keep-invalid"}).status, 6);
    EXPECT_TRUE(std::filesystem::exists(out));
    EXPECT_EQ(run_geomend({"repair", in, "-o", out, "--option", "gap=5"}).status, 0);
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
    EXPECT_EQ(run_geomend({"repair", in, "-o", out, "--step", "smooth"}).status, 2);
    EXPECT_EQ(run_geomend({"repair", in, "-o", out, "--option", "gap=wide"}).status, 2);
}

TEST(Checks, TableNamesEveryCornerPointCheck) {
    const auto run = run_geomend({"checks", "--json"});
    const auto j = nlohmann::json::parse(run.out, nullptr, false);
    std::size_t corner_point = 0;
    for (const auto& row : j) {
        if (row["code"].get<std::string>()[0] != 'C') continue;
        ++corner_point;
        EXPECT_FALSE(row["condition"].get<std::string>().empty());
    }
    EXPECT_EQ(corner_point, 32u);
}

}  // namespace
}  // namespace geomend
