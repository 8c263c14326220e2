// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "geometry/intersections.h"
#include "pipeline/load.h"
#include "support/real_data.h"
#include "validators/layered_model.h"
#include "validators/registry.h"

namespace geomend {
namespace {

using namespace testing;

std::vector<Finding> findings_of(const Dataset& data, const validators::CheckOptions& options = {}) {
    auto checked = validators::check_models(data, options);
    EXPECT_TRUE(checked);
    return checked ? std::move(checked->findings) : std::vector<Finding>{};
}

std::vector<topology::JudgedModel> judged(const Dataset& data) {
    auto models = topology::models_to_judge(data, 1e-9);
    EXPECT_TRUE(models);
    return models ? std::move(*models) : std::vector<topology::JudgedModel>{};
}

std::set<std::string> codes_of(const std::vector<Finding>& findings) {
    std::set<std::string> codes;
    for (const Finding& f : findings) codes.insert(f.code);
    return codes;
}

/// A loose surface of triangles; each has points of its own where `apart`.
Surface surface_of(const std::string& name, const std::vector<test::Triangle>& triangles, bool apart = false) {
    Surface surface;
    surface.info.name = name;
    std::map<Vec3, std::uint32_t> known;
    for (const auto& t : triangles) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto found = known.find(t[i]);
            corners[i] = apart || found == known.end() ? add_point(surface, t[i]) : found->second;
            known.emplace(t[i], corners[i]);
        }
        surface.polygons.push_back(corners);
    }
    return surface;
}

Dataset loose(std::vector<Surface> surfaces) {
    Dataset data;
    for (auto& s : surfaces) data.objects.emplace_back(std::move(s));
    return data;
}

std::vector<test::Triangle> square(double x0, double x1, double z) { return test::quad({x0, 0, z}, {x1, 0, z}, {x1, 1, z}, {x0, 1, z}); }

// The very same triangles, joined by their points: no plane is between them, and no corner beside them.
TEST(LooseSurfaces, ThatAreTheSameTwiceLieOnEachOther) {
    const auto once = square(0, 1, 0);
    const auto findings = findings_of(loose({surface_of("one", once), surface_of("two", once)}));
    const auto told = std::ranges::find(findings, "B20", &Finding::code);
    ASSERT_NE(told, findings.end());
    EXPECT_EQ(told->count, 2u);
    EXPECT_EQ(told->entities.size(), 2u);
}

/// A strip folded up so that all its triangles lie on each other, in one plane.
std::vector<test::Triangle> folded_strip(std::size_t count) {
    std::vector<test::Triangle> triangles;
    const auto at = [](std::size_t i, double y) { return Vec3{double(i % 2) + 1e-4 * double(i), y + 1e-5 * double(i), 0}; };
    for (std::size_t i = 0; 2 * i < count; ++i) {
        triangles.push_back({at(i, 0), at(i + 1, 0), at(i + 1, 1)});
        triangles.push_back({at(i, 0), at(i + 1, 1), at(i, 1)});
    }
    return triangles;
}

std::uint64_t pairs_of(const std::vector<test::Triangle>& triangles) {
    const Surface surface = surface_of("", triangles);
    std::vector<Triangle> numbers;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto t = surface.polygons[p];
        numbers.push_back({t[0], t[1], t[2]});
    }
    return intersections(surface.points, numbers).size();
}

TEST(Crowds, OfTrianglesOnEachOtherAreOneFindingWithAllTriangles) {
    validators::CheckOptions options;
    options.only = {"B26"};
    const auto many = folded_strip(1000);
    ASSERT_GT(pairs_of(many), 400000u);
    const auto findings = findings_of(loose({surface_of("pile", many)}), options);
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_GE(findings[0].count, 20000u);
    EXPECT_LT(findings[0].count, 400000u);
    EXPECT_NE(findings[0].message.find("more that were not counted"), std::string::npos) << findings[0].message;
    const auto few = findings_of(loose({surface_of("pile", folded_strip(100))}), options);
    ASSERT_EQ(few.size(), 1u);
    EXPECT_EQ(few[0].count, pairs_of(folded_strip(100))) << "exact where there are not so many";
    EXPECT_EQ(few[0].message.find("not counted"), std::string::npos);
}

