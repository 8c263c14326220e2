// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <random>

#include "horizon/horizon_test.h"
#include "support/real_data.h"

namespace geomend::test {
namespace {

constexpr std::string_view zmap_lines =
    "! RMS\n@FREE POINT        , DATA, 80, 1\nX (EASTING)        , 1, 1,  1,             1, 20,,         1.0E+30,,,       4, 0\n"
    "Y (NORTHING)       , 2, 2,  1,            21, 40,,         1.0E+30,,,       4, 0\n"
    "Z VALUE            , 3, 3,  1,            41, 60,,         1.0E+30,,,       4, 0\n"
    "SEG I.D.           , 4, 35, 1,            61, 70,,         1.0E+30,,,       0, 0\n@\n"
    "       460442.187500      5933082.500000         1696.099487         0          \n"
    "       460443.000000      5933134.500000         1695.254517         0          \n"
    "       460536.250000      5934306.500000         1634.260742         7          \n"
    "       460536.093750      5934310.500000         1634.018799         7          \n";

TEST(ZmapLines, PointsOfOneNumberAreALine) {
    const Dataset data = good("zmap-lines", zmap_lines);
    const auto& set = std::get<PolylineSet>(data.objects.at(0));
    EXPECT_EQ(set.points.size(), 4u);
    EXPECT_EQ(set.edges.size(), 2u);
    ASSERT_EQ(set.parts.size(), 2u);
    EXPECT_EQ(set.parts[1].name, "7");
    EXPECT_EQ(set.points[2], (Vec3{460536.25, 5934306.5, 1634.260742}));
}

TEST(PointsTable, ANumberOfLinesMakesLinesOfThePoints) {
    const std::string head = "X_UTME,Y_UTMN,Z_TVDSS,POLY_ID";
    const Dataset data = good("points-table", head + "\n0,0,5,a\n1,0,5,a\n1,1,5,a\n0,0,5,a\n7,7,6,b\n8,7,6,b\n");
    const auto& set = std::get<PolylineSet>(data.objects.at(0));
    EXPECT_EQ(set.points.size(), 5u);  // the first line is closed
    EXPECT_EQ(set.edges.size(), 4u);
    ASSERT_EQ(set.parts.size(), 2u);
    EXPECT_EQ(set.parts[0].name, "a");
    EXPECT_EQ(set.parts[1].name, "b");
    EXPECT_EQ(set.points[0], (Vec3{0, 0, -5}));
    EXPECT_TRUE(data.losses.empty());
    // With values beside, points keep all of them.
    const Dataset values = good("points-table", head + ",THROW\n0,0,5,a,1\n1,0,5,a,2\n");
    EXPECT_EQ(std::get<PointSet>(values.objects.at(0)).info.attributes.size(), 2u);
}

TEST(ZmapLines, WithoutNumbersOfLinesPointsStayPointsAndEachFieldHasItsNull) {
    const Dataset data = good("zmap-lines",
                              "@P, DATA, 80, 1\nX,1,1,1,1,5,,1e30\nY,2,2,1,6,10,,1e30\nZ,3,3,1,11,15,,-99\nPOR,4,60,1,16,20,,-1\n@\n"
                              "    1    2    3  0.5\n    1    2  -99  0.6\n    4    5    6   -1\n");
    const auto& set = std::get<PointSet>(data.objects.at(0));
    EXPECT_EQ(set.points.size(), 2u);  // one has no height
    ASSERT_EQ(set.info.attributes.size(), 1u);
    EXPECT_EQ(set.info.attributes[0].no_data, -1);
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].loss_class, LossClass::substance);
}

TEST(ZmapLines, WhatIsWrongIsRefusedWithItsPlace) {
    std::string text(zmap_lines);
    EXPECT_EQ(read("zmap-lines", text.substr(0, text.find("@\n"))).why().error.code, "F004");
    text.replace(text.find("5933134.5"), 4, "5x33");
    EXPECT_EQ(to_string(read("zmap-lines", text).why().error.where), "Top_A.txt:9:27");
    EXPECT_EQ(read("zmap-lines", "@A, DATA, 80, 1\nX,1,1\n@\n1\n").why().error.code, "F012");
    EXPECT_EQ(read("zmap-lines", "@A, GRID, 80, 1\n").why().error.code, "F012");
}

TEST(PointsTable, ColumnsAreCalledAsTheLineOfNamesSays) {
    const Dataset data = good(
        "points-table", "# from RMS\nX_UTME,Y_UTMN,Z_TVDSS,POLY_ID,\"net, gross\",zone\n1,2,3.5,0,0.25,\"top, upper\"\n4,5,6,1,,base\n");
    const auto& set = std::get<PointSet>(data.objects.at(0));
    EXPECT_EQ(set.points, (std::vector<Vec3>{{1, 2, -3.5}, {4, 5, -6}}));
    EXPECT_EQ(set.info.crs.z_positive, ZPositive::depth);
    ASSERT_EQ(set.info.attributes.size(), 3u);
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(set.info.attributes[0].values), (std::vector<std::int32_t>{0, 1}));
    EXPECT_EQ(set.info.attributes[1].name, "net, gross");
    EXPECT_EQ(value_as_double(set.info.attributes[1], 0), 0.25);
    EXPECT_TRUE(std::isnan(value_as_double(set.info.attributes[1], 1)));
    EXPECT_EQ(std::get<std::vector<std::string>>(set.info.attributes[2].values).at(0), "top, upper");
}

