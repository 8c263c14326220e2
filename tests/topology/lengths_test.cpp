// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/lengths.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

namespace geomend {
namespace {

/// A sheet of n x n squares of a side each, from a corner on; heights by a function.
template <class Height>
Surface sheet(const char* name, std::uint32_t n, double side, const Vec3& corner, const Height& height) {
    Surface surface;
    surface.info.name = name;
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double x = corner[0] + side * i, y = corner[1] + side * j;
            surface.points.push_back({x, y, corner[2] + height(i, j)});
        }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = i + j * (n + 1), b = a + 1, c = a + n + 1, d = c + 1;
            surface.polygons.corners.insert(surface.polygons.corners.end(), {a, b, d, a, d, c});
        }
    }
    return surface;
}

Surface flat_sheet(const char* name, std::uint32_t n, double side, const Vec3& corner) {
    return sheet(name, n, side, corner, [](std::uint32_t, std::uint32_t) { return 0.0; });
}

Dataset with(std::vector<Surface> surfaces) {
    Dataset data;
    for (Surface& s : surfaces) data.objects.emplace_back(std::move(s));
    return data;
}

topology::LocalLengths lengths_of(const Dataset& data) { return topology::local_lengths(data, {}); }

TEST(Lengths, of_one_sheet_are_those_of_its_shape) {
    const auto coarse = lengths_of(with({flat_sheet("a", 1, 1000, {0, 0, 0})}));
    const auto fine = lengths_of(with({flat_sheet("a", 50, 20, {0, 0, 0})}));
    ASSERT_EQ(coarse.clusters.size(), 1u);
    EXPECT_NEAR(coarse.largest.diameter, 1000 * std::sqrt(2.0), 1e-6);
    EXPECT_NEAR(fine.largest.diameter, coarse.largest.diameter, 1e-6);
    EXPECT_NEAR(fine.largest.tolerance, coarse.largest.tolerance, 1e-12);
}

// Sanitised builds look at the ways there: no exponent and no share of such lengths may be taken for an index.
TEST(Lengths, are_worked_out_where_squares_overflow_or_vanish) {
    for (const double side : {1e200, 1e300, 1e-160, 5e-324}) {
        const auto lengths = lengths_of(with({flat_sheet("a", 3, side, {0, 0, 0}), flat_sheet("b", 3, 1, {0, 0, 1})}));
        ASSERT_FALSE(lengths.clusters.empty()) << side;
        for (const topology::Lengths& l : lengths.clusters) EXPECT_FALSE(std::isnan(l.tolerance) || std::isnan(l.near)) << side;
    }
}

TEST(Lengths, do_not_change_where_one_triangle_is_refined) {
    Surface plain = flat_sheet("a", 2, 500, {0, 0, 0});
    Surface refined = plain;
    // The first triangle's middle again and again: a thousand small triangles at a corner.
    for (int k = 0; k < 500; ++k) {
        auto& c = refined.polygons.corners;
        const std::uint32_t a = c[0], b = c[1], d = c[2];
        Vec3 middle{};
        for (std::size_t x = 0; x < 3; ++x)
            middle[x] = (refined.points[a][x] * 0.98 + refined.points[b][x] * 0.01 + refined.points[d][x] * 0.01);
        refined.points.push_back(middle);
        const auto m = static_cast<std::uint32_t>(refined.points.size() - 1);
        c[2] = m;
        c.insert(c.end(), {b, d, m, d, a, m});
    }
    const auto before = lengths_of(with({plain})), after = lengths_of(with({refined}));
    EXPECT_NEAR(after.largest.diameter, before.largest.diameter, 1e-6);
    EXPECT_TRUE(after.outlying.empty());
}

TEST(Lengths, of_a_basin_with_small_triangles_follow_the_triangles) {
    const auto basin = lengths_of(with({flat_sheet("a", 100, 100, {0, 0, 0}), flat_sheet("far", 1, 400000, {0, 0, 50})}));
    EXPECT_NEAR(basin.of(1).near, 1e-3 * basin.of(1).diameter, 1);
    const auto fine = lengths_of(with({flat_sheet("a", 400, 100, {0, 0, 0})}));
    EXPECT_NEAR(fine.largest.near, 25, 1e-6);
}

TEST(Lengths, of_copies_in_a_row_are_those_of_one) {
    std::vector<Surface> row;
    for (int k = 0; k < 16; ++k) row.push_back(flat_sheet("a", 4, 250, {1250.0 * k, 0, 0}));
    const auto one = lengths_of(with({row[0]})), all = lengths_of(with(row));
    ASSERT_EQ(all.clusters.size(), 16u);
    for (const auto& l : all.clusters) EXPECT_NEAR(l.tolerance, one.largest.tolerance, 1e-12);
}

