// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/numbering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <vector>

#include "formats/vtk/cell_check.h"
#include "hexes/conflicts.h"
#include "hexes/lattice_meshes.h"
#include "hexes/local_search.h"
#include "model/cell_faces.h"

// Corners in an order that a check takes; a search that has nothing to look for.

namespace geomend::hexes {
namespace {

const std::vector<Vec3> places{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1},    {1, 0, 1},
                               {3, 0, 0}, {4, 0, 0}, {4, 1, 0}, {3, 1, 0}, {3.5, 0.5, 1}};

MixedMesh prism_and_pyramid() {
    MixedMesh mesh;
    mesh.positions = places;
    mesh.cells.push_back({CellType::wedge, {0, 1, 2, 3, 4, 5, no_index, no_index}, 0, 0});
    mesh.cells.push_back({CellType::pyramid, {6, 7, 8, 9, 10, no_index, no_index, no_index}, 0, 0});
    for (std::uint32_t cell = 0; cell < 2; ++cell) {
        for (std::uint32_t f = 0; f < faces_of(mesh.cells[cell].type).size(); ++f) mesh.facet_places.push_back({cell, f});
    }
    mesh.facet_places.push_back({no_index, 0});
    return mesh;
}

/// The corners of each place.
std::vector<std::set<std::uint32_t>> faces_in(const MixedMesh& mesh) {
    std::vector<std::set<std::uint32_t>> all;
    for (const CellFaceRef& place : mesh.facet_places) {
        std::set<std::uint32_t>& face = all.emplace_back();
        if (place.cell == no_index) continue;
        for (const auto k : faces_of(mesh.cells[place.cell].type)[place.face].corners()) face.insert(mesh.cells[place.cell].corners[k]);
    }
    return all;
}

TEST(Numbering, TheOrderThatACheckTakesIsFoundAndFacesFollow) {
    const auto faces = faces_in(prism_and_pyramid());
    for (std::size_t first = 0; first < places.size() - 1; ++first) {
        MixedMesh mesh = prism_and_pyramid();
        const std::uint32_t cell = first < 6 ? 0 : 1;
        const auto starts_there = [&](CellType type, std::span<const Vec3> p) {
            return (type == CellType::wedge) != (cell == 0) || p[0] == places[first];
        };
        EXPECT_TRUE(number_corners(mesh, starts_there).empty());
        EXPECT_EQ(mesh.cells[cell].corners[0], first);
        EXPECT_EQ(mesh.cells[1 - cell].corners, prism_and_pyramid().cells[1 - cell].corners);
        EXPECT_EQ(faces_in(mesh), faces);
        // Not inside out: VTK's own check goes by that, too.
        for (const MixedMesh::Cell& c : mesh.cells) {
            std::vector<Vec3> p;
            for (std::size_t k = 0; k < node_count(c.type); ++k) p.push_back(mesh.positions[c.corners[k]]);
            EXPECT_TRUE(is_taken(vtk_finds_valid, c.type, p));
            std::reverse(p.begin(), p.begin() + (c.type == CellType::wedge ? 3 : 4));
            EXPECT_FALSE(is_taken(vtk_finds_valid, c.type, p));
        }
    }
}

TEST(Numbering, WhatIsTakenInNoOrderIsTold) {
    MixedMesh mesh = prism_and_pyramid();
    const auto prisms_alone = [](CellType type, std::span<const Vec3>) { return type == CellType::wedge; };
    EXPECT_EQ(number_corners(mesh, prisms_alone), (std::vector<std::uint32_t>{1}));
    EXPECT_EQ(mesh.cells[1].corners, prism_and_pyramid().cells[1].corners);
}

TEST(Numbering, CellsBesideShareAQuadrangle) {
    MixedMesh mesh = prism_and_pyramid();
    mesh.positions.push_back({0.5, 0.5, -3});
    mesh.cells.push_back({CellType::pyramid, {0, 3, 4, 1, 11, no_index, no_index, no_index}, 0, 0});
    EXPECT_EQ(beside_cells(mesh, std::vector<std::uint32_t>{2}, 2), (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(beside_cells(mesh, std::vector<std::uint32_t>{1}, 2), (std::vector<std::uint32_t>{1}));
    EXPECT_TRUE(beside_cells(mesh, {}, 2).empty());
}

TEST(VtkCheck, IsTheSameFarFromTheOrigin) {
    for (const Vec3& shift : {Vec3{0, 0, 0}, Vec3{500000, 6000000, -3000}}) {
        std::vector<Vec3> prism(places.begin(), places.begin() + 6);
        for (Vec3& p : prism) {
            for (std::size_t k = 0; k < 3; ++k) p[k] += shift[k];
        }
        EXPECT_TRUE(vtk_finds_valid(CellType::wedge, prism));
        prism[4] = {shift[0] + 0.9, shift[1] - 0.6, shift[2] + 1};
        EXPECT_FALSE(vtk_finds_valid(CellType::wedge, prism));
    }
}

TEST(LocalSearch, EndsAtOnceWhereNothingIsInTheWay) {
    const test::Lattice one = test::lattice({1, 1, 1});
    const auto mesh = VolumeMesh::make(test::mesh_data(one.points, test::kuhn_tets(one)));
    ASSERT_TRUE(mesh);
    const TetMesh tets = tet_mesh_of(*mesh);
    const Candidates all = find_hexahedra(tets, QuadTable(tets, 0.3), {});
    ASSERT_EQ(all.size(), 1u);
    const Conflicts conflicts(all, tets.tets.size());
    LocalSearch how;
    how.steps = std::numeric_limits<std::uint64_t>::max() / 2;
    EXPECT_EQ(search_selection(conflicts, all.volume, std::vector<std::uint32_t>{0}, how), (std::vector<std::uint32_t>{0}));
}

}  // namespace
}  // namespace geomend::hexes
