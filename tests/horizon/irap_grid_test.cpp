// SPDX-License-Identifier: AGPL-3.0-or-later
#include <bit>
#include <cmath>
#include <numbers>

#include "horizon/horizon_test.h"

namespace geomend::test {
namespace {

// Three columns, two rows; the first row is the southern one.
constexpr std::string_view plain =
    "-996 2 25.0 50.0\n"
    "1000.0 1050.0 2000.0 2050.0\n"
    "3 0.0 1000.0 2000.0\n"
    "0 0 0 0 0 0 0\n"
    "1.5 2.5 9999900.000000 4.5\n"
    "5.5 6.25\n";

std::string word(std::uint32_t v) {
    return {static_cast<char>(v >> 24), static_cast<char>(v >> 16 & 255), static_cast<char>(v >> 8 & 255), static_cast<char>(v & 255)};
}
std::string real(float v) { return word(std::bit_cast<std::uint32_t>(v)); }

std::string binary_plain() {
    std::string s = word(32) + word(static_cast<std::uint32_t>(-996)) + word(2) + real(1000) + real(1050) + real(2000) + real(2050) +
                    real(25) + real(50) + word(32);
    s += word(16) + word(3) + real(0) + real(1000) + real(2000) + word(16) + word(28) + std::string(28, '\0') + word(28);
    s += word(16) + real(1.5f) + real(2.5f) + real(1e30f) + real(4.5f) + word(16);
    s += word(8) + real(5.5f) + real(6.25f) + word(8);
    return s;
}

void expect_plain(const Dataset& d) {
    EXPECT_EQ(raster_of(d).dims, (std::array<std::uint32_t, 3>{3, 2, 1}));
    EXPECT_EQ(place(d, 0, 0), (Vec3{1000, 2000, 0}));
    EXPECT_EQ(place(d, 2, 0), (Vec3{1050, 2000, 0}));
    EXPECT_EQ(place(d, 0, 1), (Vec3{1000, 2050, 0}));
    EXPECT_EQ(height(d, 0, 0), 1.5);
    EXPECT_EQ(height(d, 1, 0), 2.5);
    EXPECT_TRUE(missing(d, 2, 0));
    EXPECT_EQ(height(d, 0, 1), 4.5);
    EXPECT_EQ(height(d, 2, 1), 6.25);
    EXPECT_FALSE(missing(d, 2, 1));
    EXPECT_EQ(raster_of(d).info.name, "Top_A");
}

TEST(IrapGrid, RunsEastThenNorth) { expect_plain(good("irap-grid", plain)); }

TEST(IrapGrid, LineBreaksDoNotMatter) {
    std::string one_line(plain);
    std::ranges::replace(one_line, '\n', ' ');
    expect_plain(good("irap-grid", one_line + "\n"));
    std::string crlf;
    for (const char c : plain) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    expect_plain(good("irap-grid", crlf));
}

TEST(IrapGrid, TurnsAnticlockwiseAroundItsFirstNode) {
    std::string turned(plain);
    turned.replace(turned.find("3 0.0"), 5, "3 30.0");
    const Dataset d = good("irap-grid", turned);
    const double c = std::sqrt(3.0) / 2, s = 0.5;
    EXPECT_NEAR(place(d, 2, 0)[0], 1000 + 50 * c, 1e-9);
    EXPECT_NEAR(place(d, 2, 0)[1], 2000 + 50 * s, 1e-9);
    EXPECT_NEAR(place(d, 0, 1)[0], 1000 - 50 * s, 1e-9);
    EXPECT_NEAR(place(d, 0, 1)[1], 2000 + 50 * c, 1e-9);
}

TEST(IrapGrid, AQuarterTurnIsExact) {
    std::string turned(plain);
    turned.replace(turned.find("3 0.0"), 5, "3 90.0");
    const Dataset d = good("irap-grid", turned);
    EXPECT_EQ(place(d, 2, 1), (Vec3{950, 2050, 0}));
    turned.replace(turned.find("3 90.0"), 6, "3 -90.");
    EXPECT_EQ(place(good("irap-grid", turned), 2, 1), (Vec3{1050, 1950, 0}));
}

TEST(IrapGrid, DepthsAreNegatedButMissingValuesAreNot) {
    const Dataset d = good("irap-grid", plain, {{"z", "depth"}});
    EXPECT_EQ(height(d, 0, 0), -1.5);
    EXPECT_TRUE(missing(d, 2, 0));
    EXPECT_EQ(height(d, 2, 0), 9999900.0);
    EXPECT_EQ(raster_of(d).info.crs.z_positive, ZPositive::depth);
    const Dataset back = good("irap-grid", well_written("irap-grid", d).bytes);
    EXPECT_EQ(height(back, 0, 0), 1.5) << "written in the sign of its source";
}

TEST(IrapGrid, AnotherWordForTheSignIsAUsageError) {
    const auto d = read("irap-grid", plain, {{"z", "sideways"}});
    ASSERT_FALSE(d);
    EXPECT_EQ(d.why().kind, FailureKind::usage);
}

TEST(IrapGrid, GoesOutAndComesBackBitByBit) {
    for (const char* rotation : {"0.0", "30.0", "-70.000008", "123.456789", "270"}) {
        std::string content(plain);
        content.replace(content.find("3 0.0"), 5, std::string("3 ") + rotation);
        content.replace(content.find("25.0"), 4, "33.333333333");
        content.replace(content.find("1.5 2.5"), 7, "-1234.567890123 0.1");
        const Dataset d = good("irap-grid", content);
        const Written w = well_written("irap-grid", d);
        EXPECT_EQ(substance(w.losses), 0) << rotation;
        const Dataset back = good("irap-grid", w.bytes);
        EXPECT_EQ(raster_of(back).origin, raster_of(d).origin) << rotation;
        EXPECT_EQ(raster_of(back).step, raster_of(d).step) << rotation;
        EXPECT_EQ(raster_of(back).info.attributes[0].values, raster_of(d).info.attributes[0].values) << rotation;
    }
}

TEST(IrapGrid, ContradictoryLimitsAreTold) {
    std::string content(plain);
    content.replace(content.find("1050.0"), 6, "1500.0");
    EXPECT_TRUE(has_finding(good("irap-grid", content), "F113"));
    EXPECT_FALSE(has_finding(good("irap-grid", plain), "F113"));
}

TEST(IrapGrid, CountsMustMatch) {
    EXPECT_EQ(read("irap-grid", std::string(plain) + "7.5\n").why().error.code, "F008");
    const auto few = read("irap-grid", plain.substr(0, plain.size() - 6));
    ASSERT_FALSE(few);
    EXPECT_EQ(few.why().error.code, "F004");
    EXPECT_NE(few.why().error.message.find("expected 6 numbers"), std::string::npos) << few.why().error.message;
}

TEST(IrapGrid, WrongNumbersAreToldWithTheirPlace) {
    std::string content(plain);
    content.replace(content.find("4.5"), 3, "4.x");
    const auto bad = read("irap-grid", content);
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.why().error.code, "F005");
    EXPECT_EQ(bad.why().error.where.line, 5);
    EXPECT_EQ(bad.why().error.where.column, 24);
    content.replace(content.find("4.x"), 3, "nan");
    EXPECT_EQ(read("irap-grid", content).why().error.code, "F006");
}

TEST(IrapBinary, IsReadInEitherByteOrder) {
    const std::string big = binary_plain();
    expect_plain(good("irap-grid-binary", big));
    std::string little;
    for (std::size_t i = 0; i < big.size(); i += 4) little += {big[i + 3], big[i + 2], big[i + 1], big[i]};
    expect_plain(good("irap-grid-binary", little));
}

TEST(IrapBinary, GoesOutAsItCameIn) {
    const Dataset d = good("irap-grid-binary", binary_plain());
    const Written w = well_written("irap-grid-binary", d);
    EXPECT_EQ(substance(w.losses), 0);
    // Only the cut into records differs: one record for all heights.
    std::string expected = binary_plain().substr(0, 100) + word(24);
    for (const float v : {1.5f, 2.5f, 1e30f, 4.5f, 5.5f, 6.25f}) expected += real(v);
    EXPECT_EQ(w.bytes, expected + word(24));
    expect_plain(good("irap-grid-binary", w.bytes));
}

TEST(IrapBinary, LargeGridsTakeSeveralRecords) {
    std::vector<double> heights(101 * 99);
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<double>(i) / 4;
    const Dataset d = grid_dataset({101, 99}, {0, 0, 0}, {{{25, 0, 0}, {0, 25, 0}}}, heights);
    const Dataset back = good("irap-grid-binary", well_written("irap-grid-binary", d).bytes);
    EXPECT_EQ(height(back, 100, 98), heights.back());
    EXPECT_EQ(height(back, 3, 41), heights[41 * 101 + 3]);
}

TEST(IrapBinary, WhatSinglePrecisionDoesNotHoldIsALossOfSubstance) {
    const Dataset d = grid_dataset({2, 1}, {4500000.3, 6800000.7, 0}, {{{25, 0, 0}, {0, 25, 0}}}, {-1234.56789, 2});
    const Written w = well_written("irap-grid-binary", d);
    EXPECT_TRUE(has_loss(w.losses, LossClass::substance, "places of the nodes"));
    EXPECT_TRUE(has_loss(w.losses, LossClass::substance, "digits of heights"));
    EXPECT_EQ(substance(well_written("irap-grid", d).losses), 0);
}

TEST(IrapBinary, DamagedRecordsAreTold) {
    const std::string whole = binary_plain();
    for (const std::size_t size : {5, 60, 100, 102, 110, 130, 139}) {
        const auto cut = read("irap-grid-binary", whole.substr(0, size));
        ASSERT_FALSE(cut) << size;
        // Where the header is whole, it asks for more than what is left.
        EXPECT_TRUE(cut.why().error.code == "F004" || cut.why().error.code == "F014") << size << cut.why().error.code;
    }
    EXPECT_EQ(read("irap-grid-binary", whole + "abcd").why().error.code, "F008");
    std::string wrong = whole;
    wrong[100 + 3] = 20;  // a record that claims one height more
    EXPECT_FALSE(read("irap-grid-binary", wrong));
    wrong = whole;
    wrong[8 + 0] = 0x7f;  // 2^31 rows
    EXPECT_EQ(read("irap-grid-binary", wrong).why().error.code, "F014");
}

}  // namespace
}  // namespace geomend::test
