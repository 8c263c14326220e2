// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "ringmesh/gm_files.h"
#include "topology/brep_from_dataset.h"

namespace geomend::test {
namespace {

TEST(RingmeshReading, AModelIsSurfacesByInterfaceAndRegionsWithSides) {
    const Dataset data = good_gm(TwoHalves().bytes());
    ASSERT_EQ(data.objects.size(), 2u);
    const auto& bed = std::get<Surface>(data.objects[0]);
    const auto& box = std::get<Surface>(data.objects[1]);
    EXPECT_EQ(bed.info.name, "bed");
    EXPECT_EQ(bed.info.role, FeatureRole::horizon);
    EXPECT_EQ(box.info.role, FeatureRole::boundary);
    EXPECT_EQ(box.parts.size(), 6u);
    EXPECT_EQ(box.polygons.size(), 6u);
    ASSERT_EQ(data.models.size(), 1u);
    const StatedModel& model = data.models[0];
    EXPECT_EQ(model.name, "two halves");
    ASSERT_EQ(model.regions.size(), 3u);
    EXPECT_EQ(model.regions[0].name, "west");
    EXPECT_TRUE(model.regions[2].universe);
    ASSERT_EQ(model.layers.size(), 1u);
    EXPECT_EQ(model.layers[0].name, "all_of_it");
    EXPECT_EQ(model.layers[0].regions, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_TRUE(data.findings.empty());
}

TEST(RingmeshReading, TheBoundaryRepresentationIsThatOfTheFile) {
    Dataset data = good_gm(TwoHalves().bytes());
    topology::build_breps(data);
    ASSERT_EQ(data.breps.size(), 1u);
    const auto& brep = *data.breps[0];
    EXPECT_EQ(brep.surfaces.size(), 7u);
    EXPECT_EQ(brep.vertices.size(), 5u);
    ASSERT_EQ(brep.regions.size(), 2u);
    EXPECT_NEAR(brep.regions[0].volume, 2.0 / 3, 1e-12);
    EXPECT_NEAR(brep.regions[1].volume, 2.0 / 3, 1e-12);
}

/// The two halves, with lists of the lines around each surface.
TwoHalves with_lines() {
    TwoHalves model;
    const std::vector<std::string> lines{"0 1 2 ", "5 0 3 ", "3 2 7 ", "7 1 5 ", "0 6 4 ", "4 8 2 ", "6 1 8 "};
    for (std::size_t s = 0; s < lines.size(); ++s) {
        const std::string head = "Surface " + std::to_string(s) + " No_name GeogramSurfaceMesh\nboundary ";
        TwoHalves::replace(model.entities, head + "\n", head + lines[s] + "\n");
    }
    return model;
}

TEST(RingmeshReading, ListsOfLinesAndCornersThatDoNotFitTheGeometryAreReported) {
    EXPECT_TRUE(good_gm(with_lines().bytes()).findings.empty());
    struct Row {
        const char *what, *by, *begins;
    };
    const Row rows[] = {
        {"boundary 0 1 2 \n", "boundary 0 1 \n", "Surface 0 has a border at (0, 0, 2)"},
        {"boundary 0 1 2 \n", "boundary 0 1 8 \n", "Surface 0 is stated to be bounded by Line 8"},
        {"GeogramLineMesh\nboundary 4 2 \n", "GeogramLineMesh\nboundary 4 3 \n",
         "Line 0 is stated to end at Corner 3, which lies at (0, 0, 2)"},
        {"GeogramLineMesh\nboundary 4 2 \n", "GeogramLineMesh\nboundary 4 4 \n",
         "Line 0 ends at (0, 2, 0), where none of the corners lies"},
        {"GeogramLineMesh\nboundary 4 2 \n", "GeogramLineMesh\nboundary 2 \n", "Line 0 ends at (1, 0, 0), where none of the corners lies"},
        {"boundary 0 1 2 \n", "boundary 0 1 2 0 \n", "Surface 0 is stated to lie on both sides of Line 0"},
    };
    for (const Row& row : rows) {
        TwoHalves model = with_lines();
        TwoHalves::replace(model.entities, row.what, row.by);
        const Dataset data = good_gm(model.bytes());
        ASSERT_EQ(data.findings.size(), 1u) << row.by;
        EXPECT_EQ(data.findings[0].code, "F113");
        EXPECT_TRUE(data.findings[0].message.starts_with(row.begins)) << data.findings[0].message;
        EXPECT_EQ(data.findings[0].points.size(), 1u);
    }
    TwoHalves swapped = with_lines();
    std::swap(swapped.mesh("Line_0.geogram"), swapped.mesh("Line_8.geogram"));
    const Dataset data = good_gm(swapped.bytes());
    ASSERT_EQ(data.findings.size(), 2u);
    EXPECT_EQ(data.findings[0].count, 2u) << "lines";
    EXPECT_EQ(data.findings[1].count, 5u) << "surfaces";
}

TEST(RingmeshReading, ByteOrderMarksBeforeTheTextsAreNoPartOfThem) {
    TwoHalves model;
    model.entities = "\xEF\xBB\xBF" + model.entities;
    model.geology = "\xEF\xBB\xBF" + model.geology;
    const Dataset data = good_gm(model.bytes());
    EXPECT_EQ(data.models[0].regions.size(), 3u);
    EXPECT_TRUE(data.findings.empty());
}

TEST(RingmeshReading, EarlierVersionsStateTheFeatureInEachRecord) {
    TwoHalves model;
    for (const char* mesh : {"", " GeogramMesh2D"}) {  // versions 0 and 1
        std::string text = model.entities;
        TwoHalves::replace(text, "Version 2\n", *mesh == 0 ? "" : "Version 1\n");
        for (const char* kind : {"PointSet", "Line", "Surface", "Volume"}) {
            const std::string word = " Geogram" + std::string(kind) + "Mesh";
            for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word)) {
                text.replace(at, word.size(), std::string(*kind == 'S' ? " fault" : " no_geological_feature") + mesh);
            }
        }
        TwoHalves old = model;
        old.entities = text;
        old.geology = "No geological entity in the geomodel\n";
        const Dataset data = good_gm(old.bytes());
        ASSERT_EQ(data.objects.size(), 7u);  // no interface holds them
        EXPECT_EQ(info_of(data.objects[3]).name, "Surface_3");
        EXPECT_EQ(info_of(data.objects[3]).role, FeatureRole::fault);
        EXPECT_EQ(data.models[0].regions[1].name, "east");
    }
}

TEST(RingmeshReading, AttributesOfPartsAreJoinedAndMissingWhereAPartHasNone) {
    TwoHalves model;
    const auto triangle = [](const TwoHalves::P& p, const TwoHalves::P& q, const TwoHalves::P& r) {
        GeogramText mesh;
        mesh.points({p, q, r}).values("GEO::Mesh::vertices", "throw", "double", std::vector<double>{1, 2, 3});
        return mesh.values("GEO::Mesh::vertices", "model_vertex_id", "index_t", std::vector<std::uint32_t>{7, 8, 9}).triangles({0, 1, 2});
    };
    model.mesh("Surface_2.geogram") = triangle(model.a, model.m, model.d).plain();  // not compressed
    const Dataset data = good_gm(model.bytes());
    const auto& attributes = info_of(data.objects[1]).attributes;
    ASSERT_EQ(attributes.size(), 1u);
    ASSERT_EQ(value_count(attributes[0]), 18u);
    EXPECT_TRUE(std::isnan(value_as_double(attributes[0], 2)));
    EXPECT_EQ(value_as_double(attributes[0], 3), 1);
    EXPECT_EQ(value_as_double(attributes[0], 5), 3);
    EXPECT_TRUE(std::isnan(value_as_double(attributes[0], 6)));
}

TEST(RingmeshReading, RegionsWithCellsBecomeOneMeshWithEntities) {
    TwoHalves model;
    model.fill();
    Dataset data = good_gm(model.bytes());
    const auto& mesh = std::get<CellMesh>(data.objects.at(0));
    EXPECT_EQ(mesh.points.size(), 5u);
    EXPECT_EQ(std::ranges::count(mesh.types, CellType::tetrahedron), 2);
    EXPECT_EQ(std::ranges::count(mesh.types, CellType::triangle), 7);
    EXPECT_EQ(mesh.entities.at(0).name, "west");
    EXPECT_EQ(mesh.entities.at(0).boundary, (std::vector<std::int64_t>{-1, -2, -3, -4}));
    topology::build_breps(data);
    ASSERT_EQ(data.breps.size(), 1u);
    EXPECT_EQ(data.breps[0]->surfaces.size(), 7u);
    EXPECT_EQ(data.breps[0]->regions.size(), 2u);
}

TEST(RingmeshReading, CellsOfEveryTypeHaveTheirVolume) {
    // A unit cube, a prism and a pyramid beside each other, in GeoGram's order of corners.
    using P = std::array<double, 3>;
    TwoHalves model;
    GeogramText mesh;
    const std::vector<P> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1},    {1, 0, 1},
                                {0, 1, 1}, {1, 1, 1}, {2, 0, 0}, {2, 0, 1}, {0.5, 0.5, 2}};
    const std::vector<std::uint32_t> corners{0, 1, 2, 3, 4, 5, 6, 7, 1, 8, 3, 5, 9, 7, 4, 5, 7, 6, 10};
    mesh.points(points).set("GEO::Mesh::cells", 3).set("GEO::Mesh::cell_corners", corners.size());
    mesh.values("GEO::Mesh::cells", "GEO::Mesh::cells::cell_type", "char", std::vector<char>{1, 2, 3});
    mesh.values("GEO::Mesh::cells", "GEO::Mesh::cells::cell_ptr", "index_t", std::vector<std::uint32_t>{0, 8, 14});
    mesh.values("GEO::Mesh::cell_corners", "GEO::Mesh::cell_corners::corner_vertex", "index_t", corners);
    model.add("Region", 0, mesh);
    const Dataset data = good_gm(model.bytes());
    const auto& cells = std::get<CellMesh>(data.objects.at(0));
    // The first three edges of a corner of each make a right-handed frame, as VTK has it (its wedge is seen from outside).
    const auto turned = [&](std::size_t cell, std::array<int, 4> k) {
        const auto n = cells.cell_nodes(cell);
        std::array<Vec3, 3> e{};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t x = 0; x < 3; ++x)
                e[i][x] = cells.points[n[static_cast<std::size_t>(k[i + 1])]][x] - cells.points[n[static_cast<std::size_t>(k[0])]][x];
        }
        return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
               e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    };
    ASSERT_EQ(cells.types[0], CellType::hexahedron);
    EXPECT_EQ(turned(0, {0, 1, 3, 4}), 1);
    ASSERT_EQ(cells.types[1], CellType::wedge);
    EXPECT_EQ(turned(1, {0, 2, 1, 3}), 1);
    ASSERT_EQ(cells.types[2], CellType::pyramid);
    EXPECT_GT(turned(2, {0, 1, 3, 4}), 0);
}

