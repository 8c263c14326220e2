// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>

#include "formats/gmsh/sections.h"
#include "gmsh_support.h"
#include "support/real_data.h"

namespace geomend::test {
namespace {

TEST(MshReading, Msh22GivesNodesElementsEntitiesAndGroups) {
    const auto d = read_text(two_tets_22());
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    const CellMesh& m = mesh_of(*d);
    EXPECT_EQ(d->variant, "MSH 2.2");
    ASSERT_EQ(m.points.size(), 5u);
    EXPECT_EQ(m.points[3], (Vec3{0, 0, -1.5}));
    EXPECT_EQ(m.types, (std::vector{CellType::vertex, CellType::line, CellType::triangle, CellType::tetrahedron, CellType::tetrahedron}));
    EXPECT_EQ(m.nodes, (std::vector<std::uint32_t>{0, 0, 1, 0, 1, 2, 0, 2, 1, 3, 0, 1, 2, 4}));
    ASSERT_EQ(m.entities.size(), 5u);
    EXPECT_EQ(m.entities[2].tag, 4);
    EXPECT_EQ(m.entities[2].name, "fault");
    EXPECT_EQ(m.entities[4].name, "upper \"B\"");
    EXPECT_TRUE(m.entities[0].groups.empty());
    EXPECT_EQ(m.cell_entity, (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
}

TEST(MshReading, Msh41GivesTheSameMeshAndBoundaries) {
    const auto d = read_text(two_tets_41());
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    const auto old = read_text(two_tets_22());
    const CellMesh& m = mesh_of(*d);
    EXPECT_EQ(m.points, mesh_of(*old).points);
    EXPECT_EQ(m.nodes, mesh_of(*old).nodes);
    EXPECT_EQ(m.entities[4].boundary, (std::vector<std::int64_t>{-4}));
    EXPECT_EQ(m.entities[4].name, "upper \"B\"");
    ASSERT_TRUE(m.entities[3].bounds.has_value());
    EXPECT_EQ((*m.entities[3].bounds)[0], (Vec3{0, 0, -1.5}));
}

TEST(MshReading, Msh40HasTagAndPositionOnOneLine) {
    const auto d = read_text(
        "$MeshFormat\n4 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n3 0 0 0 1 1 0 1 9 0\n$EndEntities\n"
        "$Nodes\n1 3\n3 2 0 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1 1\n3 2 2 1\n1 1 2 3\n$EndElements\n");
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    EXPECT_EQ(mesh_of(*d).types, std::vector{CellType::triangle});
    EXPECT_EQ(mesh_of(*d).entities[0].tag, 3);
    EXPECT_EQ(mesh_of(*d).groups[0].tag, 9);
}

TEST(MshReading, Msh1HasNoHead) {
    const auto d = read_text("$NOD\n3\n1 0 0 0\n7 1 0 0\n3 0 1 0\n$ENDNOD\n$ELM\n1\n1 2 5 6 3 1 7 3\n$ENDELM\n");
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    EXPECT_EQ(d->variant, "MSH 1");
    EXPECT_EQ(mesh_of(*d).nodes, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(mesh_of(*d).point_labels[1], 7);
    EXPECT_EQ(mesh_of(*d).entities[0].tag, 6);
    EXPECT_EQ(mesh_of(*d).groups[0].tag, 5);
}

TEST(MshReading, SectionsMayStandInAnyOrderAndLinesEndWithCrLf) {
    std::string text = two_tets_22();
    const std::size_t nodes = text.find("$Nodes"), elements = text.find("$Elements");
    std::string swapped = text.substr(0, nodes) + text.substr(elements) + text.substr(nodes, elements - nodes);
    std::string crlf;
    for (const char c : swapped) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    const auto d = read_text(crlf);
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    EXPECT_EQ(mesh_of(*d).nodes, mesh_of(*read_text(text)).nodes);
    EXPECT_EQ(mesh_of(*d).groups[0].name, "fault");
}

TEST(MshReading, NumbersNeedNotKeepToOneRecordPerLine) {
    const auto d = read_text(replaced(two_tets_22(), "2 1 0 0\n3 0 1 0\n", "2\n1 0\n0 3 0 1 0 "));
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    EXPECT_EQ(mesh_of(*d).points, mesh_of(*read_text(two_tets_22())).points);
}

TEST(MshReading, ScatteredNodeTagsAreFound) {
    const auto d = read_text(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n900000000 0 0 0\n5 1 0 0\n77 0 1 0\n$EndNodes\n"
        "$Elements\n1\n12 2 2 0 1 77 5 900000000\n$EndElements\n");
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    EXPECT_EQ(mesh_of(*d).nodes, (std::vector<std::uint32_t>{2, 1, 0}));
    EXPECT_EQ(mesh_of(*d).cell_labels[0], 12);
}

TEST(MshReading, AnEntityOfTwoGroupsIsNotDoubled) {
    const auto d =
        read_text(replaced(replaced(two_tets_22(), "$Elements\n5\n", "$Elements\n6\n"), "$EndElements", "6 4 2 9 2 1 2 3 5\n$EndElements"));
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    const CellMesh& m = mesh_of(*d);
    EXPECT_EQ(m.cell_count(), 5u);
    ASSERT_EQ(m.entities.size(), 5u);
    EXPECT_EQ(m.entities[4].groups.size(), 2u);
    EXPECT_TRUE(std::ranges::any_of(d->findings, [](const Finding& f) { return f.code == "F123" && f.count == 1; }));
}

TEST(MshReading, AnEntityWhoseElementsAreInDifferentGroupsIsSplit) {
    const auto d = read_text(replaced(two_tets_22(), "5 4 2 2 2 ", "5 4 2 2 1 "));
    ASSERT_TRUE(d.ok());
    const CellMesh& m = mesh_of(*d);
    EXPECT_EQ(m.cell_count(), 5u);
    EXPECT_NE(m.cell_entity[3], m.cell_entity[4]);
    EXPECT_EQ(m.entities[m.cell_entity[3]].name, "lower");
    EXPECT_EQ(m.entities[m.cell_entity[4]].name, "upper \"B\"");
    EXPECT_TRUE(std::ranges::any_of(d->findings, [](const Finding& f) { return f.code == "F122"; }));
}

/// Two tetrahedra, and a group of boundary faces on both of them.
std::string faces_on_two_volumes(const std::string& elementary_and_physical) {
    return replaced(replaced(two_tets_22(), "$Elements\n5\n", "$Elements\n8\n"), "$EndElements",
                    "6 2 2 " + elementary_and_physical + " 1 2 4\n7 2 2 " + elementary_and_physical + " 1 2 5\n8 2 2 " +
                        elementary_and_physical + " 2 3 5\n$EndElements");
}

TEST(MshReading, SetsOfFacesOnSeveralVolumesAreASurfaceForEach) {
    for (const std::string tags : {"9 9", "9 0", "0 0", "9 4"}) {  // physical, elementary; 4 is that of the fault, too
        const auto d = read_text(faces_on_two_volumes(tags));
        ASSERT_TRUE(d.ok()) << d.why().error.message;
        const CellMesh& m = mesh_of(*d);
        EXPECT_NE(m.cell_entity[5], m.cell_entity[6]) << tags;
        EXPECT_EQ(m.cell_entity[6], m.cell_entity[7]) << tags;
        EXPECT_EQ(m.entities[m.cell_entity[5]].groups, m.entities[m.cell_entity[6]].groups) << tags;
        EXPECT_NE(m.entities[m.cell_entity[5]].tag, m.entities[m.cell_entity[6]].tag) << tags;
        EXPECT_EQ(m.entities[m.cell_entity[5]].name, m.entities[m.cell_entity[6]].name) << tags;
        EXPECT_TRUE(m.entities[m.cell_entity[5]].name.starts_with("Surface_")) << tags;
        EXPECT_TRUE(std::ranges::any_of(d->findings, [](const Finding& f) { return f.code == "F122"; })) << tags;
    }
}

TEST(MshReading, SurfacesWithNumbersOfTheirOwnStayWhole) {
    const auto d = read_text(faces_on_two_volumes("9 5"));
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    EXPECT_EQ(mesh_of(*d).cell_entity[5], mesh_of(*d).cell_entity[7]);
    EXPECT_TRUE(d->findings.empty());
}

TEST(MshReading, WithoutEntitiesSetsOfFacesAreASurfaceForEachVolume) {
    const auto d = read_text(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 -1.5\n0 0 1\n$EndNodes\n"
        "$Elements\n3 4 1 4\n2 9 2 2\n1 1 2 4\n2 1 2 5\n3 1 4 1\n3 1 3 2 4\n3 2 4 1\n4 1 2 3 5\n$EndElements\n");
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    EXPECT_NE(mesh_of(*d).cell_entity[0], mesh_of(*d).cell_entity[1]);
}

TEST(MshReading, DataOfSomeElementsGetANoDataValueForTheOthers) {
    const auto d = read_text(std::string(two_tets_22()) +
                             "$ElementData\n1\n\"porosity\"\n1\n2.5\n3\n4\n1\n1\n5 0.25\n$EndElementData\n"
                             "$NodeData\n1\n\"flow\"\n1\n0\n3\n0\n3\n5\n1 1 2 3\n2 1 2 3\n3 1 2 3\n4 1 2 3\n5 7 8 9\n$EndNodeData\n");
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    const auto& attributes = mesh_of(*d).info.attributes;
    ASSERT_EQ(attributes.size(), 2u);
    const Attribute* porosity = find_attribute(attributes, "porosity", AttributeLocation::cell);
    ASSERT_NE(porosity, nullptr);
    ASSERT_TRUE(porosity->no_data.has_value());
    EXPECT_EQ(value_as_double(*porosity, 4), 0.25);
    EXPECT_TRUE(is_no_data(*porosity, value_as_double(*porosity, 3)));
    const Attribute* flow = find_attribute(attributes, "flow", AttributeLocation::point);
    ASSERT_NE(flow, nullptr);
    EXPECT_FALSE(flow->no_data.has_value());
    EXPECT_EQ(value_as_double(*flow, 14), 9);
}

TEST(MshReading, UnknownSectionsAreKept) {
    const auto d = read_text(std::string(two_tets_22()) + "$Comments\nhello $world\n$EndComments\n");
    ASSERT_TRUE(d.ok());
    ASSERT_EQ(mesh_of(*d).info.annotations.size(), 1u);
    EXPECT_EQ(mesh_of(*d).info.annotations[0].value, "$Comments\nhello $world\n");
}

TEST(MshReading, DegenerateElementsAreTold) {
    const auto d = read_text(replaced(two_tets_22(), "3 2 2 7 4 1 2 3", "3 2 2 7 4 1 2 2"));
    ASSERT_TRUE(d.ok());
    const auto f = std::ranges::find(d->findings, "F103", &Finding::code);
    ASSERT_NE(f, d->findings.end());
    EXPECT_EQ(f->elements, std::vector<std::int64_t>{3});
}

TEST(MshReading, HigherOrdersAreReadByTheirCornersAndToldAsLost) {
    const auto d = read_text(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 3 0 0\n3 1 0 0\n4 2 0 0\n$EndNodes\n$Elements\n1\n1 26 2 0 1 1 2 3 "
        "4\n$EndElements\n");
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    EXPECT_EQ(mesh_of(*d).types, std::vector{CellType::line});
    ASSERT_EQ(d->losses.size(), 1u);
    EXPECT_EQ(d->losses[0].loss_class, LossClass::substance);
}

TEST(MshReading, ContentTellsTheFormat) {
    EXPECT_EQ(gmsh::sniff(two_tets_22(), "x"), 100);
    EXPECT_GT(gmsh::sniff("$NOD\n1\n", "x"), 50);
    EXPECT_EQ(gmsh::sniff("GOCAD TSurf 1\n", "x.msh"), 0);
}

std::map<std::string, std::uint64_t> cells_per_group(const CellMesh& m) {
    std::map<std::string, std::uint64_t> count;
    for (const std::uint32_t e : m.cell_entity) {
        for (const std::uint32_t g : m.entities.at(e).groups) ++count[m.groups.at(g).name];
    }
    return count;
}

TEST(MshRealFiles, ToyModelHasItsGroups) {
    const auto path = real_data("gmsh/toy_model.msh");
    if (!path) GTEST_SKIP() << "no real data";
    const auto d = gmsh::read_msh(*Input::open(path->string()), {});
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    EXPECT_EQ(mesh_of(*d).points.size(), 6691u);
    EXPECT_EQ(mesh_of(*d).cell_count(), 44573u);
    const std::map<std::string, std::uint64_t> expected = {
        {"Overburden1", 12255}, {"Overburden2", 5177}, {"Reservoir", 5687}, {"Underburden", 11421}, {"West", 389},
        {"North", 781},         {"East", 393},         {"South", 821},      {"Top", 887},           {"Bot", 879},
        {"Hor1", 1497},         {"Hor2", 1565},        {"Hor3", 1034},      {"Fault1", 1178},       {"Fault2", 609}};
    auto found = cells_per_group(mesh_of(*d));
    // Faults and horizons overlap nowhere, so that each element counts once.
    EXPECT_EQ(found, expected);
}

TEST(MshRealFiles, CubesHaveTheirEntities) {
    for (const char* name : {"gmsh/cube_v22.msh", "gmsh/cube_v41.msh"}) {
        const auto path = real_data(name);
        if (!path) GTEST_SKIP() << "no real data";
        const auto d = gmsh::read_msh(*Input::open(path->string()), {});
        ASSERT_TRUE(d.ok()) << d.why().error.message;
        const CellMesh& m = mesh_of(*d);
        EXPECT_EQ(m.points.size(), 131u);
        EXPECT_EQ(std::ranges::count(m.types, CellType::triangle), 240);
        EXPECT_EQ(std::ranges::count(m.types, CellType::tetrahedron), 364);
        std::array<int, 4> entities{};
        for (const auto& e : m.entities) ++entities[static_cast<std::size_t>(e.dimension)];
        EXPECT_EQ(entities, (std::array{8, 12, 6, 1})) << name;
    }
}

}  // namespace
}  // namespace geomend::test
