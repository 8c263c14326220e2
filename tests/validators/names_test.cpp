// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "validators/layered_model.h"
#include "validators/registry.h"

// Names that are used twice, and lists of regions.

namespace geomend {
namespace {

using testing::LayeredModel;
using Codes = std::multiset<std::string>;

/// Codes of family G but for the fault without throw, with the number of things that each is about.
Codes codes_of(const Dataset& data) {
    const auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    Codes codes;
    for (const Finding& f : checked->findings) {
        const char* severity = f.severity == Severity::info ? " info " : " warning ";
        if (f.code[0] == 'G' && f.code != "G03") codes.insert(f.code + severity + std::to_string(f.count));
    }
    return codes;
}

TEST(Names, OfRegionsLayersAndBlocksAreUsedOnce) {
    LayeredModel model;
    EXPECT_EQ(codes_of(model.data()), Codes{});
    auto& stated = model.maker.model();
    stated.regions[3].name = stated.regions[1].name;
    stated.layers[2].name = stated.layers[0].name;
    EXPECT_EQ(codes_of(model.data()), (Codes{"G01 warning 2", "G01 warning 2"}));
    stated.regions[5].name = stated.regions[1].name;
    EXPECT_EQ(codes_of(model.data()), (Codes{"G01 warning 2", "G01 warning 3"}));
}

TEST(Names, OfALayerMayBeThatOfItsRegion) {
    LayeredModel model;
    model.maker.model().layers[0].name = "block_00";
    EXPECT_EQ(codes_of(model.data()), Codes{});
}

TEST(Names, ThatDifferInCaseOnlyAreTold) {
    LayeredModel model;
    model.maker.model().layers[1].name = "Layer_0";
    EXPECT_EQ(codes_of(model.data()), Codes{"G06 warning 2"});
    for (auto& face : model.maker.model().faces) {
        if (face.interface_name == "upper") face.interface_name = "LOWER";
    }
    EXPECT_EQ(codes_of(model.data()), (Codes{"G06 warning 2", "G06 warning 2"}));
}

TEST(Names, OfTwoObjectsOfLooseSurfacesAreTold) {
    Dataset data;
    for (const double z : {0.0, 1.0}) {
        Surface surface;
        surface.info.name = "H1";
        surface.points = {{0, 0, z}, {1, 0, z}, {0, 1, z}};
        surface.polygons.corners = {0, 1, 2};
        data.objects.emplace_back(surface);
    }
    EXPECT_EQ(codes_of(data), Codes{"G01 warning 2"});
    info_of(data.objects[1]).name = "H2";
    EXPECT_EQ(codes_of(data), Codes{});
    info_of(data.objects[0]).name = info_of(data.objects[1]).name = "";
    EXPECT_EQ(codes_of(data), Codes{}) << "no name is no name twice";
}

TEST(Names, OfObjectsThatAModelStatesToBeOneSurfaceMayBeTheSame) {
    test::ModelMaker m;
    for (const double x : {0.0, 1.0}) m.add("H1", FeatureRole::horizon, test::quad({x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}));
    EXPECT_EQ(codes_of(m.data), Codes{});
}

/// Two cubes, each a volume of its own.
CellMesh two_volumes() {
    CellMesh mesh;
    for (int i = 0; i <= 2; ++i) {
        for (const double y : {0.0, 1.0}) {
            for (const double z : {0.0, 1.0}) mesh.points.push_back({double(i), y, z});
        }
    }
    for (std::uint32_t i = 0; i < 2; ++i) {
        const std::uint32_t a = 4 * i, b = a + 4;
        mesh.add_cell(CellType::hexahedron, std::array{a, b, b + 2, a + 2, a + 1, b + 1, b + 3, a + 3});
        mesh.cell_entity.push_back(i);
    }
    mesh.entities.resize(2);
    return mesh;
}

TEST(Names, OfVolumesOfOnePhysicalGroupAreANote) {
    CellMesh mesh = two_volumes();
    mesh.groups = {{3, 1, "Reservoir"}, {3, 2, "Overburden"}};
    mesh.entities[0].groups = mesh.entities[1].groups = {0};
    Dataset data;
    data.objects.emplace_back(mesh);
    EXPECT_EQ(codes_of(data), Codes{"G01 info 2"});
    mesh.groups[1].name = "Reservoir";
    mesh.entities[1].groups = {1};
    data.objects[0] = mesh;
    EXPECT_EQ(codes_of(data), Codes{"G01 warning 2"}) << "two groups of one name";
}

TEST(Lists, HaveEachRegionOnce) {
    LayeredModel model;
    auto& layers = model.maker.model().layers;
    layers[1].regions.push_back(layers[0].regions[0]);
    EXPECT_EQ(codes_of(model.data()), Codes{"G07 warning 1"});
    layers[0].regions.clear();
    layers[1].regions.pop_back();
    EXPECT_EQ(codes_of(model.data()), (Codes{"G02 warning 1", "G07 info 2"}));
    layers.clear();
    EXPECT_EQ(codes_of(model.data()), Codes{}) << "nothing is stated";
}

}  // namespace
}  // namespace geomend
