// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/vectors.h"
#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// Hexahedra as a user makes them.

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

/// A file of MSH 2.2 with cells in one region each, of points that are there once.
class MshText {
public:
    /// Six tetrahedra around the diagonal of a cube; with the nodes on their edges where they are of second order.
    void add_tetrahedra(const Vec3& at, bool second_order, int region) {
        constexpr int paths[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
        for (const auto& [a, b] : paths) {
            std::array<Vec3, 4> p{corner(at, 0), corner(at, a), corner(at, b), corner(at, 7)};
            const Vec3 u = minus(p[1], p[0]), v = minus(p[2], p[0]), w = minus(p[3], p[0]);
            if (dot(u, cross(v, w)) < 0) std::swap(p[1], p[2]);
            std::string nodes;
            for (const Vec3& x : p) nodes += node(x);
            if (second_order) {
                for (const auto& [i, j] : {std::array{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}})
                    nodes += node(times(0.5, plus(p[i], p[j])));
            }
            add(second_order ? 11 : 4, region, nodes);
        }
    }
    void add_hexahedron(const Vec3& at, int region) {
        std::string nodes;
        for (const int c : {0, 1, 3, 2, 4, 5, 7, 6}) nodes += node(corner(at, c));
        add(5, region, nodes);
    }
    std::string text() const {
        return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(numbers_.size()) + "\n" + nodes_ +
               "$EndNodes\n$Elements\n" + std::to_string(elements_) + "\n" + lines_ + "$EndElements\n";
    }

private:
    static Vec3 corner(const Vec3& at, int bits) { return plus(at, {1.0 * (bits & 1), 1.0 * (bits >> 1 & 1), 1.0 * (bits >> 2 & 1)}); }
    std::string node(const Vec3& p) {
        const auto [found, is_new] = numbers_.emplace(p, numbers_.size() + 1);
        if (is_new) {
            nodes_ += std::to_string(found->second);
            for (const double x : p) nodes_ += ' ' + std::to_string(x);
            nodes_ += '\n';
        }
        return ' ' + std::to_string(found->second);
    }
    void add(int type, int region, const std::string& nodes) {
        lines_ += std::to_string(++elements_) + ' ' + std::to_string(type) + " 2 " + std::to_string(region) + ' ' + std::to_string(region) +
                  nodes + '\n';
    }

    std::map<Vec3, std::size_t> numbers_;
    std::string nodes_, lines_;
    int elements_ = 0;
};

TEST(RecombineCommand, CountsWhatWasThereApartFromWhatItMakes) {
    const TemporaryFolder folder;
    MshText msh;
    msh.add_tetrahedra({0, 0, 0}, false, 1);
    msh.add_hexahedron({2, 0, 0}, 2);
    msh.add_hexahedron({3, 0, 0}, 2);
    test::write_file(folder / "in.msh", msh.text());
    const std::vector<std::string> command{"mesh", "--recombine", folder / "in.msh", "-o", folder / "out.vtu", "--lossy"};
    const auto run = run_geomend(command);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(
        run.out.find("of 6 tetrahedra:\n  1 hexahedron, 100 % of their volume\nbeside them, as they were:\n  2 hexahedra, 66.67 % of the "
                     "whole volume\n"),
        std::string::npos)
        << run.out;
    EXPECT_NE(run.out.find("3 cells in 2 regions"), std::string::npos) << run.out;
    auto with_json = command;
    with_json.push_back("--json");
    const json report = json::parse(run_geomend(with_json).out)["recombine"];
    EXPECT_EQ(report["made"], json::parse(R"({"hexahedron": {"number": 1, "volume_share": 1.0}})"));
    EXPECT_EQ(report["there"]["hexahedron"]["number"], 2);
    EXPECT_NEAR(report["there"]["hexahedron"]["volume_share"].get<double>(), 2.0 / 3, 1e-12);
}

TEST(RecombineCommand, TakesTheCornersOfTetrahedraOfSecondOrder) {
    const TemporaryFolder folder;
    MshText msh;
    for (const double x : {0.0, 1.0}) msh.add_tetrahedra({x, 0, 0}, true, 1);
    test::write_file(folder / "in.msh", msh.text());
    const auto refused = run_geomend({"mesh", "--recombine", folder / "in.msh", "-o", folder / "out.vtu"});
    EXPECT_EQ(refused.status, 4);
    EXPECT_NE(refused.err.find("nodes on edges"), std::string::npos) << refused.err;
    const auto run = run_geomend({"mesh", "--recombine", folder / "in.msh", "-o", folder / "out.vtu", "--lossy"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json counts = test::info(folder / "out.vtu")["objects"][0]["counts"];
    EXPECT_EQ(counts["cell_types"]["hexahedron"], 2);
    EXPECT_EQ(counts["points"], 12) << "the nodes on edges are gone";
}

TEST(RecombineCommand, SaysWhatIsMissingWhereThereAreNoTetrahedra) {
    const TemporaryFolder folder;
    MshText hexahedron;
    hexahedron.add_hexahedron({0, 0, 0}, 1);
    for (const auto& [name, text, why] : {std::array<std::string, 3>{"hex", hexahedron.text(), "there are no tetrahedra"},
                                          {"none", MshText().text(), "there are no cells"}}) {
        test::write_file(folder / "in.msh", text);
        const auto run = run_geomend({"mesh", "--recombine", folder / "in.msh", "-o", folder / "out.vtu", "--lossy"});
        EXPECT_EQ(run.status, 4) << name;
        EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
        EXPECT_NE(run.err.find("give a mesh that has tetrahedra"), std::string::npos) << run.err;
        EXPECT_EQ(run.err.find("choose another format"), std::string::npos) << run.err;
    }
}

TEST(RecombineCommand, WhatDoesNotGoTogetherIsRefused) {
    const TemporaryFolder folder;
    EXPECT_EQ(run_geomend({"mesh", "--recombine", "a.vtu", "-o", folder / "b.vtu", "--size", "5"}).status, 2);
    EXPECT_EQ(run_geomend({"mesh", "a.vtu", "-o", folder / "b.vtu", "--cells", "cubes"}).status, 2);
    const auto tet = run_geomend({"mesh", "--recombine", "a.vtu", "-o", folder / "b.vtu", "--cells", "tet"});
    EXPECT_EQ(tet.status, 2);
    EXPECT_NE(tet.err.find("--cells tet does not go with it"), std::string::npos) << tet.err;
    for (const char* option : {"--ratio", "--time-limit", "--memory-limit"}) {
        const auto run = run_geomend({"mesh", "--recombine", "a.vtu", "-o", folder / "b.vtu", option, "2"});
        EXPECT_EQ(run.status, 2);
        EXPECT_NE(run.err.find(std::string(option) + " is for filling regions"), std::string::npos) << run.err;
    }
    EXPECT_EQ(run_geomend({"mesh", "a.vtu", "-o", folder / "b.vtu", "--select", "GMax1"}).status, 2);
    EXPECT_EQ(run_geomend({"mesh", "--recombine", "a.vtu", "-o", folder / "b.vtu", "--select", "GMax9"}).status, 2);
}

TEST(RecombineCommand, KeepsLinesAndCornersAndReportsRegionsByType) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml", tets = folder / "tets.vtu";
    ASSERT_EQ(run_geomend({"mesh", sample, "-o", tets, "--size", "60", "--method", "lattice", "--lossy"}).status, 0);
    const std::string out = folder / "out.vtu";
    const auto run = run_geomend({"mesh", "--recombine", tets, "-o", out, "--lossy", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json before = test::info(tets), after = test::info(out), report = json::parse(run.out);
    for (const char* kind : {"edges", "vertices"}) {
        ASSERT_GT(before["objects"][0]["counts"][kind].get<int>(), 0);
        EXPECT_EQ(after["objects"][0]["counts"][kind], before["objects"][0]["counts"][kind]) << kind;
    }
    ASSERT_EQ(report["regions"].size(), 6u);
    std::map<std::string, int> cells;
    double volume = 0;
    for (const json& region : report["regions"]) {
        for (const auto& [type, count] : region["cells"].items()) cells[type] += count.get<int>();
        volume += region["volume"].get<double>();
    }
    EXPECT_NEAR(volume, 8e8, 1e-9 * 8e8);
    EXPECT_EQ(cells["hexahedron"], after["objects"][0]["counts"]["cell_types"]["hexahedron"].get<int>());
    EXPECT_EQ(cells["tetrahedron"], after["objects"][0]["counts"]["cell_types"]["tetrahedron"].get<int>());
    EXPECT_EQ(after["objects"][0]["counts"]["cells"].get<int>(), cells["hexahedron"] + cells["pyramid"] + cells["tetrahedron"]);
    EXPECT_GT(report["recombine"]["first_share"].get<double>(), 0.9);  // they grow where points are those of a lattice
}

TEST(RecombineCommand, SelectsByAHeuristicOfANameForComparison) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml", tets = folder / "tets.vtu";
    ASSERT_EQ(run_geomend({"mesh", sample, "-o", tets, "--size", "60", "--lossy"}).status, 0);
    std::map<std::string, double> shares;
    for (const char* rule : {"search", "GMax1", "GTet", "CographMAX", "CompCographRAND"}) {
        const auto run = run_geomend({"mesh", "--recombine", tets, "-o", folder / "out.vtu", "--lossy", "--json", "--select", rule});
        ASSERT_EQ(run.status, 0) << run.err;
        shares[rule] = json::parse(run.out)["recombine"]["first_share"].get<double>();
        EXPECT_GT(shares[rule], 0.01) << rule;
        EXPECT_EQ(run_geomend({"validate", folder / "out.vtu"}).status, 0) << rule;
    }
    EXPECT_GT(shares["search"], shares["GMax1"]);
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
    EXPECT_GE(report["quality"]["shares"]["hexahedron"]["volume"].get<double>(), 0.5);
    EXPECT_GE(report["quality"]["min_scaled_jacobian"].get<double>(), 0.3);
    EXPECT_EQ(report["recombine"]["folded"], 0);
    EXPECT_EQ(report["recombine"]["split"], 0);
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
}

}  // namespace
}  // namespace geomend
