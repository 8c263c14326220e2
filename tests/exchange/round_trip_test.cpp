// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "exchange/model_from_brep.h"
#include "geometry/predicates.h"
#include "topology/brep_from_dataset.h"
#include "topology/model_maker.h"
#include "topology/weld.h"

namespace geomend {
namespace {

using test::ModelMaker;
using test::two_blocks;

void expect_same_model(const BrepData& a, const BrepData& b) {
    EXPECT_EQ(a.corners.size(), b.corners.size());
    EXPECT_EQ(a.lines.size(), b.lines.size());
    EXPECT_EQ(a.contacts.size(), b.contacts.size());
    EXPECT_EQ(a.internal_lines_of_regions, b.internal_lines_of_regions);
    EXPECT_EQ(a.internal_lines_of_surfaces, b.internal_lines_of_surfaces);
    EXPECT_EQ(a.vertices.size(), b.vertices.size());
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    std::vector<std::string> names_a, names_b;
    for (const auto& i : a.interfaces) names_a.push_back(i.name);
    for (const auto& i : b.interfaces) names_b.push_back(i.name);
    EXPECT_EQ(names_a, names_b);
    ASSERT_EQ(a.regions.size(), b.regions.size());
    for (std::size_t r = 0; r < a.regions.size(); ++r) {
        EXPECT_EQ(a.regions[r].name, b.regions[r].name);
        EXPECT_EQ(a.regions[r].volume_known, b.regions[r].volume_known);
        if (!a.regions[r].volume_known) continue;
        EXPECT_NEAR(a.regions[r].volume, b.regions[r].volume, 1e-12 * a.regions[r].volume);
    }
}

TEST(WayBack, SurfacesOfAModelGiveTheSameModel) {
    auto m = two_blocks();
    topology::build_breps(m.data);
    std::vector<Loss> losses;
    Dataset again = exchange::faced_model(m.data.breps.at(0), losses);
    EXPECT_TRUE(losses.empty());
    topology::build_breps(again);
    expect_same_model(*m.data.breps[0], *again.breps.at(0));
    EXPECT_EQ(again.models[0].layers.size(), 2u);
    for (const Finding& f : again.findings) EXPECT_EQ(f.code, "F111") << f.message;
}

TEST(WayBack, NodesOfOneInterfaceAtOneVertexAreTwins) {
    auto m = two_blocks();
    topology::build_breps(m.data);
    std::vector<Loss> losses;
    const Dataset again = exchange::faced_model(m.data.breps.at(0), losses);
    const auto& south = std::get<Surface>(again.objects.at(3));
    ASSERT_EQ(south.points.size(), 8u);
    ASSERT_EQ(south.alias.size(), 8u);
    EXPECT_EQ(std::count(south.alias.begin(), south.alias.end(), no_index), 6);
    for (std::size_t i = 0; i < 8; ++i) {
        if (south.alias[i] == no_index) continue;
        EXPECT_EQ(south.points[i], south.points[south.alias[i]]);
    }
}

TEST(WayBack, ATaggedMeshGivesTheSameModel) {
    auto m = two_blocks();
    topology::build_breps(m.data);
    std::vector<Loss> losses;
    Dataset again;
    again.objects.emplace_back(exchange::tagged_mesh(m.data.breps.at(0), losses));
    topology::build_breps(again);
    expect_same_model(*m.data.breps[0], *again.breps.at(0));
    const auto& mesh = std::get<CellMesh>(again.objects[0]);
    EXPECT_EQ(std::count_if(mesh.groups.begin(), mesh.groups.end(), [](const auto& g) { return g.dimension == 2; }), 7);
    EXPECT_EQ(std::count_if(mesh.groups.begin(), mesh.groups.end(), [](const auto& g) { return g.dimension == 3; }), 2);
    EXPECT_EQ(losses.size(), 1u) << "layers";
}

TEST(WayBack, ValuesThatDifferAtASharedPointAreListedAsLost) {
    auto m = two_blocks();
    for (std::size_t o : {0u, 3u}) {
        Surface& s = m.surface(o);
        Attribute a;
        a.name = "throw";
        a.values = std::vector<double>(s.points.size(), o == 0 ? 1.0 : 2.0);
        s.info.attributes.push_back(a);
    }
    topology::build_breps(m.data);
    std::vector<Loss> losses;
    const CellMesh mesh = exchange::tagged_mesh(m.data.breps.at(0), losses);
    ASSERT_EQ(mesh.info.attributes.size(), 1u);
    EXPECT_EQ(value_count(mesh.info.attributes[0]), mesh.points.size());
    const auto lost = std::find_if(losses.begin(), losses.end(), [](const Loss& l) { return l.loss_class == LossClass::substance; });
    ASSERT_NE(lost, losses.end());
    EXPECT_EQ(lost->count, 2u) << "bottom and south share two points";
}

/// Two tetrahedra on a shared triangle (E13 of the rules), with twin nodes.
Dataset two_tetrahedra() {
    CellMesh mesh;
    mesh.info.name = "ts";
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    mesh.alias = {no_index, no_index, no_index, no_index, 0, 1, 2, no_index};
    const auto add = [&](CellType type, std::vector<std::uint32_t> nodes, std::uint32_t entity) {
        mesh.add_cell(type, nodes);
        mesh.cell_entity.push_back(entity);
    };
    mesh.entities.resize(3);
    mesh.entities[0].name = "A";
    mesh.entities[1].name = "B";
    mesh.entities[2].dimension = 2;
    mesh.entities[2].tag = 1;
    mesh.entities[2].name = "f";
    add(CellType::tetrahedron, {0, 1, 2, 3}, 0);
    add(CellType::tetrahedron, {4, 6, 5, 7}, 1);
    add(CellType::triangle, {0, 1, 2}, 2);
    Attribute phi;
    phi.name = "phi";
    phi.location = AttributeLocation::cell;
    phi.no_data = -99999;
    phi.values = std::vector<double>{0.25, 0.5, -99999};
    mesh.info.attributes.push_back(phi);
    Dataset data;
    data.objects.emplace_back(std::move(mesh));
    return data;
}

TEST(Cells, RegionsComeFromTheCellsThatFillThem) {
    Dataset data = two_tetrahedra();
    topology::build_breps(data);
    const BrepData& b = *data.breps.at(0);
    ASSERT_EQ(b.regions.size(), 2u);
    EXPECT_EQ(b.vertices.size(), 5u);
    for (const auto& region : b.regions) {
        EXPECT_NEAR(region.volume, 1.0 / 6, 1e-15);
        ASSERT_EQ(region.sides.size(), 1u);
        EXPECT_EQ(region.sides[0].front, region.name == "A");
        ASSERT_EQ(region.attributes.size(), 1u);
        EXPECT_EQ(value_as_double(region.attributes[0], 0), region.name == "A" ? 0.25 : 0.5);
    }
    EXPECT_TRUE(b.surfaces[0].attributes.empty()) << "all of its values are missing";
}

TEST(Cells, ATaggedMeshOfAFilledModelKeepsCellsAndValues) {
    Dataset data = two_tetrahedra();
    topology::build_breps(data);
    std::vector<Loss> losses;
    Dataset again;
    again.objects.emplace_back(exchange::tagged_mesh(data.breps.at(0), losses));
    topology::build_breps(again);
    expect_same_model(*data.breps[0], *again.breps.at(0));
    EXPECT_EQ(value_as_double(again.breps[0]->regions[1].attributes.at(0), 0), 0.5);
}

TEST(Properties, CountsDoNotDependOnOrderOrScale) {
    std::mt19937 random(7);
    for (int round = 0; round < 30; ++round) {
        auto m = two_blocks();
        for (Object& o : m.data.objects) {
            Surface& s = std::get<Surface>(o);
            for (Vec3& p : s.points) {
                for (double& x : p) x = std::ldexp(x, round - 15);
            }
            if (!s.parts.empty()) continue;
            std::vector<std::uint32_t> place(s.points.size());
            for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
            std::shuffle(place.begin(), place.end(), random);
            auto points = s.points;
            for (std::size_t i = 0; i < place.size(); ++i) points[place[i]] = s.points[i];
            s.points = points;
            for (std::uint32_t& c : s.polygons.corners) c = place[c];
            std::vector<std::array<std::uint32_t, 3>> triangles;
            for (std::size_t p = 0; p < s.polygons.size(); ++p) {
                const auto t = s.polygons[p];
                triangles.push_back({t[round % 3], t[(round + 1) % 3], t[(round + 2) % 3]});
            }
            std::shuffle(triangles.begin(), triangles.end(), random);
            s.polygons = {};
            for (const auto& t : triangles) s.polygons.push_back(t);
        }
        for (auto& face : m.model().faces) face.key.reset();
        if (round % 2 == 1) m.model().regions.clear();
        topology::build_breps(m.data);
        const BrepData& b = *m.data.breps.at(0);
        EXPECT_EQ(b.corners.size(), 12u);
        EXPECT_EQ(b.lines.size(), 20u);
        EXPECT_EQ(b.contacts.size(), 16u);
        ASSERT_EQ(b.regions.size(), 2u);
        EXPECT_DOUBLE_EQ(b.regions[0].volume, std::ldexp(1.0, 3 * (round - 15)));
        std::shuffle(m.data.findings.begin(), m.data.findings.end(), random);
    }
}

TEST(Orientation, IsExactWhereRoundingWouldDecide) {
    const Vec3 a{0.5, 0.5, 0.5}, b{12, 12, 12}, c{24, 24, 24.000000000000004};
    for (int i = -3; i <= 3; ++i) {
        Vec3 d{0.5 + 1e9, 0.5 + 1e9, 0.5 + 1e9};
        d[0] = std::nextafter(d[0], i < 0 ? 0 : 1e10);
        if (i == 0) d[0] = d[1];
        const int sign = orientation(a, b, c, d);
        EXPECT_EQ(sign, -orientation(b, a, c, d));
        EXPECT_EQ(sign == 0, i == 0);
    }
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
}

TEST(Weld, GrowsBeyondWhatWasExpected) {
    topology::Welder welder(2);
    for (int i = 0; i < 1000; ++i) EXPECT_EQ(welder.add({double(i), -0.0, 1}), std::uint32_t(i));
    for (int i = 0; i < 1000; ++i) EXPECT_EQ(welder.add({double(i), 0.0, 1}), std::uint32_t(i));
    EXPECT_EQ(welder.find({-1, 0, 0}), no_index);
}

}  // namespace
}  // namespace geomend
