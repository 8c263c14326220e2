// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/soup_front.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "topology/assemble.h"
#include "topology/brep_from_dataset.h"
#include "topology/model_maker.h"

namespace geomend {
namespace {

/// The surfaces of a model as patches of one soup over its vertices, with what the model says of them.
topology::SoupModel soup_of(const BrepData& brep) {
    topology::SoupModel model;
    model.name = brep.name;
    model.soup.vertices = brep.vertices;
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        model.patches.push_back({surface.name, brep.interfaces[surface.interface_id.value].name, surface.role, surface.role_text, {}, {}});
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            std::array<std::uint32_t, 3> triangle{};
            for (std::size_t k = 0; k < 3; ++k) triangle[k] = surface.nodes[surface.polygons[p][k]].value;
            model.soup.triangles.push_back(triangle);
            model.soup.patches.push_back(s);
        }
    }
    model.regions.push_back({"Universe", true, brep.universe});
    for (const auto& region : brep.regions) model.regions.push_back({region.name, false, region.sides});
    model.layers.push_back({"Cover", {2}, {}});
    return model;
}

Result<topology::JudgedModel> assembled(topology::SoupModel soup) {
    auto complex = topology::complex_of_soup(std::move(soup));
    if (!complex) return std::move(complex).why();
    return topology::assemble(std::move(*complex), topology::RegionSearch::always);
}

class SoupFront : public testing::Test {
protected:
    void SetUp() override { topology::build_breps(made_.data); }
    const BrepData& brep() { return *made_.data.breps.at(0); }
    test::ModelMaker made_ = test::two_blocks();
};

TEST_F(SoupFront, GivesTheModelThatItsTrianglesCameFrom) {
    const auto model = assembled(soup_of(brep()));
    ASSERT_TRUE(model.ok());
    const BrepData& again = *model->brep;
    EXPECT_EQ(again.corners.size(), brep().corners.size());
    EXPECT_EQ(again.lines.size(), brep().lines.size());
    ASSERT_EQ(again.surfaces.size(), brep().surfaces.size());
    for (std::size_t s = 0; s < again.surfaces.size(); ++s) EXPECT_EQ(again.surfaces[s].name, brep().surfaces[s].name);
    ASSERT_EQ(again.regions.size(), 2u);
    EXPECT_EQ(again.regions[0].name, "Lower");
    EXPECT_DOUBLE_EQ(again.regions[0].volume, 1);
    EXPECT_EQ(again.interfaces.size(), brep().interfaces.size());
    ASSERT_EQ(again.layers.size(), 1u);
    EXPECT_EQ(again.layers[0].regions[0], RegionId(1u));
    EXPECT_TRUE(model->findings.empty());
}

TEST_F(SoupFront, FindsRegionsWhereNoneAreStated) {
    auto soup = soup_of(brep());
    soup.regions.clear();
    const auto model = assembled(std::move(soup));
    ASSERT_TRUE(model.ok());
    EXPECT_EQ(model->brep->regions.size(), 2u);
    EXPECT_DOUBLE_EQ(model->brep->universe_volume, 2);
}

TEST_F(SoupFront, KeepsEmbeddedEdgesAsLinesWithTheirNames) {
    auto soup = soup_of(brep());
    const auto at = [&](const Vec3& p) {
        return static_cast<std::uint32_t>(std::ranges::find(soup.soup.vertices, p) - soup.soup.vertices.begin());
    };
    soup.soup.edges = {{at({0, 0, 1}), at({1, 1, 1})}};  // the diagonal of the horizon
    soup.soup.edge_ids = {0};
    soup.line_names = {"well"};
    const auto model = assembled(std::move(soup));
    ASSERT_TRUE(model.ok());
    EXPECT_EQ(model->brep->lines.size(), brep().lines.size() + 1);
    EXPECT_EQ(std::ranges::count(model->brep->lines, "well", &BrepData::Line::name), 1);
}

TEST_F(SoupFront, CutsAPatchWhereTwoOfItsVerticesAreAtOnePosition) {
    topology::SoupModel model;
    model.patches.resize(1);
    model.soup.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, -1, 0}};
    model.soup.triangles = {{0, 1, 2}, {4, 3, 5}};
    model.soup.patches = {0, 0};
    const auto cut = assembled(model);
    ASSERT_TRUE(cut.ok());
    EXPECT_EQ(cut->brep->vertices.size(), 4u);
    EXPECT_EQ(std::ranges::count_if(cut->brep->surfaces[0].lines, [](const auto& l) { return l.internal; }), 2);
    model.soup.triangles[1] = {1, 0, 5};
    const auto whole = assembled(model);
    ASSERT_TRUE(whole.ok());
    EXPECT_TRUE(std::ranges::none_of(whole->brep->surfaces[0].lines, [](const auto& l) { return l.internal; }));
}

TEST_F(SoupFront, RefusesWhatDoesNotFit) {
    auto soup = soup_of(brep());
    soup.soup.patches[0] = 11;
    EXPECT_FALSE(assembled(soup));
    soup = soup_of(brep());
    soup.soup.triangles[3][1] = 400;
    EXPECT_FALSE(assembled(soup));
    soup = soup_of(brep());
    soup.regions[1].sides.push_back({SurfaceId(11u), true});
    EXPECT_FALSE(assembled(soup));
    soup = soup_of(brep());
    Attribute short_one;
    short_one.name = "short";
    short_one.values = std::vector<double>{1, 2};
    soup.patches[0].attributes.push_back(short_one);
    EXPECT_FALSE(assembled(soup));
}

}  // namespace
}  // namespace geomend