/// Triangles on each other, each turned a little.
std::vector<test::Triangle> leaves(std::size_t count) {
    std::vector<test::Triangle> triangles;
    for (std::size_t i = 0; i < count; ++i) {
        const double turn = 1e-4 * double(i);
        triangles.push_back({Vec3{1e-4 * turn, -turn, 0}, Vec3{1, turn, 0}, Vec3{-turn, 1 + turn, 0}});
    }
    return triangles;
}

TEST(Crowds, OfSurfacesOnEachOtherAreToldForEachSurface) {
    validators::CheckOptions options;
    options.only = {"B20", "B08"};
    std::vector<Surface> pile;
    for (const auto& t : leaves(300)) pile.push_back(surface_of("leaf_" + std::to_string(pile.size()), {t}));
    const auto findings = findings_of(loose(pile), options);
    std::set<std::int64_t> told;
    for (const Finding& f : findings) {
        for (const EntityRef& e : f.entities) told.insert(e.id);
    }
    EXPECT_EQ(told.size(), 300u) << "each surface";
    EXPECT_LT(findings.size(), 20000u) << "not each of the 44850 pairs";
    EXPECT_NE(findings.back().message.find("not examined"), std::string::npos) << findings.back().message;
}

TEST(LooseSurfaces, ThatCloseBoundARegion) {
    // Six squares, each an object of its own.
    std::vector<Surface> sides;
    const auto box = test::box({0, 0, 0}, {1, 1, 1});
    for (std::size_t k = 0; k < 6; ++k) sides.push_back(surface_of("side_" + std::to_string(k), {box[2 * k], box[2 * k + 1]}));
    const auto models = judged(loose(sides));
    ASSERT_EQ(models.size(), 1u);
    const BrepData& b = *models[0].brep;
    EXPECT_EQ(b.corners.size(), 8u);
    EXPECT_EQ(b.lines.size(), 12u);
    EXPECT_EQ(b.surfaces.size(), 6u);
    ASSERT_EQ(b.regions.size(), 1u);
    EXPECT_DOUBLE_EQ(b.regions[0].volume, 1);
    EXPECT_EQ(codes_of(findings_of(loose(sides))), std::set<std::string>{});
}

TEST(LooseSurfaces, AreJoinedWithinTheToleranceAndToldSo) {
    std::vector<Surface> sides;
    const auto box = test::box({0, 0, 0}, {1, 1, 1});
    for (std::size_t k = 0; k < 6; ++k) sides.push_back(surface_of("side_" + std::to_string(k), {box[2 * k], box[2 * k + 1]}));
    for (Vec3& p : sides[3].points) p[0] += 1e-8;
    const auto findings = findings_of(loose(sides));
    EXPECT_EQ(codes_of(findings), std::set<std::string>{"M01"});
    EXPECT_EQ(findings[0].count, 4u);
}

TEST(LooseSurfaces, AreTakenApartWhereTheyCrossAlongSharedEdges) {
    // Two sheets that cross along x = 1: four pieces, four regions' worth of sides, one line with four pieces.
    const auto flat = test::joined({square(0, 1, 0), square(1, 2, 0)});
    const auto wall =
        test::joined({test::quad({1, 0, -1}, {1, 1, -1}, {1, 1, 0}, {1, 0, 0}), test::quad({1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1})});
    const Dataset data = loose({surface_of("flat", flat), surface_of("wall", wall)});
    const auto models = judged(data);
    ASSERT_EQ(models.size(), 1u);
    EXPECT_EQ(models[0].brep->surfaces.size(), 4u);
    EXPECT_EQ(models[0].brep->interfaces.size(), 2u);
    EXPECT_EQ(codes_of(findings_of(data)), std::set<std::string>{});
}

