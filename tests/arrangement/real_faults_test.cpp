// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <map>
#include <variant>

#include "cut_soups.h"
#include "formats/gocad/read_gocad.h"
#include "support/real_data.h"

namespace geomend::test {
namespace {

/// All surfaces of a folder, a patch for each, with the vertices of the files.
TriangleSoup soup_of_folder(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".ts") paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    TriangleSoup soup;
    for (const auto& path : paths) {
        const auto input = Input::open(path.string());
        const auto data = gocad::read_gocad(*input, {});
        if (!data.ok()) continue;
        for (const Object& object : data->objects) {
            const auto* surface = std::get_if<Surface>(&object);
            if (surface == nullptr) continue;
            std::vector<Triangle> triangles;
            for (std::size_t i = 0; i < surface->polygons.size(); ++i) {
                const auto p = surface->polygons[i];
                triangles.push_back({p[0], p[1], p[2]});
            }
            add_patch(soup, surface->points, triangles);
        }
    }
    return soup;
}

/// Each triangle in four; the points between bend the surface by up to two hundredths of an edge, the same for both sides of an edge.
TriangleSoup finer(const TriangleSoup& soup) {
    TriangleSoup fine;
    fine.vertices = soup.vertices;
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(fine.vertices.size()));
        if (is_new) {
            const Vec3 p = soup.vertices[at->first[0]], q = soup.vertices[at->first[1]], d = minus(q, p);
            const double noise = 0.02 * std::sin(12.9898 * static_cast<double>(at->second));
            fine.vertices.push_back(plus(times(0.5, plus(p, q)), times(noise, Vec3{d[1], d[2], d[0]})));
        }
        return at->second;
    };
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const auto [a, b, c] = soup.triangles[t];
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const Triangle& part : {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}}) {
            fine.triangles.push_back(part);
            fine.patches.push_back(soup.patches[t]);
        }
    }
    return fine;
}

/// Turned about a slanting axis and moved near the origin.
TriangleSoup turned(TriangleSoup soup) {
    const Vec3 first = soup.vertices[0];
    for (Vec3& p : soup.vertices) {
        const Vec3 d = minus(p, first);
        const Vec3 q{0.8 * d[0] - 0.6 * d[1], 0.6 * d[0] + 0.8 * d[1], d[2]};
        p = {q[0], 0.96 * q[1] - 0.28 * q[2], 0.28 * q[1] + 0.96 * q[2]};
    }
    return soup;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// 555 faults that cross, branch and end on each other, as they are published.
TEST(RealFaults, AreCutCleanWithTheirAreaKept) {
    const auto folder = real_data("gocad/scec_cfm7_2000m");
    if (!folder) GTEST_SKIP() << "no real data";
    const TriangleSoup soup = soup_of_folder(*folder);
    ASSERT_GT(soup.triangles.size(), 200000u);
    const double tolerance = 1e-7 * extent_of(soup), began = processor_seconds();
    const auto cut = arrangement::arrange(soup, {.tolerance = tolerance});
    std::cout << processor_seconds() - began << " s, " << cut->rounds << " rounds, " << cut->soup.triangles.size() << " triangles, "
              << cut->made << " new vertices, " << cut->merged << " merged, largest move " << cut->largest_move << ", area changed by "
              << area_of(cut->soup) / area_of(soup) - 1 << '\n';
    expect_cut(soup, *cut, tolerance);
    EXPECT_NEAR(area_of(cut->soup), area_of(soup), 1e-9 * area_of(soup));
    const auto again = arrangement::arrange(cut->soup, {.tolerance = tolerance});
    EXPECT_EQ(again->soup.triangles, cut->soup.triangles);
    EXPECT_EQ(again->soup.vertices, cut->soup.vertices);
}

TEST(RealFaults, AreCutCleanFinerAndTurned) {
    const auto folder = real_data("gocad/scec_cfm7_2000m");
    if (!folder) GTEST_SKIP() << "no real data";
    const TriangleSoup soup = soup_of_folder(*folder);
    for (const TriangleSoup& other : {turned(soup), finer(soup), turned(finer(soup))}) {
        const auto cut = arrangement::arrange(other, {.tolerance = 1e-7 * extent_of(other)});
        ASSERT_TRUE(cut.ok());
        EXPECT_TRUE(cut->clean) << other.triangles.size() << " triangles, " << cut->rounds << " rounds";
        const auto again = arrangement::arrange(cut->soup, {.tolerance = 1e-7 * extent_of(other)});
        EXPECT_EQ(again->soup.triangles, cut->soup.triangles);
        EXPECT_EQ(again->soup.vertices, cut->soup.vertices);
    }
}

}  // namespace
}  // namespace geomend::test
