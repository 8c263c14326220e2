// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/measures.h"

namespace geomend {
namespace {

using Box = std::array<Vec3, 2>;

TEST(Bounds, OfPointsLeaveOutWhatIsNotFinite) {
    PointSet points;
    points.points = {{1, 2, 3}, {-1, 5, 0}, {NAN, 100, 100}, {HUGE_VAL, 0, -50}};
    EXPECT_EQ(bounds(points), (Box{{{-1, 2, 0}, {1, 5, 3}}}));
}

TEST(Bounds, OfNothingAreNothing) {
    EXPECT_FALSE(bounds(PointSet{}).has_value());
    Surface surface;
    surface.points = {{NAN, 0, 0}};
    EXPECT_FALSE(bounds(surface).has_value());
}

TEST(Bounds, OfManyPointsSeeAllOfThem) {
    CellMesh mesh;
    for (int i = 0; i <= 100000; ++i) mesh.points.push_back({double(i), -2.0 * i, 7});
    EXPECT_EQ(bounds(mesh), (Box{{{0, -200000, 7}, {100000, 0, 7}}}));
}

TEST(Bounds, OfARotatedLatticeReachItsCorners) {
    Raster raster;
    raster.dims = {3, 2, 1};
    raster.origin = {10, 20, 5};
    raster.step = {{{1, 1, 0}, {-2, 2, 0}, {0, 0, 1}}};
    EXPECT_EQ(bounds(raster), (Box{{{8, 20, 5}, {12, 24, 5}}}));
}

TEST(Bounds, OfARectilinearGridAreThoseOfItsCoordinates) {
    Raster raster;
    raster.dims = {3, 2, 1};
    raster.coordinates = {{{0, 1, 5}, {4, 2}, {7}}};
    EXPECT_EQ(bounds(raster), (Box{{{0, 2, 7}, {5, 4, 7}}}));
}

TEST(Bounds, OfAHorizonGridTakeItsDefinedHeights) {
    Raster raster;
    raster.dims = {2, 2, 1};
    Attribute height;
    height.name = "height";
    height.values = std::vector<double>{-1000, 9999900.0, -1200, -900};
    height.no_data = 9999900.0;
    raster.info.attributes.push_back(height);
    raster.height_attribute = 0;
    EXPECT_EQ(bounds(raster), (Box{{{0, 0, -1200}, {1, 1, -900}}}));
    raster.info.attributes[0].values = std::vector<double>(4, 9999900.0);
    EXPECT_FALSE(bounds(raster).has_value());
}

TEST(Bounds, OfASplitGridSeeItsSplitNodes) {
    StructuredGrid grid;
    grid.points = {{0, 0, 0}};
    grid.splits.push_back({{0, 0, 0}, {0, 0, -8}, 1, 1});
    EXPECT_EQ(bounds(grid), (Box{{{0, 0, -8}, {0, 0, 0}}}));
}

TEST(Bounds, OfAWellAreThoseOfItsPathOrElseOfItsHead) {
    Well well;
    well.head = {1, 2, 3};
    EXPECT_EQ(bounds(well), (Box{{{1, 2, 3}, {1, 2, 3}}}));
    well.path = {{0, 0, 0}, {0, 0, -10}};
    EXPECT_EQ(bounds(well), (Box{{{0, 0, -10}, {0, 0, 0}}}));
}

}  // namespace
}  // namespace geomend
