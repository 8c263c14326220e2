// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "validators/registry.h"

namespace geomend {
namespace {

CellMesh mesh_of(std::vector<Vec3> points) {
    CellMesh mesh;
    mesh.info.name = "mesh";
    mesh.points = std::move(points);
    return mesh;
}

void add(CellMesh& mesh, CellType type, std::vector<std::uint32_t> nodes) { mesh.add_cell(type, nodes); }

/// nx x 1 x 1 unit cubes in a row.
CellMesh row_of_cubes(std::uint32_t count) {
    CellMesh mesh = mesh_of({});
    for (std::uint32_t i = 0; i <= count; ++i) {
        for (const double y : {0.0, 1.0}) {
            for (const double z : {0.0, 1.0}) mesh.points.push_back({double(i), y, z});
        }
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = 4 * i, b = a + 4;  // y z: 00 01 10 11
        add(mesh, CellType::hexahedron, {a, b, b + 2, a + 2, a + 1, b + 1, b + 3, a + 3});
    }
    return mesh;
}

std::vector<Finding> findings_of(const CellMesh& mesh) {
    Dataset data;
    data.objects.emplace_back(mesh);
    auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    return checked ? std::move(checked->findings) : std::vector<Finding>{};
}

std::set<std::string> codes_of(const CellMesh& mesh) {
    std::set<std::string> codes;
    for (const Finding& f : findings_of(mesh)) codes.insert(f.code);
    return codes;
}

const Finding* find(const std::vector<Finding>& findings, const std::string& code) {
    const auto at = std::ranges::find(findings, code, &Finding::code);
    return at == findings.end() ? nullptr : &*at;
}

TEST(ChecksOfCells, FindNothingInSoundCells) {
    EXPECT_EQ(codes_of(row_of_cubes(3)), std::set<std::string>{});
    CellMesh one_of_each = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.3, 0.3, 2}});
    add(one_of_each, CellType::wedge, {0, 2, 1, 3, 5, 4});
    add(one_of_each, CellType::tetrahedron, {3, 4, 5, 6});
    EXPECT_EQ(codes_of(one_of_each), std::set<std::string>{});
}

TEST(ChecksOfCells, FindACellThatIsTurnedAgainstTheOthers) {
    CellMesh mesh = row_of_cubes(3);
    for (std::size_t k = 0; k < 4; ++k) std::swap(mesh.nodes[8 + k], mesh.nodes[12 + k]);
    const auto findings = findings_of(mesh);
    const Finding* f = find(findings, "M20");
    ASSERT_NE(f, nullptr);
    EXPECT_EQ(f->elements, std::vector<std::int64_t>{2});
    EXPECT_EQ(f->severity, Severity::error);
}

TEST(ChecksOfCells, TakeTheSenseOfMostCellsForRight) {
    CellMesh mesh = row_of_cubes(3);
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < 4; ++k) std::swap(mesh.nodes[8 * c + k], mesh.nodes[8 * c + 4 + k]);
    }
    EXPECT_EQ(codes_of(mesh), std::set<std::string>{"M35"});  // a note: no cell is against the others
}

TEST(ChecksOfCells, FindAFoldedCorner) {
    CellMesh mesh = row_of_cubes(2);
    mesh.points[11] = {0.4, 0.4, 0.4};  // pulled past the diagonal of its cell
    const auto findings = findings_of(mesh);
    const Finding* f = find(findings, "M21");
    ASSERT_NE(f, nullptr);
    EXPECT_EQ(f->elements, std::vector<std::int64_t>{2});
}

TEST(ChecksOfCells, FindACellWithoutVolumeAndOneThatUsesANodeTwice) {
    CellMesh flat = row_of_cubes(2);
    flat.points.push_back({5, 0, 0});
    flat.points.push_back({6, 0, 0});
    flat.points.push_back({5, 1, 0});
    flat.points.push_back({6, 1, 0});
    add(flat, CellType::tetrahedron, {12, 13, 14, 15});
    EXPECT_TRUE(codes_of(flat).contains("M20"));
    CellMesh twice = row_of_cubes(2);
    add(twice, CellType::tetrahedron, {0, 1, 2, 1});
    EXPECT_TRUE(codes_of(twice).contains("M22"));
}

