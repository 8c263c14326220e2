// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/info.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace geomend {
namespace {

Dataset depth_square() {
    Dataset d;
    d.format = "gocad";
    Surface s;
    s.info.name = "square";
    s.info.crs.stated = true;
    s.info.crs.z_positive = ZPositive::depth;
    s.info.crs.axis_units = {"m", "m", "m"};
    s.points = {{0, 0, -100}, {1, 0, -100}, {1, 1, -90}, {0, 1, -90}};
    s.polygons.corners = {0, 1, 2, 0, 2, 3};
    d.objects.emplace_back(s);
    return d;
}

nlohmann::json only_object(const Dataset& d) {
    const FileSummary summary[] = {summarise("a.ts", d)};
    return nlohmann::json::parse(info_json(summary))[0]["objects"][0];
}

TEST(Info, GivesBoundsInTheFilesOwnFrame) {
    const auto o = only_object(depth_square());
    EXPECT_EQ(o["z_positive"], "depth");
    EXPECT_EQ(o["bounds"], (nlohmann::json{{0, 0, 90}, {1, 1, 100}}));
    EXPECT_EQ(o["counts"]["triangles"], 2);
}

TEST(Info, GivesElevationsForFilesThatStoreThem) {
    Dataset d = depth_square();
    d.format = "vtk";
    const auto o = only_object(d);
    EXPECT_EQ(o["z_positive"], "elevation");
    EXPECT_EQ(o["bounds"][0][2], -100);
    EXPECT_NE(info_text(summarise("a.vtp", d), false).find("z is elevation"), std::string::npos) << "as the bounds are";
    d.format = "gocad";
    EXPECT_NE(info_text(summarise("a.ts", d), false).find("z is depth"), std::string::npos);
}

TEST(Info, MeasuresOnlyWhereTheUnitsOfTheAxesAgree) {
    Dataset d = depth_square();
    EXPECT_TRUE(only_object(d).contains("area"));
    info_of(d.objects[0]).crs.axis_units = {"km", "km", "m"};
    EXPECT_FALSE(only_object(d).contains("area"));
}

TEST(Info, TellsNamesThatAreNotUtf8) {
    Dataset d = depth_square();
    info_of(d.objects[0]).name = "H\xe9lice";
    EXPECT_FALSE(only_object(d)["name"].get<std::string>().empty());
}

TEST(Info, CountsCellsByDimension) {
    Dataset d;
    CellMesh m;
    m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::uint32_t nodes[] = {0, 1, 2, 3};
    m.add_cell(CellType::tetrahedron, nodes);
    m.add_cell(CellType::triangle, std::span(nodes).first(3));
    m.add_cell(CellType::quad, nodes);
    m.add_cell(CellType::line, std::span(nodes).first(2));
    d.objects.emplace_back(m);
    const auto counts = only_object(d)["counts"];
    EXPECT_EQ(counts["elements"], 4);
    EXPECT_EQ(counts["cells"], 1);
    EXPECT_EQ(counts["cell_types"], (nlohmann::json{{"tetrahedron", 1}}));
    EXPECT_EQ(counts["polygons"], 2);
    EXPECT_EQ(counts["triangles"], 1);
    EXPECT_EQ(counts["edges"], 1);
}

TEST(Info, TextCountsCellsInWords) {
    Dataset d;
    CellMesh m;
    m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    const std::uint32_t one[] = {0, 1, 2, 3}, two[] = {1, 2, 3, 4};
    m.add_cell(CellType::tetrahedron, one);
    m.add_cell(CellType::tetrahedron, two);
    d.objects.emplace_back(m);
    const std::string text = info_text(summarise("a.vtu", d), false);
    EXPECT_NE(text.find("(2 tetrahedra)"), std::string::npos) << text;
}

}  // namespace
}  // namespace geomend
