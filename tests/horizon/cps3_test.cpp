// SPDX-License-Identifier: AGPL-3.0-or-later
#include "horizon/horizon_test.h"

namespace geomend::test {
namespace {

constexpr std::string_view grid =
    "FSASCI 0 1 \"COMPUTED GRID\" 0 1.0E+30 0\n"
    "FSATTR 0 0\n"
    "FSLIMI 100.0 150.0 2000.0 2040.0 11.0 23.0\n"
    "FSNROW 3 2\n"
    "FSXINC 50.0 20.0\n"
    "->Top A\n"
    "11. 12. 13.\n"
    "21. 1.000000E+30 23.\n";

void expect_grid(const Dataset& d) {
    EXPECT_EQ(raster_of(d).dims, (std::array<std::uint32_t, 3>{2, 3, 1}));
    EXPECT_EQ(place(d, 0, 0), (Vec3{100, 2000, 0}));
    EXPECT_EQ(place(d, 1, 2), (Vec3{150, 2040, 0}));
    EXPECT_EQ(height(d, 0, 2), 11) << "north-west";
    EXPECT_EQ(height(d, 0, 0), 13) << "south-west";
    EXPECT_EQ(height(d, 1, 2), 21) << "north-east";
    EXPECT_TRUE(missing(d, 1, 1));
    EXPECT_EQ(height(d, 1, 0), 23);
}

TEST(Cps3Grid, RunsSouthThenEast) {
    const Dataset d = good("cps3", grid);
    expect_grid(d);
    EXPECT_EQ(raster_of(d).info.name, "Top A");
    EXPECT_TRUE(d.findings.empty());
}

TEST(Cps3Grid, TheArrowAndTheStepsMayBeMissing) {
    std::string content(grid);
    content.erase(content.find("->Top A\n"), 8);
    content.erase(content.find("FSXINC"), 17);
    const Dataset d = good("cps3", content);
    expect_grid(d);
    EXPECT_EQ(raster_of(d).info.name, "Top_A") << "the name of the file";
}

TEST(Cps3Grid, TheLimitsWinOverStepsThatContradictThem) {
    std::string content(grid);
    content.replace(content.find("50.0 20.0"), 9, "50.0 25.0");
    const Dataset d = good("cps3", content);
    expect_grid(d);
    EXPECT_TRUE(has_finding(d, "F113"));
}

TEST(Cps3Grid, GoesOutAndComesBack) {
    const Dataset d = good("cps3", grid);
    const Written w = well_written("cps3", d);
    EXPECT_TRUE(w.losses.empty());
    const Dataset back = good("cps3", w.bytes);
    expect_grid(back);
    EXPECT_EQ(raster_of(back).info.name, "Top A");
    EXPECT_NE(w.bytes.find("FSLIMI 100 150 2000 2040 11 23\n"), std::string::npos);
}

TEST(Cps3Grid, HeaderAndCountsAreChecked) {
    std::string content(grid);
    EXPECT_EQ(read("cps3", content + "5\n").why().error.code, "F008");
    EXPECT_EQ(read("cps3", content.substr(0, content.size() - 5)).why().error.code, "F004");
    EXPECT_EQ(read("cps3", content.substr(0, 51)).why().error.code, "F004");
    content.replace(content.find("FSNROW 3 2"), 10, "FSNROW 3 -2");
    EXPECT_EQ(read("cps3", content).why().error.code, "F012");
    content.replace(content.find("FSNROW 3 -2"), 11, "FSNROW 1000000000 2");
    EXPECT_EQ(read("cps3", content).why().error.code, "F014");
    content.erase(content.find("FSNROW"), 20);
    EXPECT_EQ(read("cps3", content).why().error.code, "F012");
}

constexpr std::string_view lines =
    "FFASCI 0 1 \"LINES\" 0 1e+30\n"
    "FFATTR 0 1\n"
    "->North fault\n"
    "0 0 -10\n"
    "10 0 -11\n"
    "10 10 -12\n"
    "->2\n"
    "1 1 -1\n"
    "2 1 -1\n"
    "2 2 -1\n"
    "1 1 -1\n";

TEST(Cps3Lines, OpenAndClosedLinesGoOutAndComeBack) {
    const Dataset d = good("cps3-lines", lines);
    const auto& set = std::get<PolylineSet>(d.objects.at(0));
    ASSERT_EQ(set.parts.size(), 2);
    EXPECT_EQ(set.parts[0].name, "North fault");
    EXPECT_EQ(set.points.size(), 6) << "the point that closes a line is not repeated";
    EXPECT_EQ(set.edges.size(), 5);
    EXPECT_EQ(set.edges.back(), (std::array<std::uint32_t, 2>{5, 3}));
    EXPECT_EQ(well_written("cps3-lines", d).bytes, lines);
}

TEST(Cps3Lines, LinesWithoutPointsAreTold) {
    const Dataset d = good("cps3-lines", std::string(lines) + "->empty\n");
    EXPECT_TRUE(has_finding(d, "F119"));
    EXPECT_EQ(read("cps3-lines", "FFASCI 0 1\nFFATTR 0 1\n").why().error.code, "F004");
    EXPECT_EQ(read("cps3-lines", std::string(lines) + "1 2\n").why().error.code, "F012");
}

}  // namespace
}  // namespace geomend::test
