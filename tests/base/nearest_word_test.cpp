// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/nearest_word.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace geomend {
namespace {

constexpr std::array<std::string_view, 4> steps{"clean", "close", "cut", "tails"};

TEST(NearestWord, IsTheOneWithFewestLettersWrong) {
    EXPECT_EQ(nearest_word("clsoe", steps), "close");
    EXPECT_EQ(nearest_word("CUTT", steps), "cut");
    EXPECT_EQ(nearest_word("tail", steps), "tails");
    EXPECT_EQ(nearest_word("c", steps), "") << "most letters are missing";
}

TEST(NearestWord, OfEqualsTheFirstAndOfNoneNothing) {
    constexpr std::array<std::string_view, 2> equals{"ab", "ac"};
    EXPECT_EQ(nearest_word("ad", equals), "") << "of two letters one is half";
    EXPECT_EQ(nearest_word("abx", std::array<std::string_view, 2>{"abc", "abd"}), "abc");
    EXPECT_EQ(nearest_word("ad", {}), "");
    EXPECT_EQ(nearest_word(std::string(5000, 'x'), equals), "");
    EXPECT_EQ(nearest_hint("clsoe", steps), "; the nearest is 'close'");
    EXPECT_EQ(nearest_hint("mesh", steps), "");
}

}  // namespace
}  // namespace geomend