TEST(RingmeshReading, ASurfaceIsCutAlongALineThatBoundsItTwice) {
    // A square of four triangles around its centre, cut from the centre to a corner.
    using P = std::array<double, 3>;
    const std::vector<P> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
    const auto archive = [&](const char* bounds) {
        const std::string text =
            "Version 2\nGeoModel name cut\nNb Line 2\nNb Surface 1\nNb Region 0\n"
            "Line 0 No_name GeogramLineMesh\nboundary \nLine 1 No_name GeogramLineMesh\nboundary \nSurface 0 No_name "
            "GeogramSurfaceMesh\nboundary " +
            std::string(bounds) + "\n";
        const GeogramText cut = GeogramText().points({points[4], points[2]}).edges({0, 1});
        const GeogramText border = GeogramText().points({points[0], points[1]}).edges({0, 1});
        const GeogramText mesh = GeogramText().points(points).triangles({0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4});
        return zip_of({{"mesh_entities.txt", text},
                       {"Line_0.geogram", border.gzipped()},
                       {"Line_1.geogram", cut.gzipped()},
                       {"Surface_0.geogram", mesh.gzipped()}});
    };
    const Dataset whole = good_gm(archive("0 1"));
    EXPECT_EQ(std::get<Surface>(whole.objects.at(0)).points.size(), 5u);
    const Dataset cut = good_gm(archive("0 1 1"));
    const auto& surface = std::get<Surface>(cut.objects.at(0));
    EXPECT_EQ(surface.points.size(), 6u);  // the end of the cut in the surface stays one point
    EXPECT_EQ(std::ranges::count(surface.points, Vec3{1, 1, 0}), 2);
}

