// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/text_cursor.h"

#include <gtest/gtest.h>

namespace geomend {
namespace {

TEST(TextCursor, WalksOverLinesOfAllKinds) {
    TextCursor cursor("a b\r\n\n\tc\nlast");
    ASSERT_TRUE(cursor.next_line());
    EXPECT_EQ(cursor.token(), "a");
    EXPECT_EQ(cursor.column(), 2u);
    EXPECT_EQ(cursor.token(), "b");
    EXPECT_EQ(cursor.token(), "");
    ASSERT_TRUE(cursor.next_line());
    EXPECT_TRUE(cursor.at_line_end());
    ASSERT_TRUE(cursor.next_line());
    EXPECT_EQ(cursor.line(), 3u);
    EXPECT_EQ(cursor.token(), "c");
    ASSERT_TRUE(cursor.next_line());
    EXPECT_EQ(cursor.rest(), "last");
    EXPECT_FALSE(cursor.next_line());
    EXPECT_FALSE(cursor.next_line());
}

TEST(TextCursor, ReadsQuotedNames) {
    TextCursor cursor("\" gocad Local\" plain \"\" \"open");
    cursor.next_line();
    bool quoted = false;
    EXPECT_EQ(cursor.quoted_token(&quoted), "gocad Local");
    EXPECT_TRUE(quoted);
    EXPECT_EQ(cursor.quoted_token(&quoted), "plain");
    EXPECT_FALSE(quoted);
    EXPECT_EQ(cursor.quoted_token(&quoted), "");
    EXPECT_TRUE(quoted);
    EXPECT_EQ(cursor.quoted_token(&quoted), "open");
    EXPECT_EQ(cursor.quoted_token(&quoted), "");
    EXPECT_FALSE(quoted);
}

TEST(TextCursor, ReadsNumbersAndStopsAtWhatIsNone) {
    TextCursor cursor("12 -3.5e2 7x nan");
    cursor.next_line();
    std::int64_t whole = 0;
    double value = 0;
    EXPECT_EQ(cursor.integer(whole), NumberStatus::ok);
    EXPECT_EQ(whole, 12);
    EXPECT_EQ(cursor.real(value), NumberStatus::ok);
    EXPECT_EQ(value, -350);
    EXPECT_EQ(cursor.real(value), NumberStatus::malformed);
    EXPECT_EQ(cursor.real(value), NumberStatus::ok);
    EXPECT_EQ(cursor.real(value), NumberStatus::malformed);
}

TEST(TextCursor, ContinuesInThePartOfAFile) {
    const std::string_view text = "one\ntwo\nthree\n";
    TextCursor cursor(text.substr(4), 2);
    cursor.next_line();
    EXPECT_EQ(cursor.line(), 2u);
    cursor.jump(text.data() + 8, 3);
    cursor.next_line();
    EXPECT_EQ(cursor.line(), 3u);
    EXPECT_EQ(cursor.token(), "three");
}

TEST(SameWord, IgnoresAsciiCaseOnly) {
    EXPECT_TRUE(same_word("TSurf", "tsURF"));
    EXPECT_FALSE(same_word("TSurf", "TSur"));
    EXPECT_EQ(trimmed(" \t a b \r\n"), "a b");
    EXPECT_EQ(trimmed(" \t "), "");
}

}  // namespace
}  // namespace geomend
