// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "exchange/prepare_mesh.h"
#include "exchange/target_names.h"
#include "exchange/volume_mesh_of.h"
#include "meshes/cell_samples.h"
#include "topology/brep_from_dataset.h"

namespace geomend {
namespace {

using exchange::prepare;
using exchange::target_names;
using exchange::volume_mesh_of;
using test::mesh_of;
using test::sample_cells;
using test::two_boxes;

VolumeMesh made_of(CellMesh cells, std::vector<Loss>& losses) {
    Dataset data;
    data.objects.emplace_back(std::move(cells));
    topology::build_breps(data);
    const BrepData* model = data.breps.empty() ? nullptr : &*data.breps[0];
    auto mesh = volume_mesh_of(std::get<CellMesh>(data.objects[0]), model, losses);
    EXPECT_TRUE(mesh) << (mesh ? "" : mesh.why().error.message);
    return *mesh;
}

bool has(const std::vector<Loss>& losses, const std::string& entity, const std::string& what) {
    return std::ranges::any_of(losses, [&](const Loss& l) { return l.entity == entity && l.what == what; });
}

const VolumeMeshData::FaceSet& set_of(const VolumeMesh& mesh, const std::string& name) {
    return *std::ranges::find(mesh->face_sets, name, &VolumeMeshData::FaceSet::name);
}

TEST(VolumeMeshOf, PointsThatAreDoubledStayAndTheirFacesArePairs) {
    std::vector<Loss> losses;
    const VolumeMesh mesh = made_of(two_boxes(true), losses);
    EXPECT_EQ(mesh->vertices.size(), 16u);
    ASSERT_EQ(mesh->vertex_origins.size(), 16u);
    EXPECT_EQ(mesh->vertex_origins[12], 1u);
    ASSERT_EQ(mesh->split_pairs.size(), 1u);
    EXPECT_EQ(mesh->split_pairs[0].faces[0].cell, 1u) << "east, in front of the fault";
    EXPECT_EQ(mesh->split_pairs[0].sides[0], FaceSide::footwall);
    EXPECT_EQ(mesh->split_pairs[0].sides[1], FaceSide::hanging_wall);
    EXPECT_TRUE(losses.empty());
}

TEST(VolumeMeshOf, PointsThatAreStatedToBeOneAreOneVertex) {
    CellMesh cells = two_boxes(true);
    cells.alias.assign(16, no_index);
    const std::uint32_t first[] = {1, 2, 6, 5};
    for (std::uint32_t i = 0; i < 4; ++i) cells.alias[12 + i] = first[i];
    std::vector<Loss> losses;
    const VolumeMesh mesh = made_of(cells, losses);
    EXPECT_EQ(mesh->vertices.size(), 12u);
    EXPECT_TRUE(mesh->vertex_origins.empty());
    EXPECT_TRUE(mesh->split_pairs.empty());
    EXPECT_EQ(set_of(mesh, "F_hanging_wall").faces, (std::vector<CellFaceRef>{{0, 3}}));
}

TEST(VolumeMeshOf, CellsWithoutEntitiesAreOneRegionWithAnOutside) {
    CellMesh cells = two_boxes(false);
    cells.entities.clear();
    cells.cell_entity.clear();
    std::vector<Loss> losses;
    const VolumeMesh mesh = made_of(cells, losses);
    EXPECT_EQ(mesh->regions, (std::vector<std::string>{"two boxes"}));
    ASSERT_EQ(mesh->face_sets.size(), 1u);
    EXPECT_EQ(mesh->face_sets[0].name, "two boxes_outside");
    EXPECT_EQ(mesh->face_sets[0].faces.size(), 10u);
}

TEST(VolumeMeshOf, PolygonsThatAreNoFaceOfACellAreListed) {
    CellMesh cells = two_boxes(false);
    cells.add_cell(CellType::triangle, std::vector<std::uint32_t>{0, 2, 6});
    cells.cell_entity.push_back(2);
    std::vector<Loss> losses;
    const VolumeMesh mesh = made_of(cells, losses);
    EXPECT_TRUE(has(losses, "F", "polygons"));
    EXPECT_EQ(set_of(mesh, "F_footwall").faces.size(), 1u);
}

TEST(VolumeMeshOf, ValuesOfCellsGoWithThemThroughSorting) {
    CellMesh cells = two_boxes(false);
    std::swap(cells.cell_entity[0], cells.cell_entity[1]);
    Attribute phi;
    phi.name = "phi";
    phi.location = AttributeLocation::cell;
    phi.no_data = -1;
    phi.values = std::vector<double>{0.25, 0.5, -1, -1, -1};
    cells.info.attributes.push_back(phi);
    std::vector<Loss> losses;
    const VolumeMesh mesh = made_of(cells, losses);
    ASSERT_EQ(mesh->attributes.size(), 1u);
    EXPECT_EQ(std::get<std::vector<double>>(mesh->attributes[0].values), (std::vector<double>{0.5, 0.25}));
    EXPECT_TRUE(losses.empty());
}

TEST(VolumeMeshOf, CellsThatShareAFaceInThreesAreRefused) {
    CellMesh cells = two_boxes(false);
    cells.add_cell(CellType::hexahedron, std::vector<std::uint32_t>{1, 8, 9, 2, 5, 10, 11, 6});
    cells.cell_entity.push_back(1);
    Dataset data;
    std::vector<Loss> losses;
    const auto mesh = volume_mesh_of(cells, nullptr, losses);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.why().kind, FailureKind::cannot_hold);
}

TEST(VolumeMeshOf, PolyhedraAreWoundOutwards) {
    CellMesh cells;
    cells.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    cells.cell_faces = {0};
    cells.face_offsets = {0};
    for (const auto& face : std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}) {
        cells.face_nodes.insert(cells.face_nodes.end(), face.begin(), face.end());
        cells.face_offsets.push_back(cells.face_nodes.size());
    }
    cells.types = {CellType::polyhedron};
    cells.nodes = {0, 1, 2, 3};
    cells.offsets = {0, 4};
    cells.cell_faces.push_back(4);
    std::vector<Loss> losses;
    const VolumeMesh mesh = made_of(cells, losses);
    const auto is_cycle = [](std::vector<std::uint32_t> nodes, const std::vector<std::uint32_t>& of) {
        std::ranges::rotate(nodes, std::ranges::min_element(nodes));
        return nodes == of;
    };
    EXPECT_TRUE(is_cycle(mesh.nodes_of({0, 0}), {0, 2, 1}));
    EXPECT_TRUE(is_cycle(mesh.nodes_of({0, 1}), {0, 1, 3}));
    EXPECT_TRUE(is_cycle(mesh.nodes_of({0, 2}), {1, 2, 3}));
    EXPECT_TRUE(is_cycle(mesh.nodes_of({0, 3}), {0, 3, 2}));
}

