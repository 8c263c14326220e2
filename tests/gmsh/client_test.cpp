// SPDX-License-Identifier: AGPL-3.0-or-later
// The client gmsh makes files of every version for us to read, and reads the files that we write.
#include <algorithm>
#include <cstdlib>
#include <map>
#include <span>

#include "gmsh_support.h"

namespace geomend::test {
namespace {

bool has_gmsh() { return std::system("command -v gmsh >/dev/null 2>&1") == 0; }

const char* box_geo() {
    return "lc=0.6;Point(1)={0,0,0,lc};Point(2)={1,0,0,lc};Point(3)={1,1,0,lc};Point(4)={0,1,0,lc};\n"
           "Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};Curve Loop(1)={1,2,3,4};Plane Surface(1)={1};\n"
           "Extrude{0,0,1}{Surface{1};}\nPhysical Volume(\"rock\")={1};Physical Surface(\"floor\")={1};\n";
}

const char* hex_geo() {
    return "lc=0.6;Point(1)={0,0,0,lc};Point(2)={1,0,0,lc};Point(3)={1,1,0,lc};Point(4)={0,1,0,lc};\n"
           "Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};Curve Loop(1)={1,2,3,4};Plane Surface(1)={1};\n"
           "Transfinite Surface{1};Recombine Surface{1};Extrude{0,0,1}{Surface{1};Layers{2};Recombine;}\n";
}

int gmsh_counts(const std::filesystem::path& file, const std::filesystem::path& log, std::size_t& nodes, std::size_t& elements) {
    const int status = std::system(("gmsh -check '" + file.string() + "' > '" + log.string() + "' 2>&1").c_str());
    const std::string text = read_file(log);
    EXPECT_EQ(text.find("Error"), std::string::npos) << text;
    const auto number_before = [&](const std::string& word) -> std::size_t {
        const std::size_t at = text.find(word);
        if (at == std::string::npos) return 0;
        const std::size_t start = text.rfind(' ', at - 1);
        return static_cast<std::size_t>(std::strtoull(text.c_str() + start, nullptr, 10));
    };
    nodes = number_before(" nodes");
    elements = number_before(" elements");
    return status;
}

TEST(GmshClient, EveryVersionOfTheClientIsReadAlike) {
    if (!has_gmsh()) GTEST_SKIP() << "gmsh is not installed";
    const TemporaryFolder folder;
    write_file(folder / "box.geo", box_geo());
    std::size_t expected = 0;
    for (const std::string how : {"msh1", "msh22", "msh22 -bin", "msh40", "msh41", "msh41 -bin", "msh41 -order 2", "msh22 -bin -order 2"}) {
        const auto file = folder / "box.msh";
        ASSERT_EQ(
            std::system(
                ("gmsh -3 '" + (folder / "box.geo").string() + "' -format " + how + " -o '" + file.string() + "' >/dev/null 2>&1").c_str()),
            0);
        const auto d = gmsh::read_msh(*Input::open(file.string()), {});
        ASSERT_TRUE(d.ok()) << how << d.why().error.message;
        const CellMesh& m = mesh_of(*d);
        if (expected == 0) expected = m.cell_count();
        EXPECT_EQ(m.cell_count(), expected) << how;
        ASSERT_EQ(m.groups.size(), 2u);
        const auto volume = std::ranges::find(m.entities, 3, &CellMesh::Entity::dimension);
        ASSERT_NE(volume, m.entities.end());
        if (how != "msh1") {
            EXPECT_EQ(volume->name, "rock") << how;
        }
    }
}

TEST(GmshClient, SecondOrderNodesStandInTheOrderOfVtk) {
    if (!has_gmsh()) GTEST_SKIP() << "gmsh is not installed";
    const TemporaryFolder folder;
    for (const char* geo : {box_geo(), hex_geo()}) {
        write_file(folder / "a.geo", geo);
        const std::string command = "gmsh -3 '" + (folder / "a.geo").string() + "' -order 2 -setnumber Mesh.SecondOrderLinear 1 -save_all ";
        ASSERT_EQ(std::system((command + "-format msh41 -o '" + (folder / "a.msh").string() + "' >/dev/null 2>&1").c_str()), 0);
        const auto d = gmsh::read_msh(*Input::open((folder / "a.msh").string()), {});
        ASSERT_TRUE(d.ok());
        const CellMesh& m = mesh_of(*d);
        // End corners of the middle nodes, edge by edge as VTK numbers them.
        const std::map<CellType, std::vector<std::array<int, 2>>> edges = {
            {CellType::quadratic_tetrahedron, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
            {CellType::triquadratic_hexahedron,
             {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}}};
        const std::vector<std::array<int, 4>> hex_faces = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                                           {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
        std::size_t checked = 0;
        for (std::size_t cell = 0; cell < m.cell_count(); ++cell) {
            const auto known = edges.find(m.types[cell]);
            if (known == edges.end()) continue;
            const auto n = m.cell_nodes(cell);
            const auto expect_middle = [&](std::size_t at, std::span<const int> corners) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    double middle = 0;
                    for (const int c : corners) middle += m.points[n[static_cast<std::size_t>(c)]][axis];
                    EXPECT_NEAR(m.points[n[at]][axis], middle / static_cast<double>(corners.size()), 1e-9);
                }
                ++checked;
            };
            const std::size_t corners = node_count(linear_type(m.types[cell]));
            for (std::size_t e = 0; e < known->second.size(); ++e) expect_middle(corners + e, known->second[e]);
            if (m.types[cell] == CellType::triquadratic_hexahedron) {
                for (std::size_t f = 0; f < hex_faces.size(); ++f) expect_middle(20 + f, hex_faces[f]);
            }
        }
        EXPECT_GT(checked, 0u);
    }
}

TEST(GmshClient, TheClientReadsWhatWeWriteWithTheSameCounts) {
    if (!has_gmsh()) GTEST_SKIP() << "gmsh is not installed";
    const TemporaryFolder folder;
    auto d = read_text(two_tets_41());
    auto& mesh = std::get<CellMesh>(d->objects[0]);
    mesh.info.name = std::string(700, '$') + "\"quoted\"";
    mesh.groups[0].name = "a \"very\" " + std::string(200, 'n') + "\nname";
    Attribute a;
    a.name = "p \"q\"";
    a.location = AttributeLocation::point;
    a.components = 2;
    a.values = std::vector<double>(10, 0.5);
    mesh.info.attributes.push_back(a);
    for (const char* version : {"2.2", "4.1"}) {
        for (const char* binary : {"no", "yes"}) {
            const Written w = write_text(*d, {{"version", version}, {"binary", binary}});
            write_file(folder / "out.msh", w.bytes);
            std::size_t nodes = 0, elements = 0;
            EXPECT_EQ(gmsh_counts(folder / "out.msh", folder / "log", nodes, elements), 0);
            EXPECT_EQ(nodes, 5u) << version << binary;
            EXPECT_EQ(elements, 5u) << version << binary;
            const auto back = read_text(w.bytes);
            ASSERT_TRUE(back.ok());
            EXPECT_EQ(mesh_of(*back).info.name, mesh.info.name);
            EXPECT_EQ(mesh_of(*back).groups[0].name, mesh.groups[0].name);
            EXPECT_EQ(mesh_of(*back).info.attributes[0].name, a.name);
        }
    }
}

}  // namespace
}  // namespace geomend::test
