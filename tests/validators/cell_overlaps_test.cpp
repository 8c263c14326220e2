// SPDX-License-Identifier: AGPL-3.0-or-later
// Cells in each other, beside each other and face to face: whatever the frame, the numbering and the cell types.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <numeric>
#include <optional>
#include <random>

#include "cell_blocks.h"
#include "validators/registry.h"

namespace geomend {
namespace {

using namespace testing;

constexpr std::array kinds = {Kind::hexahedra, Kind::wedges, Kind::tetrahedra};

TEST(CellsInEachOther, BlocksThatTouchAreSound) {
    for (const Kind kind : kinds) {
        CellMesh mesh;
        add_block(mesh, {0, 0, 0}, 100, 2, kind);
        add_block(mesh, {100, 0, 0}, 100, 2, kind);
        EXPECT_EQ(codes_in_all_frames(mesh), Codes{});
    }
}

TEST(CellsInEachOther, ASmallBlockInsideOfOneCell) {
    for (const Kind kind : kinds) {
        CellMesh mesh;
        add_block(mesh, {0, 0, 0}, 100, 1, Kind::hexahedra);
        add_block(mesh, {40, 55, 30}, 10, 1, kind);
        const Codes codes = codes_in_all_frames(mesh);
        const std::uint64_t inner = kind == Kind::hexahedra ? 1 : kind == Kind::wedges ? 2 : 6;
        EXPECT_EQ(codes, (Codes{{"M29", 1 + inner}}));
    }
}

TEST(CellsInEachOther, BlocksWithASliceInCommon) {
    for (const Kind kind : kinds) {
        CellMesh mesh;
        add_block(mesh, {0, 0, 0}, 100, 2, kind);
        add_block(mesh, {70, 0, 0}, 100, 2, kind);
        EXPECT_TRUE(codes_in_all_frames(mesh).contains("M29"));
    }
}

TEST(CellsInEachOther, ABlockDeepInsideAMeshOfManyCells) {
    CellMesh mesh;
    add_block(mesh, {0, 0, 0}, 100, 8, Kind::tetrahedra);
    add_block(mesh, {43, 43, 43}, 5, 1, Kind::tetrahedra);
    EXPECT_TRUE(codes_in_all_frames(mesh).contains("M29"));
}

TEST(CellsInEachOther, OtherMeshesOnACommonPlaneDoNotMatch) {
    CellMesh mesh;
    add_block(mesh, {0, 0, 0}, 100, 2, Kind::hexahedra);
    add_block(mesh, {100, 0, 0}, 100, 3, Kind::hexahedra);
    EXPECT_EQ(codes_in_all_frames(mesh), (Codes{{"M24", 4 + 9}}));
}

/// Hexahedra on both sides of one bent face between two straight pillars, with other nodes along them; the right side moved by `moved`.
CellMesh beside_a_bent_face(double moved) {
    CellMesh mesh;
    const auto side = [&](double outer, double shift, std::initializer_list<double> depths) {
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        std::uint32_t layers = 0;
        for (const double t : depths) {
            mesh.points.push_back({0.3 * t + shift, 0, t});
            mesh.points.push_back({-0.3 * t + shift, 1, t});
            mesh.points.push_back({outer, 0, t});
            mesh.points.push_back({outer, 1, t});
            ++layers;
        }
        for (std::uint32_t k = 0; k + 1 < layers; ++k) {
            const std::uint32_t a = first + 4 * k, b = a + 4;
            if (outer > 0) mesh.add_cell(CellType::hexahedron, std::array{a, a + 2, a + 3, a + 1, b, b + 2, b + 3, b + 1});
            else mesh.add_cell(CellType::hexahedron, std::array{a + 2, a, a + 1, a + 3, b + 2, b, b + 1, b + 3});
        }
    };
    side(-2, 0, {0, 1, 2});
    side(2, -moved, {0, 0.6, 2});
    return mesh;
}

TEST(CellsInEachOther, WhatTrianglesDifferFromBentFacesIsNoOverlap) {
    EXPECT_FALSE(codes_of(beside_a_bent_face(0)).contains("M29"));
    EXPECT_TRUE(codes_of(beside_a_bent_face(0.5)).contains("M29"));
}

// A hexahedron against two tetrahedra over either diagonal of its bent top: their faces do not match, but none lies in another.
TEST(CellsInEachOther, TetrahedraOverEitherDiagonalOfABentFaceAreNotInItsCell) {
    using Nodes = std::vector<std::uint32_t>;
    for (const double bend : {0.02, 0.2, -0.2}) {
        for (const std::uint32_t turn : {0u, 1u}) {
            CellMesh mesh;
            for (std::uint32_t k = 0; k < 2; ++k) {
                for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}) mesh.points.push_back({x, y, 1. * k});
            }
            mesh.points[6][2] += bend;
            mesh.points.push_back({0.5, 0.5, 2});
            mesh.add_cell(CellType::hexahedron, Nodes{0, 1, 2, 3, 4, 5, 6, 7});
            const auto top = [&](std::uint32_t i) { return 4 + (i + turn) % 4; };
            mesh.add_cell(CellType::tetrahedron, Nodes{top(0), top(1), top(2), 8});
            mesh.add_cell(CellType::tetrahedron, Nodes{top(0), top(2), top(3), 8});
            const Codes codes = codes_of(mesh);
            EXPECT_TRUE(codes.contains("M24")) << bend << ' ' << turn;
            EXPECT_FALSE(codes.contains("M29")) << bend << ' ' << turn;
            mesh.points[8][2] = 0.5;  // into the hexahedron
            EXPECT_TRUE(codes_of(mesh).contains("M29")) << bend << ' ' << turn;
        }
    }
}

