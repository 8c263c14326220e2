// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "geometry/measures.h"
#include "repair/cell_cleaning.h"
#include "support/program.h"

// Meshes of cells that are cleaned.

namespace geomend {
namespace {

/// Two tetrahedra on both sides of a triangle.
CellMesh two_tetrahedra() {
    CellMesh mesh;
    mesh.info.name = "mesh";
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.add_cell(CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
    mesh.add_cell(CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 2, 1, 4});
    return mesh;
}

TEST(CellCleaning, ASoundMeshStaysAsItIs) {
    CellMesh mesh = two_tetrahedra();
    const auto nodes = mesh.nodes;
    EXPECT_EQ(repair::clean_cells(mesh, 1e-6).changes(), 0u);
    EXPECT_EQ(mesh.nodes, nodes);
}

/// A layer of nx cells of 10 x 10 x 1, of nodes that each cell has for itself.
CellMesh layer_of_cells(int nx) {
    CellMesh mesh;
    for (int i = 0; i < nx; ++i) {
        std::array<std::uint32_t, 8> nodes{};
        for (std::uint32_t k = 0; k < 8; ++k) {
            const double x = 10.0 * (i + (k == 1 || k == 2 || k == 5 || k == 6 ? 1 : 0)), y = k % 4 >= 2 ? 10 : 0, z = k >= 4 ? 1 : 0;
            nodes[k] = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back({x, y, z});
        }
        mesh.add_cell(CellType::hexahedron, nodes);
    }
    return mesh;
}

// As in single precision at map coordinates, where four steps of the northing are two metres.
TEST(CellCleaning, CellsThinnerThanTheToleranceKeepTheirVolume) {
    CellMesh mesh = layer_of_cells(3);
    const auto done = repair::clean_cells(mesh, 2);
    EXPECT_EQ(mesh.cell_count(), 3u);
    EXPECT_EQ(done.merged, 0u) << "nodes of equal positions stay as they are";
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) EXPECT_NEAR(cell_volume(mesh, c), 100, 1e-9);
}

TEST(CellCleaning, NodesOfDifferentCellsWithinTheToleranceAreMergedWhereNoCellIsThin) {
    CellMesh mesh = layer_of_cells(3);
    for (Vec3& p : mesh.points) p[2] *= 5;
    for (std::size_t n = 8; n < 16; ++n) mesh.points[n][1] += 0.01;
    const auto done = repair::clean_cells(mesh, 2);
    EXPECT_EQ(mesh.cell_count(), 3u);
    EXPECT_EQ(done.merged, 8u);
    EXPECT_EQ(done.repeated, 0u);
}

TEST(CellCleaning, CellsOfEachTypeThatAreInsideOutAreTurned) {
    const std::vector<std::pair<CellType, std::vector<Vec3>>> cells = {
        {CellType::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
        {CellType::hexahedron, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
        {CellType::wedge, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
        {CellType::pyramid, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}}},
    };
    for (const auto& [type, points] : cells) {
        for (const double mirror : {1.0, -1.0}) {
            CellMesh mesh;
            std::vector<std::uint32_t> nodes;
            for (const Vec3& p : points) {
                nodes.push_back(static_cast<std::uint32_t>(nodes.size()));
                mesh.points.push_back({p[0], p[1], mirror * p[2]});
            }
            mesh.add_cell(type, nodes);
            const double before = cell_volume(mesh, 0);
            const auto done = repair::clean_cells(mesh, 1e-6);
            EXPECT_EQ(done.turned, before < 0 ? 1u : 0u) << to_string(type);
            EXPECT_NEAR(cell_volume(mesh, 0), std::abs(before), 1e-12) << to_string(type);
        }
    }
}

TEST(CellCleaning, WhatHasNoVolumeUsesANodeTwiceOrIsThereTwiceGoesWithItsValues) {
    CellMesh mesh = two_tetrahedra();
    mesh.add_cell(CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 0, 1, 2});
    mesh.points.push_back({0.25, 0.25, 0});
    mesh.add_cell(CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 5});
    mesh.add_cell(CellType::tetrahedron, std::array<std::uint32_t, 4>{3, 0, 1, 2});
    Attribute porosity;
    porosity.name = "porosity";
    porosity.location = AttributeLocation::cell;
    porosity.values = std::vector<double>{1, 2, 3, 4, 5};
    mesh.info.attributes.push_back(porosity);
    mesh.info.sets.push_back({"some", AttributeLocation::cell, {1, 2, 4}});
    const auto done = repair::clean_cells(mesh, 1e-6);
    EXPECT_EQ(done.repeated, 1u);
    EXPECT_EQ(done.flat, 1u);
    EXPECT_EQ(done.doubles, 1u);
    EXPECT_EQ(done.unused, 1u);
    ASSERT_EQ(mesh.cell_count(), 2u);
    EXPECT_EQ(mesh.points.size(), 5u);
    EXPECT_EQ(std::get<std::vector<double>>(mesh.info.attributes[0].values), (std::vector<double>{1, 2}));
    EXPECT_EQ(mesh.info.sets[0].members, (std::vector<std::uint32_t>{1}));
    EXPECT_NEAR(volume(mesh), 1. / 3, 1e-12);
}

