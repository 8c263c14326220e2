// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/connected_surfaces.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "exchange/model_from_brep.h"
#include "topology/brep_from_dataset.h"

namespace geomend {
namespace {

/// A cube of one hexahedron, whose floor and roof are one set of faces, or two, and its walls another one.
Dataset cube(bool lids_are_one) {
    CellMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.points.push_back({1.0 * (i & 1), 1.0 * (i >> 1 & 1), 1.0 * (i >> 2)});
    for (const auto& [dimension, name] : {std::pair(3, "inside"), {2, "walls"}, {2, "lids"}, {2, "roof"}}) {
        CellMesh::Entity& entity = mesh.entities.emplace_back();
        entity.dimension = dimension;
        entity.tag = static_cast<std::int64_t>(mesh.entities.size());
        entity.name = name;
    }
    const auto add = [&](CellType type, std::vector<std::uint32_t> nodes, std::uint32_t entity) {
        mesh.add_cell(type, nodes);
        mesh.cell_entity.push_back(entity);
    };
    add(CellType::hexahedron, {0, 1, 3, 2, 4, 5, 7, 6}, 0);
    for (const auto& wall : std::vector<std::vector<std::uint32_t>>{{0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}})
        add(CellType::quad, wall, 1);
    add(CellType::quad, {0, 2, 3, 1}, 2);
    add(CellType::quad, {4, 5, 7, 6}, lids_are_one ? 2 : 3);
    Dataset data;
    data.objects.emplace_back(std::move(mesh));
    topology::build_breps(data);
    return data;
}

TEST(ConnectedSurfaces, ASurfaceAtCellsThatIsInPartsIsOneForEachInAModelOfSurfaces) {
    const Dataset data = cube(true);
    ASSERT_EQ(data.breps.size(), 1u);
    EXPECT_EQ(data.breps[0]->surfaces.size(), 2u);
    const auto apart = exchange::with_connected_surfaces(*data.breps[0]);
    ASSERT_TRUE(apart);
    ASSERT_EQ(apart->surfaces.size(), 3u);
    EXPECT_TRUE(Brep::make(*apart));
    EXPECT_EQ(apart->surfaces[1].name, "lids");
    EXPECT_EQ(apart->surfaces[2].name, "lids_2");
    EXPECT_EQ(apart->interfaces.size(), 2u);
    ASSERT_EQ(apart->regions.size(), 1u);
    EXPECT_EQ(apart->regions[0].sides.size(), 3u);
    std::vector<Loss> losses;
    Dataset written = exchange::faced_model(data.breps[0], losses);
    topology::build_breps(written);
    ASSERT_EQ(written.breps.size(), 1u);
    EXPECT_EQ(written.breps[0]->surfaces.size(), 3u);
    EXPECT_NEAR(written.breps[0]->regions[0].volume, 1, 1e-12);
}

TEST(ConnectedSurfaces, SurfacesThatHangTogetherStayAsTheyAre) {
    const Dataset data = cube(false);
    ASSERT_EQ(data.breps.size(), 1u);
    EXPECT_FALSE(exchange::with_connected_surfaces(*data.breps[0]));
}

}  // namespace
}  // namespace geomend
