// SPDX-License-Identifier: AGPL-3.0-or-later
// Inputs on which codes for cutting are known to crash, to hang or to leave pairs that cross: one test a row of what was measured of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "arrangement/arrange.h"
#include "arrangement/exact_pairs.h"
#include "arrangement/sheets.h"
#include "arrangement/soup_faults.h"
#include "geometry/vectors.h"

namespace geomend::test {
namespace {

constexpr double pi = 3.14159265358979323846;

void add(TriangleSoup& soup, const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    const std::uint32_t patch = soup.patches.empty() ? 0 : soup.patches.back() + 1;
    soup.vertices.insert(soup.vertices.end(), points.begin(), points.end());
    for (const auto& [a, b, c] : triangles) {
        soup.triangles.push_back({first + a, first + b, first + c});
        soup.patches.push_back(patch);
    }
}

/// Wavy open surfaces that cross, with triple points: horizons, and faults of two families.
TriangleSoup wavy_model(std::uint32_t cells, int horizons, int faults) {
    TriangleSoup soup;
    for (int h = 0; h < horizons; ++h) {
        add_sheet(soup, cells, cells, [&](double u, double v) {
            return Vec3{1000 * u, 1000 * v, 800.0 * (h + 0.5) / horizons + 30 * std::sin(6.1 * u + h) * std::cos(5.3 * v + 0.3 * h)};
        });
    }
    for (int f = 0; f < 2 * faults; ++f) {
        add_sheet(soup, cells, cells, [&](double u, double v) {
            const double across = 1000 * (f / 2 + 0.5) / faults + 60 * (v - 0.5) + 25 * std::sin(7.3 * u + f), along = -20 + 1040 * u;
            const double up = -20 + 840 * v;
            return f % 2 == 0 ? Vec3{across, along, up} : Vec3{along, across, up};
        });
    }
    return soup;
}

TriangleSoup placed(TriangleSoup soup, const Vec3& scale, const Vec3& offset) {
    for (Vec3& p : soup.vertices) {
        for (std::size_t k = 0; k < 3; ++k) p[k] = p[k] * scale[k] + offset[k];
    }
    return soup;
}

TriangleSoup cut(const TriangleSoup& soup, double tolerance) { return arrangement::arrange(soup, {.tolerance = tolerance})->soup; }

/// Each triangle over vertices of its own, as a soup comes from a file without topology.
TriangleSoup torn(const TriangleSoup& soup) {
    TriangleSoup loose;
    loose.patches = soup.patches;
    for (const Triangle& t : soup.triangles) {
        const auto first = static_cast<std::uint32_t>(loose.vertices.size());
        for (const std::uint32_t v : t) loose.vertices.push_back(soup.vertices[v]);
        loose.triangles.push_back({first, first + 1, first + 2});
    }
    return loose;
}

/// Six fans, their apices around a line, whose edges overlap on it in pieces of different lengths.
TriangleSoup fans() {
    TriangleSoup soup;
    for (int fan = 0; fan < 6; ++fan) {
        const double angle = fan * pi / 3 + 0.1, low = 0.07 * fan;
        std::vector<Vec3> points{{std::cos(angle), std::sin(angle), 0.5}};
        for (int k = 0; k <= 4; ++k) points.push_back({0, 0, low + k * (0.9 - 0.05 * fan) / 4});
        add(soup, points, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
    }
    return soup;
}

TriangleSoup planes_through_a_line() {
    TriangleSoup soup;
    for (int plane = 0; plane < 4; ++plane) {
        const double angle = 0.3 + plane * pi / 4;
        add_sheet(soup, 12, 10, [&](double u, double v) {
            return Vec3{(u - 0.5) * std::cos(angle) + 0.1 * (v - 0.5), (u - 0.5) * std::sin(angle), v - 0.2 * (u - 0.5)};
        });
    }
    return soup;
}

/// A sheet that stands on another: with a line of its vertices, or between them.
TriangleSoup t_contact(bool conformal) {
    TriangleSoup soup;
    add_sheet(soup, 8, 8, [](double u, double v) { return Vec3{u, v, 0}; });
    add_sheet(soup, conformal ? 8 : 5, 4, [&](double u, double v) { return conformal ? Vec3{u, 0.5, v} : Vec3{0.1 + 0.8 * u, 0.37, v}; });
    return soup;
}

TriangleSoup overlapping_sheets() {
    TriangleSoup soup;
    add_sheet(soup, 20, 20, [](double u, double v) { return Vec3{u, v, 0.3 * u}; });
    add_sheet(soup, 23, 17, [](double u, double v) { return Vec3{0.31 + u, 0.17 + v, 0.3 * (0.31 + u)}; });
    return soup;
}

TriangleSoup the_same_sheet_twice() {
    TriangleSoup soup;
    for (int copy = 0; copy < 2; ++copy) add_sheet(soup, 20, 20, [](double u, double v) { return Vec3{u, v, 0.2 * u * v}; });
    return soup;
}

/// Triangles without area of each kind: a vertex twice, two at one place, three in line, three at one place.
TriangleSoup degenerate(bool in_a_model) {
    TriangleSoup soup;
    if (in_a_model) soup = wavy_model(6, 2, 1);
    add(soup, {{100, 200, 300}, {900, 700, 500}}, {{0, 1, 0}});
    add(soup, {{300, 200, 300}, {300, 200, 300}, {700, 800, 400}}, {{0, 1, 2}});
    add(soup, {{0, 0, 0}, {400, 400, 400}, {800, 800, 800}}, {{0, 1, 2}});
    add(soup, {{500, 500, 500}, {500, 500, 500}, {500, 500, 500}}, {{0, 1, 2}});
    return soup;
}

struct Row {
    const char* name;
    std::function<TriangleSoup()> soup;
    double tolerance;
};

const std::vector<Row>& rows() {
    static const std::vector<Row> all{
        {"OwnOutputFedBack", [] { return cut(wavy_model(8, 3, 2), 1e-4); }, 1e-4},
        {"OwnOutputFedBackInPieces", [] { return torn(cut(wavy_model(5, 2, 1), 1e-4)); }, 1e-4},
        {"ConformalModelFedBack", [] { return cut(planes_through_a_line(), 1e-7); }, 1e-7},
        {"CoplanarPartialOverlapOfTwoSheets", overlapping_sheets, 1e-6},
        {"ExactDuplicateSheet", the_same_sheet_twice, 1e-6},
        {"SixFansOverlappingOnOneLine", fans, 1e-7},
        {"DegenerateTrianglesAlone", [] { return degenerate(false); }, 1e-4},
        {"DegenerateTrianglesInAModel", [] { return degenerate(true); }, 1e-4},
        {"FourPlanesThroughOneLineRounded", planes_through_a_line, 1e-7},
        {"TContactConformal", [] { return t_contact(true); }, 1e-7},
        {"TContactNotConformal", [] { return t_contact(false); }, 1e-7},
        {"UtmScaledSmallModel",
         [] {
             return placed(wavy_model(10, 2, 1), {3, 3, 0.8}, {4e5, 6.5e6, -2000});
         },
         1e-3},
        {"UtmScaledModel",
         [] {
             return placed(wavy_model(8, 4, 2), {3, 3, 0.8}, {4e5, 6.5e6, -2000});
         },
         1e-3},
        {"UtmPlanesThroughOneLine",
         [] {
             return placed(planes_through_a_line(), {1000, 1000, 1000}, {4e5, 6.5e6, 0});
         },
         1e-3},
        {"UtmOverlap",
         [] {
             return placed(overlapping_sheets(), {1000, 1000, 1000}, {4e5, 6.5e6, 0});
         },
         1e-3},
    };
    return all;
}

double area_of_all(const TriangleSoup& soup) {
    double sum = 0;
    for (const auto& [a, b, c] : soup.triangles) {
        const Vec3 n = cross(minus(soup.vertices[b], soup.vertices[a]), minus(soup.vertices[c], soup.vertices[a]));
        sum += 0.5 * std::sqrt(dot(n, n));
    }
    return sum;
}

class DegenerateTable : public testing::TestWithParam<std::size_t> {};

TEST_P(DegenerateTable, IsCutWithoutFault) {
    const Row& row = rows()[GetParam()];
    const TriangleSoup soup = row.soup();
    ASSERT_EQ(to_string(fault_in_child(soup, row.tolerance, 60)), "none");  // crash, pairs, distances, pieces and a second cut
    const auto result = arrangement::arrange(soup, {.tolerance = row.tolerance});
    ASSERT_TRUE(result.ok());
    EXPECT_NEAR(area_of_all(result->soup), area_of_all(soup), 1e-6 * area_of_all(soup));
    for (const Triangle& t : result->soup.triangles) EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
}

INSTANTIATE_TEST_SUITE_P(Rows, DegenerateTable, testing::Range<std::size_t>(0, rows().size()),
                         [](const auto& row) { return std::string(rows()[row.param].name); });

// What the rows ask beyond that: counts.
TEST(DegenerateTables, ModelsThatAreConformalStayAsTheyAre) {
    for (const auto& soup : {cut(wavy_model(12, 2, 2), 1e-4), t_contact(true)}) {
        const auto again = arrangement::arrange(soup, {.tolerance = 1e-4});
        ASSERT_TRUE(again.ok());
        EXPECT_EQ(again->soup.triangles.size(), soup.triangles.size());
    }
}

TEST(DegenerateTables, CopiesOfASheetLieOverTheSameVertices) {
    const auto soup = cut(the_same_sheet_twice(), 1e-6);
    EXPECT_EQ(soup.vertices.size(), 21u * 21u);
    EXPECT_EQ(soup.triangles.size(), 2u * 800u);
}

TEST(DegenerateTables, NothingIsLeftOfTrianglesWithoutArea) {
    EXPECT_EQ(cut(degenerate(false), 1e-4).triangles.size(), 0u);
    EXPECT_EQ(cut(degenerate(true), 1e-4).triangles.size(), cut(wavy_model(6, 2, 1), 1e-4).triangles.size());
}

TEST(DegenerateTables, PlanesThroughALineShareOneLine) {
    const auto soup = cut(planes_through_a_line(), 1e-7);
    std::vector<std::uint32_t> planes(soup.vertices.size(), 0);
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        for (const std::uint32_t v : soup.triangles[t]) planes[v] |= 1u << soup.patches[t];
    }
    EXPECT_GE(std::ranges::count(planes, 15u), 11) << "the vertices of the line are of all four";
    EXPECT_EQ(std::ranges::count_if(planes, [](std::uint32_t p) { return (p & (p - 1)) != 0 && p != 15u; }), 0) << "no other is of two";
}

}  // namespace
}  // namespace geomend::test
