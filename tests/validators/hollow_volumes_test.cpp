// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "topology/brep_from_dataset.h"
#include "validators/registry.h"

// Volumes that a mesh states without cells in them: where their surfaces are there they are regions, signs or none; where a mesher saved
// some of them only, nothing of them is judged.

namespace geomend {
namespace {

constexpr std::array<std::array<std::uint32_t, 4>, 6> sides = {
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};

/// Two cubes, one on the other, their sides as surfaces 1 to 6 and 7 to 11 of two triangles each; surface 2 is between them. The volumes
/// have no cells.
/// \param saved which surfaces have their triangles \param sign of surface 2 in the list of the upper volume
Dataset two_cubes(const std::set<std::int64_t>& saved, int sign) {
    CellMesh mesh;
    mesh.info.name = "cubes";
    for (int k = 0; k < 3; ++k) {
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 2; ++i) mesh.points.push_back({100.0 * i, 100.0 * j, 100.0 * k});
        }
    }
    std::int64_t tag = 0;
    CellMesh::Entity lower, upper;
    lower.dimension = upper.dimension = 3;
    lower.tag = 1;
    upper.tag = 2;
    for (std::uint32_t k = 0; k < 2; ++k) {
        for (std::uint32_t s = 0; s < 6; ++s) {
            if (k == 1 && s == 0) {
                upper.boundary.push_back(2 * sign);
                continue;
            }
            ++tag;
            (k == 0 ? lower : upper).boundary.push_back(tag);
            CellMesh::Entity face;
            face.dimension = 2;
            face.tag = tag;
            mesh.entities.push_back(face);
            if (!saved.contains(tag)) continue;
            const auto at = [&](std::size_t n) { return sides[s][n] + 4 * k; };
            for (const auto& t : {std::array{at(0), at(1), at(2)}, std::array{at(0), at(2), at(3)}}) {
                mesh.add_cell(CellType::triangle, t);
                mesh.cell_entity.push_back(static_cast<std::uint32_t>(mesh.entities.size() - 1));
            }
        }
    }
    mesh.entities.push_back(lower);
    mesh.entities.push_back(upper);
    Dataset data;
    data.objects.emplace_back(std::move(mesh));
    return data;
}

std::vector<Finding> judged(const Dataset& data) {
    auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    std::vector<Finding> found;
    for (const Finding& f : checked->findings) {
        if (f.severity > Severity::info) found.push_back(f);
    }
    return found;
}

const std::set<std::int64_t> all_surfaces = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};

TEST(VolumesWithoutCells, AreRegionsWithOrWithoutSigns) {
    EXPECT_TRUE(judged(two_cubes(all_surfaces, -1)).empty());
    EXPECT_TRUE(judged(two_cubes(all_surfaces, 1)).empty()) << "some meshers write no sign at all";
}

TEST(VolumesWithoutCells, OfWhichSomeSurfacesAreNotSavedAreNotJudged) {
    for (const std::int64_t absent : {1, 2, 5, 11}) {
        auto saved = all_surfaces;
        saved.erase(absent);
        const auto found = judged(two_cubes(saved, -1));
        EXPECT_TRUE(std::ranges::none_of(found, [](const Finding& f) { return f.severity == Severity::error; })) << absent;
        EXPECT_EQ(std::ranges::count(found, "F121", &Finding::code), absent == 2 ? 2 : 1) << absent;
        const auto region = std::ranges::find(found, "F121", &Finding::code);
        EXPECT_NE(region->message.find("5 of the 6 surfaces that bound it have elements"), std::string::npos) << region->message;
    }
    const auto found = judged(two_cubes({3}, -1));
    EXPECT_TRUE(std::ranges::all_of(found, [](const Finding& f) { return f.code == "F121"; }))
        << "one side of a box, as conditions at a boundary need it";
}

/// A cube with another one inside of it, both hollow, and each with six surfaces. The list of the outer one names all of them, without
/// any sign.
/// \param turned whether the sides of the inner cube are wound inwards
Dataset cube_in_cube(bool turned) {
    CellMesh mesh;
    mesh.info.name = "cubes";
    CellMesh::Entity outer, inner;
    outer.dimension = inner.dimension = 3;
    outer.tag = 1;
    inner.tag = 2;
    std::int64_t tag = 0;
    for (std::uint32_t cube = 0; cube < 2; ++cube) {
        for (std::uint32_t n = 0; n < 8; ++n) {
            const auto at = [&](std::uint32_t axis) { return (n >> axis & 1u) != 0 ? 10.0 - 3 * cube : 3.0 * cube; };
            mesh.points.push_back({at(0), at(1), at(2)});
        }
        for (const auto& side : sides) {
            CellMesh::Entity face;
            face.dimension = 2;
            face.tag = ++tag;
            outer.boundary.push_back(tag);
            if (cube == 1) inner.boundary.push_back(tag);
            mesh.entities.push_back(face);
            for (auto t : {std::array{side[0], side[1], side[2]}, std::array{side[0], side[2], side[3]}}) {
                for (std::uint32_t& node : t) node += 8 * cube;
                if (turned && cube == 1) std::swap(t[0], t[1]);
                mesh.add_cell(CellType::triangle, t);
                mesh.cell_entity.push_back(static_cast<std::uint32_t>(mesh.entities.size() - 1));
            }
        }
    }
    mesh.entities.push_back(outer);
    mesh.entities.push_back(inner);
    Dataset data;
    data.objects.emplace_back(std::move(mesh));
    return data;
}

TEST(VolumesWithoutCells, GoAroundBodiesOfSeveralSurfacesWithoutSigns) {
    for (const bool turned : {false, true}) {
        Dataset data = cube_in_cube(turned);
        EXPECT_TRUE(judged(data).empty()) << turned;
        topology::build_breps(data);
        ASSERT_EQ(data.breps.size(), 1u);
        ASSERT_EQ(data.breps[0]->regions.size(), 2u);
        EXPECT_NEAR(data.breps[0]->regions[0].volume, 1000 - 64, 1e-9) << turned;
        EXPECT_NEAR(data.breps[0]->regions[1].volume, 64, 1e-9) << turned;
    }
}

/// Three hexahedra in a row, and a set of faces on the tops of the first and the last.
Dataset cells_with_a_set() {
    CellMesh mesh;
    mesh.info.name = "cells";
    for (std::uint32_t k = 0; k < 2; ++k) {
        for (std::uint32_t j = 0; j < 2; ++j) {
            for (std::uint32_t i = 0; i < 4; ++i) mesh.points.push_back({100.0 * i, 100.0 * j, 100.0 * k});
        }
    }
    mesh.entities.resize(2);
    mesh.entities[0].dimension = 3;
    mesh.entities[0].tag = 1;
    mesh.entities[1].dimension = 2;
    mesh.entities[1].tag = 2;
    mesh.entities[1].name = "inflow";
    for (std::uint32_t i = 0; i < 3; ++i) {
        const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return i + x + 4 * y + 8 * z; };
        const std::array hexahedron{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)};
        mesh.add_cell(CellType::hexahedron, hexahedron);
        mesh.cell_entity.push_back(0);
        if (i == 1) continue;
        mesh.add_cell(CellType::quad, std::array{at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
        mesh.cell_entity.push_back(1);
    }
    Dataset data;
    data.objects.emplace_back(std::move(mesh));
    return data;
}

TEST(SetsOfFacesOfCells, NeedNotHangTogether) { EXPECT_TRUE(judged(cells_with_a_set()).empty()); }

}  // namespace
}  // namespace geomend
