// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/narrow_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

// Which cells with small angles surfaces force.

namespace geomend::volumes {
namespace {

/// A flat cell about a place.
RegionCells flat_cell(const Vec3& at) {
    RegionCells region;
    for (const Vec3& d : {Vec3{-0.2, 0, 0}, Vec3{0.2, -0.2, 0}, Vec3{0.2, 0.2, 0}, Vec3{0, 0, 0.002}})
        region.new_vertices.push_back({at[0] + d[0], at[1] + d[1], at[2] + d[2]});
    return region;
}

NarrowCells found(const RegionFacets& facets, RegionCells region) {
    const auto first = static_cast<std::uint32_t>(facets.positions.size());
    region.cells = {{first, first + 1, first + 2, first + 3}};
    return narrow_cells(facets, region, 1);
}

/// Two triangles along the edge from (0, -2, 0) to (0, 2, 0), at an angle; the region lies between them, or around them.
RegionFacets wedge(double degrees, bool between) {
    const double angle = degrees * std::numbers::pi / 180;
    RegionFacets facets;
    facets.positions = {{0, -2, 0}, {0, 2, 0}, {4, 0, 0}, {4 * std::cos(angle), 0, 4 * std::sin(angle)}};
    facets.triangles = {{0, 2, 1}, {0, 1, 3}};  // the first looks up, into the wedge
    facets.sides = {between ? in_front : behind, between ? in_front : behind};
    return facets;
}

/// Two large triangles above each other.
RegionFacets sheets(double apart) {
    RegionFacets facets;
    facets.positions = {{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}, {-5, -5, apart}, {5, -5, apart}, {0, 5, apart}};
    facets.triangles = {{0, 1, 2}, {3, 4, 5}};
    facets.sides = {in_front, behind};
    return facets;
}

TEST(NarrowCells, ACellInTheOpenIsNotForced) {
    const NarrowCells far = found(sheets(20), flat_cell({0, 0, 10}));
    EXPECT_EQ(far.all, 1u);
    EXPECT_EQ(far.forced, 0u);
}

TEST(NarrowCells, SheetsNearerThanHalfTheSizeForceACell) {
    EXPECT_EQ(found(sheets(0.4), flat_cell({0, 0, 0.2})).forced, 1u);
    EXPECT_EQ(found(sheets(0.6), flat_cell({0, 0, 0.3})).forced, 0u);
    EXPECT_EQ(found(sheets(0.4), flat_cell({0, 0, 3})).forced, 0u);
}

TEST(NarrowCells, AContactBelowTenDegreesForcesTheCellsBesideIt) {
    EXPECT_EQ(found(wedge(6, true), flat_cell({0.8, 0, 0.02})).forced, 1u);
    EXPECT_EQ(found(wedge(6, false), flat_cell({-0.8, 0, 0})).forced, 0u);
    EXPECT_EQ(found(wedge(6, true), flat_cell({3.5, 0, 0.2})).forced, 0u);
    EXPECT_EQ(found(wedge(30, true), flat_cell({0.8, 0, 0.1})).forced, 0u);
}

}  // namespace
}  // namespace geomend::volumes