TEST(Lengths, of_surfaces_that_nearly_touch_are_common_ones) {
    const auto both = lengths_of(with({flat_sheet("a", 4, 250, {0, 0, 0}), flat_sheet("b", 4, 250, {1001, 300, 0})}));
    EXPECT_EQ(both.clusters.size(), 1u);
}

/// A cube around a point, turned about two axes.
Surface turned_cube(const char* name, double half, const Vec3& middle, double angle) {
    Surface surface;
    surface.info.name = name;
    const double c = std::cos(angle), s = std::sin(angle);
    for (int v = 0; v < 8; ++v) {
        const double x = (v & 1) != 0 ? half : -half, y = (v & 2) != 0 ? half : -half, z = (v & 4) != 0 ? half : -half;
        const double u = c * x - s * y, w = s * x + c * y;
        surface.points.push_back({middle[0] + u, middle[1] + c * w - s * z, middle[2] + s * w + c * z});
    }
    for (const auto& [p, q, r, t] :
         {std::array{0u, 2u, 3u, 1u}, {4u, 5u, 7u, 6u}, {0u, 1u, 5u, 4u}, {2u, 6u, 7u, 3u}, {0u, 4u, 6u, 2u}, {1u, 3u, 7u, 5u}}) {
        surface.polygons.corners.insert(surface.polygons.corners.end(), {p, q, r, p, r, t});
    }
    return surface;
}

TEST(Lengths, of_a_body_inside_of_another_are_common_ones_however_both_are_turned) {
    for (const double angle : {0.0, 0.3, 0.785398, 1.1}) {
        const auto inside = lengths_of(with({turned_cube("in", 1, {0.5, 4, -3}, 2 * angle), turned_cube("out", 10, {0, 0, 0}, angle)}));
        EXPECT_EQ(inside.clusters.size(), 1u) << angle;
        const auto beside = lengths_of(with({turned_cube("small", 1, {0, 0, 20}, 2 * angle), turned_cube("large", 10, {0, 0, 0}, angle)}));
        EXPECT_EQ(beside.clusters.size(), 2u) << angle;
        const auto above = lengths_of(with({turned_cube("small", 1, {500, 500, 100}, angle), flat_sheet("sheet", 4, 250, {0, 0, 0})}));
        EXPECT_EQ(above.clusters.size(), 2u) << angle;
    }
}

TEST(Lengths, are_not_changed_by_a_stray_part) {
    Surface stray = flat_sheet("a", 4, 250, {0, 0, 0});
    const auto first = static_cast<std::uint32_t>(stray.points.size());
    stray.points.insert(stray.points.end(), {{1e6, 0, 0}, {1e6 + 10, 0, 0}, {1e6, 10, 0}});
    stray.polygons.corners.insert(stray.polygons.corners.end(), {first, first + 1, first + 2});
    const auto plain = lengths_of(with({flat_sheet("a", 4, 250, {0, 0, 0})})), all = lengths_of(with({stray}));
    EXPECT_NEAR(all.largest.diameter, plain.largest.diameter, 1e-6);
    EXPECT_TRUE(all.outlying.empty()) << "a part of its own, not an outlier";
}

class NoDataHeight : public ::testing::TestWithParam<double> {};

