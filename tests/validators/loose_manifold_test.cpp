// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "validators/checks_testing.h"
#include "validators/rewritten.h"

// Loose surfaces that are no surfaces at an edge or a point: they are taken apart there, and reported.

namespace geomend {
namespace {

using namespace testing;

Dataset loose_triangles(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    Surface surface;
    surface.info.name = "S";
    surface.points = points;
    for (const auto& t : triangles) surface.polygons.push_back(t);
    Dataset data;
    data.objects.emplace_back(std::move(surface));
    return data;
}

Finding found_in(const Dataset& data) {
    auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    return find(checked->findings, "B03", Severity::error);
}

const std::vector<Vec3> five = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 0, 1}};

TEST(ALooseSurface, WithThreeTrianglesAtAnEdgeIsNoSurface) {
    const Dataset data = loose_triangles(five, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    for (const Dataset& one : {data, moved(data, rotated), on_the_map(data, 1000)}) {
        const Finding f = found_in(one);
        EXPECT_EQ(measure(f, "edges_shared_by_more_than_two"), 1);
        EXPECT_EQ(measure(f, "pinched_points"), 0);
        EXPECT_EQ(f.polylines.size(), 1u);
        EXPECT_EQ(f.count, 3u);
    }
    EXPECT_TRUE(found_in(loose_triangles(five, {{0, 1, 2}, {1, 0, 3}})).code.empty());
}

TEST(ALooseSurface, WithAFlatTriangleOnAnotherOneHasTheSameCodesInEachFrame) {
    const std::vector<Vec3> points = {{0, 0, 0}, {1000, 0, 0}, {500, 1000, 0}, {400, 1e-6, 0}};
    const Dataset data = loose_triangles(points, {{0, 1, 2}, {0, 1, 3}});
    for (const Dataset& one : {data, moved(data, rotated), on_the_map(data, 1000)}) {
        auto checked = validators::check_models(one, {});
        ASSERT_TRUE(checked);
        EXPECT_EQ(find(checked->findings, "M03", Severity::warning).count, 1u);
        EXPECT_TRUE(find(checked->findings, "B26", Severity::error).code.empty()) << "what it has in common is narrower than the tolerance";
    }
    auto wide = points;
    wide[3][1] = 1;
    auto checked = validators::check_models(loose_triangles(wide, {{0, 1, 2}, {0, 1, 3}}), {});
    EXPECT_EQ(find(checked->findings, "B26", Severity::error).count, 1u);
}

TEST(ALooseSurface, WithTwoTrianglesThatShareAPointOnlyIsNoSurface) {
    const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
    const Dataset data = loose_triangles(points, {{0, 1, 2}, {0, 3, 4}});
    for (const Dataset& one : {data, moved(data, rotated), on_the_map(data, 1000)}) {
        const Finding f = found_in(one);
        EXPECT_EQ(measure(f, "pinched_points"), 1);
        EXPECT_EQ(f.points.size(), 1u);
        EXPECT_EQ(f.elements, (std::vector<std::int64_t>{1, 2}));
    }
    // A point of its own for each, or two surfaces: they touch, no more.
    auto apart = points;
    apart.push_back(points[0]);
    EXPECT_TRUE(found_in(loose_triangles(apart, {{0, 1, 2}, {5, 3, 4}})).code.empty());
    Dataset two = loose_triangles(points, {{0, 1, 2}});
    two.objects.push_back(loose_triangles(points, {{0, 3, 4}}).objects[0]);
    EXPECT_TRUE(found_in(two).code.empty());
}

TEST(ALooseSurface, ThatHoldsAWholeModelMayHaveContacts) {
    // Two boxes, one on the other, with the wall between them once; and two that touch in a point or along an edge.
    const auto as_one = [](const std::vector<test::Triangle>& triangles) {
        test::ModelMaker maker;
        maker.add("model", FeatureRole::unknown, triangles);
        Dataset data;
        data.objects.push_back(maker.data.objects[0]);
        return data;
    };
    const auto lower = test::box({0, 0, 0}, {1, 1, 1});
    auto upper = test::box({0, 0, 1}, {1, 1, 2});
    upper.erase(upper.begin(), upper.begin() + 2);  // its bottom
    EXPECT_TRUE(found_in(as_one(test::joined({lower, upper}))).code.empty());
    EXPECT_TRUE(found_in(as_one(test::joined({lower, test::box({1, 1, 1}, {2, 2, 2})}))).code.empty());
    EXPECT_TRUE(found_in(as_one(test::joined({lower, test::box({1, 1, 0}, {2, 2, 1})}))).code.empty());
    // A wall that hangs on an edge.
    auto with_fin = lower;
    const auto fin = test::quad({1, 1, 0}, {2, 2, 0}, {2, 2, 1}, {1, 1, 1});
    with_fin.insert(with_fin.end(), fin.begin(), fin.end());
    EXPECT_EQ(measure(found_in(as_one(with_fin)), "edges_shared_by_more_than_two"), 1);
}

/// A box that is closed, and a wall that hangs on one of its edges.
Dataset box_with_fin(const std::string& format) {
    const auto fin = test::quad({1, 1, 0}, {2, 2, 0}, {2, 2, 1}, {1, 1, 1});
    test::ModelMaker maker;
    maker.add("model", FeatureRole::unknown, test::joined({test::box({0, 0, 0}, {1, 1, 1}), fin}));
    Dataset data;
    data.format = format;
    data.objects.push_back(maker.data.objects[0]);
    return data;
}

std::set<std::string> codes_in(const Dataset& data) {
    auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    return codes_of(checked->findings);
}

TEST(ALooseSurface, ThatIsAloneInAMeshFileMayHoldAWholeModel) {
    for (const char* format : {"surface", "vtk"}) {
        const auto codes = codes_in(box_with_fin(format));
        EXPECT_TRUE(codes.contains("B03 warning")) << format;
        EXPECT_FALSE(codes.contains("B03 error") || codes.contains("B18 error")) << format;
        // Another surface, or a role, says what is one.
        Dataset two = box_with_fin(format);
        two.objects.push_back(loose_triangles({{5, 5, 5}, {6, 5, 5}, {5, 6, 5}}, {{0, 1, 2}}).objects[0]);
        EXPECT_TRUE(codes_in(two).contains("B03 error")) << format;
        Dataset fault = box_with_fin(format);
        info_of(fault.objects[0]).role = FeatureRole::fault;
        EXPECT_TRUE(codes_in(fault).contains("B03 error")) << format;
    }
    EXPECT_TRUE(codes_in(box_with_fin("gocad")).contains("B03 error"));
}

TEST(ALooseSurface, IsToldApartByAnArrayThatIsCalledAfterSurfaces) {
    Dataset data = box_with_fin("vtk");
    const auto add = [&](const std::string& name, std::vector<std::int32_t> values) {
        Attribute array;
        array.name = name;
        array.location = AttributeLocation::polygon;
        array.values = std::move(values);
        info_of(data.objects[0]).attributes = {array};
    };
    std::vector<std::int32_t> values(14, 1);
    values[12] = values[13] = 7;
    add("surface", values);
    auto checked = validators::check_models(data, {});
    ASSERT_TRUE(checked);
    EXPECT_TRUE(find(checked->findings, "B03", Severity::warning).code.empty());
    const Finding free = find(checked->findings, "B29", Severity::warning);
    ASSERT_EQ(free.entities.size(), 1u);
    EXPECT_EQ(free.entities[0].name, "surface 7");
    // Values of something else do not; one value everywhere says that all is one surface.
    add("colour", values);
    EXPECT_TRUE(codes_in(data).contains("B03 warning"));
    add("surface", std::vector<std::int32_t>(14, 1));
    EXPECT_TRUE(codes_in(data).contains("B03 error"));
    info_of(data.objects[0]).attributes.clear();
    EXPECT_TRUE(codes_in(data).contains("B03 warning"));
}

TEST(ClosedSurfaces, WithASideInCommonAreJudgedAlikeHoweverTheyAreTurned) {
    test::ModelMaker maker;
    maker.add("a", FeatureRole::unknown, test::box({0, 0, 0}, {1, 1, 1}));
    maker.add("b", FeatureRole::unknown, test::box({1, 0, 0}, {2, 1, 1}));
    Dataset data;
    data.objects = maker.data.objects;
    const auto codes = codes_in(data);
    EXPECT_TRUE(codes.contains("B20 error"));
    for (const Dataset& turned : {moved(data, rotated), on_the_map(data, 1000)}) EXPECT_EQ(codes_in(turned), codes);
}

}  // namespace
}  // namespace geomend
