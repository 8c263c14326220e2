// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>

#include "formats/meshes/meshes.h"
#include "formats/meshes/read_abaqus.h"
#include "geometry/cell_volume.h"
#include "geometry/measures.h"
#include "meshes/cell_samples.h"
#include "meshes/written_mesh.h"
#include "support/temporary_folder.h"

namespace geomend::test {
namespace {

Result<Dataset> read(std::string_view format, const Input& input) {
    const auto rows = meshes::formats();
    return std::ranges::find(rows, format, &Format::name)->read(input, {});
}

Dataset read_text(std::string_view format, const std::string& text) {
    auto data = read(format, Input::from_memory(text, "a.txt"));
    EXPECT_TRUE(data) << (data ? "" : data.why().error.message);
    return data ? std::move(*data) : Dataset{};
}

std::string failure_of(std::string_view format, const std::string& text) {
    const auto data = read(format, Input::from_memory(text, "a.txt"));
    return data ? "" : data.why().error.code + " " + to_string(data.why().error.where) + ": " + data.why().error.message;
}

const CellMesh& mesh_in(const Dataset& data) { return std::get<CellMesh>(data.objects.at(0)); }

std::vector<std::uint32_t> nodes(const CellMesh& mesh, std::size_t cell) {
    const auto own = mesh.cell_nodes(cell);
    return {own.begin(), own.end()};
}

const CellMesh::Entity& entity_of(const CellMesh& mesh, std::size_t cell) { return mesh.entities.at(mesh.cell_entity.at(cell)); }

/// Cells of three dimensions with their positions and the names of their regions, ascending: what a round trip is to keep.
std::vector<std::pair<std::string, std::vector<Vec3>>> solids(const CellMesh& mesh) {
    std::vector<std::pair<std::string, std::vector<Vec3>>> all;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        if (dimension(mesh.types[c]) < 3) continue;
        auto& [name, corners] = all.emplace_back(mesh.entities.empty() ? "" : entity_of(mesh, c).name, std::vector<Vec3>());
        for (const std::uint32_t n : mesh.cell_nodes(c)) corners.push_back(mesh.points[n]);
    }
    std::ranges::sort(all);
    return all;
}

TEST(MeshReading, WhatIsWrittenIsReadWithRegionsNodesAndSets) {
    struct Case {
        const char *format, *file;
    };
    for (const auto& [format, file] :
         {Case{"medit", "m.mesh"}, Case{"tetgen", "m.ele"}, Case{"tetgen", "m.node"}, Case{"abaqus", "m.inp"}}) {
        for (const SampleCell& sample : sample_cells()) {
            const bool second = is_second_order(sample.type);
            if ((std::string(format) == "tetgen" && linear_type(sample.type) != CellType::tetrahedron) ||
                (std::string(format) == "medit" && second))
                continue;
            const TemporaryFolder folder;
            const CellMesh mesh = mesh_of(sample);
            OutputSet out(folder / file);
            ASSERT_TRUE(write_cells(mesh, format, out));
            const auto data = read(format, *Input::open((folder / file).string()));
            ASSERT_TRUE(data) << data.why().error.message;
            EXPECT_EQ(solids(mesh_in(*data)), solids(mesh)) << format << ' ' << to_string(sample.type);
            const auto surfaces = std::ranges::count_if(mesh_in(*data).entities, [](const auto& e) { return e.dimension == 2; });
            EXPECT_EQ(surfaces, static_cast<std::ptrdiff_t>(sample.faces.size())) << format;
        }
    }
}

TEST(MeshReading, BoxesKeepTheirFaultAndWell) {
    for (const auto& [format, file] : {std::pair("medit", "m.mesh"), std::pair("abaqus", "m.inp")}) {
        const TemporaryFolder folder;
        OutputSet out(folder / file);
        ASSERT_TRUE(write_cells(two_boxes(false), format, out));
        const auto data = read(format, *Input::open((folder / file).string()));
        ASSERT_TRUE(data);
        EXPECT_EQ(solids(mesh_in(*data)), solids(two_boxes(false)));
        const auto& mesh = mesh_in(*data);
        const bool has_fault =
            std::ranges::any_of(mesh.entities, [](const auto& e) { return e.dimension == 2 && e.name.starts_with("F"); });
        EXPECT_TRUE(has_fault) << format;
    }
}

TEST(Abaqus, ASetWithoutANameIsListedAsLost) {
    const Dataset data =
        read_text("abaqus", "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n*NSET, GENERATE\n1,3,1\n");
    EXPECT_TRUE(info_of(data.objects.at(0)).sets.empty());
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].entity, "NSET");
}

