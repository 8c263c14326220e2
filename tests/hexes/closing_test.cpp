// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/closing.h"

#include <gtest/gtest.h>

#include "geometry/cell_volume.h"
#include "hexes/lattice_meshes.h"
#include "hexes/local_search.h"
#include "hexes/recombine.h"

namespace geomend::hexes {
namespace {

/// A unit cube in six tetrahedra, and behind its top, cut from 4 to 6, a fan of tetrahedra over further points.
VolumeMeshData cube_with_fan(const std::vector<Vec3>& apexes) {
    const test::Lattice l = test::lattice({1, 1, 1});
    // Corners of the cube in the order of its lattice, which are 4, 5, 7, 6 in VTK's order at the top.
    std::vector<Vec3> points = l.points;
    test::Tets tets = test::kuhn_tets(l);
    const auto cube = l.cube(0, 0, 0);
    std::uint32_t before = cube[5];
    for (std::size_t i = 0; i <= apexes.size(); ++i) {
        const auto next = i < apexes.size() ? static_cast<std::uint32_t>(points.size()) : cube[7];
        if (i < apexes.size()) points.push_back(apexes[i]);
        tets.push_back({cube[4], cube[6], before, next});
        before = next;
    }
    for (auto& t : tets) {
        if (tetrahedron_volume(points[t[0]], points[t[1]], points[t[2]], points[t[3]]) < 0) std::swap(t[0], t[1]);
    }
    return test::mesh_data(points, tets);
}

struct Made {
    RecombineReport report;
    std::size_t vertices = 0;
    double volume = 0;
};

Made recombined(VolumeMeshData data, Closing closing = Closing::open) {
    Made made;
    RecombineOptions options;
    options.closing = closing;
    const auto mesh = VolumeMesh::make(std::move(data));
    EXPECT_TRUE(mesh) << mesh.why().error.message;
    const auto result = recombine(*mesh, options, made.report);
    EXPECT_TRUE(result) << result.why().error.message;
    made.vertices = (*result)->vertices.size();
    for (const TypeShare& s : made.report.shares) made.volume += s.volume;
    EXPECT_EQ(made.report.folded, 0u);
    return made;
}

constexpr Vec3 one_side{0.8, 0.2, 1.8}, other_side{0.2, 0.8, 1.8}, top{0.5, 0.5, 1.8};

TEST(Closing, TwoTetrahedraWithOneApexBecomeAPyramid) {
    const Made made = recombined(cube_with_fan({top}));
    EXPECT_EQ(made.report.count_of(CellType::hexahedron), 1u);
    EXPECT_EQ(made.report.count_of(CellType::pyramid), 1u);
    EXPECT_EQ(made.report.cell_count(), 2u);
    EXPECT_EQ(made.vertices, 9u);
    EXPECT_NEAR(made.volume, 1 + 0.8 / 3, 1e-12);
}

TEST(Closing, ADiagonalWithTwoApexesBehindIsOpened) {
    const VolumeMeshData data = cube_with_fan({one_side, other_side});
    double volume = 0;
    for (std::size_t c = 0; c < data.cell_count(); ++c) {
        const auto v = data.nodes_of(c);
        volume += tetrahedron_volume(data.vertices[v[0]], data.vertices[v[1]], data.vertices[v[2]], data.vertices[v[3]]);
    }
    const Made made = recombined(data);
    EXPECT_EQ(made.report.count_of(CellType::hexahedron), 1u);
    EXPECT_EQ(made.report.count_of(CellType::pyramid), 1u);
    EXPECT_EQ(made.report.count_of(CellType::tetrahedron), 6u);
    EXPECT_EQ(made.report.closing.opened, 1u);
    EXPECT_EQ(made.vertices, 11u);
    EXPECT_NEAR(made.volume, volume, 1e-12);
}

TEST(Closing, TheThesisSplitsTheHexahedronInstead) {
    const Made made = recombined(cube_with_fan({top}), Closing::split);
    EXPECT_EQ(made.report.count_of(CellType::hexahedron), 0u);
    EXPECT_EQ(made.report.count_of(CellType::pyramid), 5u);
    EXPECT_EQ(made.report.count_of(CellType::tetrahedron), 2u + 2u);
    EXPECT_EQ(made.vertices, 10u);
    EXPECT_NEAR(made.volume, 1 + 0.8 / 3, 1e-12);
}

TEST(Closing, NothingThatIsProtectedIsSwallowed) {
    const test::Lattice l = test::lattice({1, 1, 1});
    const auto cube = l.cube(0, 0, 0);
    const auto hexahedra_with = [&](const auto& change) {
        VolumeMeshData data = test::mesh_data(l.points, test::kuhn_tets(l));
        change(data);
        return recombined(std::move(data)).report.count_of(CellType::hexahedron);
    };
    EXPECT_EQ(hexahedra_with([](VolumeMeshData&) {}), 1u);
    EXPECT_EQ(hexahedra_with([&](VolumeMeshData& d) { d.edge_sets.push_back({"edge", {{cube[0], cube[1]}}}); }), 1u);
    EXPECT_EQ(hexahedra_with([&](VolumeMeshData& d) { d.edge_sets.push_back({"well", {{cube[0], cube[6]}}}); }), 0u);
    EXPECT_EQ(hexahedra_with([&](VolumeMeshData& d) { d.edge_sets.push_back({"on a face", {{cube[4], cube[6]}}}); }), 0u);
    EXPECT_EQ(hexahedra_with([&](VolumeMeshData& d) {
                  d.surfaces.push_back("inside");
                  // The first two tetrahedra share the facet of corners 0, 2 and 6.
                  std::uint32_t face = 0;
                  for (; face < 4; ++face) {
                      const auto local = faces_of(CellType::tetrahedron)[face].corners();
                      if (std::ranges::none_of(local, [&](auto k) { return d.nodes_of(0)[k] == cube[1]; })) break;
                  }
                  d.face_sets.push_back({"inside", FeatureRole::unknown, FaceSide::front, 0, {{0, face}}});
              }),
              0u);
}

TEST(LocalSearch, FindsTheBestOfFewAndNeverMore) {
    test::Lattice l = test::lattice({2, 2, 2});
    test::jitter(l, 0.2);
    const auto mesh = VolumeMesh::make(test::mesh_data(l.points, test::kuhn_tets(l)));
    ASSERT_TRUE(mesh);
    const TetMesh tets = tet_mesh_of(*mesh);
    const QuadTable quads(tets, 0.01);
    const Candidates hexahedra = find_hexahedra(tets, quads, {0.01, {}, nullptr});
    ASSERT_GT(hexahedra.size(), 36u);
    for (std::size_t first = 0; first + 18 <= hexahedra.size(); first += 5) {
        Candidates some = hexahedra;
        std::vector<std::uint8_t> kept(hexahedra.size(), 0);
        std::fill(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.begin() + static_cast<std::ptrdiff_t>(first) + 18, 1);
        some.keep(kept);
        std::vector<std::uint32_t> in_way(some.size(), 0);
        for (std::uint32_t a = 0; a < some.size(); ++a) {
            for (std::uint32_t b = 0; b < some.size(); ++b) {
                if (a != b && !stand_together(some, a, b)) in_way[a] |= 1u << b;
            }
        }
        double best = 0;
        for (std::uint32_t set = 0; set < 1u << some.size(); ++set) {
            double sum = 0;
            bool fits = true;
            for (std::uint32_t i = 0; fits && i < some.size(); ++i) {
                if ((set >> i & 1) == 0) continue;
                fits = (in_way[i] & set) == 0;
                sum += some.quality[i];
            }
            if (fits) best = std::max(best, sum);
        }
        LocalSearch how;
        how.steps = 100000;
        const Conflicts conflicts(some, tets.tets.size());
        double found = 0;
        for (const std::uint32_t i : search_selection(conflicts, some.quality, {}, how)) found += some.quality[i];
        EXPECT_NEAR(found, best, 1e-9);
    }
}

}  // namespace
}  // namespace geomend::hexes
