// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/utf8.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace geomend {
namespace {

TEST(Utf8, KnowsWellFormedText) {
    EXPECT_TRUE(is_utf8(""));
    EXPECT_TRUE(is_utf8("abc"));
    EXPECT_TRUE(is_utf8("\xc3\xa9"));          // e with acute accent
    EXPECT_TRUE(is_utf8("\xf0\x9f\x8c\x8d"));  // beyond the basic plane
    EXPECT_FALSE(is_utf8("\xe9"));             // Latin-1
    EXPECT_FALSE(is_utf8("\xc0\x80"));         // overlong
    EXPECT_FALSE(is_utf8("\xed\xa0\x80"));     // surrogate
    EXPECT_FALSE(is_utf8("\xc3"));             // cut
}

TEST(Utf8, TakesReplacementsForWhatIsNone) {
    EXPECT_EQ(valid_utf8("a\xc3\xa9 b"), "a\xc3\xa9 b");
    EXPECT_EQ(valid_utf8("\xe9t\xc3"), "\xef\xbf\xbdt\xef\xbf\xbd");
    EXPECT_TRUE(rc::check("what comes out is UTF-8", [](const std::string& bytes) {
        RC_ASSERT(is_utf8(valid_utf8(bytes)));
        if (is_utf8(bytes)) RC_ASSERT(valid_utf8(bytes) == bytes);
    }));
}

TEST(Latin1, GoesToUtf8AndBack) {
    EXPECT_TRUE(rc::check("any bytes come back", [](const std::string& bytes) {
        const std::string text = latin1_to_utf8(bytes);
        RC_ASSERT(is_utf8(text));
        RC_ASSERT(utf8_to_latin1(text) == bytes);
    }));
}

}  // namespace
}  // namespace geomend