TEST(Prepare, AMeshIsSplitAlongFaultsOrJoinedAsTheTargetNeedsIt) {
    std::vector<Loss> losses;
    const MeshNeeds& needs = *find_mesh_needs("code-aster");
    for (const bool is_split : {false, true}) {
        const auto split = prepare(made_of(two_boxes(is_split), losses), needs);
        ASSERT_TRUE(split);
        EXPECT_EQ(split->mesh->vertices.size(), 16u);
        ASSERT_EQ(split->mesh->split_pairs.size(), 1u);
        EXPECT_NE(split->mesh->split_pairs[0].sides[0], split->mesh->split_pairs[0].sides[1]);
        const auto joined = prepare(made_of(two_boxes(is_split), losses), *find_mesh_needs("feflow"));
        ASSERT_TRUE(joined);
        EXPECT_EQ(joined->mesh->vertices.size(), 12u) << "which has no doubled faces";
    }
}

TEST(Prepare, SecondOrderBecomesFirstAndItsNodesAreGone) {
    MeshNeeds needs = *find_mesh_needs("abaqus");
    needs.order = 1;
    for (const auto& cell : sample_cells()) {
        if (!is_second_order(cell.type)) continue;
        std::vector<Loss> losses;
        const auto prepared = prepare(made_of(mesh_of(cell), losses), needs);
        ASSERT_TRUE(prepared);
        EXPECT_EQ(prepared->mesh->blocks[0].type, linear_type(cell.type));
        EXPECT_EQ(prepared->mesh->vertices, cell.corners);
        EXPECT_EQ(prepared->mesh->face_sets.size(), cell.faces.size());
        EXPECT_TRUE(has(prepared->losses, "rock", "nodes on edges"));
    }
}

TEST(Prepare, NamesAreWordsShortEnoughAndStayApart) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(target_names({"Top", "a b", "a_b", "TOP", "7"}, Naming::words, 80), (Names{"Top", "a_b_2", "a_b", "TOP_2", "N_7"}));
    EXPECT_EQ(target_names({"eastern", "easterly", "east", "east"}, Naming::words, 5), (Names{"easte", "eas_2", "east", "eas_3"}));
    EXPECT_EQ(target_names({"R", "R", "R_2", "r"}, Naming::texts, 0), (Names{"R", "R_3", "R_2", "r"}));
    // Sets on the two sides of a surface keep their side.
    EXPECT_EQ(
        target_names({"a_long_fault_name_hanging_wall", "a_long_fault_name_footwall", "a_long_fault_nick_footwall"}, Naming::words, 20),
        (Names{"a_long__hanging_wall", "a_long__footwall", "a_lon_2_footwall"}))
        << "both sides of one name are shortened alike";
    EXPECT_EQ(target_names({"abcdefghijklmno_front", "abcdefghijklmno_back"}, Naming::words, 20), (Names{"abcdefg_front", "abcdefg_back"}));
    EXPECT_EQ(target_names({"fault_front", "fault_back"}, Naming::words, 8), (Names{"fa_front", "fau_back"})) << "no room for more";
    EXPECT_EQ(target_names({"Gr\xc3\xbcn", "a b", ""}, Naming::texts, 3), (Names{"Gr", "a b", "unn"}));
}

}  // namespace
}  // namespace geomend
