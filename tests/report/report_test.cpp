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

TEST(Report, LeavesOutWhetherAFileIsValidWhereItIsNotKnown) {
    Report report = made_report();
    report.files[0].valid.reset();
    EXPECT_FALSE(nlohmann::json::parse(report_json(report))["files"][0].contains("valid"));
    EXPECT_NE(report_text(report, false).find("not fully checked"), std::string::npos);
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
    EXPECT_NE(text.find("cells (1,2,3) (4,5,6) and 248 more"), std::string::npos) << text;
    EXPECT_EQ(text.find('\033'), std::string::npos);
    EXPECT_NE(report_text(made_report(), true).find('\033'), std::string::npos);
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
