// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "topology/brep_from_dataset.h"
#include "topology/model_maker.h"

namespace geomend {
namespace {

using test::box;
using test::count_code;
using test::ModelMaker;
using test::quad;
using test::Triangle;
using test::two_blocks;

Vec3 at(double x, double y, double z) { return {x, y, z}; }

const BrepData& built(Dataset& data) {
    topology::build_breps(data);
    EXPECT_EQ(data.breps.size(), 1u);
    return *data.breps.at(0);
}

void expect_counts(const BrepData& b, std::size_t corners, std::size_t lines, std::size_t surfaces, std::size_t regions) {
    EXPECT_EQ(b.corners.size(), corners);
    EXPECT_EQ(b.lines.size(), lines);
    EXPECT_EQ(b.surfaces.size(), surfaces);
    EXPECT_EQ(b.regions.size(), regions);
}

TEST(MadeModels, TwoBlocksHaveTheirCountsVolumesAndContacts) {
    auto m = two_blocks();
    const BrepData& b = built(m.data);
    expect_counts(b, 12, 20, 11, 2);
    EXPECT_EQ(b.vertices.size(), 12u);
    EXPECT_EQ(b.interfaces.size(), 7u);
    EXPECT_DOUBLE_EQ(b.regions[0].volume, 1);
    EXPECT_DOUBLE_EQ(b.regions[1].volume, 1);
    EXPECT_DOUBLE_EQ(b.universe_volume, 2);
    EXPECT_EQ(b.layers.size(), 2u);
    // 4 below, 4 above, 4 around the middle, and one for each upright edge (two lines each)
    EXPECT_EQ(b.contacts.size(), 16u);
    EXPECT_EQ(count_code(m.data, "F113"), 0u);
    EXPECT_EQ(count_code(m.data, "F111"), 1u);
}

TEST(MadeModels, StatedSignsOfTheOtherConventionAreUnderstood) {
    auto m = two_blocks();
    for (auto& region : m.model().regions) {
        for (auto& side : region.sides) side.front = !side.front;
    }
    const BrepData& b = built(m.data);
    EXPECT_DOUBLE_EQ(b.regions[0].volume, 1);
    EXPECT_EQ(count_code(m.data, "F113"), 0u);
    for (const auto& side : b.regions[0].sides) EXPECT_EQ(side.front, false) << "the skin's normals point outwards";
}

TEST(MadeModels, OneSideStatedTheWrongWayIsFoundAndTurned) {
    auto m = two_blocks();
    for (auto& region : m.model().regions) {
        for (auto& side : region.sides) {
            if (side.face == 2) side.front = !side.front;  // the horizon
        }
    }
    const BrepData& b = built(m.data);
    EXPECT_DOUBLE_EQ(b.regions[0].volume, 1);
    EXPECT_DOUBLE_EQ(b.regions[1].volume, 1);
    EXPECT_EQ(count_code(m.data, "F113"), 2u) << "one for each of its two regions";
}

TEST(MadeModels, AReversedKeyTriangleReversesItsSign) {
    auto m = two_blocks();
    auto& key = *m.model().faces[2].key;
    std::swap(key[1], key[2]);
    for (auto& region : m.model().regions) {
        for (auto& side : region.sides) {
            if (side.face == 2) side.front = !side.front;
        }
    }
    const BrepData& b = built(m.data);
    EXPECT_DOUBLE_EQ(b.regions[0].volume, 1);
    EXPECT_EQ(count_code(m.data, "F106"), 1u);
    EXPECT_EQ(count_code(m.data, "F113"), 0u);
}

TEST(MadeModels, AKeyTriangleThatIsNotThereIsTold) {
    auto m = two_blocks();
    m.model().faces[0].key = Triangle{at(0, 0, 0), at(5, 0, 0), at(0, 5, 0)};
    built(m.data);
    EXPECT_EQ(count_code(m.data, "F116"), 1u);
}

TEST(MadeModels, RegionsAreFoundWhereNoneIsStated) {
    auto m = two_blocks();
    m.model().regions.clear();
    m.model().layers.clear();
    const BrepData& b = built(m.data);
    expect_counts(b, 12, 20, 11, 2);
    EXPECT_DOUBLE_EQ(b.regions[0].volume, 1);
    EXPECT_DOUBLE_EQ(b.regions[1].volume, 1);
    EXPECT_DOUBLE_EQ(b.universe_volume, 2);
    EXPECT_EQ(b.universe.size(), 10u);
}

TEST(MadeModels, ABoxInsideABoxMakesAHoleInTheRegionAround) {
    ModelMaker m;
    m.add("outer", FeatureRole::boundary, box(at(0, 0, 0), at(4, 4, 4)));
    m.add("inner", FeatureRole::intrusion, box(at(1, 1, 1), at(2, 2, 2)));
    m.add("loose", FeatureRole::fault, quad(at(3, 3, 1), at(3.5, 3, 1), at(3.5, 3, 2), at(3, 3, 2)));
    const BrepData& b = built(m.data);
    expect_counts(b, 1, 1, 3, 2);
    EXPECT_DOUBLE_EQ(b.regions[0].volume, 63);
    EXPECT_DOUBLE_EQ(b.regions[1].volume, 1);
    EXPECT_EQ(b.regions[0].sides.size(), 4u) << "outer skin, outside of the inner one, both sides of the loose sheet";
    EXPECT_EQ(b.internal_lines_of_regions, 1u);
    EXPECT_DOUBLE_EQ(b.universe_volume, 64);
}

TEST(MadeModels, ABodyThatHangsInACornerByOnePointIsInside) {
    // Whichever of its points comes first: the one in the corner sees the box under an eighth of all directions only.
    const std::vector<Triangle> body = {{at(0, 0, 0), at(2, 2, 1), at(2, 1, 2)},
                                        {at(0, 0, 0), at(2, 1, 2), at(1, 2, 2)},
                                        {at(0, 0, 0), at(1, 2, 2), at(2, 2, 1)},
                                        {at(2, 2, 1), at(1, 2, 2), at(2, 1, 2)}};
    for (std::size_t first = 0; first < 12; ++first) {
        auto turned = body;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first / 3), turned.end());
        std::rotate(turned[0].begin(), turned[0].begin() + static_cast<std::ptrdiff_t>(first % 3), turned[0].end());
        ModelMaker m;
        m.add("outer", FeatureRole::boundary, box(at(0, 0, 0), at(4, 4, 4)));
        m.add("body", FeatureRole::intrusion, turned);
        const BrepData& b = built(m.data);
        expect_counts(b, 0, 0, 2, 2);
        EXPECT_NEAR(b.regions[0].volume + b.regions[1].volume, 64, 1e-12) << "point " << first << " first";
        EXPECT_EQ(b.regions[0].sides.size(), 2u);
        EXPECT_DOUBLE_EQ(b.universe_volume, 64);
    }
}

