// SPDX-License-Identifier: AGPL-3.0-or-later
#include "horizon/horizon_test.h"

namespace geomend::test {
namespace {

// Three rows, two columns: the first column is the western one, each runs from north to south.
constexpr std::string_view header =
    "! made by hand\n"
    "!\n"
    "@Top_A HEADER, GRID, 2\n"
    "10, -99999.0, , 4, 1\n"
    "3, 2, 100.0, 150.0, 2000.0, 2040.0\n"
    "0.0, 0.0, 0.0\n"
    "@\n";
constexpr std::string_view apart = "      11.0      12.0\n      13.0\n      21.0-99999.000\n      23.0\n";

void expect_grid(const Dataset& d) {
    EXPECT_EQ(raster_of(d).dims, (std::array<std::uint32_t, 3>{2, 3, 1}));
    EXPECT_EQ(place(d, 0, 0), (Vec3{100, 2000, 0}));
    EXPECT_EQ(place(d, 1, 2), (Vec3{150, 2040, 0})) << "limits are those of the nodes";
    EXPECT_EQ(height(d, 0, 2), 11) << "north-west";
    EXPECT_EQ(height(d, 0, 1), 12);
    EXPECT_EQ(height(d, 0, 0), 13) << "south-west";
    EXPECT_EQ(height(d, 1, 2), 21) << "north-east";
    EXPECT_TRUE(missing(d, 1, 1));
    EXPECT_EQ(height(d, 1, 0), 23);
}

TEST(Zmap, RunsSouthThenEast) {
    const Dataset d = good("zmap", std::string(header) + std::string(apart));
    expect_grid(d);
    EXPECT_EQ(raster_of(d).info.name, "Top_A");
}

TEST(Zmap, FieldsNeedNoBlanksBetweenThem) {
    expect_grid(good("zmap", std::string(header) + "11.000000012.0000000\n13.0000000\n21.0000000-99999.000\n23.0000000\n"));
}

TEST(Zmap, FieldsOfAnotherWidthAreSplitAtBlanks) { expect_grid(good("zmap", std::string(header) + "11. 12.\n13.\n21. -99999.0\n23.\n")); }

TEST(Zmap, AColumnMayGoOnInALineOfTheNextOne) {
    expect_grid(good("zmap", std::string(header) + "      11.0      12.0\n      13.0      21.0\n-99999.000      23.0\n"));
}

TEST(Zmap, ImpliedDecimalsApplyWhenNoHeightHasAPoint) {
    const Dataset d = good("zmap", std::string(header) + "    110000    120000\n    130000\n    210000    -99999\n    230000\n");
    expect_grid(d);
    EXPECT_TRUE(has_finding(d, "F113"));
    const Dataset mixed = good("zmap", std::string(header) + "      11.0        12\n        13\n        21    -99999\n        23\n");
    expect_grid(mixed);
    EXPECT_FALSE(has_finding(mixed, "F113"));
}

TEST(Zmap, ALineOfRmsBetweenHeaderAndHeightsIsPassedOver) {
    const std::string whole(header);
    expect_grid(good("zmap", whole.substr(0, whole.size() - 2) + "+ Grid data starts after this line\n@\n" + std::string(apart)));
    expect_grid(good("zmap", whole + "+\n" + std::string(apart)));
    expect_grid(good("zmap", whole + "+11. 12.\n13.\n21. -99999.0\n23.\n"));
    EXPECT_FALSE(read("zmap", whole + "11. 12.\n+ remark\n13.\n21. -99999.0\n23.\n").ok());
}

TEST(Zmap, ANullTextStandsForMissing) {
    std::string content = std::string(header) + std::string(apart);
    content.replace(content.find("-99999.0, "), 10, " , VOID");
    content.replace(content.find("-99999.000"), 10, "      VOID");
    expect_grid(good("zmap", content));
}

TEST(Zmap, TrailingCommasInTheHeaderAreHarmless) {
    std::string content = std::string(header) + std::string(apart);
    content.replace(content.find("GRID, 2\n"), 8, "GRID, 2,\n");
    content.replace(content.find("2040.0\n"), 7, "2040.0,\n");
    expect_grid(good("zmap", content));
}

TEST(Zmap, OtherKindsOfFileAreToldApart) {
    std::string content = std::string(header) + std::string(apart);
    content.replace(content.find("GRID"), 4, "DATA");
    EXPECT_EQ(read("zmap", content).why().error.code, "F013");
}

TEST(Zmap, CountsAndHeaderAreChecked) {
    const std::string head(header);
    EXPECT_EQ(read("zmap", head + "      11.0\n").why().error.code, "F004");
    EXPECT_EQ(read("zmap", head + std::string(apart) + "      99.0\n").why().error.code, "F008");
    EXPECT_EQ(read("zmap", head.substr(0, head.size() / 2)).why().error.code, "F004");
    std::string many = head + std::string(apart);
    many.replace(many.find("3, 2"), 4, "2000000000, 2000000000");
    EXPECT_EQ(read("zmap", many).why().error.code, "F014");
    std::string letters = head + std::string(apart);
    letters.replace(letters.find("12.0"), 4, "1Z.0");
    const auto bad = read("zmap", letters);
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.why().error.code, "F005");
    EXPECT_EQ(bad.why().error.where.line, 8);
}

TEST(Zmap, WritesFixedFieldsWithAllDigitsAndAPoint) {
    const Dataset d = grid_dataset({2, 3}, {100, 2000, 0}, {{{50, 0, 0}, {0, 20, 0}}}, {13, 23, 12, 1e30, 11, -1234.567890123456});
    const Written w = well_written("zmap", d);
    EXPECT_EQ(w.bytes,
              "@Top_A HEADER, GRID, 5\n"
              "19, 1.0e+30, , 7, 1\n"
              "3, 2, 100, 150, 2000, 2040\n"
              "0.0, 0.0, 0.0\n"
              "@\n"
              "               11.0               12.0               13.0\n"
              " -1234.567890123456            1.0e+30               23.0\n");
    EXPECT_EQ(substance(w.losses), 0);
}

TEST(Zmap, GoesOutAndComesBackBitByBit) {
    std::string content = std::string(header) + std::string(apart);
    content.replace(content.find("150.0"), 5, "133.333333333333");
    content.replace(content.find("2000.0"), 6, "6781234.1");
    content.replace(content.find("2040.0"), 6, "6781266.7");
    const Dataset d = good("zmap", content);
    const Written w = well_written("zmap", d);
    EXPECT_TRUE(w.losses.empty());
    const Dataset back = good("zmap", w.bytes);
    EXPECT_EQ(raster_of(back).step, raster_of(d).step);
    EXPECT_EQ(raster_of(back).origin, raster_of(d).origin);
    EXPECT_EQ(raster_of(back).info.attributes[0].values, raster_of(d).info.attributes[0].values);
    EXPECT_EQ(w.bytes.substr(0, 15), "! made by hand\n") << "comments go back";
}

}  // namespace
}  // namespace geomend::test