TEST(StatedSurfaces, ThatOthersCutThroughHaveToBeStatedInParts) {
    // Two sheets that cross along x = 1. Without regions nothing else would say that their sides go on across each other.
    const auto west = square(0, 1, 0), east = square(1, 2, 0);
    const auto below = test::quad({1, 0, -1}, {1, 1, -1}, {1, 1, 0}, {1, 0, 0}),
               above = test::quad({1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1});
    test::ModelMaker whole, parts;
    whole.add("flat", FeatureRole::horizon, test::joined({west, east}));
    whole.add("wall", FeatureRole::fault, test::joined({below, above}));
    const auto findings = findings_of(whole.data);
    EXPECT_EQ(std::ranges::count(findings, "B04", &Finding::code), 2);
    parts.add_parts("flat", FeatureRole::horizon, {west, east});
    parts.add_parts("wall", FeatureRole::fault, {below, above});
    EXPECT_FALSE(codes_of(findings_of(parts.data)).contains("B04"));
}

TEST(LooseSurfaces, WhoseTrianglesHaveOwnPointsAreJoinedByPosition) {
    const Dataset data = loose({surface_of("soup", test::box({0, 0, 0}, {1, 1, 1}), true)});
    const auto models = judged(data);
    ASSERT_EQ(models.size(), 1u);
    EXPECT_EQ(models[0].brep->surfaces.size(), 1u);
    EXPECT_EQ(models[0].brep->regions.size(), 1u);
    EXPECT_EQ(codes_of(findings_of(data)), std::set<std::string>{"M08"});
}

TEST(LooseSurfaces, ThatCrossAreOneFindingWithTheirPolyline) {
    const auto flat = test::joined({square(-1, 1, 0), square(1, 3, 0)});
    const Dataset data =
        loose({surface_of("flat", flat), surface_of("wall", test::quad({0.5, 0.2, -1}, {0.5, 0.8, -1}, {0.5, 0.8, 1}, {0.5, 0.2, 1}))});
    const auto findings = findings_of(data);
    ASSERT_EQ(codes_of(findings), std::set<std::string>{"B08"});
    ASSERT_EQ(findings.size(), 1u);
    ASSERT_EQ(findings[0].polylines.size(), 1u);
    EXPECT_EQ(findings[0].entities.size(), 2u);
    double length = 0;
    for (const auto& [name, value] : findings[0].measures) length = name == "length" ? value : length;
    EXPECT_NEAR(length, 0.6, 1e-12);
}

TEST(AClosedSurfaceInAnother, IsARegionInARegion) {
    const Dataset data =
        loose({surface_of("outer", test::box({0, 0, 0}, {4, 4, 4})), surface_of("inner", test::box({1, 1, 1}, {2, 2, 2}))});
    const auto models = judged(data);
    ASSERT_EQ(models[0].brep->regions.size(), 2u);
    double sum = 0;
    for (const auto& region : models[0].brep->regions) sum += region.volume;
    EXPECT_DOUBLE_EQ(sum, 64);
    EXPECT_DOUBLE_EQ(models[0].brep->universe_volume, 64);
    EXPECT_EQ(codes_of(findings_of(data)), std::set<std::string>{});
}

TEST(ASheetInsideARegion, IsInformationAndALeakOnlyWhereItShouldSeparate) {
    const auto sheet = test::quad({1, 1, 2}, {3, 1, 2}, {3, 3, 2}, {1, 3, 2});
    Dataset data = loose({surface_of("box", test::box({0, 0, 0}, {4, 4, 4})), surface_of("sheet", sheet)});
    EXPECT_EQ(codes_of(findings_of(data)), std::set<std::string>{"B29"}) << "no role says which of the two it is";
    std::get<Surface>(data.objects[1]).info.role = FeatureRole::horizon;
    EXPECT_EQ(codes_of(findings_of(data)), (std::set<std::string>{"B09", "B12"}));
    std::get<Surface>(data.objects[1]).info.role = FeatureRole::fault;
    EXPECT_EQ(codes_of(findings_of(data)), std::set<std::string>{"B25"});
}

