// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/brep.h"

#include <gtest/gtest.h>

namespace geomend {
namespace {

BrepData one_triangle() {
    BrepData d;
    d.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    BrepData::Surface s;
    s.nodes = {VertexId{0u}, VertexId{1u}, VertexId{2u}};
    s.polygons.corners = {0, 1, 2};
    s.neighbours = {no_index, no_index, no_index};
    d.surfaces.push_back(s);
    return d;
}

TEST(Brep, TakesConsistentData) { EXPECT_TRUE(Brep::make(one_triangle())); }

TEST(Brep, RefusesIndicesOutOfRange) {
    auto d = one_triangle();
    d.surfaces[0].nodes[1] = VertexId{3u};
    EXPECT_FALSE(Brep::make(d));
    d = one_triangle();
    d.surfaces[0].polygons.corners[0] = 3;
    EXPECT_FALSE(Brep::make(d));
    d = one_triangle();
    d.corners.push_back({"c", VertexId{7u}});
    EXPECT_FALSE(Brep::make(d));
}

TEST(Brep, RefusesOneSidedAdjacency) {
    auto d = one_triangle();
    d.surfaces[0].polygons.corners = {0, 1, 2, 1, 0, 2};
    d.surfaces[0].neighbours = {1, no_index, no_index, no_index, no_index, no_index};
    EXPECT_FALSE(Brep::make(d));
    d.surfaces[0].neighbours[3] = 0;
    EXPECT_TRUE(Brep::make(d));
}

}  // namespace
}  // namespace geomend
