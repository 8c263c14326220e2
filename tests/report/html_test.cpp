// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <string>

#include "report/base64.h"
#include "report/page_pieces.h"
#include "report/report.h"
#include "support/base64_values.h"

namespace geomend {
namespace {

using Json = nlohmann::json;

std::size_t occurrences(const std::string& text, const std::string& piece) {
    std::size_t count = 0;
    for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++count;
    return count;
}

// What the page says of the report: the JSON in it.
std::string data_of(const std::string& page) {
    const std::string head = "<script type=\"application/json\" id=\"report\">";
    const std::size_t first = page.find(head) + head.size();
    return page.substr(first, page.find("</script>", first) - first);
}

Report with_one_finding(Finding f) {
    Report report;
    report.tool = "geomend 1.2";
    ReportedFile file;
    file.file = "a.ml";
    file.findings.push_back(std::move(f));
    report.files.push_back(std::move(file));
    return report;
}

Finding finding(std::string message) {
    Finding f;
    f.code = "C04";
    f.severity = Severity::error;
    f.message = std::move(message);
    f.entities = {{"surface", "s", 3}};
    return f;
}

// A square of n x n points in z = 7, far from the origin, as two triangles a cell.
ScenePart square(std::uint32_t n, const std::string& name) {
    ScenePart part;
    part.kind = "surface";
    part.name = name;
    part.role = FeatureRole::fault;
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) part.points.push_back({4e5 + i, 6.5e6 + j, 7});
    }
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
        for (std::uint32_t i = 0; i + 1 < n; ++i) {
            const std::uint32_t a = i + n * j;
            part.triangles.push_back({a, a + 1, a + n + 1});
            part.triangles.push_back({a, a + n + 1, a + n});
        }
    }
    return part;
}

std::vector<float> floats(const std::string& base64) { return test::base64_values<float>(base64); }

TEST(HtmlReport, TextOfFilesNeverBecomesMarkup) {
    const std::string evil = "</script><img src=x onerror=alert(1)> <!-- ' \" & \\ ]]> \u2028 {{";
    Finding f = finding(evil);
    f.entities = {{evil, evil, 1}};
    f.where = {evil, 3, 4, -1};
    f.element_kind = evil;
    f.measures = {{evil, 1.0}};
    Report report = with_one_finding(f);
    report.tool = evil;
    report.files[0].file = evil;
    report.files[0].debris = {{evil}};
    ReportedStep step;
    step.step = step.why = evil;
    step.what = f;
    step.kept = false;
    step.contacts.push_back({evil, evil, 1, evil, evil});
    report.files[0].steps.push_back(step);
    Scene scene;
    scene.parts = {square(2, evil)};
    scene.parts[0].kind = evil;
    scene.marks.resize(1);
    report.files[0].scene = scene;
    const std::string page = report_html(report), data = data_of(page);
    EXPECT_EQ(data.find_first_of("<>&"), std::string::npos);
    EXPECT_EQ(page.find("onerror=alert(1)>"), std::string::npos);
    // The same tags as in a page about nothing.
    EXPECT_EQ(occurrences(page, "</script"), occurrences(report_html(Report{}), "</script"));
    EXPECT_EQ(occurrences(page, "<!--"), occurrences(report_html(Report{}), "<!--"));
    const Json j = Json::parse(data);
    EXPECT_EQ(j["files"][0]["findings"][0]["message"], evil);
    EXPECT_EQ(j["files"][0]["findings"][0]["entities"][0]["name"], evil);
    EXPECT_EQ(j["files"][0]["scene"]["parts"][0]["name"], evil);
    EXPECT_EQ(j["files"][0]["file"], evil);
}

TEST(HtmlReport, ZeroBytesAndBrokenUtf8AreHarmless) {
    const std::string broken = std::string("a\0b", 3) + "\xff\xfe \xc3( \xed\xa0\x80 \xf0\x9f\x92";
    const std::string page = report_html(with_one_finding(finding(broken)));
    for (const char c : data_of(page)) ASSERT_TRUE(c >= 0x20 && c < 0x7f) << int(c);
    EXPECT_EQ(page.find('\0'), std::string::npos);
    const std::string back = Json::parse(data_of(page))["files"][0]["findings"][0]["message"];
    EXPECT_EQ(back.substr(0, 3), std::string("a\0b", 3));
    EXPECT_NE(back.find("\xef\xbf\xbd"), std::string::npos) << "what is no text shows as such";
}