TEST(AMoebiusStrip, HasOneSideOnly) {
    std::vector<test::Triangle> strip;
    constexpr int n = 12;
    const auto at = [&](int k, double w) {
        const double a = 2 * std::numbers::pi * k / n;
        return Vec3{(2 + w * std::cos(a / 2)) * std::cos(a), (2 + w * std::cos(a / 2)) * std::sin(a), w * std::sin(a / 2)};
    };
    Surface surface;
    surface.info.name = "strip";
    for (int k = 0; k < n; ++k) {
        add_point(surface, at(k, -0.5));
        add_point(surface, at(k, 0.5));
    }
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t a = 2 * k, b = a + 1;
        const std::uint32_t c = k + 1 < n ? a + 2 : 1, d = k + 1 < n ? a + 3 : 0;  // the last one is turned over
        add_triangle(surface, a, b, d);
        add_triangle(surface, a, d, c);
    }
    EXPECT_EQ(codes_of(findings_of(loose({surface}))), std::set<std::string>{"M06"});
}

TEST(TenThousandBadTrianglesOfOneSurface, AreOneFinding) {
    Surface surface = surface_of("bad", square(0, 1, 0));
    for (int k = 0; k < 10000; ++k) add_triangle(surface, 0, 1, 1);
    const auto findings = findings_of(loose({surface}));
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].code, "B01");
    EXPECT_EQ(findings[0].count, 10000u);
    EXPECT_EQ(findings[0].elements.size(), 100u);
}

TEST(ACoordinateBeyondAllMeasure, IsToldAndNothingElseIsJudged) {
    for (const double huge : {1e20, 1e200, -1e300}) {
        Surface surface = surface_of("far", square(0, 1, 0));
        surface.points[1][1] = huge;
        const auto findings = findings_of(loose({surface, surface_of("near", square(0, 1, 1))}));
        ASSERT_EQ(codes_of(findings), std::set<std::string>{"M09"});
        EXPECT_EQ(findings[0].count, 1u);
    }
}

TEST(Checks, AreLeftOutWhereTheOptionsSaySo) {
    Surface surface = surface_of("bad", square(0, 1, 0));
    add_triangle(surface, 0, 1, 1);
    validators::CheckOptions options;
    options.skip = {"B01"};
    EXPECT_FALSE(codes_of(findings_of(loose({surface}), options)).contains("B01"));
    options = {};
    options.only = {"B08"};
    EXPECT_TRUE(codes_of(findings_of(loose({surface}), options)).empty());
}

TEST(AFaultThatDisplacesNothing, IsTold) {
    LayeredModel model;
    const auto findings = findings_of(model.data());
    EXPECT_TRUE(codes_of(findings).contains("G03"));
}

TEST(HorizonsInBothOrders, AreTold) {
    // In the second block the parts of the two horizons have changed names.
    LayeredModel model;
    auto& faces = model.maker.model().faces;
    for (auto& face : faces) {
        if (face.part != 1) continue;
        if (face.interface_name == "lower") face.interface_name = "upper";
        else if (face.interface_name == "upper") face.interface_name = "lower";
    }
    EXPECT_TRUE(codes_of(findings_of(model.data())).contains("G04"));
    EXPECT_FALSE(codes_of(findings_of(LayeredModel().data())).contains("G04"));
}

TEST(VolumesOfCells, MayLeaveTheirPartingToTheCells) {
    // The surfaces of this mesh leave a strip open between two volumes; their cells part them all the same.
    const auto file = test::real_data("gmsh/toy_model.msh");
    if (!file) GTEST_SKIP() << "no real data";
    const auto data = load(file->string(), {});
    ASSERT_TRUE(data);
    const auto codes = codes_of(findings_of(*data));
    EXPECT_FALSE(codes.contains("B12"));
    EXPECT_FALSE(codes.contains("B13"));
}

}  // namespace
}  // namespace geomend
