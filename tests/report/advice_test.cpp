// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/advice.h"

#include <gtest/gtest.h>

#include <set>

#include "base/codes.h"

namespace geomend {
namespace {

TEST(Advice, IsThereForMostCodesAndForNothingElse) {
    std::size_t advised = 0;
    for (const CodeInfo& row : code_catalogue()) advised += advice_for(row.code).empty() ? 0 : 1;
    EXPECT_GT(2 * advised, code_catalogue().size());
    EXPECT_EQ(advice_for("F004"), "the file was cut short: copy or export it again");
    EXPECT_TRUE(advice_for("F022").empty()) << "nothing mends a run that was stopped";
    EXPECT_TRUE(advice_for("F999").empty());
}

TEST(Advice, IsGivenForEachErrorOfAFileThatCannotBeRead) {
    for (const CodeInfo& row : code_catalogue()) {
        if (row.code[0] != 'F' || row.severity != Severity::error || row.code == "F022") continue;
        EXPECT_FALSE(advice_for(row.code).empty()) << row.code;
    }
}

TEST(Advice, FitsTheSituationThatAMeasureTells) {
    Finding f = make_finding("B05", "");
    const auto of_holes = advice_for(f);
    EXPECT_EQ(of_holes, advice_for("B05"));
    f.measures = {{"length", 3}, {"sides_missing", 1}};
    EXPECT_NE(advice_for(f), of_holes);
    EXPECT_NE(advice_for(f).find("list of the region"), std::string_view::npos) << advice_for(f);
}

TEST(Advice, HasOneRowForEachSituationAndTheRowOfAllOthersLast) {
    std::string_view code;
    std::set<std::string_view> measures;
    for (const Advice& row : advice_rows()) {
        if (row.code != code) {
            EXPECT_LT(code, row.code) << "in the order of codes";
            measures.clear();
        }
        code = row.code;
        EXPECT_FALSE(measures.contains("")) << row.code << " has a row behind that of all others";
        EXPECT_TRUE(measures.insert(row.measure).second) << row.code << ' ' << row.measure;
        EXPECT_NE(find_code(row.code), nullptr) << row.code;
        EXPECT_FALSE(row.text.ends_with('.')) << row.code;
    }
}

}  // namespace
}  // namespace geomend