TEST(HtmlReport, NeedsNoNetwork) {
    const std::string page = report_html(with_one_finding(finding("m")));
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
    const std::string own = page.substr(0, page.find("<script"));
    EXPECT_EQ(own.find("http://"), std::string::npos);
    EXPECT_EQ(own.find("https://"), std::string::npos);
    EXPECT_EQ(page.find("<script src"), std::string::npos);
    EXPECT_EQ(page.find("@import"), std::string::npos);
}

TEST(HtmlReport, ListsNoMoreFindingsThanAskedTheWorstFirst) {
    Report report = with_one_finding(finding("worst"));
    for (int i = 0; i < 5; ++i) {
        Finding f = finding("note");
        f.severity = Severity::info;
        report.files[0].findings.insert(report.files[0].findings.begin(), f);
    }
    report.most_findings = 2;
    const Json file = Json::parse(data_of(report_html(report)))["files"][0];
    ASSERT_EQ(file["findings"].size(), 2u);
    EXPECT_EQ(file["findings"][0]["message"], "worst");
    EXPECT_EQ(file["not_listed"], 4);
    EXPECT_EQ(file["counts"]["info"], 5);
}

TEST(HtmlReport, MarksStayWithTheirFindingAndKeepTheirPlace) {
    Report report = with_one_finding(finding("note"));
    ReportedFile& file = report.files[0];
    file.findings[0].severity = Severity::info;
    file.findings.push_back(finding("error"));
    file.findings[1].points = {{400001.5, 6500001.25, 7}};
    file.scene.emplace();
    file.scene->parts = {square(3, "s")};
    file.scene->marks.resize(2);
    file.scene->marks[1].points = file.findings[1].points;
    file.scene->marks[1].polylines = {{{4e5, 6.5e6, 7}, {4e5 + 2, 6.5e6, 7}}, {{4e5, 6.5e6, 8}}};
    finish(*file.scene);
    const Json j = Json::parse(data_of(report_html(report)))["files"][0];
    EXPECT_EQ(j["scene"]["origin"], Json::parse("[400001.0, 6500001.0, 7.0]"));
    EXPECT_EQ(j["findings"][0]["message"], "error");
    EXPECT_FALSE(j["findings"][1].contains("mark"));
    const Json& mark = j["findings"][0]["mark"];
    EXPECT_EQ(floats(mark["points"]), (std::vector<float>{0.5f, 0.25f, 0.0f}));
    EXPECT_EQ(floats(mark["lines"]), (std::vector<float>{-1, -1, 0, 1, -1, 0, -1, -1, 1}));
    EXPECT_EQ(mark["lengths"], Json::parse("[2,1]"));
    EXPECT_FALSE(j["findings"][0].contains("points")) << "once is enough";
    EXPECT_EQ(j["scene"]["parts"][0]["role"], "fault");
    EXPECT_EQ(floats(j["scene"]["parts"][0]["points"]).size(), 27u);
}

TEST(HtmlReport, OfManyFilesEachIsDrawnWithFewerTriangles) {
    Report report;
    report.files.resize(50);
    report.files[7].scene.emplace();
    report.files[7].scene->parts = {square(200, "s")};
    finish(*report.files[7].scene);
    const Json scene = Json::parse(data_of(report_html(report)))["files"][7]["scene"];
    EXPECT_TRUE(scene["simplified"]);
    EXPECT_LE(scene["drawn"], 20000);
    EXPECT_EQ(page_triangles(1), 250000u);
    EXPECT_EQ(page_triangles(0), 250000u);
    EXPECT_GE(page_triangles(1000000), 1000u);
}

TEST(HtmlReport, MarksAreShownEvenWhereThereIsNothingToDrawAroundThem) {
    Report report = with_one_finding(finding("m"));
    report.files[0].scene.emplace();
    report.files[0].scene->marks.resize(1);
    EXPECT_FALSE(Json::parse(data_of(report_html(report)))["files"][0].contains("scene"));
    report.files[0].scene->marks[0].points = {{1, 2, 3}};
    finish(*report.files[0].scene);
    const Json file = Json::parse(data_of(report_html(report)))["files"][0];
    EXPECT_TRUE(file.contains("scene"));
    EXPECT_TRUE(file["findings"][0].contains("mark"));
}

