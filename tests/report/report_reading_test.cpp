// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/report_reading.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace geomend {
namespace {

Report full_report() {
    Report report;
    report.tool = "geomend 1.2";
    ReportedFile& one = report.files.emplace_back();
    one.file = "a \"b\".ml";
    one.valid = false;
    one.tolerance = 1.0 / 3;
    one.near = 1e-300;
    one.companions = {"part.grdecl"};
    one.clusters = {{0.25, 3, {"a", "b"}}, {1.0 / 3, 1e-300, {"c"}}};
    one.closing = ReportedClosing{0.03, 236, 6};
    Finding f;
    f.code = "B08";
    f.severity = Severity::error;
    f.message = "about \xc3\xa9 <&>\n";
    f.where = {"a.ml", 12, 3, 77};
    f.entities = {{"surface", "H1", 12}, {"line", ""}};
    f.elements = {1, -2, 3000000000};
    f.index = {0, 5};
    f.element_kind = "triangle";
    f.count = 12345678901;
    f.points = {{0.1, -2e17, 3}};
    f.polylines = {{{0, 0, 0}, {1, 2, 3}}, {}};
    f.measures = {{"gap", 0.2}, {"angle", 12.5}};
    one.findings = {f};
    f.element_kind = "cell-ijk";
    f.elements = {1, 2, 3, 4, 5, 6};
    one.findings.push_back(f);
    f.element_kind = "pillar-ij";
    f.severity = Severity::info;
    f.elements = {1, 2};
    one.findings.push_back(f);
    ReportedFile& other = report.files.emplace_back();
    other.file = "c.ts";
    other.outcome = FileOutcome::crashed;
    return report;
}

TEST(ReportReading, GivesBackWhatWasWritten) {
    const std::string text = report_json(full_report());
    const auto read = read_report(text, "r.json");
    ASSERT_TRUE(read.ok()) << read.why().error.message;
    EXPECT_EQ(report_json(*read), text);
    EXPECT_EQ(read->files[0].findings[1].element_kind, "cell-ijk");
    EXPECT_EQ(read->files[0].findings[1].elements.size(), 6u);
    EXPECT_EQ(read->files[0].findings[0].points[0][1], -2e17);
    EXPECT_EQ(read->files[1].outcome, FileOutcome::crashed);
    EXPECT_FALSE(read->files[1].valid.has_value());
}

TEST(ReportReading, RefusesWhatIsNoReport) {
    for (const char* text : {"", "null", "[]", "{}", "{\"schema\": 1}", "{\"schema\": 2, \"tool\": \"\", \"files\": []}",
                             "{\"schema\": 1, \"tool\": 3, \"files\": []}", "{\"schema\": 1, \"tool\": \"\", \"files\": [1]}"}) {
        const auto read = read_report(text, "r.json");
        ASSERT_FALSE(read.ok()) << text;
        EXPECT_EQ(read.why().error.code, "F012");
        EXPECT_EQ(read.why().error.where.file, "r.json");
    }
}

// Each value of a good report is replaced by values of other types: that is read or refused, never a crash.
TEST(ReportReading, SurvivesWrongTypesAnywhere) {
    const auto good = nlohmann::json::parse(report_json(full_report()));
    const auto flat = good.flatten();
    std::size_t refused = 0;
    for (const auto& [path, value] : flat.items()) {
        for (const char* other : {"null", "-1", "1e300", "\"x\"", "[[1],[1,2]]", "{\"a\": 1}", "true"}) {
            auto bad = good;
            bad[nlohmann::json::json_pointer(path)] = nlohmann::json::parse(other);
            refused += !read_report(bad.dump(), "r").ok();
        }
    }
    EXPECT_GT(refused, 3 * flat.size());
}

TEST(ReportReading, RefusesACutReport) {
    const std::string text = report_json(full_report());
    for (std::size_t size = 0; size + 2 < text.size(); size += 17) EXPECT_FALSE(read_report(text.substr(0, size), "r").ok()) << size;
}

}  // namespace
}  // namespace geomend
