// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/split_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "base/vectors.h"
#include "geometry/cell_volume.h"
#include "model/cell_faces.h"

namespace geomend::hexes {
namespace {

/// One cell that stands by itself, and behind one of its quadrangles the two tetrahedra that cut it from corner `start` on.
MixedMesh cell_before_tetrahedra(CellType type, std::vector<Vec3> positions, std::uint32_t face, std::uint32_t start, const Vec3& behind) {
    MixedMesh m;
    MixedMesh::Cell cell{type, {}, 0, 0};
    cell.corners.fill(no_index);
    for (std::uint32_t k = 0; k < positions.size(); ++k) cell.corners[k] = k;
    m.cells.push_back(cell);
    const auto local = std::next(faces_of(type).begin(), face)->corners();
    const auto apex = static_cast<std::uint32_t>(positions.size());
    positions.push_back(behind);
    for (std::size_t half = 1; half < 3; ++half) {
        const auto at = [&](std::size_t k) { return std::uint32_t{local[(start + k) % 4]}; };
        m.cells.push_back({CellType::tetrahedron, {at(0), at(half), at(half + 1), apex, no_index, no_index, no_index, no_index}, 0, 1});
    }
    m.positions = std::move(positions);
    return m;
}

std::map<CellType, int> count_by_type(const MixedMesh& m) {
    std::map<CellType, int> counts;
    for (const MixedMesh::Cell& cell : m.cells) ++counts[cell.type];
    return counts;
}

double volume_of(const MixedMesh& m) {
    double sum = 0;
    for (const MixedMesh::Cell& cell : m.cells) {
        const auto at = [&](std::size_t k) { return m.positions[cell.corners[k]]; };
        const double volume = cell.type == CellType::tetrahedron ? tetrahedron_volume(at(0), at(1), at(2), at(3))
                                                                 : pyramid_volume({at(0), at(1), at(2), at(3), at(4)});
        EXPECT_GT(volume, 0);
        sum += volume;
    }
    return sum;
}

/// Faces with the same corners as no other: those at the end of a mesh that conforms.
std::size_t faces_with_one_cell(const MixedMesh& m) {
    std::map<std::vector<std::uint32_t>, int> cells;
    for (const MixedMesh::Cell& cell : m.cells) {
        for (const LocalFace& face : faces_of(cell.type)) {
            std::vector<std::uint32_t> corners;
            for (const std::uint8_t k : face.corners()) corners.push_back(cell.corners[k]);
            std::ranges::sort(corners);
            ++cells[corners];
        }
    }
    return static_cast<std::size_t>(std::ranges::count_if(cells, [](const auto& f) { return f.second == 1; }));
}

const std::vector<Vec3> unit_cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
// Two upright edges in front, at x = 0: the quadrangle between them faces to -x.
const std::vector<Vec3> unit_prism{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}};

std::uint32_t face_to(CellType type, const std::vector<Vec3>& positions, const Vec3& direction) {
    std::uint32_t number = 0;
    for (const LocalFace& face : faces_of(type)) {
        const auto c = face.corners();
        const Vec3 n = cross(minus(positions[c[1]], positions[c[0]]), minus(positions[c[2]], positions[c[0]]));
        if (c.size() == 4 && dot(n, direction) > 0.99) return number;
        ++number;
    }
    return no_index;
}

// Botella 2016, figure 3.12: six pyramids, one of them cut.
TEST(Splitting, AHexahedronBeforeTwoTetrahedraBecomesFivePyramidsAndTwoTetrahedra) {
    const std::uint32_t face = face_to(CellType::hexahedron, unit_cube, {0, 0, 1});
    for (const std::uint32_t start : {0u, 1u}) {
        MixedMesh m = cell_before_tetrahedra(CellType::hexahedron, unit_cube, face, start, {0.5, 0.5, 1.8});
        const std::vector<OpenQuad> open{{0, face, start}};
        EXPECT_EQ(split_cells(m, open), 1u);
        EXPECT_EQ(count_by_type(m), (std::map<CellType, int>{{CellType::pyramid, 5}, {CellType::tetrahedron, 2 + 2}}));
        EXPECT_EQ(m.positions.size(), 10u);
        EXPECT_NEAR(volume_of(m), 1 + 0.8 / 3, 1e-14);
        EXPECT_EQ(faces_with_one_cell(m), 5u + 4);
    }
}

// Figure 3.13: three pyramids and two tetrahedra, one of the pyramids cut.
TEST(Splitting, APrismBeforeTwoTetrahedraBecomesTwoPyramidsAndFourTetrahedra) {
    const std::uint32_t face = face_to(CellType::wedge, unit_prism, {-1, 0, 0});
    ASSERT_NE(face, no_index);
    for (const std::uint32_t start : {0u, 1u}) {
        MixedMesh m = cell_before_tetrahedra(CellType::wedge, unit_prism, face, start, {-0.8, 0.5, 0.5});
        const std::vector<OpenQuad> open{{0, face, start}};
        EXPECT_EQ(split_cells(m, open), 1u);
        EXPECT_EQ(count_by_type(m), (std::map<CellType, int>{{CellType::pyramid, 2}, {CellType::tetrahedron, 4 + 2}}));
        EXPECT_EQ(m.positions.size(), 8u);
        EXPECT_NEAR(volume_of(m), 0.5 + 0.8 / 3, 1e-14);
        EXPECT_EQ(faces_with_one_cell(m), 4u + 4);
    }
}

TEST(Splitting, APyramidBeforeTwoTetrahedraBecomesTwoTetrahedra) {
    const std::vector<Vec3> pyramid{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
    for (const std::uint32_t start : {0u, 1u}) {
        MixedMesh m = cell_before_tetrahedra(CellType::pyramid, pyramid, 0, start, {0.5, 0.5, -0.8});
        const std::vector<OpenQuad> open{{0, 0, start}};
        EXPECT_EQ(split_cells(m, open), 1u);
        EXPECT_EQ(count_by_type(m), (std::map<CellType, int>{{CellType::tetrahedron, 2 + 2}}));
        EXPECT_EQ(m.positions.size(), 6u);
        EXPECT_NEAR(volume_of(m), 1.8 / 3, 1e-14);
        EXPECT_EQ(faces_with_one_cell(m), 8u);
    }
}

}  // namespace
}  // namespace geomend::hexes
