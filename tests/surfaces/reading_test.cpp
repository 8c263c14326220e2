// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cstring>
#include <limits>

#include "surfaces/surface_files.h"

namespace geomend::test {
namespace {

bool has_code(const Dataset& data, std::string_view code) {
    return std::ranges::any_of(data.findings, [&](const Finding& f) { return f.code == code; });
}

std::string solid(const std::string& name, const std::string& facets) {
    return "solid " + name + "\n" + facets + "endsolid " + name + "\n";
}
const std::string up = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
const std::string beside = "facet normal 0 0 1\nouter loop\nvertex 1 0 -0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n";

TEST(Stl, SolidsAreSurfacesWhoseEqualPositionsAreOnePoint) {
    const Dataset data = good_surface("stl", solid("upper bed", up + beside) + solid("", up));
    ASSERT_EQ(data.objects.size(), 2u);
    EXPECT_EQ(surface_at(data, 0).info.name, "upper bed");
    EXPECT_EQ(surface_at(data, 1).info.name, "top");
    EXPECT_EQ(surface_at(data, 0).points.size(), 4u);
    EXPECT_EQ(surface_at(data, 0).polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    EXPECT_TRUE(data.findings.empty());
}

TEST(Stl, NormalsAgainstTheOrderOfCornersAreReported) {
    std::string text = solid("a", up);
    text.replace(text.find("0 0 1"), 5, "0 0 -1");
    const Dataset data = good_surface("stl", text);
    EXPECT_TRUE(has_code(data, "F113"));
    EXPECT_EQ(surface_at(data, 0).polygons.corners, (std::vector<std::uint32_t>{0, 1, 2}));
    text.replace(text.find("0 0 -1"), 6, "nan 0 0");
    EXPECT_TRUE(good_surface("stl", text).findings.empty()) << "a normal that is none says nothing";
}

std::string binary_stl(const std::vector<std::array<float, 12>>& facets, std::uint16_t mark = 0) {
    std::string bytes = "solid is what some programs write here";
    bytes.resize(80, ' ');
    const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    append(static_cast<std::uint32_t>(facets.size()));
    for (const auto& facet : facets) {
        append(facet);
        append(mark);
    }
    return bytes;
}

TEST(Stl, BinaryFilesAreToldByTheirSize) {
    const std::array<float, 12> facet{0, 0, 1, 0, 0, 0, 0.1f, 0, 0, 0, 1, 0};
    const Dataset data = good_surface("stl", binary_stl({facet}, 5));
    EXPECT_EQ(data.variant, "STL, binary");
    EXPECT_EQ(surface_at(data, 0).points[1][0], static_cast<double>(0.1f));
    EXPECT_EQ(surface_at(data, 0).info.precision, CoordinatePrecision::single_precision);
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].loss_class, LossClass::style);
    std::string bytes = binary_stl({facet, facet});
    bytes.pop_back();
    EXPECT_EQ(refused("stl", bytes).substr(0, 4), "F004") << "a text that begins with solid";
    bytes[0] = 'S';
    bytes[1] = '\0';
    EXPECT_EQ(refused("stl", bytes).substr(0, 4), "F008");
    const float none = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(refused("stl", binary_stl({{0, 0, 1, none, 0, 0, 1, 0, 0, 0, 1, 0}})), "F006 top.stl");
}

TEST(Stl, BytesBehindTheTrianglesOfABinaryFileAreTold) {
    const std::array<float, 12> facet{0, 0, 1, 0, 0, 0, 0.1f, 0, 0, 0, 1, 0};
    for (const std::size_t more : {2u, 60u}) {
        const Dataset data = good_surface("stl", binary_stl({facet, facet}) + std::string(more, '\0'));
        EXPECT_EQ(data.variant, "STL, binary");
        EXPECT_EQ(surface_at(data, 0).polygons.size(), 2u);
        ASSERT_EQ(data.losses.size(), 1u);
        EXPECT_EQ(data.losses[0].loss_class, more < 50 ? LossClass::identity : LossClass::substance) << "room for a triangle";
        ASSERT_EQ(data.findings.size(), 1u);
        EXPECT_NE(data.findings[0].message.find(std::to_string(more) + " bytes"), std::string::npos) << data.findings[0].message;
    }
    std::string bytes = binary_stl({facet}) + std::string(500, 'x');
    bytes[0] = 'S';
    bytes[1] = '\0';
    EXPECT_EQ(refused("stl", bytes).substr(0, 4), "F008") << "most of it is no triangle";
}

TEST(Stl, DamageIsToldWithItsPlace) {
    EXPECT_EQ(refused("stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n"), "F005 top.stl:4:12");
    EXPECT_EQ(refused("stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e999\n"), "F006 top.stl:4:12");
    EXPECT_EQ(refused("stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"), "F012 top.stl:6:1");
    EXPECT_EQ(refused("stl", "solid a\n" + up.substr(0, up.size() - 9)).substr(0, 4), "F004");
    EXPECT_TRUE(has_code(good_surface("stl", "solid a\n" + up), "F101")) << "whole facets without endsolid";
}

TEST(Obj, NamesMakeSurfacesAndNumbersMayCountBackwards) {
    const Dataset data =
        good_surface("obj",
                     "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\no top\nf 1/1 2/1 3/1 4/1\ng fault a\nv 0 0 -1\nf -1 -5 2\n"
                     "o top\nf 1 3 4\nl 1 2 3\n");
    ASSERT_EQ(data.objects.size(), 3u);
    const Surface& top = surface_at(data, 0);
    EXPECT_EQ(top.info.name, "top");
    ASSERT_EQ(top.polygons.size(), 2u);
    EXPECT_EQ(top.polygons[0].size(), 4u);
    const auto& lines = std::get<PolylineSet>(data.objects[1]);
    EXPECT_EQ(lines.info.name, "top");
    EXPECT_EQ(lines.edges.size(), 2u);
    const Surface& fault = surface_at(data, 2);
    EXPECT_EQ(fault.info.name, "fault a");
    ASSERT_EQ(fault.polygons.size(), 1u);
    std::vector<Vec3> corners;
    for (const std::uint32_t c : fault.polygons[0]) corners.push_back(fault.points[c]);
    EXPECT_EQ(corners, (std::vector<Vec3>{{0, 0, -1}, {0, 0, 0}, {1, 0, 0}}));
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].loss_class, LossClass::style);
}