TEST(HtmlReport, TellsHowManyFindingsAreNotMarkedWhereThereAreTooMany) {
    Report report = with_one_finding(finding("m"));
    report.files[0].findings.push_back(finding("n"));
    report.files[0].scene.emplace();
    report.files[0].scene->marks.resize(2);
    report.files[0].scene->marks[0].points.assign(1600000, {1, 2, 3});
    report.files[0].scene->marks[1].points = {{1, 2, 3}};
    const Json file = Json::parse(data_of(report_html(report)))["files"][0];
    EXPECT_EQ(file["scene"]["unmarked"], 1);
    EXPECT_FALSE(file["findings"][0].contains("mark"));
    EXPECT_TRUE(file["findings"][1].contains("mark"));
}

// A repair of which something is known: two sheets before, one after, 7 m away.
Report of_a_repair() {
    Report report = with_one_finding(finding("m"));
    ReportedFile& file = report.files[0];
    file.scene.emplace();
    file.scene->crs.axis_units = {"m", "m", "m"};
    file.scene->parts = {square(3, "s")};
    file.scene->parts[0].moved.assign(9, 0.0f);
    file.scene->parts[0].moved[4] = 0.25f;
    file.scene->parts.push_back(square(2, "strip"));
    file.scene->parts[1].change = PartChange::added;
    finish(*file.scene);
    file.changes.emplace();
    file.changes->before.parts = {square(3, "s"), square(2, "tail")};
    for (ScenePart& part : file.changes->before.parts) {
        for (Vec3& p : part.points) p[0] += 7;
    }
    file.changes->before.parts[1].change = PartChange::removed;
    finish(file.changes->before);
    file.changes->vertices = 9;
    file.changes->moved = 1;
    file.changes->largest = file.changes->mean = 0.25;
    return report;
}

TEST(HtmlReport, ARepairHasItsModelBeforeAndAfterInOneSpace) {
    const Json file = Json::parse(data_of(report_html(of_a_repair())))["files"][0];
    const Json &changes = file["changes"], &before = changes["before"], &after = file["scene"];
    EXPECT_EQ(before["origin"], after["origin"]);
    const auto was = floats(before["parts"][0]["points"]), is = floats(after["parts"][0]["points"]);
    for (std::size_t i = 0; i < is.size(); ++i) EXPECT_EQ(was[i], is[i] + (i % 3 == 0 ? 7 : 0)) << i;
    EXPECT_EQ(floats(after["parts"][0]["moved"]), (std::vector<float>{0, 0, 0, 0, 0.25f, 0, 0, 0, 0}));
    EXPECT_FALSE(after["parts"][0].contains("change"));
    EXPECT_EQ(after["parts"][1]["change"], "added");
    EXPECT_FALSE(after["parts"][1].contains("moved"));
    EXPECT_EQ(before["parts"][1]["change"], "removed");
    EXPECT_EQ(changes["unit"], "m");
    EXPECT_EQ(changes["largest"], 0.25);
}

TEST(HtmlReport, UnitsThatDifferAreNotSaidOfLengths) {
    Report report = of_a_repair();
    report.files[0].scene->crs.axis_units = {"m", "m", "ft"};
    EXPECT_EQ(Json::parse(data_of(report_html(report)))["files"][0]["changes"]["unit"], "");
}

TEST(HtmlReport, ALargeRepairIsDrawnWithinBoundsBeforeAndAfter) {
    Report report = of_a_repair();
    report.files[0].scene->parts[0] = square(500, "s");
    report.files[0].scene->parts[0].moved.assign(500 * 500, 0.0f);
    report.files[0].scene->parts[0].moved[777] = 2.5f;
    report.files[0].changes->before.parts[0] = square(500, "s");
    finish(*report.files[0].scene);
    finish(report.files[0].changes->before);
    const std::string page = report_html(report);
    const Json file = Json::parse(data_of(page))["files"][0];
    for (const Json& scene : {file["scene"], file["changes"]["before"]}) {
        EXPECT_TRUE(scene["simplified"]);
        EXPECT_LE(scene["drawn"], page_triangles(2));
        EXPECT_GE(scene["drawn"], 100000);
    }
    EXPECT_LT(page.size(), 30u << 20);
    const auto moved = floats(file["scene"]["parts"][0]["moved"]);
    EXPECT_EQ(moved.size(), floats(file["scene"]["parts"][0]["points"]).size() / 3);
    EXPECT_EQ(*std::ranges::max_element(moved), 2.5f) << "what moved farthest is not thinned away";
}