TEST(MadeModels, LooseSquaresHaveOneCornerAndOneLineEach) {
    ModelMaker m;
    m.add("a", FeatureRole::boundary, quad(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)));
    m.add("b", FeatureRole::boundary, quad(at(0, 0, 5), at(1, 0, 5), at(1, 1, 5), at(0, 1, 5)));
    m.region("Universe", {1, -1, 2, -2});
    const BrepData& b = built(m.data);
    expect_counts(b, 2, 2, 2, 0);
    EXPECT_TRUE(b.lines[0].closed());
    EXPECT_EQ(b.lines[0].vertices.size(), 5u);
}

TEST(MadeModels, AClosedLineHasItsCornerWhereTheFileStatesABorderCorner) {
    ModelMaker m;
    m.add("a", FeatureRole::boundary, quad(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)));
    m.surface(0).border_corners = {2};
    const BrepData& b = built(m.data);
    EXPECT_EQ(b.vertices[b.corners[0].vertex.value], at(1, 1, 0));
}

TEST(MadeModels, ASurfaceAroundABoxMeetsItInOneClosedLine) {
    // The lower and upper half of a box's skin, and a lid between them.
    ModelMaker m;
    const auto ring = [](double z0, double z1) {
        return test::joined(
            {quad(at(0, 0, z0), at(1, 0, z0), at(1, 0, z1), at(0, 0, z1)), quad(at(1, 0, z0), at(1, 1, z0), at(1, 1, z1), at(1, 0, z1)),
             quad(at(1, 1, z0), at(0, 1, z0), at(0, 1, z1), at(1, 1, z1)), quad(at(0, 1, z0), at(0, 0, z0), at(0, 0, z1), at(0, 1, z1))});
    };
    m.add_parts("box", FeatureRole::boundary,
                {test::joined({ring(0, 0.25), quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0))}),
                 test::joined({ring(0.25, 1), quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1))})});
    m.add("lid", FeatureRole::horizon, quad(at(0, 0, 0.25), at(1, 0, 0.25), at(1, 1, 0.25), at(0, 1, 0.25)));
    m.region("Universe", {1, 2});
    m.region("Low", {-1, -3});
    m.region("High", {-2, 3});
    const BrepData& b = built(m.data);
    expect_counts(b, 1, 1, 3, 2);
    EXPECT_EQ(b.vertices.size(), 12u);
    EXPECT_DOUBLE_EQ(b.regions[0].volume, 0.25);
    EXPECT_DOUBLE_EQ(b.regions[1].volume, 0.75);
}

