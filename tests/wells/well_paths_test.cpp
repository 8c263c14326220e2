// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include "wells/well_files.h"

namespace geomend::test {
namespace {

constexpr std::string_view petrel =
    "# WELL TRACE FROM PETREL\n# WELL NAME:              A 1\n# WELL HEAD X-COORDINATE: 686352.08000000 (m)\n"
    "# WELL HEAD Y-COORDINATE: 3217437.84000000 (m)\n# WELL DATUM (KB, Kelly bushing, from MSL): 23.00000000 (m)\n"
    "# WELL TYPE:              UNKNOWN\n#=====================\n"
    "      MD            X            Y            Z           TVD           AZIM         INCL\n#=====================\n"
    " 0.0000000000 686352.08000 3217437.8400 23.000000000 0.0 0.0 0.0\n 100.00000000 686353.08000 3217437.8400 -77.000000000 100.0 90.0 "
    "0.5\n";

TEST(WellPaths, AnExportOfPetrel) {
    const Dataset data = good_wells("well-path", std::string(petrel));
    ASSERT_EQ(data.objects.size(), 1u);
    const Well& well = well_at(data, 0);
    EXPECT_EQ(well.info.name, "A 1");
    EXPECT_EQ(well.head, (Vec3{686352.08, 3217437.84, 0}));
    EXPECT_EQ(well.kelly_bushing, 23);
    EXPECT_EQ(well.path.at(1), (Vec3{686353.08, 3217437.84, -77}));
    EXPECT_EQ(well.measured_depth, (std::vector<double>{0, 100}));
    EXPECT_EQ(well.info.crs.z_positive, ZPositive::elevation);
    ASSERT_EQ(well.curves.size(), 2u);  // the depth below the bushing follows from Z
    EXPECT_EQ(well.curves[1].values.name, "INCL");
}

TEST(WellPaths, ATableOfSeveralWellsByTheNamesOfItsColumns) {
    const Dataset data =
        good_wells("well-path", "Well;MD [m];Easting (m);Northing (m);TVDSS;GR\nA;0;1;2;-20;\nA;10;1;2;-10;55\n\"B 2\";0;5;6;0;-999.25\n");
    ASSERT_EQ(data.objects.size(), 2u);
    const Well &a = well_at(data, 0), &b = well_at(data, 1);
    EXPECT_EQ(a.info.name, "A");
    EXPECT_EQ(a.path, (std::vector<Vec3>{{1, 2, 20}, {1, 2, 10}}));
    EXPECT_EQ(a.info.crs.z_positive, ZPositive::depth);
    EXPECT_TRUE(std::isnan(value_as_double(a.curves.at(0).values, 0)));
    EXPECT_EQ(value_as_double(a.curves.at(0).values, 1), 55);
    EXPECT_EQ(b.info.name, "B 2");
    EXPECT_TRUE(is_no_data(b.curves.at(0).values, -999.25));
}

TEST(WellPaths, ACommaInQuotesPartsNoColumns) {
    const Dataset data = good_wells("well-path", "Well,MD,X,Y,Z\n\"A, north\",0,1,2,3\n\"A, north\",10,1,2,-7\n'B',0,5,6,7\n");
    ASSERT_EQ(data.objects.size(), 2u);
    EXPECT_EQ(well_at(data, 0).info.name, "A, north");
    EXPECT_EQ(well_at(data, 0).path.size(), 2u);
    EXPECT_EQ(well_at(data, 1).info.name, "B");
}

TEST(WellPaths, AColumnOfNamesIsNoNameOfAWell) {
    const Dataset data = good_wells("well-path", "Name X Y Z MD\nA 1 2 3 0\nA 1 2 -7 10\n");
    ASSERT_EQ(data.objects.size(), 1u);
    EXPECT_EQ(well_at(data, 0).path.size(), 2u);
}

TEST(WellPaths, FilesOfResInsightNameWellsAndNoColumns) {
    const Dataset data =
        good_wells("well-path", "WELLNAME: 'B-H'\n# X Y TVDMSL MDMSL\n10 20 0 0\n10 20 30 31\n-999\nWELLNAME: C\n1 2 3 4\n");
    ASSERT_EQ(data.objects.size(), 2u);
    EXPECT_EQ(well_at(data, 0).info.name, "B-H");
    EXPECT_EQ(well_at(data, 0).path, (std::vector<Vec3>{{10, 20, -0.0}, {10, 20, -30}}));
    EXPECT_EQ(well_at(data, 0).measured_depth, (std::vector<double>{0, 31}));
    EXPECT_EQ(well_at(data, 1).info.name, "C");
}

TEST(WellPaths, DepthsBelowTheBushingBecomeElevations) {
    const Dataset data = good_wells("well-path", "# WELL DATUM (KB, Kelly bushing, from MSL): 25 (m)\nMD X Y TVD\n0 1 2 0\n100 1 2 100\n");
    EXPECT_EQ(well_at(data, 0).path, (std::vector<Vec3>{{1, 2, 25}, {1, 2, -75}}));
    EXPECT_EQ(well_at(data, 0).info.name, "a");
}

TEST(WellPaths, TheBushingIsInACommentOrAColumn) {
    for (const char* text : {"# WELL KB: 25.0 (m)\nMD X Y TVD\n0 1 2 0\n100 1 2 100\n", "MD X Y TVD KB\n0 1 2 0 25\n100 1 2 100 25\n"}) {
        const Dataset data = good_wells("well-path", text);
        EXPECT_EQ(well_at(data, 0).path, (std::vector<Vec3>{{1, 2, 25}, {1, 2, -75}})) << text;
        EXPECT_EQ(well_at(data, 0).kelly_bushing, 25);
        EXPECT_TRUE(data.findings.empty());
    }
    const Dataset unknown = good_wells("well-path", "MD X Y TVD\n0 1 2 0\n100 1 2 100\n");
    ASSERT_EQ(unknown.findings.size(), 1u) << "depths below a bushing of unknown height were taken as depths below the sea";
    EXPECT_EQ(unknown.findings[0].code, "F113");
    EXPECT_EQ(unknown.findings[0].where.line, 2u);
}

TEST(WellPaths, RowsOfWellsMayTakeTurns) {
    const Dataset data = good_wells("well-path", "WELL MD X Y TVDSS GR\nA 0 1 2 0 5\nB 0 7 8 0 6\nA 10 1 2 10 7\nB 10 7 8 10 8\n");
    ASSERT_EQ(data.objects.size(), 2u);
    EXPECT_EQ(well_at(data, 0).path, (std::vector<Vec3>{{1, 2, 0}, {1, 2, -10}}));
    EXPECT_EQ(well_at(data, 1).path, (std::vector<Vec3>{{7, 8, 0}, {7, 8, -10}}));
    EXPECT_EQ(value_as_double(well_at(data, 1).curves.at(0).values, 1), 8);
    const Dataset again = good_wells("well-path", "WELL MD X Y TVDSS\nA 0 1 2 0\nA 9 1 2 9\nB 0 7 8 0\nA 0 5 2 0\nA 9 5 2 9\n");
    ASSERT_EQ(again.objects.size(), 3u) << "a second well of one name is none that goes on";
    EXPECT_EQ(well_at(again, 2).path.size(), 2u);
}

TEST(WellPaths, ANameBeforeItsRowsBelongsToThem) {
    const Dataset data = good_wells("well-path", "# WELL NAME: A\nMD X Y Z\n0 1 2 3\n9 1 2 -6\n# WELL NAME: B\n0 4 5 6\n9 4 5 -3\n");
    ASSERT_EQ(data.objects.size(), 2u);
    EXPECT_EQ(well_at(data, 0).info.name, "A");
    EXPECT_EQ(well_at(data, 1).info.name, "B");
}

TEST(WellPaths, RowsWithoutAPositionAreLost) {
    const Dataset data =
        good_wells("well-path", "MD X Y TVDSS\n0 1 2 0\n10 -999 2 10\n20 1 -999.25 20\n30 1 2 -999\n40 1 2 -999.25\n50 1 2 50\n");
    EXPECT_EQ(well_at(data, 0).path, (std::vector<Vec3>{{1, 2, 0}, {1, 2, -50}}));
    EXPECT_EQ(well_at(data, 0).measured_depth, (std::vector<double>{0, 50}));
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].count, 4u);
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].where.line, 3u);
    const Dataset deep = good_wells("well-path", "MD X Y Z\n0 1 2 1\n1000 1 2 -999\n");
    EXPECT_EQ(well_at(deep, 0).path.size(), 2u) << "an elevation may be -999";
    EXPECT_TRUE(deep.losses.empty());
}