/// Two blocks of one mesh with an array of regions.
CellMesh blocks_with_regions(const std::string& name, double gap, std::int32_t second) {
    CellMesh mesh;
    add_block(mesh, {0, 0, 0}, 100, 2, Kind::tetrahedra);
    const auto cells = static_cast<std::ptrdiff_t>(mesh.cell_count());
    add_block(mesh, {100 + gap, 0, 0}, 100, 2, Kind::tetrahedra);
    std::vector<std::int32_t> regions(mesh.cell_count(), 1);
    std::fill(regions.begin() + cells, regions.end(), second);
    Attribute a;
    a.name = name;
    a.location = AttributeLocation::cell;
    a.values = std::move(regions);
    mesh.info.attributes.push_back(std::move(a));
    return mesh;
}

std::optional<Severity> severity_of(const CellMesh& mesh, std::string_view code) {
    Dataset data;
    data.objects.emplace_back(mesh);
    const auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    for (const Finding& f : checked->findings) {
        if (f.code == code) return f.severity;
    }
    return {};
}

TEST(RegionsOfCells, AreOneVolumeEach) {
    for (const char* name : {"region", "Regions", "Region_ID", "region id"})
        EXPECT_EQ(severity_of(blocks_with_regions(name, 50, 1), "M37"), Severity::error) << name;
    for (const char* name : {"MaterialIDs", "attribute", "CellEntityIds"})  // several bodies of one material are usual
        EXPECT_EQ(severity_of(blocks_with_regions(name, 50, 1), "M37"), Severity::warning) << name;
    EXPECT_FALSE(severity_of(blocks_with_regions("region", 50, 2), "M37")) << "two regions, one volume each";
    EXPECT_FALSE(severity_of(blocks_with_regions("region", 0, 1), "M37")) << "faces at one position join";
    EXPECT_FALSE(severity_of(blocks_with_regions("porosity class", 50, 1), "M37")) << "no array of regions";
}

TEST(RegionsOfCells, AreTheEntitiesWhereAMeshHasThem) {
    CellMesh mesh = blocks_with_regions("region", 50, 2);
    mesh.entities = {{3, 7, "rock", {}, {}, {}, {}, {}}};
    mesh.cell_entity.assign(mesh.cell_count(), 0);
    EXPECT_EQ(severity_of(mesh, "M37"), Severity::error);
    mesh.entities.push_back({3, 8, "rock too", {}, {}, {}, {}, {}});
    for (std::size_t c = mesh.cell_count() / 2; c < mesh.cell_count(); ++c) mesh.cell_entity[c] = 1;
    EXPECT_FALSE(severity_of(mesh, "M37"));
}

/// Two blocks side by side along an axis, turned, with a gap between them.
CellMesh blocks_apart(std::size_t axis, double gap, std::uint32_t pieces, Kind kind, double turn) {
    CellMesh mesh;
    add_block(mesh, {0, 0, 0}, 100, 4, kind);
    Vec3 from{};
    from[axis] = 100 + gap;
    add_block(mesh, from, 100, pieces, kind);
    for (Vec3& p : mesh.points) {
        const Vec3 q{std::cos(turn) * p[0] - std::sin(turn) * p[1], std::sin(turn) * p[0] + std::cos(turn) * p[1], p[2]};
        p = {4.5e5 + q[0], 6.1e6 + std::cos(turn) * q[1] - std::sin(turn) * q[2], std::sin(turn) * q[1] + std::cos(turn) * q[2] - 2000};
    }
    return mesh;
}