TEST(MadeModels, ASlitOfTwinNodesIsAnInternalLine) {
    // A square of four triangles around (1,1,0), slit from the border point (2,1,0) to the middle.
    ModelMaker m;
    m.add("cut", FeatureRole::fault, {});
    Surface& s = m.surface(0);
    s.points = {at(0, 0, 0), at(2, 0, 0), at(2, 1, 0), at(2, 2, 0), at(0, 2, 0), at(1, 1, 0), at(2, 1, 0)};
    for (const auto& t : std::vector<std::array<std::uint32_t, 3>>{{0, 1, 5}, {1, 2, 5}, {6, 3, 5}, {3, 4, 5}, {4, 0, 5}})
        s.polygons.push_back(t);
    s.alias = {no_index, no_index, no_index, no_index, no_index, no_index, 2};
    const BrepData& b = built(m.data);
    expect_counts(b, 2, 2, 1, 0);
    EXPECT_EQ(b.internal_lines_of_surfaces, 1u);
    std::size_t internal = 0;
    for (const auto& use : b.surfaces[0].lines) internal += use.internal ? 1 : 0;
    EXPECT_EQ(internal, 2u) << "both sides of the slit";
    EXPECT_EQ(b.surfaces[0].nodes.size(), 7u) << "twins stay two nodes";
    EXPECT_EQ(b.vertices.size(), 6u);
}

TEST(MadeModels, ALineAcrossAnUncutSurfaceHasACornerAtEveryPointOnIt) {
    // A wall of two sheets stands on a floor that is not cut where they meet it.
    ModelMaker m;
    std::vector<Triangle> floor;
    for (int i = 0; i < 4; ++i) {
        for (const auto& t : quad(at(i, -1, 0), at(i + 1, -1, 0), at(i + 1, 0, 0), at(i, 0, 0))) floor.push_back(t);
        for (const auto& t : quad(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 1, 0), at(i, 1, 0))) floor.push_back(t);
    }
    m.add("floor", FeatureRole::horizon, floor);
    const auto wall = [](double z) {
        return test::joined(
            {quad(at(1, 0, 0), at(2, 0, 0), at(2, 0, z), at(1, 0, z)), quad(at(2, 0, 0), at(3, 0, 0), at(3, 0, z), at(2, 0, z))});
    };
    m.add("up", FeatureRole::fault, wall(1));
    m.add("down", FeatureRole::fault, wall(-1));
    const BrepData& b = built(m.data);
    // The floor's border; the foot in two lines; the rest of each wall's border.
    expect_counts(b, 4, 5, 3, 0);
    std::size_t internal = 0;
    for (const auto& use : b.surfaces[0].lines) internal += use.internal ? 1 : 0;
    EXPECT_EQ(internal, 4u) << "both sides of both lines of the foot";
}

TEST(MadeModels, SurfacesThatCrossAlongEdgesMeetInALine) {
    ModelMaker m;
    m.add("flat", FeatureRole::horizon,
          test::joined(
              {quad(at(0, -1, 0), at(1, -1, 0), at(1, 0, 0), at(0, 0, 0)), quad(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0))}));
    m.add("steep", FeatureRole::fault,
          test::joined(
              {quad(at(0, 0, -1), at(1, 0, -1), at(1, 0, 0), at(0, 0, 0)), quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1))}));
    const BrepData& b = built(m.data);
    expect_counts(b, 2, 5, 2, 0);
}

TEST(MadeModels, RepeatedAndDegenerateTrianglesMakeNoLines) {
    auto m = two_blocks();
    Surface& s = m.surface(2);
    const std::vector<std::uint32_t> again{0, 1, 2}, flat{0, 0, 1};
    s.polygons.push_back(again);
    s.polygons.push_back(flat);
    const BrepData& b = built(m.data);
    expect_counts(b, 12, 20, 11, 2);
    EXPECT_EQ(b.surfaces[2].polygons.size(), 4u) << "they stay in the list";
    EXPECT_DOUBLE_EQ(b.regions[0].volume, 1);
}

