// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "exchange/model_from_brep.h"
#include "topology/brep_from_dataset.h"
#include "validators/checks_testing.h"
#include "validators/rewritten.h"

// Lines that a mesh states inside of a face, as faults, wells and rivers are: the face is not cut there, and nothing is wrong.

namespace geomend {
namespace {

using namespace testing;

constexpr std::uint32_t n = 4;  // squares along each side of the sheet

std::uint32_t node(std::uint32_t i, std::uint32_t j) { return i * (n + 1) + j; }

void add_entity(CellMesh& mesh, int dimension, const std::string& name) {
    CellMesh::Entity entity;
    entity.dimension = dimension;
    entity.tag = 1;
    entity.name = name;
    mesh.entities.push_back(entity);
}
void add_cell(CellMesh& mesh, CellType type, const std::vector<std::uint32_t>& nodes) {
    mesh.add_cell(type, nodes);
    mesh.cell_entity.push_back(static_cast<std::uint32_t>(mesh.entities.size() - 1));
}

/// A sheet of triangles with a line along x from one node to another in the middle of y; cut there where asked: then the triangles
/// on one side have points of their own.
Dataset sheet_with_line(std::uint32_t from, std::uint32_t to, bool cut) {
    CellMesh mesh;
    mesh.info.name = "sheet";
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j <= n; ++j) mesh.points.push_back({1.0 * i, 1.0 * j, 0.1 * i * j});
    }
    std::map<std::uint32_t, std::uint32_t> twin;
    for (std::uint32_t i = from; cut && i <= to; ++i) {
        if ((i == from && i > 0) || (i == to && i < n)) continue;  // the ends inside are joined
        twin[node(i, 2)] = static_cast<std::uint32_t>(mesh.points.size());
        const Vec3 p = mesh.points[node(i, 2)];
        mesh.points.push_back(p);
    }
    add_entity(mesh, 1, "trace");
    for (std::uint32_t i = from; i < to; ++i) add_cell(mesh, CellType::line, {node(i, 2), node(i + 1, 2)});
    add_entity(mesh, 2, "face");
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const auto at = [&](std::uint32_t v) { return j >= 2 && twin.contains(v) ? twin[v] : v; };
            const std::uint32_t a = at(node(i, j)), b = at(node(i + 1, j)), c = at(node(i + 1, j + 1)), d = at(node(i, j + 1));
            add_cell(mesh, CellType::triangle, {a, b, c});
            add_cell(mesh, CellType::triangle, {a, c, d});
        }
    }
    Dataset data;
    data.objects.emplace_back(std::move(mesh));
    return data;
}

/// The model as surfaces with a stated model over them, which is how Model3d files hold it.
Dataset as_faces(Dataset data, std::vector<Loss>& losses) {
    topology::build_breps(data);
    EXPECT_EQ(data.breps.size(), 1u);
    return data.breps.size() == 1 ? exchange::faced_model(data.breps.front(), losses) : Dataset{};
}

/// How many points of surfaces stand where another one of the same surface does.
std::size_t places_with_two_points(const Dataset& data) {
    std::size_t twice = 0;
    for (const Object& object : data.objects) {
        const auto& points = std::get<Surface>(object).points;
        twice += points.size() - std::set<Vec3>(points.begin(), points.end()).size();
    }
    return twice;
}

std::set<std::string> codes(const Dataset& data) {
    auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    std::set<std::string> all;
    for (const Finding& f : checked->findings) {
        if (f.severity > Severity::info) all.insert(f.code);
    }
    return all;
}

TEST(ALineInAFace, IsNoSeamAndNoCutHoweverLongItIs) {
    for (const auto& [from, to] : {std::pair{1u, 2u}, {1u, 3u}, {0u, 3u}, {2u, 4u}, {0u, 4u}}) {
        EXPECT_EQ(codes(sheet_with_line(from, to, false)), std::set<std::string>{}) << from << " to " << to;
    }
}