TEST(Medit, IsReadWhateverTheOrderOfSectionsAndLines) {
    const Dataset data = read_text("medit",
                                   "MeshVersionFormatted\n2\n# a comment\nDimension\n3\nTetrahedra 1 1 2 3 4 7\nTriangles\n1\n1 2 3 -5\n"
                                   "Vertices 4\n0 0 0 0 1 0 0 0\n0 1 0 0\n0 0 1 0\nCorners 2\n1 2\nEnd\n");
    const CellMesh& mesh = mesh_in(data);
    ASSERT_EQ(mesh.cell_count(), 2u);
    EXPECT_EQ(nodes(mesh, 0), (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(entity_of(mesh, 0).tag, 7);
    EXPECT_EQ(entity_of(mesh, 1).tag, -5);
    EXPECT_TRUE(data.findings.empty());
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].loss_class, LossClass::style);
}

TEST(Medit, PiecesOfASurfaceOnSeveralRegionsHaveOneName) {
    const Dataset data = read_text("medit",
                                   "MeshVersionFormatted 2 Dimension 3 Vertices 5 0 0 0 0 1 0 0 0 0 1 0 0 0 0 -1 0 0 0 1 0\n"
                                   "Tetrahedra 2 1 3 2 4 1 1 2 3 5 2 Triangles 2 1 2 4 9 1 2 5 9 End\n");
    const CellMesh& mesh = mesh_in(data);
    ASSERT_EQ(mesh.cell_count(), 4u);
    std::vector<const CellMesh::Entity*> pieces;
    for (const auto& entity : mesh.entities) {
        if (entity.dimension == 2) pieces.push_back(&entity);
    }
    ASSERT_EQ(pieces.size(), 2u);
    EXPECT_NE(pieces[0]->tag, pieces[1]->tag);
    EXPECT_EQ(pieces[0]->name, "Surface_9");
    EXPECT_EQ(pieces[1]->name, "Surface_9");
}

TEST(Medit, PrismsLookIntoTheCellWithTheirFirstTriangle) {
    const Dataset data = read_text("medit",
                                   "MeshVersionFormatted 2 Dimension 3 Vertices 6 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 1 0 1 0 0 1 1 0\n"
                                   "Prisms 1 1 2 3 4 5 6 1 End\n");
    const CellMesh& mesh = mesh_in(data);
    std::vector<Vec3> corners;
    for (const std::uint32_t n : mesh.cell_nodes(0)) corners.push_back(mesh.points[n]);
    EXPECT_EQ(prism_volume(corners, std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}), -0.5) << "VTK's wedge looks out of it";
}

TEST(Medit, UnknownSectionsAreReportedAndPassedOver) {
    const Dataset data = read_text("medit", "MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0 0 0\nVoronoi 2\n1 2 3\n4 5 6\nEnd\n");
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].where.line, 5u);
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].count, 2u);
}

TEST(Medit, BrokenFilesSayWhereAndWhy) {
    const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
    EXPECT_TRUE(failure_of("medit", head + "Vertices 2\n0 0 0 0\n").starts_with("F004"));
    EXPECT_TRUE(failure_of("medit", head + "Vertices 1\n0 x 0 0\n").starts_with("F005 a.txt:4:3"));
    EXPECT_TRUE(failure_of("medit", head + "Vertices 1\n0 nan 0 0\n").starts_with("F006"));
    EXPECT_TRUE(failure_of("medit", head + "Vertices 1000000000000\n").starts_with("F014"));
    EXPECT_TRUE(failure_of("medit", head + "Vertices 1\n0 0 0 0\nTriangles 1\n1 2 3 0\nEnd\n").starts_with("F007 a.txt:6"));
    EXPECT_TRUE(failure_of("medit", "MeshVersionFormatted 2\nDimension 2\n").starts_with("F013"));
    EXPECT_FALSE(read_text("medit", head + "Vertices 1\n0 0 0 0\n").findings.empty()) << "no End";
}

