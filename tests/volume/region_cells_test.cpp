// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/region_cells.h"

#include <gtest/gtest.h>

namespace geomend::volumes {
namespace {

// Two tetrahedra on either side of the triangle 0, 1, 2, with tips 3 (above) and 4 (below).
const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
const std::array<std::uint32_t, 4> upper = {0, 1, 2, 3}, lower = {0, 2, 1, 4};

RegionFacets facets_of(std::vector<Triangle> triangles, std::vector<FacetSides> sides, double volume) {
    RegionFacets facets;
    facets.region = 0;
    facets.vertices = {0, 1, 2, 3, 4};
    facets.positions = positions;
    facets.triangles = std::move(triangles);
    facets.sides = std::move(sides);
    facets.surfaces.assign(facets.triangles.size(), 0);
    facets.volume = volume;
    return facets;
}

// The three upper and the three lower faces, wound outwards, and the triangle between.
const std::vector<Triangle> around_upper = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, around_lower = {{1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
const Triangle between = {0, 1, 2};

RegionFacets both_with_sheet() {
    std::vector<Triangle> all = around_upper;
    all.insert(all.end(), around_lower.begin(), around_lower.end());
    all.push_back(between);
    return facets_of(all, {behind, behind, behind, behind, behind, behind, on_both}, 1.0 / 3);
}

RegionFacets upper_alone() {
    std::vector<Triangle> all = around_upper;
    all.push_back(between);
    return facets_of(all, {behind, behind, behind, in_front}, 1.0 / 6);
}

TEST(RegionCells, ATriangleInsideOfARegionIsAFaceOfCellsOnBothSides) {
    const auto cells = cells_of_region(both_with_sheet(), {{}, {upper, lower}});
    ASSERT_TRUE(cells) << cells.why().error.message;
    EXPECT_EQ(cells->cells.size(), 2u);
    EXPECT_DOUBLE_EQ(cells->volume, 1.0 / 3);
    EXPECT_NEAR(cells->least_dihedral, 54.735610317245346, 1e-9);  // between the oblique face and the others: atan sqrt 2
}

TEST(RegionCells, CellsBeyondItsFacetsAreLeftOut) {
    const auto cells = cells_of_region(upper_alone(), {{}, {lower, upper}});
    ASSERT_TRUE(cells) << cells.why().error.message;
    EXPECT_EQ(cells->cells, (std::vector{upper}));
}

TEST(RegionCells, CellsOnOneSideOfAFaceDoNotLieApart) {
    EXPECT_TRUE(lie_apart(std::vector{upper, lower}));
    const std::array<std::uint32_t, 4> turned_over = {0, 1, 2, 4};  // as if its tip were above
    for (const auto& first : {upper, std::array<std::uint32_t, 4>{1, 2, 0, 3}, std::array<std::uint32_t, 4>{3, 0, 2, 1}}) {
        EXPECT_TRUE(lie_apart(std::vector{first, lower}));
        EXPECT_FALSE(lie_apart(std::vector{first, turned_over}));
    }
}

TEST(RegionCells, CellsAreTurnedTheRightWay) {
    const auto cells = cells_of_region(upper_alone(), {{}, {{1, 0, 2, 3}}});
    ASSERT_TRUE(cells);
    EXPECT_DOUBLE_EQ(cells->volume, 1.0 / 6);
}

TEST(RegionCells, NewVerticesThatOnlyCellsBeyondUseGoWithThem) {
    const Tetrahedra all{{{9, 9, -9}, {0.2, 0.2, 0.2}}, {{0, 1, 2, 6}, {0, 1, 6, 3}, {1, 2, 6, 3}, {2, 0, 6, 3}, {0, 2, 1, 5}}};
    const auto cells = cells_of_region(upper_alone(), all);
    ASSERT_TRUE(cells) << cells.why().error.message;
    EXPECT_EQ(cells->new_vertices, (std::vector<Vec3>{{0.2, 0.2, 0.2}}));
    for (const auto& c : cells->cells) {
        for (const std::uint32_t v : c) EXPECT_LT(v, 6u);
    }
}

TEST(RegionCells, WhatDoesNotFillARegionIsRefused) {
    const auto message = [](const RegionFacets& facets, Tetrahedra all) {
        const auto cells = cells_of_region(facets, std::move(all));
        return cells ? std::string() : cells.why().error.message;
    };
    EXPECT_NE(message(both_with_sheet(), {{}, {upper}}), "");                                      // the lower half is missing
    EXPECT_NE(message(upper_alone(), {{}, {upper, upper}}).find("two cells"), std::string::npos);  // twice
    EXPECT_NE(message(upper_alone(), {{{0.5, 0, 0}}, {{0, 1, 5, 2}}}).find("no volume"), std::string::npos);
    EXPECT_NE(message(upper_alone(), {{{0, 0, 1}}, {{0, 1, 2, 5}}}).find("no face"), std::string::npos);  // a twin of its tip
    // A cell with other vertices fills more than the facets enclose.
    RegionFacets wrong = upper_alone();
    wrong.volume = 0.2;
    EXPECT_NE(message(wrong, {{}, {upper}}).find("volume"), std::string::npos);
    // The facets state the region on the side where no cell is.
    RegionFacets turned = upper_alone();
    turned.sides = {in_front, in_front, in_front, behind};
    EXPECT_NE(message(turned, {{}, {upper}}).find("beside"), std::string::npos);
}

}  // namespace
}  // namespace geomend::volumes
