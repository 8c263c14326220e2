// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/wording.h"

#include <gtest/gtest.h>

namespace geomend {
namespace {

TEST(Wording, CountsAndRounds) {
    EXPECT_EQ(counted(0, "cell", "cells"), "0 cells");
    EXPECT_EQ(counted(1, "cell has", "cells have"), "1 cell has");
    EXPECT_EQ(counted(18446744073709551615u, "cell", "cells"), "18446744073709551615 cells");
    EXPECT_EQ(rounded(0.123456), "0.1235");
    EXPECT_EQ(rounded(-1e300), "-1e+300");
    EXPECT_EQ(short_number(1234567.0), "1.23457e+06");
}

TEST(Wording, QuotesNamesAsTheyAreAndWordsOfFilesWithCare) {
    EXPECT_EQ(quoted("Gr\xc3\xa4"
                     "ben"),
              "'Gr\xc3\xa4"
              "ben'");
    EXPECT_EQ(quoted_start("VRTX"), "'VRTX'");
    EXPECT_EQ(quoted_start(std::string("a\0\n\x7f\xff", 5)), "'a" + std::string(4, '?') + "'");
    EXPECT_EQ(quoted_start(std::string(40, 'x')), "'" + std::string(40, 'x') + "'");
    EXPECT_EQ(quoted_start(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace geomend
