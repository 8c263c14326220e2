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

}  // namespace
}  // namespace geomend
