// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/baseline.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/temporary_folder.h"

namespace geomend {
namespace {

Finding made(const char* code, std::vector<EntityRef> entities, std::vector<std::int64_t> elements = {}, std::uint64_t count = 0) {
    Finding f;
    f.code = code;
    f.severity = Severity::error;
    f.message = "message of " + f.code;
    f.entities = std::move(entities);
    f.elements = std::move(elements);
    f.count = count;
    if (!f.elements.empty()) f.element_kind = "triangle";
    return f;
}

ReportedFile file_of(std::vector<Finding> findings, const std::string& name = "a.ml") {
    ReportedFile file;
    file.file = name;
    file.valid = false;
    file.findings = std::move(findings);
    return file;
}

// Through the file, as a user's baseline goes.
Baseline through_file(std::vector<ReportedFile> files, std::size_t most = static_cast<std::size_t>(-1)) {
    const test::TemporaryFolder folder;
    Report report;
    report.tool = "geomend 1.2";
    report.files = std::move(files);
    report.most_findings = most;
    test::write_file(folder / "old.json", report_json(report));
    auto baseline = read_baseline(folder / "old.json");
    EXPECT_TRUE(baseline.ok());
    return baseline ? *baseline : Baseline{};
}

// Codes that are left of `now` where `before` is known.
std::vector<std::string> left(const std::vector<Finding>& before, const std::vector<Finding>& now) {
    const Baseline baseline = through_file({file_of(before)});
    ReportedFile file = file_of(now);
    leave_out_known(file, baseline.files.at(0));
    const SeverityCounts known = file.known.value_or(SeverityCounts{});
    EXPECT_EQ(known.error + known.warning + known.info + file.findings.size(), now.size());
    std::vector<std::string> codes;
    for (const Finding& f : file.findings) codes.push_back(f.code);
    return codes;
}
using Codes = std::vector<std::string>;

const EntityRef surface_a{"surface", "A", 3}, surface_b{"surface", "B", 4};

TEST(Baseline, KnowsWhatItHasTold) {
    Finding cells = made("C04", {{"corner-point-grid", "g"}}, {1, 2, 3, 4, 5, 6}, 250);
    cells.element_kind = "cell-ijk";
    Finding file_only = made("F102", {});
    file_only.where = {"a.ml", 17, 2, -1};
    const std::vector<Finding> all{cells, made("B08", {surface_a, surface_b}), made("M03", {surface_a}, {7, 9}, 2), file_only};
    EXPECT_EQ(left(all, all), Codes{});
}

TEST(Baseline, AnotherCodeOrEntityIsNew) {
    const std::vector<Finding> before{made("M03", {surface_a}, {7, 9}, 2)};
    EXPECT_EQ(left(before, {made("M04", {surface_a}, {7, 9}, 2)}), Codes{"M04"});
    EXPECT_EQ(left(before, {made("M03", {surface_b}, {7, 9}, 2)}), Codes{"M03"});
    EXPECT_EQ(left(before, {made("M03", {surface_a, surface_b}, {7, 9}, 2)}), Codes{"M03"});
    EXPECT_EQ(left(before, {made("M03", {{"surface", "A", 5}}, {7, 9}, 2)}), Codes{"M03"});
    EXPECT_EQ(left(before, {made("M03", {{"line", "A", 3}}, {7, 9}, 2)}), Codes{"M03"});
    EXPECT_EQ(left({}, {made("M03", {surface_a})}), Codes{"M03"});
}

TEST(Baseline, PairsAreTheSameInEitherOrder) {
    EXPECT_EQ(left({made("B08", {surface_a, surface_b})}, {made("B08", {surface_b, surface_a})}), Codes{});
}

TEST(Baseline, ADefectThatMovedIsNewThoughTheNumberStayed) {
    const std::vector<Finding> before{made("M03", {surface_a}, {7, 9}, 2)};
    EXPECT_EQ(left(before, {made("M03", {surface_a}, {7, 10}, 2)}), Codes{"M03"});
    EXPECT_EQ(left(before, {made("M03", {surface_a}, {10}, 1)}), Codes{"M03"});
    EXPECT_EQ(left(before, {made("M03", {surface_a}, {9}, 1)}), Codes{}) << "one of two was mended";
    EXPECT_EQ(left(before, {made("M03", {surface_a}, {9, 7}, 2)}), Codes{}) << "the order says nothing";
}

TEST(Baseline, AHoleElsewhereIsNewAndOneInAnotherOrderIsNot) {
    Finding hole = made("M07", {{"surface", "A_2", 3}}, {}, 1);
    hole.polylines = {{{1, 2, 3}, {2, 2, 3}, {1, 3, 3}, {1, 2, 3}}};
    Finding elsewhere = hole;
    for (Vec3& p : elsewhere.polylines[0]) p[0] += 10;
    Finding again = hole;  // written anew: other number of the part, another start, rounded
    again.entities = {{"surface", "A_1", 7}};
    again.polylines = {{{2, 2, 3}, {1, 3, 3 + 1e-9}, {1, 2, 3}, {2, 2, 3}}};
    const Baseline baseline = through_file({file_of({hole})});
    const auto left_of = [&](const Finding& now) {
        ReportedFile file = file_of({now});
        file.tolerance = 1e-6;
        leave_out_known(file, baseline.files.at(0));
        return file.findings.size();
    };
    EXPECT_EQ(left_of(hole), 0u);
    EXPECT_EQ(left_of(elsewhere), 1u);
    EXPECT_EQ(left_of(again), 0u);
    Finding two = hole;
    two.count = 2;
    two.polylines.push_back(elsewhere.polylines[0]);
    EXPECT_EQ(left_of(two), 1u);
    again.entities = {{"surface", "B_1", 7}};
    EXPECT_EQ(left_of(again), 1u);
    // Numbers of triangles change with their order, their places do not.
    Finding flat = made("M03", {surface_a}, {7, 9}, 2), shuffled = made("M03", {surface_a}, {1, 2}, 2), other = shuffled;
    flat.points = {{0, 0, 0}, {5, 5, 5}};
    shuffled.points = {{5, 5, 5}, {0, 0, 0}};
    other.points = {{5, 5, 5}, {1, 1, 1}};
    EXPECT_EQ(left({flat}, {shuffled}), Codes{});
    EXPECT_EQ(left({flat}, {other}), Codes{"M03"});
}

TEST(Baseline, OfLongListsTheNumberDecides) {
    std::vector<std::int64_t> first(100), others(100);
    for (std::size_t i = 0; i < 100; ++i) {
        first[i] = static_cast<std::int64_t>(i);
        others[i] = static_cast<std::int64_t>(1000 + i);
    }
    const std::vector<Finding> before{made("M03", {surface_a}, first, 500)};
    EXPECT_EQ(left(before, {made("M03", {surface_a}, others, 500)}), Codes{});
    EXPECT_EQ(left(before, {made("M03", {surface_a}, first, 501)}), Codes{"M03"});
    EXPECT_EQ(left({made("B01", {surface_a}, {}, 4)}, {made("B01", {surface_a}, {}, 5)}), Codes{"B01"});
    EXPECT_EQ(left({made("B01", {surface_a}, {}, 4)}, {made("B01", {surface_a}, {}, 4)}), Codes{});
}

TEST(Baseline, TriplesAreComparedAsCellsNotAsNumbers) {
    Finding before = made("C03", {{"corner-point-grid", "g"}}, {1, 2, 3, 4, 5, 6}, 2), now = before;
    before.element_kind = now.element_kind = "cell-ijk";
    now.elements = {1, 5, 6};  // each number is known, the cell is not
    now.count = 1;
    EXPECT_EQ(left({before}, {now}), Codes{"C03"});
    now.elements = {4, 5, 6};
    EXPECT_EQ(left({before}, {now}), Codes{});
}

TEST(Baseline, EachOldFindingStandsForOneNewOne) {
    const Finding one = made("M03", {surface_a}, {7}, 1), other = made("M03", {surface_a}, {7, 8}, 2);
    EXPECT_EQ(left({one}, {one, one}), Codes{"M03"});
    // The exact one keeps its place, whatever the order.
    EXPECT_EQ(left({other, one}, {one, other}), Codes{});
    EXPECT_EQ(left({one, other}, {one, other}), Codes{});
}

TEST(Baseline, FindingsAboutNothingInParticularAreToldByTheirWords) {
    Finding before = made("F102", {}), now = before;
    before.message = "record FOO in line 12 is not known";
    now.message = "record FOO in line 14 is not known";
    EXPECT_EQ(left({before}, {now}), Codes{});
    now.message = "record BAR in line 12 is not known";
    EXPECT_EQ(left({before}, {now}), Codes{"F102"});
}

TEST(Baseline, NamesMayHoldAnything) {
    const std::vector<Finding> odd{made("M03", {{"surface", std::string("a\0b\"\\\n<", 7), 1}}, {7}, 1)};
    EXPECT_EQ(left(odd, odd), Codes{});
    const std::vector<Finding> latin{made("M03", {{"surface", "faille \xe9tendue", 1}}, {7}, 1)};
    EXPECT_EQ(left(latin, latin), Codes{}) << "also what is no UTF-8, and stands changed in the report";
}

TEST(Baseline, ValidityStillSpeaksOfAllFindings) {
    const Baseline baseline = through_file({file_of({made("M03", {surface_a}, {7}, 1)})});
    ReportedFile file = file_of({made("M03", {surface_a}, {7}, 1)});
    leave_out_known(file, baseline.files[0]);
    Report report;
    report.files.push_back(file);
    const auto j = nlohmann::json::parse(report_json(report))["files"][0];
    EXPECT_EQ(j["valid"], false);
    EXPECT_EQ(j["counts"]["error"], 0);
    EXPECT_EQ(j["known"]["error"], 1);
    EXPECT_NE(report_text(report, false).find("1 finding of the baseline left out"), std::string::npos);
}

TEST(Baseline, FindsItsFileByPathThenByNameThenByPlace) {
    Baseline old;
    for (const char* name : {"x/a.ml", "x/b.ml", "y/b.ml", "z/c.ml"}) old.files.push_back({name, {}, 0});
    const auto chosen = baseline_files(old, {"new/c.ml", "x/b.ml", "new.ml", "x/a.ml"});
    EXPECT_EQ(chosen[0], &old.files[3]) << "by name";
    EXPECT_EQ(chosen[1], &old.files[1]) << "by path";
    EXPECT_EQ(chosen[2], &old.files[2]) << "by place";
    EXPECT_EQ(chosen[3], &old.files[0]);
    // A file that came in between does not take the place of one that is still there.
    const auto shifted = baseline_files(old, {"x/a.ml", "between.ml", "x/b.ml"});
    EXPECT_EQ(shifted[1], nullptr);
    EXPECT_EQ(shifted[2], &old.files[1]);
}

TEST(Baseline, WhatWasNotListedIsNotKnownAndCounted) {
    const std::vector<Finding> two{made("M03", {surface_a}, {7}, 1), made("M04", {surface_a}, {7}, 1)};
    const Baseline baseline = through_file({file_of(two)}, 1);
    EXPECT_EQ(baseline.files[0].not_listed, 1u);
    ReportedFile file = file_of(two);
    leave_out_known(file, baseline.files[0]);
    ASSERT_EQ(file.findings.size(), 1u);
    EXPECT_EQ(file.findings[0].code, "M04");
}

TEST(Baseline, SaysWhatIsWrongWithIt) {
    const test::TemporaryFolder folder;
    const auto code = [&](const std::string& text) {
        test::write_file(folder / "old.json", text);
        const auto read = read_baseline(folder / "old.json");
        return read ? std::string("ok") : read.why().error.code;
    };
    EXPECT_EQ(read_baseline(folder / "none.json").why().error.code, "F001");
    EXPECT_EQ(read_baseline(folder.path()).why().error.code, "F001");
    EXPECT_EQ(code(""), "F012");
    EXPECT_EQ(code("[1,2"), "F012");
    EXPECT_EQ(code("[]"), "F013");
    EXPECT_EQ(code("{\"schema\": 2, \"files\": []}"), "F013");
    EXPECT_EQ(code("{\"schema\": 1}"), "F013");
    EXPECT_EQ(code("{\"schema\": 1, \"files\": [3]}"), "F013");
    EXPECT_EQ(code("{\"schema\": 1, \"files\": [{\"findings\": 3}]}"), "F013");
    EXPECT_EQ(
        code("{\"schema\": 1, \"files\": [{\"findings\": [3, {\"code\": 4, \"entities\": [1], \"elements\": [[[1]]], \"count\": -1}]}]}"),
        "ok");
    test::write_file(folder / "old.json", "{\n \"schema\": 1,\n \"files\": [x]}");
    const auto read = read_baseline(folder / "old.json");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.why().error.where.line, 3u);
    EXPECT_EQ(read.why().error.where.column, 12u);
}

}  // namespace
}  // namespace geomend
