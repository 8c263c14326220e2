// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/recombine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "hexes/lattice_meshes.h"
#include "model/cell_faces.h"

namespace geomend::hexes {
namespace {

// What is protected is swallowed by no cell (Botella 2016, 3.3.4).

/// How many cells of a mesh have two vertices, and how many of them have an edge between them.
std::array<int, 2> cells_at_edge(const VolumeMeshData& d, std::uint32_t a, std::uint32_t b) {
    std::array<int, 2> counts{};
    for (const VolumeMeshData::Block& block : d.blocks) {
        for (std::size_t c = block.first; c < block.first + block.count; ++c) {
            const auto nodes = d.nodes_of(c);
            const auto has = [&](std::uint32_t v) { return std::ranges::find(nodes, v) != nodes.end(); };
            if (!has(a) || !has(b)) continue;
            ++counts[0];
            bool is_edge = false;
            for (const LocalFace& face : faces_of(block.type)) {
                const auto local = face.corners();
                for (std::size_t k = 0; k < local.size(); ++k) {
                    const std::uint32_t p = nodes[local[k]], q = nodes[local[(k + 1) % local.size()]];
                    is_edge = is_edge || (p == a && q == b) || (p == b && q == a);
                }
            }
            counts[1] += is_edge ? 1 : 0;
        }
    }
    return counts;
}

/// The faces that have just these corners.
std::vector<CellFaceRef> faces_with(const VolumeMeshData& d, const std::array<std::uint32_t, 3>& corners) {
    std::vector<CellFaceRef> found;
    for (const VolumeMeshData::Block& block : d.blocks) {
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
            std::uint32_t number = 0;
            for (const LocalFace& face : faces_of(block.type)) {
                const auto local = face.corners();
                const auto is_one = [&](auto k) { return std::ranges::find(corners, d.nodes_of(c)[k]) != corners.end(); };
                if (local.size() == 3 && std::ranges::all_of(local, is_one)) found.push_back({c, number});
                ++number;
            }
        }
    }
    return found;
}

/// A brick of eight cubes with something to protect in it, made of cells in each way there is.
class ProtectedInABrick : public testing::Test {
protected:
    template <class Protect, class Judge>
    void each_way(const Protect& protect, const Judge& judge) {
        for (const Closing closing : {Closing::open, Closing::split}) {
            for (std::size_t rule = 0; rule < heuristic_names.size(); ++rule) {
                SCOPED_TRACE(heuristic_names[rule]);
                VolumeMeshData d = test::mesh_data(brick_.points, test::kuhn_tets(brick_));
                protect(d);
                const auto mesh = VolumeMesh::make(std::move(d));
                ASSERT_TRUE(mesh);
                RecombineOptions options;
                options.closing = closing;
                options.select = static_cast<Heuristic>(rule);
                RecombineReport report;
                const auto made = recombine(*mesh, options, report);
                ASSERT_TRUE(made);
                judge(**made);
                EXPECT_LT(report.count_of(CellType::hexahedron), 8u);
                if (closing == Closing::open && rule == 0) {
                    EXPECT_GE(report.count_of(CellType::hexahedron), 5u);
                }
            }
        }
    }
    void keeps_edge(std::uint32_t a, std::uint32_t b) {
        const auto protect = [&](VolumeMeshData& d) { d.edge_sets.push_back({"well", {{a, b}}}); };
        each_way(protect, [&](const VolumeMeshData& made) {
            const auto [with, as_edge] = cells_at_edge(made, a, b);
            EXPECT_GT(with, 0);
            EXPECT_EQ(with, as_edge);
        });
    }

    test::Lattice brick_ = test::lattice({2, 2, 2});
    std::array<std::uint32_t, 8> cube_ = brick_.cube(0, 0, 0);
};

TEST_F(ProtectedInABrick, AMainDiagonalStaysAnEdge) { keeps_edge(cube_[0], cube_[6]); }

TEST_F(ProtectedInABrick, DiagonalsOfFacesStayEdges) {
    keeps_edge(cube_[1], cube_[6]);  // between two cubes
    keeps_edge(cube_[0], cube_[2]);  // at the end
}

TEST_F(ProtectedInABrick, AFacetInsideStaysAFaceOfTwoCells) {
    // In the plane between two cubes, and in the middle of a cube.
    for (const auto& facet : {std::array{cube_[1], cube_[2], cube_[6]}, std::array{cube_[0], cube_[2], cube_[6]}}) {
        const auto protect = [&](VolumeMeshData& d) {
            const auto faces = faces_with(d, facet);
            ASSERT_EQ(faces.size(), 2u);
            d.surfaces.push_back("facet");
            d.face_sets.push_back({"facet", FeatureRole::unknown, FaceSide::front, 0, {faces[0]}});
        };
        each_way(protect, [&](const VolumeMeshData& made) { EXPECT_EQ(faces_with(made, facet).size(), 2u); });
    }
}

}  // namespace
}  // namespace geomend::hexes