TEST(ALineInAFace, IsNoSeamInAModelOfSurfacesMadeOfIt) {
    for (const auto& [from, to] : {std::pair{1u, 2u}, {1u, 3u}, {0u, 3u}, {2u, 4u}, {0u, 4u}}) {
        std::vector<Loss> losses;
        const Dataset faces = as_faces(sheet_with_line(from, to, false), losses);
        EXPECT_EQ(places_with_two_points(faces), 0u) << from << " to " << to;
        EXPECT_EQ(codes(faces), std::set<std::string>{}) << from << " to " << to;
        EXPECT_FALSE(losses.empty()) << "the line is in none of the surfaces";
    }
}

TEST(ALineInAFace, IsLostFromAModelOfSurfacesWithAWordWhereItHasNoName) {
    Dataset data = sheet_with_line(1, 3, false);
    std::get<CellMesh>(data.objects[0]).entities[0].name.clear();
    std::vector<Loss> losses;
    as_faces(data, losses);
    const auto lost = std::ranges::find(losses, std::string("lines inside of surfaces"), &Loss::what);
    ASSERT_NE(lost, losses.end());
    EXPECT_EQ(lost->count, 1u);
}

TEST(ALineInAFace, StaysACutInAModelOfSurfacesWhereTheMeshCutsTheFace) {
    std::vector<Loss> losses;
    const Dataset faces = as_faces(sheet_with_line(1, 3, true), losses);
    EXPECT_EQ(places_with_two_points(faces), 1u) << "the middle of the line, not its ends";
    EXPECT_TRUE(codes(faces).contains("B07"));
}

TEST(ALineInAFace, AlongWhichTheFaceIsCutIsASeam) {
    EXPECT_TRUE(codes(sheet_with_line(1, 3, true)).contains("B07"));
    EXPECT_TRUE(codes(sheet_with_line(0, 4, true)).contains("B07"));
}

/// Two loose pieces of a floor side by side, with points of their own, and a wall on their common border but for some of its edges.
Dataset floor_with_wall(const std::set<std::uint32_t>& gaps) {
    Dataset data;
    Surface floor, wall;
    floor.info.name = "floor";
    wall.info.name = "wall";
    wall.info.role = FeatureRole::fault;
    const auto add = [](Surface& surface, const Vec3& a, const Vec3& b, const Vec3& c) {
        std::array<std::uint32_t, 3> corners{};
        const std::array points{a, b, c};
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = static_cast<std::uint32_t>(std::ranges::find(surface.points, points[k]) - surface.points.begin());
            if (corners[k] == surface.points.size()) surface.points.push_back(points[k]);
        }
        surface.polygons.push_back(corners);
    };
    for (const double side : {-1.0, 1.0}) {
        Surface piece;
        for (std::uint32_t i = 0; i < n; ++i) {
            const Vec3 a{1.0 * i, 0, 0}, b{1.0 * i + 1, 0, 0}, c{1.0 * i + 1, side, 0}, d{1.0 * i, side, 0};
            add(piece, a, side > 0 ? b : c, side > 0 ? c : b);
            add(piece, a, side > 0 ? c : d, side > 0 ? d : c);
        }
        const auto first = static_cast<std::uint32_t>(floor.points.size());
        floor.points.insert(floor.points.end(), piece.points.begin(), piece.points.end());
        for (const std::uint32_t corner : piece.polygons.corners) floor.polygons.corners.push_back(first + corner);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const Vec3 a{1.0 * i, 0, 0}, b{1.0 * i + 1, 0, 0}, c{1.0 * i + 1, 0, 1}, d{1.0 * i, 0, 1};
        if (!gaps.contains(i)) add(wall, a, b, c);
        add(wall, a, c, d);
    }
    data.objects.emplace_back(std::move(floor));
    data.objects.emplace_back(std::move(wall));
    return data;
}

TEST(ASeamBetweenPieces, IsNoneWhereAnotherSurfaceOnlyHasAHole) {
    EXPECT_FALSE(codes(floor_with_wall({})).contains("B07"));
    EXPECT_FALSE(codes(floor_with_wall({1})).contains("B07")) << "the wall stands on both sides of its hole";
    EXPECT_TRUE(codes(floor_with_wall({2, 3})).contains("B07")) << "the wall ends, and the pieces go on apart";
    EXPECT_TRUE(codes(floor_with_wall({0, 1, 2, 3})).contains("B07"));
}

}  // namespace
}  // namespace geomend
