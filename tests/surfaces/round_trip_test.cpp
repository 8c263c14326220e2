// SPDX-License-Identifier: AGPL-3.0-or-later
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "surfaces/surface_files.h"

namespace geomend::test {
namespace {

/// Some points with awkward coordinates, and polygons of three and more corners over them.
Surface any_surface(bool triangles) {
    Surface surface;
    const auto points = *rc::gen::inRange<std::uint32_t>(3, 12);
    for (std::uint32_t i = 0; i < points; ++i) {
        Vec3 p{};
        for (double& x : p) x = *rc::gen::inRange<int>(-1000000000, 1000000000) / 3.0;
        surface.points.push_back(p);
    }
    const auto polygons = *rc::gen::inRange<int>(1, 8);
    for (int k = 0; k < polygons; ++k) {
        const std::size_t size = triangles ? 3 : *rc::gen::inRange<std::size_t>(3, 6);
        std::vector<std::uint32_t> polygon;
        for (std::size_t i = 0; i < size; ++i) polygon.push_back(*rc::gen::inRange<std::uint32_t>(0, points));
        surface.polygons.push_back(polygon);
    }
    return surface;
}

/// The positions of the corners of each polygon.
std::vector<std::vector<Vec3>> shapes_of(const Surface& surface) {
    std::vector<std::vector<Vec3>> shapes;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        auto& shape = shapes.emplace_back();
        for (const std::uint32_t c : surface.polygons[p]) shape.push_back(surface.points[c]);
    }
    return shapes;
}

Dataset dataset_of(std::vector<Surface> surfaces) {
    Dataset data;
    for (Surface& s : surfaces) data.objects.emplace_back(std::move(s));
    return data;
}

RC_GTEST_PROP(SurfaceRoundTrip, EveryBitOfPositionsAndEveryPolygonComesBack, ()) {
    const Surface surface = any_surface(false);
    for (const char* format : {"obj", "ply", "off"}) {
        for (const char* encoding : {"text", "binary"}) {
            const WrittenSurface file = written_surface(format, dataset_of({surface}), encoding);
            const Dataset back = good_surface(format, file.bytes);
            RC_ASSERT(surface_at(back, 0).points == surface.points);
            RC_ASSERT(shapes_of(surface_at(back, 0)) == shapes_of(surface));
            RC_ASSERT(written_surface(format, back, encoding).bytes == file.bytes);
        }
    }
}

TEST(SurfaceRoundTrip, ObjectsOfOneNameStayApartInObjAndTheNumberOfTheSecondIsListed) {
    Surface surface;
    surface.info.name = "dup";
    surface.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    surface.polygons.push_back(std::array<std::uint32_t, 3>{0, 1, 2});
    Surface numbered = surface;
    numbered.info.name = "dup_2";
    const WrittenSurface file = written_surface("obj", dataset_of({surface, numbered, surface}));
    const Dataset back = good_surface("obj", file.bytes);
    ASSERT_EQ(back.objects.size(), 3u);
    std::set<std::string> names;
    for (const Object& object : back.objects) names.insert(info_of(object).name);
    EXPECT_EQ(names, (std::set<std::string>{"dup", "dup_2", "dup_3"}));
    EXPECT_EQ(std::ranges::count(file.losses, std::string("name"), &Loss::what), 1);
}

RC_GTEST_PROP(SurfaceRoundTrip, StlKeepsTrianglesAndNamesOfSolids, ()) {
    std::vector<Surface> surfaces{any_surface(true), any_surface(true)};
    surfaces[0].info.name = "upper bed";
    surfaces[1].info.name = "fault 3";
    const Dataset back = good_surface("stl", written_surface("stl", dataset_of(surfaces)).bytes);
    RC_ASSERT(back.objects.size() == 2u);
    for (std::size_t s = 0; s < 2; ++s) {
        RC_ASSERT(shapes_of(surface_at(back, s)) == shapes_of(surfaces[s]));
        RC_ASSERT(surface_at(back, s).info.name == surfaces[s].info.name);
    }
}

TEST(SurfaceRoundTrip, StlListsPointsThatAreApartAtOnePosition) {
    Surface surface;  // cut along the edge from (1, 0, 0) to (0, 1, 0)
    surface.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    surface.polygons.push_back(std::array<std::uint32_t, 3>{0, 1, 2});
    surface.polygons.push_back(std::array<std::uint32_t, 3>{3, 4, 5});
    surface.info.name = "cut";
    for (const char* encoding : {"text", "binary"}) {
        const WrittenSurface file = written_surface("stl", dataset_of({surface}), encoding);
        const auto joined = std::ranges::find(file.losses, "points apart at one position", &Loss::what);
        ASSERT_NE(joined, file.losses.end()) << encoding;
        EXPECT_EQ(joined->loss_class, LossClass::identity);
        EXPECT_EQ(joined->entity, "cut");
        EXPECT_EQ(joined->count, 2u);
        EXPECT_EQ(surface_at(good_surface("stl", file.bytes), 0).points.size(), 4u);
    }
}

TEST(SurfaceRoundTrip, WhatHasNoPlaceIsListed) {
    Surface surface;
    surface.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1.0 / 3, 0}};
    surface.polygons.push_back(std::array<std::uint32_t, 4>{0, 1, 2, 3});
    surface.info.name = "top";
    surface.info.role = FeatureRole::horizon;
    Attribute throw_of;
    throw_of.name = "throw";
    throw_of.values = std::vector<double>{1, 2, 3, 4};
    surface.info.attributes.push_back(throw_of);
    const auto classes = [&](const char* format, const char* encoding) {
        std::multiset<LossClass> all;
        for (const Loss& loss : written_surface(format, dataset_of({surface}), encoding).losses) all.insert(loss.loss_class);
        return all;
    };
    using enum LossClass;
    EXPECT_EQ(classes("ply", "binary"), (std::multiset{identity})) << "the role";
    EXPECT_EQ(classes("obj", "text"), (std::multiset{substance, identity})) << "the attribute, the role";
    EXPECT_EQ(classes("stl", "text"), (std::multiset{substance, identity, identity})) << "and which triangles make a polygon";
    EXPECT_EQ(classes("stl", "binary"), (std::multiset{substance, substance, identity, identity})) << "and digits";
    PointSet points;
    points.points = {{0, 0, 0}};
    Dataset none;
    none.objects.emplace_back(points);
    const TemporaryFolder folder;
    OutputSet out(folder / "a.stl");
    const auto refused = surface_format("stl").write(none, out, {});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.why().error.code, "F021");
}

}  // namespace
}  // namespace geomend::test
