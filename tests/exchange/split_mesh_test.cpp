// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/split_mesh.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "model/cell_faces.h"

namespace geomend {
namespace {

using exchange::joined;
using exchange::split_along;
using Data = VolumeMeshData;
using Nodes = std::array<int, 3>;

/// A block of nx x ny x nz cubes, each cut into six tetrahedra along the same diagonal, as one region.
class TetrahedraBlock {
public:
    TetrahedraBlock(int nx, int ny, int nz) : n_{nx, ny, nz} {
        data_.regions = {"rock"};
        for (int k = 0; k <= nz; ++k) {
            for (int j = 0; j <= ny; ++j) {
                for (int i = 0; i <= nx; ++i) data_.vertices.push_back({double(i), double(j), double(k)});
            }
        }
        for (int k = 0; k < nz; ++k) {
            for (int j = 0; j < ny; ++j) {
                for (int i = 0; i < nx; ++i) add_cube({i, j, k});
            }
        }
        data_.blocks.push_back({0, CellType::tetrahedron, 0, static_cast<std::uint32_t>(data_.cell_count())});
    }

    std::uint32_t vertex(const Nodes& at) const { return static_cast<std::uint32_t>(at[0] + (n_[0] + 1) * (at[1] + (n_[1] + 1) * at[2])); }

    /// Faces of cells in the plane where coordinate `axis` is `at` whose middle `wanted` says yes to, as a surface with two sides.
    void add_surface(const std::string& name, FeatureRole role, std::size_t axis, double at,
                     const std::function<bool(const Vec3&)>& wanted) {
        const auto surface = static_cast<std::uint32_t>(data_.surfaces.size());
        data_.surfaces.push_back(name);
        Data::FaceSet below{name + "_back", role, FaceSide::back, surface, {}}, above{name + "_front", role, FaceSide::front, surface, {}};
        for (std::uint32_t c = 0; c < data_.cell_count(); ++c) {
            Vec3 centre{};
            for (const std::uint32_t v : data_.nodes_of(c)) centre[axis] += data_.vertices[v][axis] / 4;
            for (std::uint32_t f = 0; f < 4; ++f) {
                Vec3 middle{};
                bool in_plane = true;
                for (const std::uint8_t corner : faces_of(CellType::tetrahedron)[f].corners()) {
                    const Vec3& p = data_.vertices[data_.nodes_of(c)[corner]];
                    in_plane = in_plane && p[axis] == at;
                    for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / 3;
                }
                if (in_plane && wanted(middle)) (centre[axis] < at ? below : above).faces.push_back({c, f});
            }
        }
        data_.face_sets.push_back(below);
        data_.face_sets.push_back(above);
    }

    Data& data() { return data_; }
    VolumeMesh mesh() const { return *VolumeMesh::make(data_); }

private:
    std::array<int, 3> n_;
    Data data_;

    void add_cube(const Nodes& at) {
        std::array<std::size_t, 3> axes{0, 1, 2};
        bool even = true;
        do {
            Nodes corner = at;
            std::vector<std::uint32_t> tet{vertex(corner)};
            for (const std::size_t axis : axes) {
                ++corner[axis];
                tet.push_back(vertex(corner));
            }
            if (!even) std::swap(tet[2], tet[3]);
            data_.cell_nodes.insert(data_.cell_nodes.end(), tet.begin(), tet.end());
            data_.cell_offsets.push_back(data_.cell_nodes.size());
            std::next_permutation(axes.begin(), axes.end());
            even = is_even(axes);
        } while (axes != std::array<std::size_t, 3>{0, 1, 2});
    }
    static bool is_even(const std::array<std::size_t, 3>& axes) {
        int turns = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = i + 1; j < 3; ++j) turns += axes[i] > axes[j] ? 1 : 0;
        }
        return turns % 2 == 0;
    }
};

bool everywhere(const Vec3&) { return true; }

std::size_t doubled(const VolumeMesh& before, const VolumeMesh& after) { return after->vertices.size() - before->vertices.size(); }