TEST(Obj, ABackslashAtTheEndOfALineCarriesARecordOn) {
    const Dataset data =
        good_surface("obj", "v 0 0 \\\n0\nv 1 0 0\\\r\n 1 1 1\nv 1 1 0\nv 0 1 0\nvn 0 \\\n 0 1\nf 1 2 \\\n\\\n3\\\n 4\nl 1 \\\n 2 3\n");
    ASSERT_EQ(data.objects.size(), 2u);
    EXPECT_TRUE(data.findings.empty());
    const Surface& top = surface_at(data, 0);
    ASSERT_EQ(top.points.size(), 4u);
    ASSERT_EQ(top.polygons.size(), 1u);
    EXPECT_EQ(top.polygons[0].size(), 4u);
    EXPECT_EQ(std::get<PolylineSet>(data.objects[1]).edges.size(), 2u);
    EXPECT_EQ(refused("obj", "v 0 0 0\nv 1 0 0\nf 1 \\\n 2 3\n"), "F007 top.obj:4:4");
    EXPECT_EQ(refused("obj", "v 0 0 0\nv 1 0 0\nf 1 \\\n 2 \\\n"), "F012 top.obj:3:1");
    EXPECT_EQ(refused("obj", "v 0 0 0\nv 1 0 0\nf 1 \\ 2\n"), "F005 top.obj:3:5") << "within a line it means nothing";
}

