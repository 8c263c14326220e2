// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/recombine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hexes/lattice_meshes.h"

namespace geomend::hexes {
namespace {

RecombineReport recombined(VolumeMeshData data) {
    RecombineReport report;
    const auto mesh = VolumeMesh::make(std::move(data));
    EXPECT_TRUE(mesh) << mesh.why().error.message;
    const auto made = recombine(*mesh, {}, report);
    EXPECT_TRUE(made) << made.why().error.message;
    return report;
}

TEST(Recombine, GivesTheHexahedraOfALatticeBack) {
    for (const double part : {0.0, 0.15}) {
        test::Lattice l = test::lattice({20, 20, 20});
        test::jitter(l, part);
        const test::Tets tets = test::kuhn_tets(l);
        ASSERT_EQ(tets.size(), 48000u);
        const RecombineReport report = recombined(test::mesh_data(l.points, tets));
        EXPECT_EQ(report.count_of(CellType::hexahedron), 8000u) << part;
        EXPECT_DOUBLE_EQ(report.volume_share_of(CellType::hexahedron), 1) << part;
        EXPECT_EQ(report.folded, 0u);
    }
}

/// Tetrahedra whose corners are put into the order that fits their neighbours.
VolumeMeshData fitting(const std::vector<Vec3>& points, test::Tets tets, std::size_t next = 0) {
    for (std::size_t i = next; i < tets.size(); ++i) {
        test::Tets some(tets.begin(), tets.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        if (VolumeMesh::make(test::mesh_data(points, some))) continue;
        std::swap(tets[i][0], tets[i][1]);
    }
    return test::mesh_data(points, tets);
}

// A square and a pentagon below an apex, with other diagonals seen from above than from below: flat tetrahedra between them.
TEST(Recombine, LeavesNoFlatTetrahedraOnAnEvenSide) {
    const RecombineReport square =
        recombined(fitting({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.2}}, {{0, 1, 3, 4}, {1, 2, 3, 4}, {0, 1, 2, 3}}));
    EXPECT_EQ(square.leftovers.flat, 0u);
    double below = 0;
    for (const TypeShare& share : square.shares) below += share.volume;
    EXPECT_NEAR(below, 0.2 / 3, 1e-14);
    EXPECT_EQ(square.folded, 0u);

    std::vector<Vec3> points;
    for (int k = 0; k < 5; ++k) points.push_back({std::cos(k * 1.2566370614359172), std::sin(k * 1.2566370614359172), 0});
    points.push_back({0, 0, 0.2});
    const RecombineReport pentagon = recombined(fitting(points, {{0, 1, 2, 5}, {0, 2, 3, 5}, {0, 3, 4, 5}, {0, 1, 2, 3}, {0, 1, 3, 4}}));
    EXPECT_EQ(pentagon.leftovers.flat, 0u);
    double volume = 0;
    for (const TypeShare& share : pentagon.shares) volume += share.volume;
    EXPECT_NEAR(volume, 2.5 * std::sin(1.2566370614359172) * 0.2 / 3, 1e-12);
    EXPECT_EQ(pentagon.folded, 0u);
}

}  // namespace
}  // namespace geomend::hexes
