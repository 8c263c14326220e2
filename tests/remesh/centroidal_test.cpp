// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/centroidal.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/length.h"
#include "base/vectors.h"
#include "made_surfaces.h"
#include "remesh/triangle_quality.h"
#include "topology_stays.h"

namespace geomend::remeshing {
namespace {

using test::quality_of;
using test::with_fixed_borders;

RC_GTEST_PROP(Centroidal, TopologyStaysAndVerticesLieOnTheSurface, ()) {
    test::check_topology_stays([](WorkSurface& work) { remesh_centroidal(work, {}); });
}

TEST(Centroidal, AFlatSheetHasBetterTrianglesThanWithEvenEdgesAlone) {
    const EdgeMesh reference = test::sheet(30, 30, [](double, double) { return 0.0; });
    const std::vector<double> sizes(reference.places.size(), 0.7);  // so that its squares go: they are at rest as they are
    WorkSurface even = with_fixed_borders(reference, sizes), work = with_fixed_borders(reference, sizes);
    remesh_isotropic(even, {});
    remesh_centroidal(work, {});
    EXPECT_GT(quality_of(work.mesh).mean_shape(), quality_of(even.mesh).mean_shape() + 0.01);
    EXPECT_GT(quality_of(work.mesh).mean_quality(), 0.95);
}

// The cells of a regular hexagonal pattern are hexagons around their sites: nothing moves.
TEST(Centroidal, EquilateralTrianglesStay) {
    const std::uint32_t n = 8;
    std::vector<Vec3> places;
    std::vector<Triangle> triangles;
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) places.push_back({i + 0.5 * j, std::sqrt(0.75) * j, 2.0});
    }
    std::vector<std::uint32_t> corners, neighbours;
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t t = 2 * (j * n + i);
            corners.insert(corners.end(), {at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
            neighbours.insert(neighbours.end(), {j > 0 ? t - 2 * n + 1 : no_index, t + 1, i > 0 ? t - 1 : no_index,
                                                 i + 1 < n ? t + 2 : no_index, j + 1 < n ? t + 2 * n : no_index, t});
        }
    }
    const EdgeMesh reference = std::move(fanned_mesh(places, corners, neighbours)->mesh);
    const std::vector<double> sizes(places.size(), 1.0);
    WorkSurface work = with_fixed_borders(reference, sizes);
    EXPECT_EQ(move_to_centroids(work, 1e-9), 0u);
    for (std::uint32_t v = 0; v < places.size(); ++v) EXPECT_LT(length(minus(work.mesh.places[v], reference.places[v])), 1e-9);
}

}  // namespace
}  // namespace geomend::remeshing