TEST(TetGen, NodesCountFromTheFirstOneAndAloneArePoints) {
    const TemporaryFolder folder;
    write_file(folder / "m.node", "4 3 1 1\n0 0 0 0 10.5 1\n1 1 0 0 11 1\n2 0 1 0 12 1\n3 0 0 1 13 1\n");
    auto points = read("tetgen", *Input::open((folder / "m.node").string()));
    ASSERT_TRUE(points);
    const auto& set = std::get<PointSet>(points->objects.at(0));
    EXPECT_EQ(set.points.size(), 4u);
    EXPECT_EQ(std::get<std::vector<double>>(set.info.attributes.at(0).values), (std::vector<double>{10.5, 11, 12, 13}));
    write_file(folder / "m.ele", "1 4 1\n0 0 1 2 3 9\n");
    write_file(folder / "m.face", "2 1\n0 0 2 1 4\n1 0 1 3 0\n");
    auto cells = read("tetgen", *Input::open((folder / "m.ele").string()));
    ASSERT_TRUE(cells) << cells.why().error.message;
    const CellMesh& mesh = mesh_in(*cells);
    ASSERT_EQ(mesh.cell_count(), 2u) << "a face without a marker is a face of its cell alone";
    EXPECT_EQ(nodes(mesh, 0), (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(entity_of(mesh, 0).tag, 9);
    EXPECT_EQ(entity_of(mesh, 1).tag, 4);
}

TEST(TetGen, BrokenFilesSayWhereAndWhy) {
    const TemporaryFolder folder;
    const auto failure = [&](const std::string& node, const std::string& cells) {
        write_file(folder / "m.node", node);
        write_file(folder / "m.ele", cells);
        const auto data = read("tetgen", *Input::open((folder / "m.ele").string()));
        return data ? std::string() : data.why().error.code;
    };
    const std::string four = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
    EXPECT_EQ(failure(four, "1 4 0\n1 1 2 3 4\n"), "");
    EXPECT_EQ(failure(four, "1 4 0\n1 0 1 2 3\n"), "F007");
    EXPECT_EQ(failure(four, "2 4 0\n1 1 2 3 4\n"), "F004");
    EXPECT_EQ(failure(four, "1 5 0\n1 1 2 3 4 4\n"), "F012");
    EXPECT_EQ(failure(four, "900000000 4 0\n1 1 2 3 4\n"), "F014");
    EXPECT_EQ(failure("2 2 0 0\n1 0 0\n2 1 0\n", "1 4 0\n1 1 2 3 4\n"), "F013");
    EXPECT_EQ(failure("2 3 0 0\n1 0 0 0\n5 1 0 0\n", "1 4 0\n1 1 2 3 4\n"), "F012");
    std::filesystem::remove(folder / "m.node");
    EXPECT_EQ(read("tetgen", *Input::open((folder / "m.ele").string())).why().error.code, "F010");
}

constexpr const char* deck = R"(*HEADING
 a cube, as its manual has it
** a comment
*Node, nset=Nall
1, 0., 0., 0.
2, 1.
3, 1., 1., 0.
4, , 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*ELEMENT, TYPE=C3D8R, ELSET=Rock
 1, 1, 2, 3, 4,
 5, 6, 7, 8
*Element, type=S4R, elset=Shell
2, 1, 2, 3, 4
*NSET, NSET=BASE, GENERATE
1, 4, 1
*ELSET, ELSET=Both
Rock, Shell
*SURFACE, NAME=Top, TYPE=ELEMENT
1, S2
*SURFACE, NAME=West
Rock, S6
*MATERIAL, NAME=stuff
*ELASTIC
1000, 0.25
)";

TEST(Abaqus, NodesElementsSetsAndSurfacesOfADeck) {
    const Dataset data = read_text("abaqus", deck);
    const CellMesh& mesh = mesh_in(data);
    EXPECT_EQ(mesh.points.size(), 8u);
    EXPECT_EQ(mesh.points[3], (Vec3{0, 1, 0})) << "what is left out is 0";
    ASSERT_EQ(mesh.cell_count(), 4u);
    EXPECT_EQ(mesh.types[0], CellType::hexahedron);
    EXPECT_EQ(nodes(mesh, 0), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7})) << "over two lines";
    EXPECT_EQ(entity_of(mesh, 0).name, "Rock");
    EXPECT_EQ(entity_of(mesh, 1).name, "Shell");
    EXPECT_EQ(entity_of(mesh, 2).name, "Top");
    EXPECT_EQ(entity_of(mesh, 3).name, "West");
    const auto corners = [&](std::size_t cell) {
        auto own = nodes(mesh, cell);
        std::ranges::sort(own);
        return own;
    };
    EXPECT_EQ(corners(2), (std::vector<std::uint32_t>{4, 5, 6, 7})) << "S2: 5 8 7 6";
    EXPECT_EQ(corners(3), (std::vector<std::uint32_t>{0, 3, 4, 7})) << "S6: 4 8 5 1";
    const auto set = [&](const std::string& name) { return std::ranges::find(mesh.info.sets, name, &NamedSet::name)->members; };
    EXPECT_EQ(set("NALL").size(), 8u);
    EXPECT_EQ(set("BASE"), (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(set("BOTH"), (std::vector<std::uint32_t>{0, 1}));
    std::vector<std::string> lost;
    for (const Loss& loss : data.losses) lost.push_back(loss.what);
    EXPECT_EQ(lost, (std::vector<std::string>{"*MATERIAL", "*ELASTIC"}));
}

TEST(Abaqus, PartsCountTheirNodesAnew) {
    const Dataset data =
        read_text("abaqus",
                  "*PART, NAME=A\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=a\n1,1,2,3,4\n*END PART\n"
                  "*PART, NAME=B\n*NODE\n1,5,0,0\n2,6,0,0\n3,5,1,0\n4,5,0,1\n*ELEMENT,TYPE=C3D4,ELSET=b\n1,1,2,3,4\n*END PART\n"
                  "*ASSEMBLY, NAME=all\n*INSTANCE, NAME=B-1, PART=B\n0, 0, 10\n*END INSTANCE\n*END ASSEMBLY\n");
    const CellMesh& mesh = mesh_in(data);
    ASSERT_EQ(mesh.cell_count(), 2u);
    EXPECT_EQ(nodes(mesh, 1), (std::vector<std::uint32_t>{4, 5, 6, 7}));
    EXPECT_EQ(mesh.points[4], (Vec3{5, 0, 10}));
    ASSERT_EQ(data.findings.size(), 1u) << "A has no instance";
    EXPECT_EQ(data.findings[0].code, "F150");
}

TEST(Abaqus, PartsStandWhereTheirInstancesPutThemAndAsOftenAsThoseAre) {
    const std::string parts =
        "*Part, "
        "name=Box\n*Node\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*Element,type=C3D4\n1,1,2,3,4\n*Nset,nset=tip\n4\n*Elset,elset=all\n1\n"
        "*End Part\n*Part, name=Bolt\n*Node\n1,0,0,0\n2,2,0,0\n3,0,2,0\n4,0,0,2\n*Element,type=C3D4,elset=steel\n7,1,2,3,4\n*End Part\n";
    const Dataset data = read_text("abaqus", parts +
                                                 "*Assembly, name=A\n*Instance, name=Box-1, part=box\n*End Instance\n"
                                                 "*Instance, name=Bolt-1, part=Bolt\n 10, 0, 0\n*End Instance\n"
                                                 "*Instance, name=Bolt-2, part=Bolt\n 10, 0, 5\n 10, 0, 5, 10, 0, 9, 90\n*End Instance\n"
                                                 "*Instance, name=Box-2, part=Box\n , , 0\n 0, 0, 0, 1, 1, 1, 240.\n*End Instance\n"
                                                 "*Nset, nset=heads, instance=Bolt-2\n 2, 4\n*Elset, elset=top, instance=Bolt-2\n 7\n"
                                                 "*Surface, name=side\n top, S1\n*End Assembly\n");
    const CellMesh& mesh = mesh_in(data);
    EXPECT_TRUE(data.findings.empty()) << data.findings[0].message;
    ASSERT_EQ(mesh.cell_count(), 5u) << "four cells and a face";
    ASSERT_EQ(mesh.points.size(), 16u);
    EXPECT_EQ(mesh.points[5], (Vec3{12, 0, 0}));
    EXPECT_EQ(mesh.points[9], (Vec3{10, 2, 5})) << "x was turned to y";
    EXPECT_EQ(mesh.points[10], (Vec3{8, 0, 5}));
    for (std::size_t k = 0; k < 3; ++k)  // by 240 degrees around (1,1,1) x goes to z, y to x and z to y
        for (std::size_t node = 0; node < 3; ++node) EXPECT_NEAR(mesh.points[13 + node][k], k == (node + 2) % 3 ? 1 : 0, 1e-15) << node;
    const std::vector<std::string> names{"Box-1", "Bolt-1.steel", "Bolt-2.steel", "Box-2"};
    for (std::uint32_t cell = 0; cell < 4; ++cell) EXPECT_EQ(entity_of(mesh, cell).name, names[cell]);
    EXPECT_EQ(entity_of(mesh, 4).name, "side");
    const auto set = [&](std::string_view name) {
        const auto at = std::ranges::find(mesh.info.sets, name, &NamedSet::name);
        return at == mesh.info.sets.end() ? std::vector<std::uint32_t>{} : at->members;
    };
    EXPECT_EQ(set("HEADS"), (std::vector<std::uint32_t>{9, 11}));
    EXPECT_EQ(set("TIP"), (std::vector<std::uint32_t>{3, 15})) << "in both instances of its part";
    EXPECT_EQ(set("ALL"), (std::vector<std::uint32_t>{0, 3}));
}

TEST(Abaqus, InstancesThatCannotBePlacedAreToldOrRefused) {
    const std::string part = "*Part, name=P\n*Node\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*Element,type=C3D4\n1,1,2,3,4\n*End Part\n";
    const Dataset lost =
        read_text("abaqus", part + "*Instance, name=Q-1, part=Q\n*End Instance\n*Instance, name=P-1, part=P\n*End Instance\n");
    ASSERT_EQ(lost.findings.size(), 1u);
    EXPECT_EQ(lost.findings[0].where.line, 10u);
    EXPECT_TRUE(mesh_in(lost).entities.empty()) << "a single part needs no region";
    for (const char* lines : {"1, x, 0\n", "0,0,0\n1,1,1, 1,1,1, 90\n", "0,0,0\n0,0,0,0,0,1,90\n1\n", "1e999,0,0\n"})
        EXPECT_NE(failure_of("abaqus", part + "*Instance, name=P-1, part=P\n" + lines + "*End Instance\n"), "") << lines;
    std::string many = part;
    for (int n = 0; n < 3; ++n) many += "*Part, name=E\n*End Part\n*Instance, name=I, part=P\n*End Instance\n";
    EXPECT_EQ(mesh_in(read_text("abaqus", many)).cell_count(), 3u);
}

// CalculiX has no pyramids, and other programs write all solids as hexahedra.
TEST(Abaqus, HexahedraThatNameNodesSeveralTimesAreWhatTheyAre) {
    const std::string points = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n*ELEMENT,TYPE=C3D8,ELSET=a\n";
    struct Case {
        std::string element;
        CellType type;
        std::vector<std::uint32_t> own;
        std::vector<std::pair<std::string, std::vector<std::uint32_t>>> faces;  ///< nodes, ascending
    };
    for (const Case& c : {Case{"1,2,3,4,5,5,5,5",
                               CellType::pyramid,
                               {0, 1, 2, 3, 4},
                               {{"S1", {0, 1, 2, 3}}, {"S3", {0, 1, 4}}, {"S4", {1, 2, 4}}, {"S5", {2, 3, 4}}, {"S6", {0, 3, 4}}}},
                          Case{"1,2,3,3,5,6,7,7",
                               CellType::wedge,
                               {0, 2, 1, 4, 6, 5},
                               {{"S1", {0, 1, 2}}, {"S2", {4, 5, 6}}, {"S3", {0, 1, 4, 5}}, {"S4", {1, 2, 5, 6}}, {"S6", {0, 2, 4, 6}}}},
                          Case{"1,2,3,3,5,5,5,5",
                               CellType::tetrahedron,
                               {0, 1, 2, 4},
                               {{"S1", {0, 1, 2}}, {"S3", {0, 1, 4}}, {"S4", {1, 2, 4}}, {"S6", {0, 2, 4}}}}}) {
        std::string text = points + "1," + c.element + "\n";
        for (const auto& [face, corners] : c.faces) text += "*SURFACE, NAME=f" + face + "\n1," + face + "\n";
        const Dataset data = read_text("abaqus", text);
        const CellMesh& mesh = mesh_in(data);
        ASSERT_EQ(mesh.cell_count(), 1 + c.faces.size()) << c.element;
        EXPECT_EQ(mesh.types[0], c.type);
        EXPECT_EQ(nodes(mesh, 0), c.own) << c.element;
        for (std::uint32_t f = 0; f < c.faces.size(); ++f) {
            std::vector<std::uint32_t> found = nodes(mesh, f + 1);
            std::ranges::sort(found);
            EXPECT_EQ(found, c.faces[f].second) << c.element << ' ' << c.faces[f].first;
        }
    }
}

// Any face of a cube may become an edge in two ways, or a point; the faces that are left keep their numbers.
TEST(Abaqus, CollapsedHexahedraAreReadWhicheverWayTheyAreTurned) {
    const std::string points =
        "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n*ELEMENT,TYPE=C3D8,ELSET=a\n";
    constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}};
    for (const auto& f : faces) {
        for (int way = 0; way < 3; ++way) {
            std::array<std::uint32_t, 8> h{0, 1, 2, 3, 4, 5, 6, 7};
            if (way == 0) h[f[1]] = f[0], h[f[2]] = f[3];
            if (way == 1) h[f[3]] = f[0], h[f[2]] = f[1];
            if (way == 2) h[f[1]] = h[f[2]] = h[f[3]] = f[0];
            std::string text = points + "1";
            for (const std::uint32_t node : h) text += "," + std::to_string(node + 1);
            text += "\n";
            std::vector<std::vector<std::uint32_t>> left;
            for (std::size_t s = 0; s < 6; ++s) {
                std::set<std::uint32_t> corners;
                for (const std::uint32_t k : faces[s]) corners.insert(h[k]);
                if (corners.size() < 3) continue;
                text += "*SURFACE, NAME=f" + std::to_string(s + 1) + "\n1,S" + std::to_string(s + 1) + "\n";
                left.emplace_back(corners.begin(), corners.end());
            }
            const Dataset data = read_text("abaqus", text);
            const CellMesh& mesh = mesh_in(data);
            ASSERT_EQ(mesh.cell_count(), 1 + left.size()) << text;
            EXPECT_EQ(mesh.types[0], way == 2 ? CellType::pyramid : CellType::wedge) << text;
            EXPECT_NEAR(cell_volume(mesh, 0), way == 2 ? 1.0 / 3 : 0.5, 1e-15) << text;
            for (std::uint32_t s = 0; s < left.size(); ++s) {
                std::vector<std::uint32_t> found = nodes(mesh, s + 1);
                std::ranges::sort(found);
                EXPECT_EQ(found, left[s]) << text;
            }
        }
    }
}

