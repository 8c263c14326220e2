// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/number_text.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <limits>

namespace geomend {
namespace {

double real(std::string_view text) {
    double value = -12345;
    EXPECT_EQ(parse_real(text, value), NumberStatus::ok) << text;
    return value;
}

TEST(ParseReal, TakesWhatModelFilesWrite) {
    EXPECT_EQ(real("1.5"), 1.5);
    EXPECT_EQ(real("+1.5"), 1.5);
    EXPECT_EQ(real("-0"), 0.0);
    EXPECT_TRUE(std::signbit(real("-0")));
    EXPECT_EQ(real("60e3"), 60000);
    EXPECT_EQ(real("5.28845e-005"), 5.28845e-5);
    EXPECT_EQ(real(".5"), 0.5);
    EXPECT_EQ(real("5."), 5);
    EXPECT_EQ(real("1.25D+02"), 125);
    EXPECT_EQ(real("1.25d2"), 125);
}

TEST(ParseReal, KnowsTheNonFiniteSpellings) {
    EXPECT_EQ(real("inf"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(real("-inf"), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(real("1.#INF"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(real("-1.#INF"), -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(real("nan")));
    EXPECT_TRUE(std::isnan(real("NaN")));
    EXPECT_TRUE(std::isnan(real("-1.#IND")));
    EXPECT_TRUE(std::isnan(real("1.#QNAN")));
}

TEST(ParseReal, RefusesWhatIsNoNumber) {
    for (const char* text : {"", "-", "+", "+-1", "1,5", "1.5x", "x", "1e", "1 2", "0x10", "--1", "1.5.2", "d5"}) {
        double value = 0;
        EXPECT_EQ(parse_real(text, value), NumberStatus::malformed) << '"' << text << '"';
    }
}

TEST(ParseReal, TellsOverflowFromUnderflow) {
    double value = 0;
    EXPECT_EQ(parse_real("1e400", value), NumberStatus::out_of_range);
    EXPECT_EQ(parse_real("-1e99999", value), NumberStatus::out_of_range);
    EXPECT_EQ(real("1e-400"), 0.0);
    EXPECT_EQ(real("1e-99999"), 0.0);
    EXPECT_TRUE(std::signbit(real("-1e-400")));
    EXPECT_EQ(real("4.9e-324"), std::numeric_limits<double>::denorm_min());
}

TEST(ParseInteger, TakesWholeTokensOnly) {
    std::int64_t value = 0;
    EXPECT_EQ(parse_integer("+17", value), NumberStatus::ok);
    EXPECT_EQ(value, 17);
    EXPECT_EQ(parse_integer("-17", value), NumberStatus::ok);
    EXPECT_EQ(value, -17);
    EXPECT_EQ(parse_integer("3.0", value), NumberStatus::malformed);
    EXPECT_EQ(parse_integer("", value), NumberStatus::malformed);
    EXPECT_EQ(parse_integer("99999999999999999999", value), NumberStatus::out_of_range);
}

TEST(AppendNumber, GivesTheShortestTextThatReadsBack) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(400000.33333333331), "400000.3333333333");
    std::string text;
    append_number(text, 0.1f);
    EXPECT_EQ(text, "0.1");
}

TEST(AppendNumber, AndParseRealAreInverse) {
    EXPECT_TRUE(rc::check("any finite double comes back bit by bit", [](std::uint64_t bits) {
        const auto value = std::bit_cast<double>(bits);
        RC_PRE(std::isfinite(value));
        double back = 0;
        RC_ASSERT(parse_real(number_text(value), back) == NumberStatus::ok);
        RC_ASSERT(std::bit_cast<std::uint64_t>(back) == bits);
    }));
}

}  // namespace
}  // namespace geomend