TEST_P(NoDataHeight, is_named_and_takes_no_part) {
    Surface surface = flat_sheet("hz", 6, 100, {0, 0, -1500});
    surface.points[17][2] = GetParam();
    surface.points[30][2] = GetParam();
    const auto found = lengths_of(with({surface}));
    EXPECT_LT(found.largest.diameter, 1000);
    ASSERT_EQ(found.outlying.size(), 2u);
    EXPECT_EQ(found.outlying[0].point, 17u);
    EXPECT_EQ(found.outlying[1].point, 30u);
    EXPECT_GT(found.outlying[0].times, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Numbers, NoDataHeight, ::testing::Values(-999.25, -999.0, -32768.0, -9999.0, -99999.0, 99999.0, 1e9, 1e15, -3e7));

TEST(Lengths, know_no_data_at_many_points_of_a_surface) {
    for (const double height : {-999.25, -32768.0, -99999.0, 1e9}) {
        for (const std::uint32_t rows : {1u, 2u, 4u, 6u}) {
            Surface surface = flat_sheet("hz", 6, 100, {0, 0, -1500});
            for (std::uint32_t p = 0; p < 7 * rows; ++p) surface.points[p][2] = height;
            const auto found = lengths_of(with({surface}));
            EXPECT_EQ(found.outlying.size(), 7 * rows) << height;
            EXPECT_LT(found.largest.diameter, 1000) << height;
        }
    }
}

TEST(Lengths, know_round_no_data_at_a_corner_of_a_surface) {
    Surface surface = flat_sheet("hz", 6, 100, {0, 0, -1500});
    for (const std::size_t p : {0, 1, 2, 7, 8, 9, 14, 15, 16}) surface.points[p][2] = -999;
    EXPECT_EQ(lengths_of(with({surface})).outlying.size(), 9u);
}

/// A sheet that stands, or leans, with rows at some heights.
Surface wall(const std::vector<double>& heights, double lean) {
    Surface surface = flat_sheet("wall", static_cast<std::uint32_t>(heights.size() - 1), 100, {0, 0, 0});
    for (Vec3& p : surface.points) {
        p[2] = heights[static_cast<std::size_t>(std::lround(p[1] / 100))];
        p[1] = lean * p[2];
    }
    return surface;
}

TEST(Lengths, know_walls_that_end_at_a_usual_depth_from_no_data) {
    for (const double lean : {0.0, 0.3}) {
        for (const double bottom : {-999.0, -9999.0}) {
            EXPECT_TRUE(lengths_of(with({wall({0, bottom}, lean)})).outlying.empty()) << lean << ' ' << bottom;
            EXPECT_TRUE(lengths_of(with({wall({0, bottom / 3, 2 * bottom / 3, bottom}, lean)})).outlying.empty()) << lean << ' ' << bottom;
        }
    }
    EXPECT_TRUE(lengths_of(with({wall({0, -99999}, 0)})).outlying.empty());
}

/// The closed surface of a box of four by four columns, with points of its sides at some heights, lowest first.
Surface box(const std::vector<double>& heights) {
    Surface surface;
    surface.info.name = "box";
    std::map<Vec3, std::uint32_t> known;
    const auto point = [&](double x, double y, double z) {
        const auto [at, added] = known.emplace(Vec3{2500 * x, 2500 * y, z}, static_cast<std::uint32_t>(surface.points.size()));
        if (added) surface.points.push_back(at->first);
        return at->second;
    };
    const auto square = [&](const std::array<std::uint32_t, 4>& q) {
        surface.polygons.push_back(std::array<std::uint32_t, 3>{q[0], q[1], q[2]});
        surface.polygons.push_back(std::array<std::uint32_t, 3>{q[0], q[2], q[3]});
    };
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            for (const double z : {heights.front(), heights.back()})
                square({point(i, j, z), point(i + 1, j, z), point(i + 1, j + 1, z), point(i, j + 1, z)});
        }
        for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
            const double low = heights[k], high = heights[k + 1];
            for (const double end : {0.0, 4.0}) {
                square({point(i, end, low), point(i + 1, end, low), point(i + 1, end, high), point(i, end, high)});
                square({point(end, i, low), point(end, i + 1, low), point(end, i + 1, high), point(end, i, high)});
            }
        }
    }
    return surface;
}

TEST(Lengths, know_a_body_that_ends_at_a_usual_depth_from_no_data) {
    for (const double base : {-999.25, -9999.0, -99999.0, -1e9}) {
        EXPECT_TRUE(lengths_of(with({box({base, 0.4 * base, 0})})).outlying.empty()) << base;
        EXPECT_TRUE(lengths_of(with({box({0, -0.4 * base, -base})})).outlying.empty()) << -base;
        EXPECT_TRUE(lengths_of(with({wall({0, 0.4 * base, base}, 0)})).outlying.empty()) << base;
    }
    Surface pulled = box({-1500, -1000, -500});
    for (Vec3& p : pulled.points) {
        if (p == Vec3{5000, 5000, -1500} || p == Vec3{5000, 2500, -1500}) p[2] = -99999;
    }
    EXPECT_EQ(lengths_of(with({pulled})).outlying.size(), 2u) << "two points of the base are not all of it";
}