TEST(SlitsBetweenCells, AreToldWithTheirPlaceHoweverTheBlocksAreTurned) {
    for (const double turn : {0.0, 0.3, 1.1}) {
        for (const std::uint32_t pieces : {4u, 3u}) {  // matching, and not
            for (const std::size_t axis : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
                const CellMesh mesh = blocks_apart(axis, 0.2, pieces, Kind::tetrahedra, turn);
                EXPECT_EQ(severity_of(mesh, "M38"), Severity::warning) << turn << ' ' << pieces << ' ' << axis;
                EXPECT_FALSE(severity_of(mesh, "M24"));
            }
        }
    }
    Dataset data;
    data.objects.emplace_back(blocks_apart(0, 0.2, 4, Kind::tetrahedra, 0));
    const auto checked = validators::check_models(data, {});
    ASSERT_TRUE(checked);
    const auto slit = std::ranges::find(checked->findings, "M38", &Finding::code);
    ASSERT_NE(slit, checked->findings.end());
    EXPECT_EQ(slit->count, 64u) << "two triangles on each of 16 squares, from both sides";
    ASSERT_FALSE(slit->points.empty());
    EXPECT_NEAR(slit->points[0][0], 4.5e5 + 100, 0.3);
    EXPECT_NE(slit->message.find("across a slit of 0.2 "), std::string::npos) << slit->message;
}

TEST(SlitsBetweenCells, AreNarrowAndEmpty) {
    EXPECT_FALSE(severity_of(blocks_apart(0, 0, 4, Kind::tetrahedra, 0.3), "M38"));
    EXPECT_FALSE(severity_of(blocks_apart(0, 5, 4, Kind::tetrahedra, 0.3), "M38")) << "a fifth of an edge";
    EXPECT_FALSE(severity_of(blocks_apart(0, -5, 4, Kind::tetrahedra, 0.3), "M38")) << "they overlap: M29";
    CellMesh thin;  // a plate by itself: its sides look away from each other
    add_block(thin, {0, 0, 0}, 100, 1, Kind::hexahedra);
    for (Vec3& p : thin.points) p[0] *= 1e-3;
    EXPECT_FALSE(severity_of(thin, "M38"));
}

TEST(SlitsBetweenCells, LayersOfInactiveCellsMayBeLeftOut) {
    EXPECT_FALSE(severity_of(blocks_apart(2, 1, 4, Kind::hexahedra, 0), "M38"));
    EXPECT_EQ(severity_of(blocks_apart(0, 1, 4, Kind::hexahedra, 0), "M38"), Severity::warning) << "not from side to side";
    EXPECT_EQ(severity_of(blocks_apart(2, 0.02, 4, Kind::hexahedra, 0), "M38"), Severity::warning) << "nor as thin as near misses";
}

TEST(RegionsOfCells, OfAMillionCellsCostLittle) {
    const double before = static_cast<double>(std::clock());
    CellMesh large;
    add_block(large, {0, 0, 0}, 100, 55, Kind::tetrahedra);  // 998,250 cells
    Attribute a;
    a.name = "region";
    a.location = AttributeLocation::cell;
    a.values = std::vector<std::int32_t>(large.cell_count(), 1);
    large.info.attributes.push_back(std::move(a));
    const double made = static_cast<double>(std::clock());
    EXPECT_FALSE(severity_of(large, "M29"));
    const double all = (static_cast<double>(std::clock()) - made) / CLOCKS_PER_SEC;
    std::printf("all checks of a million tetrahedra: %.2f s of processor time (made in %.2f)\n", all, (made - before) / CLOCKS_PER_SEC);
    EXPECT_LT(all, 30);
}

TEST(CellsInEachOther, AHealthyTetrahedronIsNotBlamedForADegenerateOne) {
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, 0.3, 1e-17}};
    mesh.add_cell(CellType::tetrahedron, std::array{0u, 2u, 1u, 3u});  // wound the other way
    mesh.add_cell(CellType::tetrahedron, std::array{0u, 1u, 2u, 4u});
    Dataset data;
    data.objects.emplace_back(mesh);
    const auto checked = validators::check_models(data, {});
    ASSERT_TRUE(checked);
    const auto at = std::ranges::find(checked->findings, "M20", &Finding::code);
    ASSERT_NE(at, checked->findings.end());
    EXPECT_EQ(at->elements, std::vector<std::int64_t>{2});
}

}  // namespace
}  // namespace geomend