TEST(WellPaths, ZThatEqualsTheDepthBesideItIsADepth) {
    for (const char* name : {"TVDSS", "TVD"}) {
        const Dataset data = good_wells("well-path", std::string("MD X Y Z ") + name + "\n0 1 2 10 10\n100 1 2 110 110\n");
        EXPECT_EQ(well_at(data, 0).path, (std::vector<Vec3>{{1, 2, -10}, {1, 2, -110}})) << name;
        EXPECT_EQ(well_at(data, 0).info.crs.z_positive, ZPositive::depth);
        ASSERT_EQ(data.findings.size(), 1u) << name;
        EXPECT_EQ(data.findings[0].code, "F113");
    }
    const Dataset sound = good_wells("well-path", "MD X Y Z TVDSS TVD\n0 1 2 25 -25 0\n100 1 2 -75 75 100\n");
    EXPECT_EQ(well_at(sound, 0).path.at(1), (Vec3{1, 2, -75}));
    EXPECT_TRUE(sound.findings.empty());
}

TEST(WellPaths, ZThatContradictsTheDepthBesideItIsReported) {
    const Dataset data = good_wells("well-path", "MD X Y Z TVDSS\n0 1 2 25 -25\n100 1 2 -75 85\n");
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].code, "F113");
    EXPECT_EQ(data.findings[0].where.line, 3u);
    EXPECT_EQ(well_at(data, 0).path.at(1), (Vec3{1, 2, -75}));
}

