// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/frontal.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/length.h"
#include "base/vectors.h"
#include "made_surfaces.h"
#include "remesh/triangle_quality.h"
#include "topology_stays.h"

namespace geomend::remeshing {
namespace {

using test::quality_of;
using test::with_fixed_borders;

RC_GTEST_PROP(Frontal, TopologyStaysAndVerticesLieOnTheSurface, ()) {
    test::check_topology_stays([](WorkSurface& work) { remesh_frontal(work, {}); });
}

TEST(Frontal, PointsKeepApartFromEachOtherAndFromBorders) {
    const EdgeMesh reference = test::sheet(20, 16, [](double x, double y) { return std::sin(0.3 * x) + 0.1 * y; });
    const std::vector<double> sizes(reference.places.size(), 1.0);
    const WorkSurface work = with_fixed_borders(reference, sizes);
    const FrontalRules rules;
    const auto points = frontal_points(work, rules);
    EXPECT_GT(points.size(), 200u);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3& p = points[i].at.place;
        for (std::size_t k = 0; k < i; ++k) EXPECT_GE(length(minus(p, points[k].at.place)), rules.apart);
        for (std::uint32_t v = 0; v < reference.places.size(); ++v) {
            EXPECT_TRUE(!reference.on_border(v) || length(minus(p, reference.places[v])) >= rules.from_border);
        }
    }
}

// On a flat sheet whose lower border has points one apart, the first rows are those of equilateral triangles over it.
TEST(Frontal, FirstRowsAreEquilateral) {
    const EdgeMesh reference = test::sheet(20, 20, [](double, double) { return 0.0; });
    const std::vector<double> sizes(reference.places.size(), 1.0);
    const WorkSurface work = with_fixed_borders(reference, sizes);
    std::size_t in_row = 0;
    for (const FrontalPoint& point : frontal_points(work, {})) {
        const Vec3& p = point.at.place;
        if (p[0] < 4 || p[0] > 16 || p[1] > 1.2) continue;
        EXPECT_NEAR(p[1], std::sqrt(0.75), 1e-6);
        EXPECT_NEAR(p[0] - std::floor(p[0]), 0.5, 1e-6);
        ++in_row;
    }
    EXPECT_GE(in_row, 11u);
}

TEST(Frontal, AFlatSheetHasBetterTrianglesThanWithEvenEdgesAlone) {
    const EdgeMesh reference = test::sheet(30, 30, [](double, double) { return 0.0; });
    const std::vector<double> sizes(reference.places.size(), 1.0);
    WorkSurface even = with_fixed_borders(reference, sizes), work = with_fixed_borders(reference, sizes);
    remesh_isotropic(even, {});
    remesh_frontal(work, {});
    EXPECT_GT(quality_of(work.mesh).mean_quality(), quality_of(even.mesh).mean_quality());
    EXPECT_GT(quality_of(work.mesh).mean_quality(), 0.97);
    EXPECT_EQ(quality_of(work.mesh).share_above_30(), 1);
}

// No border begins a front there.
TEST(Frontal, AClosedSurfaceGetsPointsAllOver) {
    const EdgeMesh reference = test::closed_cube(12);
    const std::vector<double> sizes(reference.places.size(), 1.5);
    WorkSurface work = work_surface(reference, {sizes, {}, 0, nullptr});
    remesh_frontal(work, {});
    EXPECT_TRUE(is_consistent(work.mesh));
    EXPECT_EQ(test::numbers_of(work.mesh).euler, 2);
    EXPECT_NEAR(static_cast<double>(test::numbers_of(work.mesh).triangles), 6 * 144 / (std::sqrt(0.1875) * 1.5 * 1.5), 200);
    EXPECT_GT(quality_of(work.mesh).mean_quality(), 0.9);
}

}  // namespace
}  // namespace geomend::remeshing
