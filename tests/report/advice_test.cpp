// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/advice.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace geomend