TEST(PointsTable, BlanksTabsAndSemicolonsPartColumns) {
    for (const std::string_view content :
         {"X Y Z poro\n1 2 3 0.5\n", "x\ty\tz\tporo\n1\t2\t3\t0.5\n", "Easting (m);Northing (m);Elevation;poro\n1;2;3;0.5\n"}) {
        const Dataset data = good("points-table", content);
        const auto& set = std::get<PointSet>(data.objects.at(0));
        EXPECT_EQ(set.points, (std::vector<Vec3>{{1, 2, 3}})) << content;
        EXPECT_EQ(set.info.attributes.at(0).name, "poro");
    }
}

TEST(PointsTable, WhatIsWrongIsRefusedWithItsPlace) {
    EXPECT_EQ(to_string(read("points-table", "x,y,z\n1,2\n").why().error.where), "Top_A.txt:2:1");
    EXPECT_EQ(to_string(read("points-table", "x,y,z\n1,b,3\n").why().error.where), "Top_A.txt:2:3");
    EXPECT_EQ(read("points-table", "x,y,z\n").why().error.code, "F017");
    EXPECT_EQ(read("points-table", "x,y\n1,2\n").why().error.code, "F012");
    EXPECT_EQ(read("points-table", "1,2,3\n").why().error.code, "F012");
    std::mt19937 random(3);
    const std::string whole = "I,J,X_UTME,Y_UTMN,Z_TVDSS\n1,1,0,0,5\n1,2,0,25,6\n2,1,25,0,7\n";
    for (int round = 0; round < 2000; ++round) {
        std::string bytes = whole.substr(0, round % 2 == 0 ? whole.size() : random() % whole.size());
        if (!bytes.empty()) bytes[random() % bytes.size()] = static_cast<char>(random());
        const auto data = read("points-table", bytes);
        if (!data) {
            EXPECT_FALSE(data.why().error.code.empty());
        }
    }
}

TEST(LineMaps, AreRastersWhoseMissingSamplesHaveNoHeight) {
    // Turned by the 3-4-5 triangle; inlines by twos; one sample is missing.
    const std::string rows =
        "10\t100\t1000\t2000\t-5\n10\t101\t985\t2020\t-6\n12\t100\t1020\t2015\t-7\n12 \t102\t990\t2055\t-8\n10\t102\t970\t2040\t-9\n";
    const Dataset data = good("ijxyz", rows);
    const auto& raster = std::get<Raster>(data.objects.at(0));
    EXPECT_EQ(raster.dims, (std::array<std::uint32_t, 3>{2, 3, 1}));
    const Attribute& height = raster.info.attributes.at(raster.height_attribute);
    EXPECT_EQ(value_as_double(height, 0), -5);
    EXPECT_EQ(value_as_double(height, 1), -7);
    EXPECT_TRUE(is_no_data(height, value_as_double(height, 3)));
    EXPECT_EQ(value_as_double(height, 5), -8);
    const Vec3 corner = sample_position(raster, 1, 2, 0);
    EXPECT_NEAR(corner[0], 990, 1e-9);
    EXPECT_NEAR(corner[1], 2055, 1e-9);
    const Dataset named = good("points-table", "inline,crossline,x,y,z\n1,1,0,0,5\n1,2,0,25,6\n2,1,25,0,7\n");
    EXPECT_TRUE(std::holds_alternative<Raster>(named.objects.at(0)));
}

TEST(LineMaps, WithoutALatticeAreReadAsPoints) {
    const Dataset data = good("ijxyz", "1 1 0 0 5\n1 2 0 25 6\n2 1 25 0 7\n2 2 30 25 8\n");
    EXPECT_EQ(std::get<PointSet>(data.objects.at(0)).points.size(), 4u);
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].code, "F113");
    EXPECT_EQ(good("ijxyz", "1 1 0 0 5\n1000000000 2 0 25 6\n2 1 25 0 7\n").findings.size(), 1u);  // no memory for its lattice
}

TEST(RealTables, LinesPointsAndTablesOfOneFaultModelAgree) {
    const auto zmap = real_data("maps/reek/top_upper_reek_faultpoly.zmap"), csv = real_data("maps/reek/top_upper_reek_faultpoly.csv");
    if (!zmap || !csv) GTEST_SKIP() << "no real data";
    const auto read_one = [](std::string_view row, const std::filesystem::path& path) {
        return format(row).read(*Input::open(path.string()), {});
    };
    const auto lines = read_one("zmap-lines", *zmap), points = read_one("points-table", *csv);
    ASSERT_TRUE(lines.ok() && points.ok());
    for (const auto* data : {&lines, &points}) {
        const auto& set = std::get<PolylineSet>((*data)->objects.at(0));
        EXPECT_EQ(set.parts.size(), 7u);
        EXPECT_EQ(set.points.size(), 747u);  // of 754 rows seven close a line
        EXPECT_EQ(set.edges.size(), 747u);
    }
}

}  // namespace
}  // namespace geomend::test
