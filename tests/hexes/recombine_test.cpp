// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/recombine.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace geomend::hexes
