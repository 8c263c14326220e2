// SPDX-License-Identifier: AGPL-3.0-or-later
// Models that are stated over faces of several cell meshes.
#include "topology/several_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "topology/brep_from_dataset.h"

namespace geomend {
namespace {

std::set<std::string> names_of_all(const auto& entities) {
    std::set<std::string> names;
    for (const auto& entity : entities) names.insert(entity.name);
    names.erase("");
    return names;
}

TEST(SeveralMeshes, GiveOneModelItsSurfacesLinesCornersAndRegions) {
    Dataset data = test::model_over_two_meshes();
    topology::build_breps(data);
    ASSERT_EQ(data.breps.size(), 1u);
    const BrepData& brep = *data.breps[0];
    EXPECT_EQ(brep.surfaces.size(), 11u);
    ASSERT_EQ(brep.regions.size(), 2u);
    for (std::uint32_t r = 0; r < 2; ++r) {
        EXPECT_EQ(brep.regions[r].source_object, r);
        EXPECT_DOUBLE_EQ(brep.regions[r].volume, 1);
        EXPECT_EQ(brep.regions[r].cell_types.size(), 1u);
        EXPECT_EQ(brep.regions[r].sides.size(), 6u);
    }
    EXPECT_EQ(brep.regions[0].name, "lower cells");
    EXPECT_EQ(brep.regions[1].name, "upper cells");
    EXPECT_EQ(names_of_all(brep.lines), (std::set<std::string>{"lower line", "upper line"}));
    EXPECT_EQ(names_of_all(brep.corners), (std::set<std::string>{"lower corner", "upper corner"}));
    ASSERT_EQ(brep.layers.size(), 1u);
    EXPECT_EQ(brep.layers[0].regions.size(), 2u);
    EXPECT_EQ(std::ranges::count(data.findings, "F113", &Finding::code), 0);
}

// A file may put a point or a line into the entity of a face: it is no polygon.
TEST(SeveralMeshes, HavePolygonsOfThreeCornersAndMoreOnly) {
    Dataset data;
    CellMesh mesh = test::block_mesh("block", 0, false, 0);
    const std::vector<std::uint32_t> point{0}, line{0, 1};
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
        if (mesh.entities[e].dimension != 2) continue;
        mesh.add_cell(CellType::vertex, point);
        mesh.add_cell(CellType::line, line);
        mesh.cell_entity.insert(mesh.cell_entity.end(), 2, e);
    }
    data.objects.emplace_back(std::move(mesh));
    topology::build_breps(data);
    ASSERT_EQ(data.breps.size(), 1u);
    ASSERT_EQ(data.breps[0]->surfaces.size(), 6u);
    for (const auto& surface : data.breps[0]->surfaces) {
        ASSERT_EQ(surface.polygons.size(), 1u);
        EXPECT_EQ(surface.polygons[0].size(), 4u);
    }
}

TEST(SeveralMeshes, HaveNoFaceOverALineOrACorner) {
    for (const std::uint32_t entity : {0u, 1u}) {
        Dataset data = test::model_over_two_meshes();
        data.models[0].faces[2].part = entity;
        topology::build_breps(data);
        ASSERT_EQ(data.breps.size(), 1u);
        for (const auto& surface : data.breps[0]->surfaces) {
            for (std::size_t p = 0; p < surface.polygons.size(); ++p) EXPECT_EQ(surface.polygons[p].size(), 4u) << surface.name;
        }
    }
}

TEST(SeveralMeshes, AreJudgedAsOneModelWhateverTheirOrder) {
    for (const bool turned : {false, true}) {
        Dataset data = test::model_over_two_meshes();
        if (turned) {
            std::swap(data.objects[0], data.objects[1]);
            for (auto& face : data.models[0].faces) face.object = 1 - face.object;
        }
        const auto models = topology::models_to_judge(data, 1e-9);
        ASSERT_TRUE(models.ok());
        ASSERT_EQ(models->size(), 1u);
        const BrepData& brep = *(*models)[0].brep;
        EXPECT_EQ(brep.vertices.size(), 12u + 40u);
        EXPECT_EQ(brep.lines.size(), 20u);
        EXPECT_EQ(brep.corners.size(), 12u);
        EXPECT_EQ((*models)[0].found.regions.size(), 2u);
    }
}

TEST(SeveralMeshes, MayStandBesideSurfaces) {
    Dataset data = test::model_over_two_meshes();
    const auto& mesh = std::get<CellMesh>(data.objects[1]);
    Surface top;
    top.info.name = "top";
    top.points = {mesh.points.end() - 4, mesh.points.end()};
    top.polygons.push_back(std::array<std::uint32_t, 4>{0, 1, 2, 3});
    for (auto& face : data.models[0].faces) {
        if (face.name == "upper high") face.object = 2, face.part = 0;
    }
    data.objects.emplace_back(top);
    topology::build_breps(data);
    ASSERT_EQ(data.breps.size(), 1u);
    EXPECT_EQ(data.breps[0]->surfaces.size(), 11u);
    ASSERT_EQ(data.breps[0]->regions.size(), 2u);
    EXPECT_EQ(data.breps[0]->regions[1].sides.size(), 6u);
}

}  // namespace
}  // namespace geomend