TEST(RingmeshReading, LinesAndCornersOffTheSurfacesAreObjects) {
    TwoHalves model;
    model.mesh("Line_3.geogram") = GeogramText().points({{5, 5, 5}, {6, 6, 6}}).edges({0, 1}).gzipped();
    model.mesh("Corner_1.geogram") = GeogramText().points({{9, 9, 9}}).gzipped();
    const Dataset data = good_gm(model.bytes());
    ASSERT_EQ(data.objects.size(), 4u);
    EXPECT_EQ(info_of(data.objects[2]).name, "Line_3");
    EXPECT_EQ(std::get<PolylineSet>(data.objects[2]).edges.size(), 1u);
    EXPECT_EQ(info_of(data.objects[3]).name, "Corner_1");
}

TEST(RingmeshReading, WhatHasNoPlaceIsListed) {
    TwoHalves model;
    model.geology += "Interface 2 other fault\n99 \nStratum 0 s none\n0 \n";
    model.meshes.emplace_back("notes/readme.md", "hello");
    const Dataset data = good_gm(model.bytes());
    const auto has = [&](std::string_view what) {
        return std::ranges::any_of(
            data.losses, [&](const Loss& l) { return l.what.find(what) != std::string::npos && l.loss_class == LossClass::identity; });
    };
    EXPECT_TRUE(has("Stratum 's'"));
    EXPECT_TRUE(has("files of the archive"));
    EXPECT_TRUE(has("a member of a geological record"));
    EXPECT_TRUE(std::ranges::any_of(data.findings, [](const Finding& f) { return f.code == "F109" && f.where.line == 13; }));
}

}  // namespace
}  // namespace geomend::test
