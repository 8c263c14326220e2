// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/codes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace geomend {
namespace {

TEST(Codes, AscendAndAreUnique) {
    const auto all = code_catalogue();
    ASSERT_FALSE(all.empty());
    const auto wrong = std::ranges::adjacent_find(all, std::ranges::greater_equal(), &CodeInfo::code);
    EXPECT_EQ(wrong, all.end()) << wrong->code;
}

TEST(Codes, AreFoundByTheirText) {
    ASSERT_NE(find_code("F004"), nullptr);
    EXPECT_EQ(find_code("F004")->severity, Severity::error);
    EXPECT_EQ(find_code("F999"), nullptr);
}

TEST(Codes, HaveAnotherSeverityOnlyWhereItDiffersAndTheCaseIsNamed) {
    for (const CodeInfo& row : code_catalogue()) {
        if (!row.other) continue;
        EXPECT_NE(row.other->severity, row.severity) << row.code;
        EXPECT_FALSE(row.other->when.empty()) << row.code;
    }
}

TEST(Codes, GiveFindingsTheirSeverity) {
    const Finding plain = make_finding("C04", "message", {"a.grdecl", 7}, 3);
    EXPECT_EQ(plain.severity, Severity::error);
    EXPECT_EQ(plain.message, "message");
    EXPECT_EQ(plain.where.line, 7u);
    EXPECT_EQ(plain.count, 3u);
    Finding other = plain;
    use_other_severity(other);
    EXPECT_EQ(other.severity, Severity::warning);
    EXPECT_EQ(make_finding("none", "").severity, Severity::error);
}

}  // namespace
}  // namespace geomend