TEST(Obj, DamageIsToldWithItsPlace) {
    EXPECT_EQ(refused("obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n"), "F007 top.obj:3:7");
    EXPECT_EQ(refused("obj", "v 0 0 0\nv 1 0 0\nf 1 2 0\n"), "F007 top.obj:3:7");
    EXPECT_EQ(refused("obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), "F012 top.obj:3:1");
    EXPECT_EQ(refused("obj", "v 0 0\n"), "F005 top.obj:1:6");
    EXPECT_EQ(refused("obj", "v 0 0 nan\n"), "F006 top.obj:1:7");
    EXPECT_EQ(refused("obj", "# nothing\n"), "F017 top.obj");
    const Dataset curves = good_surface("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ncstype bezier\ncurv 0 1 1 2\n");
    EXPECT_EQ(std::ranges::count(curves.losses, LossClass::substance, &Loss::loss_class), 2);
    EXPECT_TRUE(has_code(curves, "F150"));
}

const std::string ply_head =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\nproperty short code\n"
    "element face 1\nproperty list uchar int vertex_indices\nproperty float throw\nend_header\n";

TEST(Ply, NumbersAtPointsAndPolygonsAreAttributesOfTheirType) {
    const Dataset data = good_surface("ply", ply_head + "0 0 0 1\n1 0 0 -2\n0 1 0 3\n3 0 1 2 0.5\n");
    const Surface& surface = surface_at(data, 0);
    ASSERT_EQ(surface.info.attributes.size(), 2u);
    EXPECT_EQ(std::get<std::vector<std::int16_t>>(surface.info.attributes[0].values), (std::vector<std::int16_t>{1, -2, 3}));
    EXPECT_EQ(surface.info.attributes[1].location, AttributeLocation::polygon);
    EXPECT_EQ(std::get<std::vector<float>>(surface.info.attributes[1].values), std::vector<float>{0.5f});
}

TEST(Ply, BytesOfBothOrdersAreRead) {
    for (const bool big : {false, true}) {
        std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                            "_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                            "property list uchar int vertex_index\nend_header\n";
        const auto append = [&](auto value) {
            std::array<char, sizeof value> raw{};
            std::memcpy(raw.data(), &value, sizeof value);
            if (big) std::ranges::reverse(raw);
            bytes.append(raw.data(), raw.size());
        };
        for (const float x : {0.0f, 0.0f, 0.0f, 1.5f, 0.0f, 0.0f, 0.0f, 2.5f, 0.0f}) append(x);
        append(std::uint8_t{3});
        for (const std::int32_t c : {2, 0, 1}) append(c);
        const Dataset data = good_surface("ply", bytes);
        EXPECT_EQ(surface_at(data, 0).points[1], (Vec3{1.5, 0, 0}));
        EXPECT_EQ(surface_at(data, 0).polygons.corners, (std::vector<std::uint32_t>{2, 0, 1}));
        EXPECT_EQ(refused("ply", bytes.substr(0, bytes.size() - 1)).substr(0, 4), "F004");
        EXPECT_TRUE(has_code(good_surface("ply", bytes + "x"), "F107"));
    }
}

TEST(Ply, DamageIsToldWithItsPlace) {
    EXPECT_EQ(refused("ply", ply_head + "0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 3 0.5\n").substr(0, 13), "F007 top.ply:");
    EXPECT_EQ(refused("ply", ply_head + "0 0 0 1\n1 0 x 2\n"), "F005 top.ply:13:5");
    EXPECT_EQ(refused("ply", ply_head + "0 0 0 1\n1 0 0 2\n").substr(0, 4), "F004");
    EXPECT_EQ(refused("ply", "ply\nformat utf8 1.0\nend_header\n"), "F013 top.ply:2:8");
    EXPECT_EQ(
        refused("ply",
                "ply\nformat ascii 1.0\nelement vertex 999999999999\nproperty float x\nproperty float y\nproperty float z\nend_header\n")
            .substr(0, 4),
        "F014");
    EXPECT_EQ(refused("ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n").substr(0, 4), "F012");
    const Dataset more =
        good_surface("ply",
                     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement patch 2\n"
                     "property list uchar float w\nend_header\n1 2 3\n2 0 1\n0\n");
    EXPECT_EQ(std::get<PointSet>(more.objects.at(0)).points[0], (Vec3{1, 2, 3}));
    ASSERT_EQ(more.losses.size(), 1u);
    EXPECT_EQ(more.losses[0].loss_class, LossClass::substance);
}

TEST(Off, CountsMayStandOnTheFirstLineAndColoursAreStyle) {
    for (const char* head : {"OFF\n3 1 0\n", "OFF 3 1 0\n", "# by hand\nOFF # here\n\n3 1\n"}) {
        const Dataset data = good_surface("off", std::string(head) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
        EXPECT_EQ(surface_at(data, 0).polygons.size(), 1u) << head;
    }
    EXPECT_EQ(good_surface("off", "COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2 255 0 0\n").losses.size(), 1u);
    EXPECT_EQ(refused("off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "F007 top.off:6:7");
    EXPECT_EQ(refused("off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"), "F004 top.off:4");
    EXPECT_EQ(refused("off", "OFF\n300000000 1 0\n0 0 0\n").substr(0, 4), "F014");
    EXPECT_EQ(refused("off", "OFF\n3 1 0\n0 0 0\n1 0 zero\n"), "F005 top.off:4:5");
}

TEST(SurfaceFiles, AreToldByTheirContent) {
    const auto best = [](const std::string& content, std::string_view name) {
        std::string_view found = "none";
        int most = 0;
        for (const Format& row : surfaces::formats()) {
            if (const int score = row.sniff(content, name); score > most) {
                most = score;
                found = row.name;
            }
        }
        return std::string(found);
    };
    EXPECT_EQ(best(solid("a", up), "a.txt"), "stl");
    EXPECT_EQ(best("solid ground is rare\nin the sea\n", "a.stl"), "none");
    EXPECT_EQ(best("# c\nv 0 0 0\n", "a.obj"), "obj");
    EXPECT_EQ(best("v 0 0 0\n", "a.txt"), "none");
    EXPECT_EQ(best(ply_head, "a"), "ply");
    EXPECT_EQ(best("OFF\n3 1 0\n", "a"), "off");
    EXPECT_EQ(best("OFFSET 3\n", "a"), "none");
}

}  // namespace
}  // namespace geomend::test
