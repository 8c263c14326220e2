// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "model/dataset.h"
#include "remesh/remesh.h"
#include "topology/brep_from_dataset.h"

// Surfaces that no one should make: remeshing ends, and gives a boundary representation with the same entities, or says why not.

namespace geomend::remeshing {
namespace {

Dataset loose(std::vector<Vec3> points, std::vector<std::uint32_t> corners) {
    Surface surface;
    surface.info.name = "s";
    surface.points = std::move(points);
    surface.polygons.corners = std::move(corners);
    Dataset dataset;
    dataset.objects.emplace_back(std::move(surface));
    return dataset;
}

/// \return triangles of the result
std::size_t remeshed(const Dataset& dataset, double size) {
    const auto models = topology::models_to_judge(dataset, 0);
    EXPECT_TRUE(models.ok());
    if (!models) return 0;
    std::size_t triangles = 0;
    for (const auto& model : *models) {
        RemeshOptions options;
        options.size = size;
        options.most_triangles = 200'000;
        auto made = remesh_model(*model.brep, options);
        if (!made) {
            EXPECT_EQ(made.why().kind, FailureKind::limit);
            continue;
        }
        EXPECT_EQ(made->brep.corners.size(), model.brep->corners.size());
        EXPECT_EQ(made->brep.lines.size(), model.brep->lines.size());
        for (const auto& surface : made->brep.surfaces) triangles += surface.polygons.size();
        EXPECT_TRUE(Brep::make(std::move(made->brep)).ok());
    }
    return triangles;
}

TEST(HostileSurfaces, ASingleTriangle) {
    const Dataset dataset = loose({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {0, 1, 2});
    EXPECT_EQ(remeshed(dataset, 100), 1u);
    EXPECT_GT(remeshed(dataset, 0.5), 20u);
}

TEST(HostileSurfaces, TrianglesWithoutArea) {
    const Dataset dataset = loose({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, -2, 0}}, {0, 1, 3, 1, 2, 3, 0, 2, 1, 0, 4, 2});
    EXPECT_GT(remeshed(dataset, 0.5), 0u);
    EXPECT_GT(remeshed(dataset, 50), 0u);
}

TEST(HostileSurfaces, NeedlesOfAnyKind) {
    std::vector<Vec3> points{{0, 0, 0}};
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i <= 40; ++i) points.push_back({1000, i * 1e-4, 0});
    for (std::uint32_t i = 1; i <= 40; ++i) corners.insert(corners.end(), {0, i, i + 1});
    for (const double size : {0.5, 10.0, 1e5}) EXPECT_GT(remeshed(loose(points, corners), size), 0u) << size;
}

TEST(HostileSurfaces, ABandThatIsNotOrientable) {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> corners;
    const std::uint32_t n = 12;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double a = 2 * 3.14159265358979 * i / n, half = a / 2;
        for (const double w : {-1.0, 1.0})
            points.push_back({(5 + w * std::cos(half)) * std::cos(a), (5 + w * std::cos(half)) * std::sin(a), w * std::sin(half)});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const bool last = i + 1 == n;
        const std::uint32_t a = 2 * i, b = 2 * i + 1, c = last ? 1 : 2 * i + 2, d = last ? 0 : 2 * i + 3;
        corners.insert(corners.end(), {a, c, b, b, c, d});
    }
    for (const double size : {0.4, 3.0, 50.0}) EXPECT_GT(remeshed(loose(points, corners), size), 0u) << size;
}

TEST(HostileSurfaces, AClosedOneWithoutLinesThatIsSmallerThanTheSize) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<std::uint32_t> corners{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    EXPECT_EQ(remeshed(loose(points, corners), 100), 4u);
    EXPECT_GT(remeshed(loose(points, corners), 0.2), 50u);
}

RC_GTEST_PROP(HostileSurfaces, AnyTriangles, ()) {
    const auto places =
        *rc::gen::container<std::vector<std::array<int, 3>>>(*rc::gen::inRange(3, 9), rc::gen::arbitrary<std::array<int, 3>>());
    std::vector<Vec3> points;
    for (const auto& p : places) points.push_back({double(p[0] % 5), double(p[1] % 5), double(p[2] % 3)});
    std::vector<std::uint32_t> corners;
    const auto count = *rc::gen::inRange(1, 10);
    const auto most = static_cast<std::uint32_t>(points.size());
    for (int t = 0; t < count; ++t) {
        for (int k = 0; k < 3; ++k) corners.push_back(*rc::gen::inRange(0u, most));
    }
    remeshed(loose(points, corners), *rc::gen::element(0.3, 1.0, 10.0));
}

}  // namespace
}  // namespace geomend::remeshing
