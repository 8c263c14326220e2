// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/thickness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "topology/lengths.h"

namespace geomend {
namespace {

using Triangles = std::vector<std::array<Vec3, 3>>;

/// A sheet of n x n squares over width x width at some height, with waves of some height on it.
void add_sheet(Triangles& to, int n, double width, double z, double waves = 0) {
    const double side = width / n;
    const auto at = [&](int i, int j) { return Vec3{side * i, side * j, z + waves * std::sin(12.0 * i / n) * std::cos(9.0 * j / n)}; };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            to.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            to.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
}

/// Layers of a basin, its walls apart.
Triangles basin(int layers, int n, double width, double height) {
    Triangles all;
    for (int k = 0; k <= layers; ++k) add_sheet(all, n, width, height * k / layers, height / layers / 10);
    return all;
}

Vec3 tilted(const Vec3& p) {
    constexpr double a = 0.7, b = 0.3;
    const Vec3 q{std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], p[2]};
    return {q[0] + 5e5, std::cos(b) * q[1] - std::sin(b) * q[2] + 6e6, std::sin(b) * q[1] + std::cos(b) * q[2]};
}

double thickness(const Triangles& triangles) { return topology::slab_of(triangles).thickness; }

TEST(WeightedQuantile, is_one_of_the_lengths_even_where_they_hardly_differ_or_are_no_numbers) {
    const auto half_of = [](std::vector<std::pair<double, double>> lengths) { return topology::weighted_quantile(lengths, 0.5); };
    EXPECT_EQ(half_of({{1, 1}, {3, 1}, {2, 1}}), 2);
    EXPECT_EQ(half_of({{0, 1}, {5e-324, 4}}), 5e-324);
    EXPECT_EQ(half_of({{7, 1}, {HUGE_VAL, 0.1}}), 7);
}

TEST(Thickness, of_layers_is_about_their_height) {
    for (const int layers : {1, 3, 8, 30}) {
        const double t = thickness(basin(layers, 8, 4e5, 4000));
        EXPECT_GT(t, 3400) << layers;
        EXPECT_LT(t, 4800) << layers;
    }
}

TEST(Thickness, does_not_change_where_the_body_lies_or_how_it_is_turned) {
    Triangles all = basin(3, 8, 4e5, 4000);
    const double before = thickness(all);
    for (auto& t : all) {
        for (Vec3& p : t) p = tilted(p);
    }
    EXPECT_NEAR(thickness(all), before, 1e-5 * before);
}

TEST(Thickness, hardly_depends_on_how_finely_it_is_triangulated) {
    const double coarse = thickness(basin(3, 8, 4e5, 4000)), fine = thickness(basin(3, 64, 4e5, 4000));
    EXPECT_NEAR(fine, coarse, 0.1 * coarse);
}

TEST(Thickness, is_not_changed_by_a_stray_part) {
    const double before = thickness(basin(3, 8, 4e5, 4000));
    for (const double size : {10.0, 1e3, 2e4}) {
        for (const double height : {-5000.0, 5000.0, 50000.0}) {
            Triangles all = basin(3, 8, 4e5, 4000);
            all.push_back({Vec3{1e5, 1e5, height}, Vec3{1e5 + size, 1e5, height}, Vec3{1e5, 1e5 + size / 10, height + size}});
            EXPECT_NEAR(thickness(all), before, 0.02 * before) << size << " at " << height;
            EXPECT_GT(topology::slab_of(all).sheets, 3.9);
        }
    }
}

TEST(Thickness, of_a_plane_is_none) {
    Triangles plane;
    add_sheet(plane, 5, 1000, 3);
    EXPECT_EQ(thickness(plane), 0);
    EXPECT_EQ(topology::slab_of({}).thickness, 0);
}

TEST(Sheets, are_counted_whatever_their_outline) {
    for (const int layers : {1, 3, 8}) {
        Triangles all = basin(layers, 8, 4e5, 4000);
        EXPECT_NEAR(topology::slab_of(all).sheets, layers + 1, 0.01 * (layers + 1));
        for (auto& t : all) {
            for (Vec3& p : t) p = tilted({0.3 * p[0], p[1], p[2]});
        }
        EXPECT_NEAR(topology::slab_of(all).sheets, layers + 1, 0.01 * (layers + 1)) << "narrow and turned";
    }
    Triangles patches;
    add_sheet(patches, 4, 1000, 0, 30);
    add_sheet(patches, 4, 1000, 0, 30);
    for (std::size_t i = patches.size() / 2; i < patches.size(); ++i) {
        for (Vec3& p : patches[i]) p[0] += 1001;
    }
    EXPECT_NEAR(topology::slab_of(patches).sheets, 1, 0.05);
}

TEST(Flatness, of_basins_and_sheets) {
    EXPECT_EQ(topology::flatness({300, 2}, 1000), 1);
    EXPECT_EQ(topology::flatness({200, 2}, 1000), 1);
    EXPECT_DOUBLE_EQ(topology::flatness({20, 2}, 1000), 0.1);
    EXPECT_DOUBLE_EQ(topology::flatness({20, 7}, 1000), 0.1);
    EXPECT_DOUBLE_EQ(topology::flatness({0.3, 2}, 1000), 0.01);
    EXPECT_EQ(topology::flatness({10, 1}, 1000), 1) << "a sheet";
    EXPECT_DOUBLE_EQ(topology::flatness({20, 1.25}, 1000), std::sqrt(0.1));
    EXPECT_EQ(topology::flatness({0, 0}, 0), 1);
}

/// A surface of separate triangles.
Surface surface_of(const Triangles& triangles) {
    Surface surface;
    for (const auto& t : triangles) {
        for (const Vec3& p : t) {
            surface.polygons.corners.push_back(static_cast<std::uint32_t>(surface.points.size()));
            surface.points.push_back(p);
        }
    }
    return surface;
}

TEST(SearchLength, of_basins_is_a_two_hundredth_of_their_thickness) {
    for (const double height : {2000.0, 4000.0, 8000.0}) {
        Dataset data;
        data.objects.emplace_back(surface_of(basin(4, 6, 4e5, height)));
        const auto lengths = topology::local_lengths(data, {});
        ASSERT_EQ(lengths.clusters.size(), 1u);
        EXPECT_GT(lengths.largest.near, height / 250);
        EXPECT_LT(lengths.largest.near, height / 170);
    }
}

TEST(SearchLength, of_a_basin_is_not_changed_by_a_stray_part) {
    Dataset data;
    data.objects.emplace_back(surface_of(basin(4, 6, 4e5, 4000)));
    const double before = topology::local_lengths(data, {}).largest.near;
    for (const double height : {-3000.0, 4500.0, 6500.0}) {
        Dataset all = data;
        all.objects.emplace_back(surface_of({{Vec3{2e5, 2e5, height}, Vec3{2e5 + 900, 2e5, height + 900}, Vec3{2e5, 2e5 + 900, height}}}));
        const auto lengths = topology::local_lengths(all, {});
        EXPECT_NEAR(lengths.of(0).near, before, 0.02 * before) << height;
    }
}

}  // namespace
}  // namespace geomend