TEST(Abaqus, AnElementWithTooFewNodesDoesNotTakeTheNextOneIn) {
    const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,1,1\n*ELEMENT,TYPE=C3D4,ELSET=a\n";
    const auto read = [&](const std::string& elements) {
        return meshes::read_abaqus(Input::from_memory(nodes + elements, "deck.inp"), {});
    };
    const auto failed = read("1,1,2,3\n2,2,3,4,5\n");
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.why().error.code, "F008");
    EXPECT_EQ(failed.why().error.where.line, 8u);
    EXPECT_TRUE(read("1,1,2,\n3,4\n2,2,3,4,5\n")) << "an element on two lines";
}

TEST(Abaqus, SurfacesOfBothSidesAreOneAndAreCutWhereRegionsChange) {
    const Dataset data = read_text("abaqus",
                                   "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,1,1\n6,-1,0,0\n*ELEMENT,TYPE=C3D4,ELSET=a\n1,1,2,3,4\n"
                                   "*ELEMENT,TYPE=C3D4,ELSET=b\n2,2,3,4,5\n*ELEMENT,TYPE=C3D4,ELSET=c\n3,1,4,3,6\n"
                                   "*SURFACE, NAME=F_front\n1,S3\n1,S4\n*SURFACE, NAME=F_back\n2,S1\n3,S1\n");
    const CellMesh& mesh = mesh_in(data);
    ASSERT_EQ(mesh.cell_count(), 5u) << "each face once";
    EXPECT_EQ(entity_of(mesh, 3).name, "F");
    EXPECT_EQ(entity_of(mesh, 4).name, "F");
    EXPECT_NE(mesh.cell_entity[3], mesh.cell_entity[4]) << "between a and b, and between a and c";
    ASSERT_EQ(mesh.groups.size(), 1u);
    EXPECT_EQ(mesh.groups[0].name, "F");
    EXPECT_EQ(entity_of(mesh, 3).groups, entity_of(mesh, 4).groups);
}