TEST(HtmlReport, WhatARepairLeftOutIsListedOnceForEachReason) {
    Report report = of_a_repair();
    for (int n = 0; n < 3; ++n)
        report.files[0].changes->removed.push_back({"tails", n < 2 ? "tail" : "outside", "</script>", square(2, "<b>"), {}});
    const std::string page = report_html(report);
    const Json removed = Json::parse(data_of(page))["files"][0]["removed"];
    ASSERT_EQ(removed.size(), 2u);
    EXPECT_EQ(removed[0]["pieces"], 2);
    EXPECT_EQ(removed[0]["triangles"], 4);
    EXPECT_EQ(removed[0]["surface"], "<b>");
    EXPECT_EQ(occurrences(page, "</script"), occurrences(report_html(Report{}), "</script"));
    report.files[0].changes->removed[1].debris = {"d/0002-tail-b.ts"};
    const Json json = Json::parse(report_json(report))["files"][0]["removed"];
    ASSERT_EQ(json.size(), 3u);
    EXPECT_EQ(json[1]["debris"][0], "d/0002-tail-b.ts");
}

TEST(HtmlReport, TellsThatALargeModelIsDrawnSimplified) {
    Report report = with_one_finding(finding("m"));
    report.files[0].scene.emplace();
    report.files[0].scene->parts = {square(500, "s")};
    finish(*report.files[0].scene);
    const Json scene = Json::parse(data_of(report_html(report)))["files"][0]["scene"];
    EXPECT_EQ(scene["triangles"], 2 * 499 * 499);
    EXPECT_TRUE(scene["simplified"]);
    EXPECT_LE(scene["drawn"], 250000);
    EXPECT_GE(scene["drawn"], 100000);
}

TEST(Thin, KeepsWhatFitsTogetherFitting) {
    Scene scene;
    scene.parts = {square(101, "left"), square(101, "right")};
    for (Vec3& p : scene.parts[1].points) p[0] += 100;  // they share the border x = 4e5 + 100
    thin(scene, 2000);
    ASSERT_TRUE(scene.simplified);
    std::vector<Vec3> borders[2];
    double most[2] = {-1e300, -1e300}, least = 1e300;
    for (const Vec3& p : scene.parts[0].points) most[0] = std::max(most[0], p[0]);
    for (const Vec3& p : scene.parts[1].points) least = std::min(least, p[0]);
    EXPECT_EQ(most[0], least);
    for (const Vec3& p : scene.parts[0].points) {
        if (p[0] == least) borders[0].push_back(p);
    }
    for (const Vec3& p : scene.parts[1].points) {
        if (p[0] == least) borders[1].push_back(p);
    }
    std::ranges::sort(borders[0]);
    std::ranges::sort(borders[1]);
    EXPECT_EQ(borders[0], borders[1]);
    std::size_t triangles = 0;
    for (const ScenePart& part : scene.parts) {
        triangles += part.triangles.size();
        for (const auto& t : part.triangles) {
            for (const std::uint32_t corner : t) ASSERT_LT(corner, part.points.size());
        }
    }
    EXPECT_LE(triangles, 2000u);
    EXPECT_GE(triangles, 800u);
}

TEST(Thin, LeavesSmallScenesAsTheyAre) {
    Scene scene;
    scene.parts = {square(11, "s")};
    thin(scene, 200);
    EXPECT_FALSE(scene.simplified);
    EXPECT_EQ(scene.parts[0].triangles.size(), 200u);
}

TEST(Base64, IsThatOfTheStandard) {
    // "fooba" + zeroes, by the lowest byte first.
    const std::uint32_t words[] = {0x626f6f66u, 0x00000061u};
    EXPECT_EQ(base64_of_words(words), "Zm9vYmEAAAA=");
    EXPECT_EQ(base64_of_words(std::span(words).first(1)), "Zm9vYg==");
    EXPECT_EQ(base64_of_words({}), "");
    const std::uint32_t three[] = {0x00010203u, 0xfffefdfcu, std::bit_cast<std::uint32_t>(1.0f)};
    EXPECT_EQ(base64_of_words(three), "AwIBAPz9/v8AAIA/");
}

TEST(Page, HasItsPlainViewWhateverTheNetworkWas) {
    EXPECT_NE(page::script().find("class PlainView"), std::string_view::npos);
    EXPECT_NE(page::body().find("id=\"rows\""), std::string_view::npos);
    if (page::vtk_view().empty()) GTEST_SKIP() << "vtk.js could not be fetched when this was built";
    EXPECT_NE(page::vtk_view().find("Kitware"), std::string_view::npos) << "its licence goes with it";
    EXPECT_NE(page::vtk_view().find("GeomendVtkView"), std::string_view::npos);
}

}  // namespace
}  // namespace geomend
