// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>

#include "hexes/lattice_meshes.h"
#include "hexes/recombine.h"
#include "pipeline/load.h"
#include "pipeline/mesh_output.h"
#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// Hexahedra as a user makes them, and real meshes of hexahedra that come back from tetrahedra.

namespace geomend {
namespace {

using nlohmann::json;
using test::run_geomend;
using test::TemporaryFolder;

std::map<std::string, double> volumes_in(const std::string& file) {
    std::map<std::string, double> all;
    const json info = test::info(file);
    if (!info.contains("brep")) return all;
    for (const json& r : info["brep"]["region_volumes"]) all[r["name"]] = r["volume"];
    return all;
}

TEST(RecombineCommand, KeepsRegionsAndIsTheSameForAnyNumberOfThreads) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml", tets = folder / "tets.vtu";
    ASSERT_EQ(run_geomend({"mesh", sample, "-o", tets, "--size", "60", "--lossy"}).status, 0);
    for (const char* threads : {"1", "2"}) {
        const auto run =
            run_geomend({"mesh", "--recombine", tets, "-o", folder / (std::string(threads) + ".msh"), "--threads", threads, "--lossy"});
        ASSERT_EQ(run.status, 0) << run.err;
    }
    EXPECT_EQ(test::read_file(folder / "1.msh"), test::read_file(folder / "2.msh"));
    EXPECT_EQ(run_geomend({"validate", folder / "1.msh"}).status, 0);
    const auto before = volumes_in(tets), after = volumes_in(folder / "1.msh");
    ASSERT_EQ(before.size(), 6u);
    ASSERT_EQ(after.size(), before.size());
    for (const auto& [name, volume] : before) EXPECT_NEAR(after.at(name), volume, 2e-3 * volume) << name;
}

TEST(RecombineCommand, WhatDoesNotGoTogetherIsRefused) {
    const TemporaryFolder folder;
    EXPECT_EQ(run_geomend({"mesh", "--recombine", "a.vtu", "-o", folder / "b.vtu", "--size", "5"}).status, 2);
    EXPECT_EQ(run_geomend({"mesh", "a.vtu", "-o", folder / "b.vtu", "--cells", "cubes"}).status, 2);
}

/// Cuts a hexahedron from its corner of least rank: neighbours cut a common face along the same diagonal.
void cut_at_least(const std::array<std::uint32_t, 8>& c, const std::vector<std::uint32_t>& rank, test::Tets& tets) {
    const auto less = [&](std::uint32_t a, std::uint32_t b) { return rank[a] < rank[b]; };
    const std::uint32_t from = *std::ranges::min_element(c, less);
    for (const LocalFace& face : faces_of(CellType::hexahedron)) {
        std::array<std::uint32_t, 4> v{};
        for (std::size_t k = 0; k < 4; ++k) v[k] = c[face.corners()[k]];
        if (std::ranges::find(v, from) != v.end()) continue;
        std::ranges::rotate(v, std::ranges::min_element(v, less));
        tets.push_back({v[0], v[2], v[1], from});
        tets.push_back({v[0], v[3], v[2], from});
    }
}

TEST(RecombineCommand, RealMeshesOfHexahedraComeBackWhole) {
    bool any = false;
    for (const auto& [name, count] : {std::pair{"vtk/Domain_Mesh_FaultModel.vtu", 6000u}, {"vtk/faultMesh.vtu", 17980u}}) {
        const auto file = test::real_data(name);
        if (!file) continue;
        any = true;
        const LoadOptions options;
        auto dataset = load(file->string(), options);
        ASSERT_TRUE(dataset) << name;
        std::vector<Loss> losses;
        const auto mesh = volume_mesh_in(*dataset, losses);
        ASSERT_TRUE(mesh) << name << ' ' << mesh.why().error.message;
        std::vector<std::uint32_t> rank((*mesh)->vertices.size());
        for (std::uint32_t v = 0; v < rank.size(); ++v) rank[v] = v * 2654435761u;
        test::Tets tets;
        std::uint32_t hexahedra = 0;
        for (const auto& block : (*mesh)->blocks) {
            if (block.type != CellType::hexahedron) continue;
            for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
                std::array<std::uint32_t, 8> corners{};
                std::ranges::copy((*mesh)->nodes_of(c), corners.begin());
                cut_at_least(corners, rank, tets);
                ++hexahedra;
            }
        }
        EXPECT_EQ(hexahedra, count) << name;
        const auto cut = VolumeMesh::make(test::mesh_data((*mesh)->vertices, tets));
        ASSERT_TRUE(cut) << name << ' ' << cut.why().error.message;
        hexes::RecombineReport report;
        hexes::RecombineOptions how;
        how.least_quality = 0.01;
        ASSERT_TRUE(hexes::recombine(*cut, how, report)) << name;
        EXPECT_EQ(report.count_of(CellType::hexahedron), hexahedra) << name;
        EXPECT_NEAR(report.volume_share_of(CellType::hexahedron), 1, 1e-12) << name;
    }
    if (!any) GTEST_SKIP() << "no real data";
}

TEST(RecombineCommand, TetrahedraOfARealModelBecomeHexahedraThatConform) {
    const auto file = test::real_data("gocad/modelA4.so");
    if (!file) GTEST_SKIP() << "no real data";
    const TemporaryFolder folder;
    const std::string out = folder / "out.vtu";
    const auto run = run_geomend({"mesh", "--recombine", file->string(), "-o", out, "--lossy", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json report = json::parse(run.out, nullptr, false);
    ASSERT_TRUE(report.is_object());
    EXPECT_GT(report["quality"]["shares"]["hexahedron"]["volume"].get<double>(), 0.45);
    EXPECT_GE(report["quality"]["min_scaled_jacobian"].get<double>(), 0.3);
    EXPECT_EQ(report["recombine"]["folded"], 0);
    EXPECT_EQ(report["recombine"]["split"], 0);
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
}

}  // namespace
}  // namespace geomend
