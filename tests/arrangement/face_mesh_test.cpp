// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/face_mesh.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "arrangement/search.h"

namespace geomend::test {
namespace {

using arrangement::FaceMesh;

// Points of other sheets may be far off the plane, and one may stand right above another one. As a second point there it made triangles
// without area, between which no edge could be turned, and the search for one that can did not end.
TEST(FaceMesh, RefusesAPointThatIsSeenWhereAnotherOneIs) {
    const std::vector<Vec3> points{{2128657698, -19274010667, -30743947245}, {2128657698, -19274010667, 31284701351},
                                   {2128657698, 36551773070, 270377053},     {2128657684, 49538323, -47558083},
                                   {2128657684, 696455027, -47193267},       {2128661104, -1232075416, 666460925},
                                   {2128657684, -1232075416, 666460925},     {2128657684, -1232071038, 666458125}};
    const std::vector<std::uint32_t> names{0, 1, 2, 3, 4, 5, 6, 7};
    const std::vector<std::uint64_t> no_ways(points.size(), 0);
    FaceMesh mesh;
    ASSERT_TRUE(mesh.begin(points, names, no_ways, 0, -1, 16));
    for (const std::uint32_t point : {3u, 4u, 5u}) ASSERT_TRUE(mesh.add_inside(point));
    const auto before = mesh.triangles().size();
    ASSERT_FALSE(mesh.add_inside(6));
    EXPECT_EQ(mesh.triangles().size(), before);
    ASSERT_TRUE(mesh.add_inside(7));
    EXPECT_FALSE(mesh.fix(4, 6)) << "it is not in the mesh";
    EXPECT_TRUE(mesh.fix(4, 7));
}

// Where pieces grow in number without end, a round may find a hundred times as much as the one before: it need not find all of it.
TEST(Search, EndsWhereItFoundMoreThanItMay) {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < 40; ++i) {  // upright ones through lying ones
        const double x = 4 * i;
        points.insert(points.end(), {{x, -100, -100}, {x, 300, -100}, {x, -100, 300}, {-100, x, -100}, {300, x, -100}, {-100, x, 300}});
        triangles.push_back({6 * i, 6 * i + 1, 6 * i + 2});
        triangles.push_back({6 * i + 3, 6 * i + 4, 6 * i + 5});
    }
    const std::vector<std::uint8_t> is_new(triangles.size(), 1);
    const auto all = arrangement::search(points, triangles, is_new, 0.25, nullptr);
    ASSERT_GT(all.points.size(), 1000u);
    EXPECT_EQ(arrangement::search(points, triangles, is_new, 0.25, nullptr, all.points.size()).points.size(), all.points.size());
    const auto some = arrangement::search(points, triangles, is_new, 0.25, nullptr, 100);
    EXPECT_GT(some.points.size(), 100u);
    EXPECT_LT(some.points.size(), 400u);
}

}  // namespace
}  // namespace geomend::test