ModelMaker skin_with_crack(int sign_of_skin) {  // E15 and E16 of the rules
    ModelMaker m;
    m.add("skin", FeatureRole::boundary,
          {{at(0, 0, 0), at(0, 1, 0), at(1, 0, 0)},
           {at(0, 0, 0), at(1, 0, 0), at(0, 0, 1)},
           {at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)},
           {at(0, 1, 0), at(0, 0, 0), at(0, 0, 1)}});
    m.add("frac", FeatureRole::fault, {{at(0.1, 0.1, 0.1), at(0.2, 0.1, 0.1), at(0.1, 0.2, 0.1)}});
    m.region("Universe", {1});
    m.region("R", {sign_of_skin, 2, -2});
    m.model().layers.push_back({"L", {1}, {}});
    return m;
}

TEST(MadeModels, ACrackInsideARegionIsInternal) {
    auto m = skin_with_crack(-1);
    const BrepData& b = built(m.data);
    expect_counts(b, 1, 1, 2, 1);
    EXPECT_NEAR(b.regions[0].volume, 1.0 / 6, 1e-15);
    EXPECT_EQ(b.surfaces[1].regions[0], RegionId(0u));
    EXPECT_EQ(b.surfaces[1].regions[1], RegionId(0u));
    EXPECT_EQ(b.internal_lines_of_regions, 1u);
    EXPECT_EQ(count_code(m.data, "F113"), 0u);
}

TEST(MadeModels, ARegionOnTheWrongSideOfItsSkinIsTold) {
    auto m = skin_with_crack(1);
    const BrepData& b = built(m.data);
    EXPECT_NEAR(b.regions[0].volume, 1.0 / 6, 1e-15);
    ASSERT_EQ(count_code(m.data, "F113"), 1u);
    for (const Finding& f : m.data.findings) {
        if (f.code != "F113") continue;
        EXPECT_NEAR(f.measures.at(0).second, -1.0 / 6, 1e-15);
    }
}

TEST(MadeModels, ARegionThatDoesNotCloseHasNoVolume) {
    auto m = two_blocks();
    m.model().regions[1].sides.pop_back();
    const BrepData& b = built(m.data);
    EXPECT_FALSE(b.regions[0].volume_known);
    EXPECT_TRUE(b.regions[1].volume_known);
    EXPECT_EQ(count_code(m.data, "F113"), 1u);
}

TEST(MadeModels, NumbersWithoutARegionAreToldOnce) {
    auto m = two_blocks();
    m.model().fault_blocks.push_back({"block", {1}, {65, 66}});
    m.model().fault_blocks.push_back({"other", {}, {67}});
    const BrepData& b = built(m.data);
    EXPECT_EQ(b.fault_blocks[0].unresolved, (std::vector<std::int64_t>{65, 66}));
    EXPECT_EQ(count_code(m.data, "F109"), 1u);
}

TEST(MadeModels, NegativeZeroIsZero) {
    auto m = two_blocks();
    for (Vec3& p : m.surface(0).points) {
        for (double& x : p) {
            if (x == 0) x = -0.0;
        }
    }
    EXPECT_EQ(built(m.data).vertices.size(), 12u);
}

TEST(MadeModels, VolumesKeepTheirDigitsFarFromTheOrigin) {
    auto m = two_blocks();
    for (Object& o : m.data.objects) {
        for (Vec3& p : std::get<Surface>(o).points) p = {p[0] + 4194304, p[1] + 8388608, p[2] - 2048};
    }
    for (auto& face : m.model().faces) face.key.reset();
    EXPECT_DOUBLE_EQ(built(m.data).regions[0].volume, 1);
}

TEST(MadeModels, NodesCarryTheirAttributes) {
    auto m = two_blocks();
    Surface& south = m.surface(3);
    Attribute a;
    a.name = "throw";
    std::vector<double> values;
    for (std::size_t i = 0; i < south.points.size(); ++i) values.push_back(static_cast<double>(i));
    a.values = values;
    south.info.attributes.push_back(a);
    const BrepData& b = built(m.data);
    ASSERT_EQ(b.surfaces[4].attributes.size(), 1u);
    EXPECT_EQ(std::get<std::vector<double>>(b.surfaces[4].attributes[0].values), (std::vector<double>{4, 5, 6, 7}));
}

}  // namespace
}  // namespace geomend
