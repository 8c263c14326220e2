// SPDX-License-Identifier: AGPL-3.0-or-later
// Wedges: the first triangle looks into the cell in Gmsh and out of it in VTK, whose order is ours.
#include <gtest/gtest.h>

#include "gmsh/gmsh_support.h"

namespace geomend::test {
namespace {

/// A prism of volume 1/2 as Gmsh numbers it, of first order (type 6) or with the nodes of its edges (type 18).
std::string prism(bool second_order) {
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
    text += second_order ? "15\n" : "6\n";
    text += "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 0 1\n6 0 1 1\n";
    if (second_order) {
        text += "7 0.5 0 0\n8 0 0.5 0\n9 0 0 0.5\n10 0.5 0.5 0\n11 1 0 0.5\n12 0 1 0.5\n13 0.5 0 1\n14 0 0.5 1\n15 0.5 0.5 1\n";
    }
    text += "$EndNodes\n$Elements\n1\n1 ";
    text += second_order ? "18 2 1 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n" : "6 2 1 1 1 2 3 4 5 6\n";
    return text + "$EndElements\n";
}

/// Six volumes of the tetrahedron at the first corner, positive as VTK takes a wedge.
double sign_in_vtk(const CellMesh& mesh) {
    const auto n = mesh.cell_nodes(0);
    const auto& p = mesh.points;
    Vec3 a{}, b{}, c{};
    for (std::size_t k = 0; k < 3; ++k) {
        a[k] = p[n[2]][k] - p[n[0]][k];
        b[k] = p[n[1]][k] - p[n[0]][k];
        c[k] = p[n[3]][k] - p[n[0]][k];
    }
    return c[0] * (a[1] * b[2] - a[2] * b[1]) + c[1] * (a[2] * b[0] - a[0] * b[2]) + c[2] * (a[0] * b[1] - a[1] * b[0]);
}

TEST(Wedges, OfGmshAreTheRightWayRoundForVtk) {
    for (const bool second_order : {false, true}) {
        const auto data = read_text(prism(second_order));
        ASSERT_TRUE(data);
        const CellMesh& mesh = mesh_of(*data);
        EXPECT_GT(sign_in_vtk(mesh), 0);
        if (!second_order) continue;
        // Between which corners the nodes of the edges lie in VTK's quadratic wedge.
        constexpr unsigned ends[9][2] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
        const auto n = mesh.cell_nodes(0);
        for (std::size_t e = 0; e < 9; ++e) {
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(mesh.points[n[6 + e]][k], 0.5 * (mesh.points[n[ends[e][0]]][k] + mesh.points[n[ends[e][1]]][k])) << "edge " << e;
            }
        }
    }
}

TEST(Wedges, GoBackToGmshAsTheyCame) {
    for (const bool second_order : {false, true}) {
        const auto data = read_text(prism(second_order));
        ASSERT_TRUE(data);
        const auto again = read_text(write_text(*data, {{"version", "2.2"}, {"order", "2"}}).bytes);
        ASSERT_TRUE(again);
        EXPECT_EQ(mesh_of(*again).nodes, mesh_of(*data).nodes);
    }
}

TEST(Wedges, OfOtherProgramsAreTurnedByTheirOwnSign) {
    for (const bool second_order : {false, true}) {
        auto data = read_text(prism(second_order));
        ASSERT_TRUE(data);
        data->format = "vtk";
        auto& mesh = std::get<CellMesh>(data->objects.front());
        const auto sound = mesh.nodes;
        constexpr unsigned turned[15] = {0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13};
        for (std::size_t k = 0; k < mesh.nodes.size(); ++k) mesh.nodes[k] = sound[turned[k]];
        ASSERT_LT(sign_in_vtk(mesh), 0);
        const auto again = read_text(write_text(*data, {{"version", "2.2"}, {"order", "2"}}).bytes);
        ASSERT_TRUE(again);
        EXPECT_EQ(mesh_of(*again).nodes, sound);
    }
}

}  // namespace
}  // namespace geomend::test