TEST(WellPaths, WhatIsWrongIsRefusedWithItsPlace) {
    EXPECT_EQ(refused_well("well-path", "MD INCL AZIM\n0 0 0\n"), "F013 a.w:1");
    EXPECT_EQ(refused_well("well-path", "MD X Y Z\n0 0 0\n"), "F012 a.w:2:1");
    EXPECT_EQ(refused_well("well-path", "MD X Y Z\n0 0 0 a\n"), "F005 a.w:2:7");
    EXPECT_EQ(refused_well("well-path", "MD X Y Z\n"), "F017 a.w:1");
    for (std::size_t size = 0; size < petrel.size(); ++size) {
        const auto data = read_wells("well-path", std::string(petrel.substr(0, size)));
        EXPECT_TRUE(data.ok() || !data.why().error.code.empty());
    }
}

TEST(WellPaths, AreToldFromOtherTables) {
    const auto sniffed = [](std::string_view text) { return well_format("well-path").sniff(text, "a.txt"); };
    EXPECT_GT(sniffed(petrel), 90);
    EXPECT_GT(sniffed("MD X Y Z\n0 0 0 0\n"), 0);
    EXPECT_GT(sniffed("WELLNAME: A\n0 0 0 0\n"), 0);
    EXPECT_EQ(sniffed("X Y Z\n0 0 0\n"), 0);
    EXPECT_EQ(sniffed("1 2 3\n"), 0);
    EXPECT_EQ(well_format("rms-wells").sniff("1.0\nUndefined\nA 1 2\n0\n", "a.txt"), 90);
    EXPECT_EQ(well_format("rms-wells").sniff("1 2 3\n4 5 6\n", "a.txt"), 0);
}

}  // namespace
}  // namespace geomend::test