VolumeMesh all_split(const VolumeMesh& mesh) {
    const auto split = split_along(mesh, std::vector<std::uint8_t>(mesh->surfaces.size(), 1));
    EXPECT_TRUE(split) << (split ? "" : split.why().error.message);
    return *split;
}

TEST(SplitMesh, TwoTetrahedraOnASurfaceHaveEightVerticesAndOnePair) {
    Data data;
    data.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
    data.regions = {"above", "below"};
    data.surfaces = {"S"};
    data.cell_nodes = {0, 1, 2, 3, 0, 2, 1, 4};
    data.cell_offsets = {0, 4, 8};
    data.blocks = {{0, CellType::tetrahedron, 0, 1}, {1, CellType::tetrahedron, 1, 1}};
    for (std::uint32_t f = 0; f < 4; ++f) {
        const auto corners = faces_of(CellType::tetrahedron)[f].corners();
        if (std::ranges::find(corners, 3) == corners.end())
            data.face_sets = {{"S_front", FeatureRole::horizon, FaceSide::front, 0, {{0, f}}},
                              {"S_back", FeatureRole::horizon, FaceSide::back, 0, {{1, f}}}};
    }
    data.node_sets = {{"shared", {0, 1}}};
    data.edge_sets = {{"edge", {{1, 0}}}};
    Attribute a;
    a.name = "depth";
    a.location = AttributeLocation::point;
    a.values = std::vector<double>{1, 2, 3, 4, 5};
    data.attributes = {a};
    const VolumeMesh mesh = *VolumeMesh::make(data), split = all_split(mesh);
    ASSERT_EQ(split->vertices.size(), 8u);
    EXPECT_EQ(split->vertex_origins, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 0, 2, 1}));
    EXPECT_EQ(std::vector(split->nodes_of(0).begin(), split->nodes_of(0).end()), (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(std::vector(split->nodes_of(1).begin(), split->nodes_of(1).end()), (std::vector<std::uint32_t>{5, 6, 7, 4}));
    ASSERT_EQ(split->split_pairs.size(), 1u);
    EXPECT_EQ(split->split_pairs[0].faces[0].cell, 0u);
    EXPECT_EQ(split->split_pairs[0].sides[0], FaceSide::front);
    EXPECT_EQ(split->split_pairs[0].sides[1], FaceSide::back);
    EXPECT_EQ(split->node_sets[0].nodes, (std::vector<std::uint32_t>{0, 1, 5, 7}));
    EXPECT_EQ(split->edge_sets[0].edges[0], (std::array<std::uint32_t, 2>{1, 0}));
    EXPECT_EQ(std::get<std::vector<double>>(split->attributes[0].values), (std::vector<double>{1, 2, 3, 4, 5, 1, 3, 2}));
}

TEST(SplitMesh, APatchInsideOpensButForItsBorder) {
    for (int n = 1; n <= 4; ++n) {
        TetrahedraBlock block(n + 2, n + 2, 4);
        block.add_surface("patch", FeatureRole::fracture, 2, 2,
                          [&](const Vec3& p) { return p[0] > 1 && p[0] < n + 1 && p[1] > 1 && p[1] < n + 1; });
        const VolumeMesh mesh = block.mesh(), split = all_split(mesh);
        EXPECT_EQ(doubled(mesh, split), std::size_t((n - 1) * (n - 1))) << n;
    }
}

TEST(SplitMesh, APatchWithOneSideOnTheModelsBorderOpensThere) {
    for (int n = 1; n <= 4; ++n) {
        TetrahedraBlock block(n + 1, n + 2, 4);
        block.add_surface("patch", FeatureRole::fracture, 2, 2, [&](const Vec3& p) { return p[0] < n && p[1] > 1 && p[1] < n + 1; });
        const VolumeMesh mesh = block.mesh(), split = all_split(mesh);
        EXPECT_EQ(doubled(mesh, split), std::size_t(n * (n - 1))) << n;
    }
}

TEST(SplitMesh, AHorizonThroughABlockOpensWhole) {
    TetrahedraBlock block(4, 4, 2);
    block.add_surface("H", FeatureRole::horizon, 2, 1, everywhere);
    const VolumeMesh mesh = block.mesh(), split = all_split(mesh);
    EXPECT_EQ(doubled(mesh, split), 25u);
    EXPECT_EQ(split->split_pairs.size(), 32u);
}

TEST(SplitMesh, AHorizonOpensWhereTheTipOfAFractureTouchesIt) {
    for (const bool is_whole : {true, false}) {  // a fracture that stands on the horizon, or touches it with one corner
        TetrahedraBlock block(4, 4, 4);
        block.add_surface("H", FeatureRole::horizon, 2, 2, everywhere);
        block.add_surface("F", FeatureRole::fracture, 0, 2,
                          [&](const Vec3& p) { return p[2] > 2 && p[2] < 3 && p[1] > 1 && p[1] < 2 && (is_whole || p[2] - 2 > p[1] - 1); });
        const VolumeMesh mesh = block.mesh(), split = all_split(mesh);
        EXPECT_EQ(doubled(mesh, split), 25u) << is_whole;
    }
}

TEST(SplitMesh, OnlyTheNamedSurfacesOpen) {
    TetrahedraBlock block(4, 4, 4);
    block.add_surface("H", FeatureRole::horizon, 2, 2, everywhere);
    block.add_surface("F", FeatureRole::fault, 0, 2, everywhere);
    const VolumeMesh mesh = block.mesh();
    EXPECT_EQ(exchange::faults_of(mesh), (std::vector<std::uint8_t>{0, 1}));
    EXPECT_EQ(doubled(mesh, *split_along(mesh, exchange::faults_of(mesh))), 25u);
    EXPECT_EQ(doubled(mesh, *split_along(mesh, std::vector<std::uint8_t>{0, 0})), 0u);
    EXPECT_EQ(doubled(mesh, all_split(mesh)), 20u + 20u + 5u * 3u) << "twice along each, four times where they cross";
}

TEST(SplitMesh, SplittingOneSurfaceAfterTheOtherIsSplittingBoth) {
    TetrahedraBlock block(3, 3, 4);
    block.add_surface("H", FeatureRole::horizon, 2, 2, everywhere);
    block.add_surface("F", FeatureRole::fault, 0, 1, everywhere);
    const VolumeMesh mesh = block.mesh();
    const VolumeMesh first = *split_along(mesh, std::vector<std::uint8_t>{1, 0});
    const VolumeMesh both = *split_along(first, std::vector<std::uint8_t>{0, 1});
    const VolumeMesh at_once = all_split(mesh);
    EXPECT_EQ(both->vertices.size(), at_once->vertices.size());
    EXPECT_EQ(both->split_pairs.size(), at_once->split_pairs.size());
    EXPECT_EQ(all_split(both)->vertices.size(), both->vertices.size());
}

TEST(SplitMesh, WhatWasSplitCanBeJoinedAgainToTheBit) {
    TetrahedraBlock block(3, 3, 4);
    block.add_surface("H", FeatureRole::horizon, 2, 2, everywhere);
    block.add_surface("F", FeatureRole::fault, 0, 1, [](const Vec3& p) { return p[1] < 2; });
    block.data().edge_sets = {
        {"well", {{block.vertex({1, 1, 4}), block.vertex({1, 1, 3})}, {block.vertex({1, 1, 3}), block.vertex({1, 1, 2})}}}};
    block.data().node_sets = {{"gauges", {block.vertex({0, 0, 2}), block.vertex({1, 1, 2})}}};
    const VolumeMesh mesh = block.mesh();
    std::vector<Loss> losses;
    const auto back = joined(all_split(mesh), losses);
    ASSERT_TRUE(back);
    EXPECT_TRUE(losses.empty());
    EXPECT_EQ((*back)->cell_nodes, mesh->cell_nodes);
    EXPECT_EQ((*back)->vertices, mesh->vertices);
    EXPECT_EQ((*back)->edge_sets[0].edges, mesh->edge_sets[0].edges);
    EXPECT_EQ((*back)->node_sets[0].nodes, mesh->node_sets[0].nodes);
    EXPECT_TRUE((*back)->vertex_origins.empty());
    EXPECT_TRUE((*back)->split_pairs.empty());
}

TEST(SplitMesh, ValuesThatDifferOnBothSidesAreListedWhenTheyBecomeOne) {
    TetrahedraBlock block(2, 2, 2);
    block.add_surface("H", FeatureRole::horizon, 2, 1, everywhere);
    Data data = *all_split(block.mesh());
    Attribute a;
    a.name = "p";
    a.location = AttributeLocation::point;
    std::vector<double> values(data.vertices.size());
    std::iota(values.begin(), values.end(), 0.0);
    a.values = values;
    data.attributes = {a};
    std::vector<Loss> losses;
    ASSERT_TRUE(joined(*VolumeMesh::make(data), losses));
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_EQ(losses[0].count, 9u);
}

RC_GTEST_PROP(SplitMesh, CellsHangTogetherAcrossEachFaceThatIsNotSplitAndVerticesAreNoMoreThanNeeded, ()) {
    TetrahedraBlock block(3, 3, 3);
    const auto wanted =
        *rc::gen::container<std::vector<std::vector<bool>>>(3, rc::gen::container<std::vector<bool>>(9, rc::gen::arbitrary<bool>()));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        block.add_surface("S" + std::to_string(axis), FeatureRole::fault, axis, axis == 2 ? 2 : 1, [&](const Vec3& p) {
            return bool(wanted[axis][std::size_t(p[(axis + 1) % 3]) * 3 + std::size_t(p[(axis + 2) % 3])]);
        });
    }
    const VolumeMesh mesh = block.mesh(), split = all_split(mesh);
    std::set<CellFaceRef> on_surface;
    for (const auto& set : mesh->face_sets) on_surface.insert(set.faces.begin(), set.faces.end());
    // Cells that share a face before: after it they share its vertices, unless it is on a surface.
    std::map<std::vector<std::uint32_t>, std::vector<CellFaceRef>> faces;
    for (std::uint32_t c = 0; c < mesh->cell_count(); ++c) {
        for (std::uint32_t f = 0; f < 4; ++f) {
            auto nodes = mesh.nodes_of(CellFaceRef{c, f});
            std::ranges::sort(nodes);
            faces[nodes].push_back({c, f});
        }
    }
    std::size_t parted = 0;
    for (const auto& [nodes, sides] : faces) {
        if (sides.size() < 2) continue;
        auto a = split.nodes_of(sides[0]), b = split.nodes_of(sides[1]);
        std::ranges::sort(a);
        std::ranges::sort(b);
        if (!on_surface.contains(sides[0])) RC_ASSERT(a == b);
        else if (a != b) ++parted;
    }
    RC_ASSERT(split->split_pairs.size() == parted);
    // Around each place the cells of one vertex can be walked through without crossing a surface.
    std::map<std::uint32_t, std::set<std::uint32_t>> cells_of;
    for (std::uint32_t c = 0; c < split->cell_count(); ++c) {
        for (const std::uint32_t v : split->nodes_of(c)) cells_of[v].insert(c);
    }
    for (const auto& [v, cells] : cells_of) {
        if (v < mesh->vertices.size() && (split->vertex_origins[v] == v) && std::ranges::count(split->vertex_origins, v) == 1) continue;
        std::set<std::uint32_t> seen{*cells.begin()};
        for (bool grows = true; grows;) {
            grows = false;
            for (const auto& [nodes, sides] : faces) {
                if (sides.size() < 2 || on_surface.contains(sides[0])) continue;
                if (std::ranges::find(nodes, split->vertex_origins[v]) == nodes.end()) continue;
                const bool one = seen.contains(sides[0].cell), other = seen.contains(sides[1].cell);
                if (one == other) continue;
                seen.insert(sides[0].cell);
                seen.insert(sides[1].cell);
                grows = true;
            }
        }
        RC_ASSERT(seen == cells);
    }
}

}  // namespace
}  // namespace geomend
