// SPDX-License-Identifier: AGPL-3.0-or-later
// Surfaces in meshes of cells: faces of the cells, beside them, on them with triangles of their own, through them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "cell_blocks.h"

namespace geomend {
namespace {

using namespace testing;

constexpr std::array kinds_of_cells = {Kind::hexahedra, Kind::wedges, Kind::tetrahedra};

/// A block 100 wide of n x n x n cubes and a level square from `low`, of m x m squares with nodes of its own: two triangles each, or not.
CellMesh block_with_square(Kind kind, const Vec3& low, double size, std::uint32_t m, bool triangles) {
    CellMesh mesh;
    add_block(mesh, {0, 0, 0}, 100, 4, kind);
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (std::uint32_t j = 0; j <= m; ++j)
        for (std::uint32_t i = 0; i <= m; ++i) mesh.points.push_back({low[0] + i * size / m, low[1] + j * size / m, low[2]});
    for (std::uint32_t j = 0; j < m; ++j) {
        for (std::uint32_t i = 0; i < m; ++i) {
            const std::uint32_t a = first + j * (m + 1) + i, b = a + 1, c = b + m + 1, d = a + m + 1;
            if (triangles) {
                mesh.add_cell(CellType::triangle, std::array{a, b, c});
                mesh.add_cell(CellType::triangle, std::array{a, c, d});
            } else {
                mesh.add_cell(CellType::quad, std::array{a, b, c, d});
            }
        }
    }
    return mesh;
}

TEST(SurfacesInCells, FacesAndHalvesOfFacesBelongToTheCells) {
    for (const Kind kind : kinds_of_cells) {
        for (const bool triangles : {false, true}) {
            for (const double z : {0.0, 25.0, 50.0, 100.0}) {
                EXPECT_EQ(codes_in_all_frames(block_with_square(kind, {0, 0, z}, 100, 4, triangles)), Codes{})
                    << int(kind) << ' ' << triangles << ' ' << z;
            }
        }
    }
}

TEST(SurfacesInCells, ThoseThroughCellsAreCounted) {
    for (const Kind kind : kinds_of_cells) {
        EXPECT_EQ(codes_in_all_frames(block_with_square(kind, {0, 0, 30}, 100, 4, true)), (Codes{{"M39", 32}}));
        EXPECT_EQ(codes_in_all_frames(block_with_square(kind, {10, 10, 30}, 80, 2, false)), (Codes{{"M39", 4}}));
        EXPECT_EQ(codes_in_all_frames(block_with_square(kind, {-400, -400, 30}, 900, 1, false)), (Codes{{"M39", 1}})) << "around the block";
        EXPECT_EQ(codes_in_all_frames(block_with_square(kind, {5, 5, 30}, 2, 1, false)), (Codes{{"M39", 1}})) << "inside of one cell";
        EXPECT_EQ(codes_in_all_frames(block_with_square(kind, {50, 50, 100 - 1e-3}, 20, 1, false)), (Codes{{"M39", 1}}))
            << "just below the top";
    }
}

TEST(SurfacesInCells, ThoseAcrossCellsByTheirDiagonalsAreCounted) {
    for (const Kind kind : {Kind::hexahedra, Kind::wedges}) {
        for (const std::uint32_t m : {1u, 4u, 7u}) {  // upright, from one edge of the block to that opposite to it
            CellMesh mesh = block_with_square(kind, {0, 0, 0}, 100, m, true);
            const std::size_t first = mesh.points.size() - (m + 1) * (m + 1);
            for (std::size_t i = first; i < mesh.points.size(); ++i) {
                const double along = mesh.points[i][0], up = mesh.points[i][1];
                mesh.points[i] = kind == Kind::hexahedra ? Vec3{along, along, up} : Vec3{along, 100 - along, up};
            }
            EXPECT_EQ(codes_in_all_frames(mesh), (Codes{{"M39", 2 * m * m}})) << int(kind) << ' ' << m;
        }
    }
}

TEST(SurfacesInCells, ThoseOnCellsWithTrianglesOfTheirOwnAreCounted) {
    for (const Kind kind : kinds_of_cells) {
        for (const double z : {0.0, 50.0, 100.0})
            EXPECT_EQ(codes_in_all_frames(block_with_square(kind, {0, 0, z}, 100, 3, true)), (Codes{{"M39", 18}})) << int(kind) << ' ' << z;
        EXPECT_EQ(codes_in_all_frames(block_with_square(kind, {0, 0, 100}, 200, 8, false)), Codes{})
            << "beyond the block they are clear of it";
    }
}

TEST(SurfacesInCells, ThoseThatUseANodeTwiceOrCrossThemselvesAreNoFaces) {
    for (const Kind kind : kinds_of_cells) {
        for (const double z : {50.0, 130.0}) {  // on faces, and clear of all cells
            CellMesh mesh = block_with_square(kind, {0, 0, z}, 100, 4, true);
            const std::size_t last = mesh.nodes.size() - 1;
            mesh.nodes[last] = mesh.nodes[last - 1];
            EXPECT_EQ(codes_in_all_frames(mesh), (Codes{{"M39", 1}})) << int(kind) << ' ' << z;
        }
    }
    CellMesh mesh = block_with_square(Kind::hexahedra, {0, 0, 50}, 100, 4, false);
    const std::size_t end = mesh.nodes.size();
    std::swap(mesh.nodes[end - 1], mesh.nodes[end - 2]);
    EXPECT_EQ(codes_in_all_frames(mesh), (Codes{{"M39", 1}})) << "a bow-tie";
    std::rotate(mesh.nodes.end() - 8, mesh.nodes.end() - 7, mesh.nodes.end() - 4);
    std::reverse(mesh.nodes.end() - 8, mesh.nodes.end() - 4);
    EXPECT_EQ(codes_in_all_frames(mesh), (Codes{{"M39", 1}})) << "any turning of the others is a face";
}

TEST(SurfacesInCells, NodesOfTheirOwnThatAreTheSameWithinTheToleranceMatch) {
    for (const Kind kind : kinds_of_cells) {
        Codes codes = codes_of(block_with_square(kind, {1e-6, -1e-6, 50 + 1e-6}, 100, 4, true));
        EXPECT_EQ(codes.count("M27"), 1u) << "that they are not one node is told";
        EXPECT_EQ(codes.count("M39"), 0u);
    }
}

TEST(SurfacesInCells, ThoseClearOfAllCellsAreFine) {
    for (const Kind kind : kinds_of_cells) {
        EXPECT_EQ(codes_in_all_frames(block_with_square(kind, {0, 0, 130}, 100, 3, true)), Codes{});
        EXPECT_EQ(codes_in_all_frames(block_with_square(kind, {100, 0, 30}, 100, 3, true)), Codes{}) << "it ends on a side of the block";
    }
}

}  // namespace
}  // namespace geomend
