// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iostream>
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

}  // namespace
}  // namespace geomend::test