TEST(CellCleaning, NodesThatAreNearlyOneBecomeOneAndEqualOnesStayTwo) {
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1e-8, 0, 0}, {1, 1e-8, 0}, {0, 1, 1e-8}, {0, 0, -1}};
    mesh.add_cell(CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
    mesh.add_cell(CellType::tetrahedron, std::array<std::uint32_t, 4>{4, 6, 5, 7});
    EXPECT_EQ(repair::clean_cells(mesh, 1e-6).merged, 3u);
    EXPECT_EQ(mesh.points.size(), 5u);
    mesh = two_tetrahedra();
    mesh.points.insert(mesh.points.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    std::ranges::copy(std::array<std::uint32_t, 4>{5, 7, 6, 4}, mesh.nodes.begin() + 4);
    EXPECT_EQ(repair::clean_cells(mesh, 1e-6).changes(), 0u) << "parted on purpose, as along a fault";
    EXPECT_EQ(mesh.points.size(), 8u);
}

TEST(CellCleaning, FromFileToFileTheCellsStay) {
    const test::TemporaryFolder folder;
    test::write_file(
        folder / "in.vtk",
        "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n1 1 "
        "1\nCELLS 4 20\n4 0 1 2 3\n4 0 1 2 4\n4 1 2 3 5\n4 5 1 2 3\nCELL_TYPES 4\n10\n10\n10\n10\n");
    const auto run = test::run_geomend({"repair", folder / "in.vtk", "-o", folder / "out.vtk"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("inside out"), std::string::npos) << run.out;
    const auto check = test::run_geomend({"validate", folder / "out.vtk"});
    EXPECT_EQ(check.status, 0) << check.out;
    EXPECT_NE(test::read_file(folder / "out.vtk").find("CELL"), std::string::npos);
}

// Alone it is a matter of the order of nodes; in one mesh with the other it would be an error.
TEST(CellCleaning, OfTwoMeshesTheOneThatIsInsideOutIsTurned) {
    const test::TemporaryFolder folder;
    const auto vtk = [](const std::string& apex) {
        return "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n1 0 0\n0 1 0\n0 0 " + apex +
               "\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
    };
    test::write_file(folder / "a.vtk", vtk("1"));
    test::write_file(folder / "b.vtk", vtk("-1"));
    const auto run = test::run_geomend({"repair", folder / "a.vtk", folder / "b.vtk", "-o", folder / "out.msh"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    const auto check = test::run_geomend({"validate", folder / "out.msh"});
    EXPECT_EQ(check.status, 0) << check.out;
}

// The file states a surface between two regions of cells, and none around them: in a format of surfaces these would be open.
TEST(CellCleaning, RegionsOfCellsGoIntoAModelOfSurfacesWithSurfacesAroundThem) {
    const test::TemporaryFolder folder;
    test::write_file(folder / "in.so",
                     "GOCAD TSolid 1\nHEADER {\nname:ts\n}\nTVOLUME A\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nVRTX 4 0 0 1\n"
                     "TETRA 1 2 3 4\nTVOLUME B\nATOM 5 1\nATOM 6 2\nATOM 7 3\nVRTX 8 0 0 -1\nTETRA 5 7 6 8\n"
                     "MODEL\nSURFACE f\nTFACE 1\nKEYVERTICES 1 2 3\nTRGL 1 2 3\nMODEL_REGION A +1\nMODEL_REGION B -1\nEND\n");
    const auto run = test::run_geomend({"repair", folder / "in.so", "-o", folder / "out.ml", "--lossy"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    const auto check = test::run_geomend({"validate", folder / "out.ml"});
    EXPECT_EQ(check.status, 0) << check.out;
    const auto info = test::run_geomend({"info", "--json", folder / "out.ml"});
    EXPECT_NE(info.out.find("\"regions\": 2"), std::string::npos) << info.out;
}

}  // namespace
}  // namespace geomend