TEST(Abaqus, NodesOfOtherSystemsAreTurnedIntoCartesianOnes) {
    const Dataset data = read_text("abaqus", "*NODE, SYSTEM=C\n1,2,90,5\n*NODE, SYSTEM=S\n2,2,0,90\n*NODE\n3,1,2,3\n");
    const auto& points = mesh_in(data).points;
    const auto is_near = [](const Vec3& a, const Vec3& b) { return dot(minus(a, b), minus(a, b)) < 1e-24; };
    EXPECT_TRUE(is_near(points[0], {0, 2, 5}));
    EXPECT_TRUE(is_near(points[1], {0, 0, 2}));
    EXPECT_TRUE(is_near(points[2], {1, 2, 3}));
}

TEST(Abaqus, SetsOfSetsDoNotGrowAndThoseOfElementsHaveTheirNodes) {
    std::string text =
        "\xEF\xBB\xBF*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,9,9,9\n*ELEMENT,TYPE=C3D4,ELSET=\"my set, 1\"\n1,1,2,3,4\n"
        "*ELSET,ELSET=E0\n1\n*NSET,NSET=n,ELSET=E0\n";
    for (int k = 0; k < 60; ++k)
        text += "*ELSET,ELSET=E" + std::to_string(k + 1) + "\nE" + std::to_string(k) + ",E" + std::to_string(k) + "\n";
    const Dataset data = read_text("abaqus", text);
    const CellMesh& mesh = mesh_in(data);
    EXPECT_EQ(entity_of(mesh, 0).name, "my set, 1");
    const auto set = [&](const std::string& name) { return std::ranges::find(mesh.info.sets, name, &NamedSet::name)->members; };
    EXPECT_EQ(set("E60"), (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(set("N"), (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(Abaqus, IncludedFilesAreRead) {
    const TemporaryFolder folder;
    write_file(folder / "nodes.inp", "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n");
    write_file(folder / "m.inp", "*INCLUDE, INPUT=nodes.inp\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n");
    const auto data = read("abaqus", *Input::open((folder / "m.inp").string()));
    ASSERT_TRUE(data) << data.why().error.message;
    EXPECT_EQ(mesh_in(*data).cell_count(), 1u);
    EXPECT_TRUE(mesh_in(*data).entities.empty());
    write_file(folder / "loop.inp", "*INCLUDE, INPUT=loop.inp\n");
    EXPECT_EQ(read("abaqus", *Input::open((folder / "loop.inp").string())).why().error.code, "F014");
}

TEST(Abaqus, WhatIsNotKnownIsReportedAndBrokenFilesSayWhere) {
    const std::string four = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n";
    const Dataset springs = read_text("abaqus", four + "*ELEMENT, TYPE=SPRINGA\n1,1,2\n2,2,3\n");
    ASSERT_EQ(springs.findings.size(), 1u);
    EXPECT_EQ(springs.findings[0].count, 2u);
    EXPECT_EQ(read_text("abaqus", four + "*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n1,2,1,3,4\n").findings.size(), 1u) << "the last one holds";
    EXPECT_TRUE(failure_of("abaqus", four + "*ELEMENT, TYPE=C3D4\n1,1,2,3,5\n").starts_with("F007 a.txt:7"));
    EXPECT_TRUE(failure_of("abaqus", four + "*ELEMENT, TYPE=C3D4\n1,1,2,3\n").starts_with("F008"));
    EXPECT_TRUE(failure_of("abaqus", four + "*ELEMENT, TYPE=C3D4\n1,1,2,x,4\n").starts_with("F005 a.txt:7:7"));
    EXPECT_TRUE(failure_of("abaqus", "*NODE\n1,0,inf,0\n").starts_with("F006"));
    EXPECT_TRUE(failure_of("abaqus", "*HEADING\n").starts_with("F017"));
    EXPECT_TRUE(failure_of("abaqus", four + "*NSET, NSET=a, GENERATE\n1, 9000000000000, 1\n").starts_with("F012"));
    EXPECT_TRUE(failure_of("abaqus", four + "*NSET, NSET=a, GENERATE\n-9223372036854775807, 9223372036854775807, 1\n").starts_with("F012"));
    const Dataset wide = read_text("abaqus", four + "*NSET, NSET=a, GENERATE\n1, 9223372036854775807, 9223372036854775807\n");
    EXPECT_EQ(info_of(wide.objects.at(0)).sets.at(0).members.size(), 1u);
}

}  // namespace
}  // namespace geomend::test