TEST(ChecksOfCells, FindAFaceOnThreeCells) {
    CellMesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 1}});
    add(mesh, CellType::tetrahedron, {0, 1, 2, 3});
    add(mesh, CellType::tetrahedron, {0, 2, 1, 4});
    add(mesh, CellType::tetrahedron, {0, 1, 2, 5});
    const auto findings = findings_of(mesh);
    const Finding* f = find(findings, "M23");
    ASSERT_NE(f, nullptr);
    EXPECT_EQ(f->count, 3u);
}

TEST(ChecksOfCells, FindFacesThatLieOnEachOtherWithoutMatching) {
    CellMesh mesh = row_of_cubes(1);
    // Beside the cube, two tetrahedra on its face x = 1 would match with two triangles; one with a hanging node does not.
    mesh.points.push_back({1, 0.5, 0.5});
    mesh.points.push_back({2, 0.5, 0.5});
    add(mesh, CellType::tetrahedron, {4, 6, 8, 9});
    const auto findings = findings_of(mesh);
    const Finding* f = find(findings, "M24");
    ASSERT_NE(f, nullptr);
    EXPECT_EQ(f->elements, (std::vector<std::int64_t>{1, 2}));
}

TEST(ChecksOfCells, FindAPolyhedronThatIsOpenAndOneWithABentFace) {
    CellMesh mesh = row_of_cubes(1);
    const CellMesh cube = mesh;
    mesh.types = {CellType::polyhedron};
    mesh.face_nodes.clear();
    const std::vector<std::vector<std::uint32_t>> faces = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                                                           {4, 6, 7, 5}, {6, 2, 3, 7}, {2, 0, 1, 3}};
    mesh.face_offsets = {0};
    for (const auto& face : faces) {
        mesh.face_nodes.insert(mesh.face_nodes.end(), face.begin(), face.end());
        mesh.face_offsets.push_back(mesh.face_nodes.size());
    }
    mesh.cell_faces = {0, 6};
    EXPECT_EQ(codes_of(mesh), std::set<std::string>{});
    CellMesh open = mesh;
    open.cell_faces = {0, 5};
    open.face_offsets.pop_back();
    open.face_nodes.resize(20);
    EXPECT_TRUE(codes_of(open).contains("M25"));
    CellMesh bent = mesh;
    bent.points[7][0] += 0.1;
    EXPECT_TRUE(codes_of(bent).contains("Q10"));
    EXPECT_FALSE(codes_of(bent).contains("M25"));
}

TEST(ChecksOfCells, FindRepeatedCellsNearNodesAndUnusedNodes) {
    CellMesh mesh = row_of_cubes(2);
    add(mesh, CellType::hexahedron, {0, 4, 6, 2, 1, 5, 7, 3});
    EXPECT_TRUE(codes_of(mesh).contains("M26"));
    CellMesh apart = row_of_cubes(2);
    for (std::uint32_t n = 4; n < 8; ++n) apart.points.push_back(apart.points[n]);
    for (std::size_t k = 8; k < 16; ++k) {
        if (apart.nodes[k] < 8) apart.nodes[k] += 8;
    }
    const auto equal = findings_of(apart);
    ASSERT_NE(find(equal, "M27"), nullptr);
    EXPECT_EQ(find(equal, "M27")->severity, Severity::info) << "disconnected on purpose";
    apart.points[12][0] += 1e-8;
    const auto near = findings_of(apart);
    ASSERT_NE(find(near, "M27"), nullptr);
    EXPECT_EQ(find(near, "M27")->severity, Severity::warning);
    CellMesh unused = row_of_cubes(2);
    unused.points.push_back({1, 1, 3});
    EXPECT_EQ(codes_of(unused), std::set<std::string>{"M28"});
}

TEST(ChecksOfCells, LetRegionsMeetAtAnEdgeButNotPartsOfOne) {
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {0.5, 1, 0.5}, {-1, 0.5, 0.5}, {-0.5, -1, 0.5}};
    add(mesh, CellType::tetrahedron, {0, 2, 3, 1});
    add(mesh, CellType::tetrahedron, {0, 4, 5, 1});
    Attribute region;
    region.name = "region";
    region.location = AttributeLocation::cell;
    for (const bool two : {false, true}) {
        region.values = std::vector<std::int32_t>{1, two ? 2 : 1};
        mesh.info.attributes = {region};
        EXPECT_EQ(codes_of(mesh).contains("M36"), !two);
    }
    mesh.info.attributes.clear();
    EXPECT_TRUE(codes_of(mesh).contains("M36"));
}

}  // namespace
}  // namespace geomend
