// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/utf8.h"
#include "support/temporary_folder.h"

namespace geomend {
namespace {

Finding made(const char* code, Severity severity, const char* entity) {
    Finding f;
    f.code = code;
    f.severity = severity;
    f.message = std::string("about ") + entity + " <&>";
    f.entities = {{"corner-point-grid", entity}};
    return f;
}

Report made_report() {
    Report report;
    report.tool = "geomend 1.2";
    ReportedFile file;
    file.file = "a.grdecl";
    file.valid = false;
    file.tolerance = 0.5;
    file.findings = {made("C06", Severity::info, "one"), made("C04", Severity::error, "two"), made("C05", Severity::warning, "one")};
    file.findings[1].elements = {1, 2, 3, 4, 5, 6};
    file.findings[1].index = {7, 8};
    file.findings[1].element_kind = "cell-ijk";
    file.findings[1].count = 250;
    report.files.push_back(file);
    return report;
}

TEST(Report, JsonHasTriplesForCellsAndTheWorstFirst) {
    const auto j = nlohmann::json::parse(report_json(made_report()));
    const auto& file = j["files"][0];
    EXPECT_EQ(j["tool"], "geomend 1.2");
    EXPECT_EQ(j["tolerance"], 0.5);
    EXPECT_EQ(file["counts"], nlohmann::json::parse(R"({"error":1,"warning":1,"info":1})"));
    EXPECT_EQ(file["findings"][0]["code"], "C04");
    EXPECT_EQ(file["findings"][0]["elements"], nlohmann::json::parse("[[1,2,3],[4,5,6]]"));
    EXPECT_EQ(file["findings"][0]["element_kind"], "cell");
    EXPECT_EQ(file["findings"][2]["code"], "C06");
    EXPECT_TRUE(file["findings"][2]["fix"].is_null());
}

TEST(Report, SaysFirstAtWhichToleranceAModelCloses) {
    Report report = made_report();
    report.files[0].closing = ReportedClosing{0.03, 236, 0};
    const std::string text = report_text(report, false),
                      words = "points of borders agree within 0.03 only: with --tolerance 0.03 the model closes";
    EXPECT_EQ(text.find(words), text.find('\n') + 3) << text;
    const auto closes = nlohmann::json::parse(report_json(report))["files"][0]["closes_with"];
    EXPECT_EQ(closes["tolerance"], 0.03);
    EXPECT_EQ(closes["errors"], 236);
    EXPECT_EQ(closes["left"], 0);
    EXPECT_EQ(closes["message"], words);
    report.files[0].closing->left = 6;
    EXPECT_NE(report_text(report, false).find("of 236 errors 230 vanish with --tolerance 0.03"), std::string::npos);
}

TEST(Report, NamesTheLengthsOfClustersThatDiffer) {
    Report report = made_report();
    EXPECT_FALSE(nlohmann::json::parse(report_json(report))["files"][0].contains("clusters"));
    report.files[0].clusters = {{0.5, 20, {"a", "b", "c", "d"}}, {0.01, 1, {"e"}}};
    const std::string text = report_text(report, false);
    EXPECT_NE(text.find("  tolerance 0.5, near 20 for 'a', 'b', 'c' and 1 more\n"), std::string::npos) << text;
    EXPECT_NE(text.find("  tolerance 0.01, near 1 for 'e'\n"), std::string::npos) << text;
    const auto clusters = nlohmann::json::parse(report_json(report))["files"][0]["clusters"];
    ASSERT_EQ(clusters.size(), 2u);
    EXPECT_EQ(clusters[1]["near"], 1);
    EXPECT_EQ(clusters[1]["objects"][0], "e");
}

TEST(Report, LeavesOutWhetherAFileIsValidWhereItIsNotKnown) {
    Report report = made_report();
    report.files[0].valid.reset();
    EXPECT_FALSE(nlohmann::json::parse(report_json(report))["files"][0].contains("valid"));
    EXPECT_NE(report_text(report, false).find("not fully checked"), std::string::npos);
}

TEST(Report, SaysWhatWasJudgedWhereThatIsAPart) {
    Report report = made_report();
    ReportedFile& file = report.files[0];
    file.valid.reset();
    file.findings = {made("C06", Severity::info, "one")};
    file.chosen = ChosenChecks{{"C", "G"}, {"C05"}};
    const auto j = nlohmann::json::parse(report_json(report))["files"][0];
    EXPECT_FALSE(j.contains("valid"));
    EXPECT_EQ(j["judged"], nlohmann::json::parse(R"({"only":["C","G"],"skip":["C05"]})"));
    const std::string text = report_text(report, false);
    EXPECT_NE(text.find("no error among the checks run: C, G but C05; not judged: all others, C05; 0 errors"), std::string::npos) << text;
    EXPECT_NE(report_junit(report).find("name=\"checks run: C, G but C05\""), std::string::npos) << report_junit(report);
    EXPECT_NE(report_junit(report).find("name=\"not_judged\" value=\"all others, C05\""), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(report_sarif(report))["runs"][0]["properties"]["judged"][0]["skip"][0], "C05");
    EXPECT_NE(report_html(report).find("\"judged\""), std::string::npos);
    file.chosen = ChosenChecks{{}, {"C05"}};
    EXPECT_NE(report_text(report, false).find("no error among the checks run: all but C05; not judged: C05;"), std::string::npos);
    file.valid = false;
    EXPECT_NE(report_text(report, false).find("not valid; not judged: C05;"), std::string::npos);
}

TEST(Report, JunitFailsFromTheSeverityThatTheRunFailsFrom) {
    Report report = made_report();
    const auto counts = [&] {
        const std::string xml = report_junit(report);
        const std::size_t from = xml.find("tests=");
        return xml.substr(from, xml.find('>', from) - from);
    };
    EXPECT_EQ(counts(), R"(tests="3" failures="1" errors="0" skipped="2")");
    report.fails_from = Severity::warning;
    EXPECT_EQ(counts(), R"(tests="3" failures="2" errors="0" skipped="1")");
    report.fails_from.reset();
    EXPECT_EQ(counts(), R"(tests="4" failures="0" errors="0" skipped="3")");
    report.files[0].outcome = FileOutcome::unreadable;
    EXPECT_EQ(counts(), R"(tests="3" failures="0" errors="1" skipped="2")");
}

TEST(Report, JunitCasesHaveNamesOfTheirOwnAndBodiesInWords) {
    Report report = made_report();
    Finding pair = made("B11", Severity::error, "A");
    pair.entities.push_back({"surface", "B"});
    Finding other = pair;
    other.entities[1].name = "C";
    report.files[0].findings = {pair, other, pair};
    const std::string xml = report_junit(report);
    for (const char* name : {"\"B11 A, B\"", "\"B11 A, C\"", "\"B11 A, B (2)\""})
        EXPECT_NE(xml.find(name), std::string::npos) << name << xml;
    EXPECT_NE(xml.find("error B11 of corner-point-grid 'A': about A"), std::string::npos) << xml;
    EXPECT_EQ(xml.find("&quot;severity&quot;"), std::string::npos) << "no JSON";
}

TEST(Report, SarifNamesFilesByUrisAndPlacesByFingerprints) {
    Report report = made_report();
    report.files[0].file =
        "a b#c%20d/m\xc3\xb6"
        "del.ml";
    Finding one = made("M07", Severity::info, "H1_2");
    one.polylines = {{{1, 2, 3}, {4, 5, 6}}};
    Finding shuffled = made("M07", Severity::info, "H1_1");
    shuffled.polylines = {{{4, 5, 6}, {1, 2, 3}}};
    Finding elsewhere = one;
    elsewhere.polylines = {{{1, 2, 3}, {4, 5, 7}}};
    report.files[0].findings = {one, shuffled, elsewhere};
    const auto results = nlohmann::json::parse(report_sarif(report))["runs"][0]["results"];
    EXPECT_EQ(results[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "a%20b%23c%2520d/m%C3%B6del.ml");
    EXPECT_EQ(results[0]["partialFingerprints"], results[1]["partialFingerprints"]);
    EXPECT_NE(results[0]["partialFingerprints"], results[2]["partialFingerprints"]);
}

TEST(Report, ListsNoMoreFindingsThanAskedButCountsAll) {
    Report report = made_report();
    report.most_findings = 1;
    const auto file = nlohmann::json::parse(report_json(report))["files"][0];
    EXPECT_EQ(file["findings"].size(), 1u);
    EXPECT_EQ(file["not_listed"], 2);
    EXPECT_EQ(file["counts"]["warning"], 1);
    EXPECT_NE(report_text(report, false).find("2 more findings"), std::string::npos);
    const auto run = nlohmann::json::parse(report_sarif(report))["runs"][0];
    ASSERT_EQ(run["results"].size(), 1u);
    EXPECT_EQ(run["results"][0]["ruleId"], "C04");
    EXPECT_EQ(run["properties"]["not_listed"], 2);
    const std::string xml = report_junit(report);
    EXPECT_NE(xml.find("tests=\"1\" failures=\"1\""), std::string::npos) << xml;
    EXPECT_NE(xml.find("name=\"not_listed\" value=\"2\""), std::string::npos) << xml;
    report.most_findings = 0;
    EXPECT_NE(report_junit(report).find("failures=\"0\""), std::string::npos);
}

TEST(Report, TextGroupsByEntityWithTheWorstFirst) {
    const std::string text = report_text(made_report(), false);
    const auto two = text.find("'two'"), one = text.find("'one'");
    ASSERT_NE(two, std::string::npos);
    ASSERT_NE(one, std::string::npos);
    EXPECT_LT(two, one);
    EXPECT_EQ(text.find("'one'", one + 1), std::string::npos) << "each entity once";
    EXPECT_NE(text.find("cells (1,2,3) (4,5,6)\n"), std::string::npos) << text;
    EXPECT_EQ(text.find('\033'), std::string::npos);
    EXPECT_NE(report_text(made_report(), true).find('\033'), std::string::npos);
}

TEST(Report, TextSaysHowManyElementsAreNotListedAndNeverMoreThanThereAre) {
    Report report = made_report();
    Finding& f = report.files.front().findings[1];
    f.elements = {3, 11};
    f.element_kind = "triangle";
    f.count = 5;  // pairs of two triangles with others
    EXPECT_NE(report_text(report, false).find("triangles 3 11\n"), std::string::npos) << report_text(report, false);
    f.elements.clear();
    for (std::int64_t i = 1; i <= 100; ++i) f.elements.push_back(i);
    f.count = 250;
    EXPECT_NE(report_text(report, false).find("triangles 1 2 3 4 5 6 7 8 and 242 more\n"), std::string::npos) << report_text(report, false);
    f.elements = {7};
    f.element_kind.clear();  // a number that only programs know the meaning of
    EXPECT_EQ(report_text(report, false).find(" 7\n"), std::string::npos) << report_text(report, false);
}

TEST(Report, TextSaysOfAnEntityWithoutANameThatItHasNone) {
    Report report = made_report();
    report.files.front().findings[1].entities.front().name.clear();
    EXPECT_NE(report_text(report, false).find("  corner-point-grid without a name\n"), std::string::npos) << report_text(report, false);
}

TEST(Report, JunitIsUtf8WhateverNamesAre) {
    Report report = made_report();
    report.files.front().file = "caf\xe9";
    report.files.front().findings.front().message = "'\xff' is a name";
    report.files.front().findings.front().entities = {{"surface", "\xc3(", 1}};
    EXPECT_TRUE(is_utf8(report_junit(report)));
}

TEST(Report, JunitEscapesAndFailsOnErrorsOnly) {
    const std::string xml = report_junit(made_report());
    EXPECT_NE(xml.find("tests=\"3\" failures=\"1\""), std::string::npos) << xml;
    EXPECT_NE(xml.find("message=\"about two &lt;&amp;&gt;\""), std::string::npos) << xml;
    EXPECT_EQ(xml.find("<&>"), std::string::npos);
}

TEST(Report, SarifHasALevelARuleAndAPlaceForEachResult) {
    const auto run = nlohmann::json::parse(report_sarif(made_report()))["runs"][0];
    EXPECT_EQ(run["tool"]["driver"]["name"], "geomend");
    EXPECT_EQ(run["tool"]["driver"]["version"], "1.2");
    EXPECT_EQ(run["tool"]["driver"]["rules"].size(), 3u);
    EXPECT_EQ(run["results"][0]["level"], "error");
    EXPECT_EQ(run["results"][2]["level"], "note");
    EXPECT_EQ(run["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "a.grdecl");
}

TEST(Report, IsWrittenByExtension) {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(write_report(made_report(), folder / "r.json"));
    EXPECT_EQ(test::read_file(folder / "r.json"), report_json(made_report()));
    EXPECT_FALSE(write_report(made_report(), folder / "r.doc"));
    EXPECT_FALSE(report_form("report"));
}

}  // namespace
}  // namespace geomend