/// A closed cone of eight sides with a base that has a point in the middle, and with a collar, a narrower ring above the base, or without.
Surface cone(double height, bool collar) {
    Surface surface;
    surface.info.name = "cone";
    surface.points = {{0, 0, 0}, {0.3, 0.2, height}};
    const auto ring = [&](double radius, double z) {
        for (int i = 0; i < 8; ++i) surface.points.push_back({radius * std::cos(i * 0.785398), radius * std::sin(i * 0.785398), z});
    };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        surface.polygons.corners.insert(surface.polygons.corners.end(), {a, b, c});
    };
    ring(1, 0);
    if (collar) ring(0.5, 0.5);
    for (std::uint32_t i = 0; i < 8; ++i) {
        const std::uint32_t here = 2 + i, next = 2 + (i + 1) % 8, up = collar ? 8 : 0;
        add(0, next, here);
        if (collar) {
            add(here, next, next + 8);
            add(here, next + 8, here + 8);
        }
        add(here + up, next + up, 1);
    }
    return surface;
}

TEST(Lengths, know_the_apex_of_a_body_from_a_point_that_was_pulled_out_of_one) {
    for (const double height : {3.0, 30.0, 300.0, 3e4}) {
        Surface body = cone(height, false);
        for (int turned = 0; turned < 2; ++turned) {
            const auto found = lengths_of(with({body}));
            EXPECT_TRUE(found.outlying.empty()) << height;
            EXPECT_GT(found.largest.diameter, height);
            std::swap(body.polygons.corners[0], body.polygons.corners[1]);  // how it is wound plays no part
        }
    }
    const auto pulled = lengths_of(with({cone(300, true)}));
    ASSERT_EQ(pulled.outlying.size(), 1u);
    EXPECT_EQ(pulled.outlying[0].point, 1u);
    Surface open = cone(300, false);
    open.polygons.corners.resize(open.polygons.corners.size() - 6);
    EXPECT_EQ(lengths_of(with({open})).outlying.size(), 1u) << "it encloses nothing";
}

TEST(Lengths, know_a_needle_from_no_data) {
    const auto needle = sheet("salt", 20, 100, {0, 0, -1000}, [](std::uint32_t i, std::uint32_t j) {
        return i == 10 && j == 10 ? 9000.0 : i + j == 20 ? 200.0 : 0.0;
    });
    EXPECT_TRUE(lengths_of(with({needle})).outlying.empty());
}

TEST(Lengths, of_single_precision_have_its_steps_apart_from_the_offset) {
    Surface surface = flat_sheet("a", 4, 250, {6.6e6, 0, 0});
    surface.info.precision = CoordinatePrecision::single_precision;
    EXPECT_DOUBLE_EQ(lengths_of(with({surface})).largest.tolerance, 2);
    surface.info.stored_around = {6.6e6, 0, 0};
    EXPECT_DOUBLE_EQ(lengths_of(with({surface})).largest.tolerance, 4 * std::ldexp(1.0, -14));
}

// Steps of a northing of millions are half a metre, those of a depth of two thousand are 0.1 mm.
TEST(Lengths, of_single_precision_tell_heights_apart_that_northings_could_not) {
    Surface surface = flat_sheet("a", 4, 250, {5e5, 6e6, -2000});
    surface.info.precision = CoordinatePrecision::single_precision;
    const auto lengths = lengths_of(with({surface}));
    EXPECT_DOUBLE_EQ(lengths.largest.tolerance, 2);
    ASSERT_EQ(lengths.clusters.size(), 1u);
    const Vec3 shares = lengths.clusters[0].shares;
    EXPECT_DOUBLE_EQ(shares[0], 1.0 / 16);
    EXPECT_DOUBLE_EQ(shares[1], 1);
    EXPECT_DOUBLE_EQ(2 * shares[2], 4 * std::ldexp(1.0, -13));
    EXPECT_EQ(topology::local_lengths(with({surface}), {0.5, 7}).clusters[0].shares, (Vec3{1, 1, 1}));
}

TEST(Lengths, that_are_given_are_those_of_all) {
    const auto given = topology::local_lengths(with({flat_sheet("a", 4, 250, {0, 0, 0}), flat_sheet("b", 4, 1, {1e5, 0, 0})}), {0.5, 7});
    ASSERT_EQ(given.clusters.size(), 2u);
    for (const auto& l : given.clusters) {
        EXPECT_EQ(l.tolerance, 0.5);
        EXPECT_EQ(l.near, 7);
    }
}

TEST(Lengths, that_are_given_hold_where_there_is_no_surface_and_no_cell) {
    const auto given = topology::local_lengths(Dataset{}, {0.5, 7});
    EXPECT_TRUE(given.clusters.empty());
    EXPECT_EQ(given.largest.tolerance, 0.5);
    EXPECT_EQ(given.largest.near, 7);
    EXPECT_EQ(given.largest.shares, (Vec3{1, 1, 1}));
}

}  // namespace
}  // namespace geomend
