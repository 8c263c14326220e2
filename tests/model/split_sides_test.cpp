// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/split_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

namespace geomend::test {
namespace {

/// Two layers of hexahedra over 4 x 4 squares. The face between them is split but for the last column, whose inner edge is the tip; the
/// faces of both sides are stated, in an order that is asked for, those of the last column once.
struct SplitBlock {
    CellMesh mesh;
    std::vector<std::array<std::uint32_t, 4>> above, below, alone;

    std::uint32_t node(int i, int j, int k) const { return static_cast<std::uint32_t>((k * 5 + j) * 5 + i); }
    /// A node of the middle as the cells below have it: its double left of the tip.
    std::uint32_t lower(int i, int j) const { return i < 3 ? static_cast<std::uint32_t>(75 + 3 * j + i) : node(i, j, 1); }

    SplitBlock() {
        for (int k = 0; k < 3; ++k) {
            for (int j = 0; j < 5; ++j) {
                for (int i = 0; i < 5; ++i) mesh.points.push_back({1.0 * i, 1.0 * j, 1.0 * k});
            }
        }
        for (int j = 0; j < 5; ++j) {
            for (int i = 0; i < 3; ++i) mesh.points.push_back({1.0 * i, 1.0 * j, 1.0});
        }
        mesh.entities.resize(2);
        mesh.entities[1].dimension = 2;
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i < 4; ++i) add_column(i, j);
        }
    }

    void add_column(int i, int j) {
        const std::array<std::uint32_t, 4> low{node(i, j, 0), node(i + 1, j, 0), node(i + 1, j + 1, 0), node(i, j + 1, 0)},
            under{lower(i, j), lower(i + 1, j), lower(i + 1, j + 1), lower(i, j + 1)},
            over{node(i, j, 1), node(i + 1, j, 1), node(i + 1, j + 1, 1), node(i, j + 1, 1)},
            high{node(i, j, 2), node(i + 1, j, 2), node(i + 1, j + 1, 2), node(i, j + 1, 2)};
        for (const auto& [bottom, top] : {std::pair(low, under), std::pair(over, high)}) {
            std::vector<std::uint32_t> nodes(bottom.begin(), bottom.end());
            nodes.insert(nodes.end(), top.begin(), top.end());
            mesh.add_cell(CellType::hexahedron, nodes);
            mesh.cell_entity.push_back(0);
        }
        if (under == over) return alone.push_back(under);
        below.push_back(under);
        above.push_back({over[0], over[3], over[2], over[1]});  // each looks out of its cell
    }

    void state(std::vector<std::array<std::uint32_t, 4>> faces) {
        for (const auto& face : faces) {
            mesh.add_cell(CellType::quad, face);
            mesh.cell_entity.push_back(1);
        }
    }
};

bool is_doubled_below(const CellMesh& mesh, std::size_t cell) {
    return std::ranges::any_of(mesh.cell_nodes(cell), [](std::uint32_t n) { return n >= 75; });
}

TEST(SplitSides, OneSideIsKeptAsFarAsItHangsTogetherInAnyOrder) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(seed);
        SplitBlock block;
        std::vector<std::array<std::uint32_t, 4>> faces = block.above;
        faces.insert(faces.end(), block.below.begin(), block.below.end());
        faces.insert(faces.end(), block.alone.begin(), block.alone.end());
        std::mt19937 random(seed);
        std::ranges::shuffle(faces, random);
        block.state(faces);
        const auto side_of = other_sides(block.mesh);
        ASSERT_EQ(side_of.size(), block.mesh.cell_count());
        std::size_t left_out = 0;
        for (std::size_t c = 32; c < side_of.size(); ++c) {
            if (side_of[c] == no_index) continue;
            ++left_out;
            EXPECT_FALSE(is_doubled_below(block.mesh, c)) << "those alone are wound as those below";
            EXPECT_TRUE(is_doubled_below(block.mesh, side_of[c]));
        }
        EXPECT_EQ(left_out, 12u);
    }
}

TEST(SplitSides, WithoutFacesThatAreAloneTheFirstSideIsKept) {
    SplitBlock block;
    block.state(block.above);
    block.state(block.below);
    const auto side_of = other_sides(block.mesh);
    ASSERT_EQ(side_of.size(), block.mesh.cell_count());
    for (std::size_t c = 32; c < side_of.size(); ++c) EXPECT_EQ(side_of[c] == no_index, c < 44);
}

TEST(SplitSides, TwoSurfacesThatAreTheSidesOfASplitAreOneUnderTheFirstName) {
    for (const bool turned : {false, true}) {
        SplitBlock block;
        block.state(block.above);
        block.state(block.below);
        block.mesh.entities.push_back(block.mesh.entities[1]);
        block.mesh.entities[1].name = turned ? "slave" : "master";
        block.mesh.entities[2].name = turned ? "master" : "slave";
        std::fill(block.mesh.cell_entity.begin() + 44, block.mesh.cell_entity.end(), 2);
        const auto side_of = other_sides(block.mesh);
        ASSERT_EQ(side_of.size(), block.mesh.cell_count());
        for (std::size_t c = 32; c < side_of.size(); ++c)
            EXPECT_EQ(side_of[c] == no_index, block.mesh.entities[block.mesh.cell_entity[c]].name == "master") << c;
    }
}

TEST(SplitSides, FacesOnTheFreeBorderThatBothSidesStateWithTheSameNodesAreThereOnce) {
    SplitBlock block;
    block.state(block.above);
    block.state(block.below);
    block.state(block.alone);
    for (auto face : block.alone) {
        std::ranges::reverse(face);
        block.state({face});
    }
    const auto side_of = other_sides(block.mesh);
    ASSERT_EQ(side_of.size(), block.mesh.cell_count());
    EXPECT_EQ(std::ranges::count(side_of, no_index), 32 + 16);
    for (std::size_t c = 32; c < side_of.size(); ++c) EXPECT_EQ(side_of[c] == no_index, c < 44 || c >= 60) << "all looking down: " << c;
}

TEST(SplitSides, FacesOfNoCellsAreNoSides) {
    SplitBlock hollow;
    hollow.mesh.types.clear();
    hollow.mesh.nodes.clear();
    hollow.mesh.offsets = {0};
    hollow.mesh.cell_entity.clear();
    hollow.state(hollow.above);
    hollow.state(hollow.below);
    EXPECT_TRUE(other_sides(hollow.mesh).empty());
}

}  // namespace
}  // namespace geomend::test
