// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "base/parallel.h"
#include "geometry/cell_volume.h"
#include "geometry/measures.h"
#include "geometry/predicates.h"

namespace geomend {
namespace {

using std::vector;

CellMesh one_cell(CellType type, vector<Vec3> points) {
    CellMesh mesh;
    mesh.points = std::move(points);
    vector<std::uint32_t> nodes(mesh.points.size());
    for (std::uint32_t i = 0; i < nodes.size(); ++i) nodes[i] = i;
    mesh.add_cell(type, nodes);
    return mesh;
}

CellMesh polyhedron(vector<Vec3> points, const vector<vector<std::uint32_t>>& faces) {
    CellMesh mesh = one_cell(CellType::polyhedron, std::move(points));
    mesh.face_offsets = {0};
    for (const auto& face : faces) {
        mesh.face_nodes.insert(mesh.face_nodes.end(), face.begin(), face.end());
        mesh.face_offsets.push_back(mesh.face_nodes.size());
    }
    mesh.cell_faces = {0, faces.size()};
    return mesh;
}

const vector<Vec3> cube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const vector<vector<std::uint32_t>> cube_faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

vector<Vec3> moved(vector<Vec3> points, const Vec3& by) {
    for (Vec3& p : points) {
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += by[axis];
    }
    return points;
}

/// The trilinear volume the other way: 2x2x2 Gauss points, exact for the determinant of the map.
double gauss_volume(const std::array<Vec3, 8>& p) {
    const double g = 0.5 / std::numbers::sqrt3;
    double sum = 0;
    for (const double u : {0.5 - g, 0.5 + g}) {
        for (const double v : {0.5 - g, 0.5 + g}) {
            for (const double w : {0.5 - g, 0.5 + g}) {
                std::array<Vec3, 3> d{};
                for (std::size_t c = 0; c < 8; ++c) {
                    const bool iu = c == 1 || c == 2 || c == 5 || c == 6, iv = c == 2 || c == 3 || c == 6 || c == 7, iw = c >= 4;
                    const double fu = iu ? u : 1 - u, fv = iv ? v : 1 - v, fw = iw ? w : 1 - w;
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        d[0][axis] += (iu ? 1 : -1) * fv * fw * p[c][axis];
                        d[1][axis] += (iv ? 1 : -1) * fu * fw * p[c][axis];
                        d[2][axis] += (iw ? 1 : -1) * fu * fv * p[c][axis];
                    }
                }
                sum += dot(d[0], cross(d[1], d[2])) / 8;
            }
        }
    }
    return sum;
}

TEST(CellVolume, IsPositiveAndRightInVtkCornerOrder) {
    const vector<Vec3> tet = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_DOUBLE_EQ(cell_volume(one_cell(CellType::tetrahedron, tet), 0), 1.0 / 6);
    EXPECT_DOUBLE_EQ(cell_volume(one_cell(CellType::hexahedron, cube), 0), 1);
    const vector<Vec3> pyramid = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.2, 0.9, 3}};
    EXPECT_DOUBLE_EQ(cell_volume(one_cell(CellType::pyramid, pyramid), 0), 1);
    const vector<Vec3> wedge = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 2}, {0, 1, 2}, {1, 0, 2}};
    EXPECT_DOUBLE_EQ(cell_volume(one_cell(CellType::wedge, wedge), 0), 1);
}

// Of a cell that is flat but for the rounding of its coordinates the sign is that of the exact volume.
TEST(CellVolume, HasTheRightSignHoweverFlatATetrahedronIs) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1, 1);
    std::size_t against = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 a{place(random), place(random), place(random)}, u{place(random), place(random), place(random)},
            v{place(random), place(random), place(random)};
        const Vec3 b = plus(a, u), c = plus(a, v), d = plus(a, plus(times(0.3, u), times(0.6, v)));
        const double volume = tetrahedron_volume(a, b, c, d);
        const int sign = volume > 0 ? 1 : volume < 0 ? -1 : 0;
        EXPECT_EQ(sign, orientation(a, b, c, d));
        const double plain = flux6(minus(b, a), minus(c, a), minus(d, a));
        against += (plain > 0) != (volume > 0) ? 1 : 0;
    }
    EXPECT_GT(against, 0u) << "plain arithmetic has it wrong at times";
}

TEST(CellVolume, OfRegularPrisms) {
    for (const auto& [type, n] : {std::pair{CellType::pentagonal_prism, 5}, {CellType::hexagonal_prism, 6}}) {
        vector<Vec3> points;
        for (int i = 0; i < 2 * n; ++i) {
            const double angle = 2 * std::numbers::pi * (i % n) / n;
            points.push_back({std::cos(angle), std::sin(angle), i < n ? 0.0 : 4.0});
        }
        const double base = 0.5 * n * std::sin(2 * std::numbers::pi / n);
        EXPECT_NEAR(cell_volume(one_cell(type, points), 0), 4 * base, 1e-14) << n;
    }
}

TEST(CellVolume, OfAnInvertedCellIsNegativeButCountsInTheSum) {
    CellMesh mesh = one_cell(CellType::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    mesh.add_cell(CellType::tetrahedron, std::vector<std::uint32_t>{1, 0, 2, 3});
    EXPECT_DOUBLE_EQ(cell_volume(mesh, 1), -1.0 / 6);
    EXPECT_DOUBLE_EQ(volume(mesh), 1.0 / 3);
}

TEST(CellVolume, OfAWarpedHexahedronIsTheTrilinearOne) {
    rc::check("flux through bilinear faces equals 2x2x2 Gauss", [] {
        std::array<Vec3, 8> p{};
        for (std::size_t c = 0; c < 8; ++c) {
            for (std::size_t axis = 0; axis < 3; ++axis) p[c][axis] = cube[c][axis] + *rc::gen::inRange(-400, 400) / 1000.0;
        }
        RC_ASSERT(std::abs(hexahedron_volume(p) - gauss_volume(p)) < 1e-13);
    });
}

TEST(CellVolume, OfATwistedHexahedronIsKnownInClosedForm) {
    // The top is raised at one corner: the height is 1 + uv, whose mean is 5/4.
    vector<Vec3> p = cube;
    p[6][2] = 2;
    EXPECT_DOUBLE_EQ(cell_volume(one_cell(CellType::hexahedron, p), 0), 1.25);
}

TEST(VolumeByTetrahedra, AgreesWhereFacesAreFlatAndDiffersWhereTheyAreWarped) {
    EXPECT_DOUBLE_EQ(volume_by_tetrahedra(one_cell(CellType::hexahedron, cube)), 1);
    // By determinants: 1/6 for (0,1,3,4), 1/3 for (1,2,3,6), 1/6 each for (1,4,5,6) and (3,4,6,7), 1/2 for (1,3,4,6).
    vector<Vec3> p = cube;
    p[6][2] = 2;
    EXPECT_DOUBLE_EQ(volume_by_tetrahedra(one_cell(CellType::hexahedron, p)), 4.0 / 3.0);
}

TEST(CellVolume, AddsUpOverACutThroughWarpedFaces) {
    // A warped hexahedron cut along i = 1/2 into two, and one half of it into two wedges by a bilinear face.
    rc::check("halves of a trilinear map add up", [] {
        std::array<Vec3, 8> p{};
        for (std::size_t c = 0; c < 8; ++c) {
            for (std::size_t axis = 0; axis < 3; ++axis) p[c][axis] = 3 * cube[c][axis] + *rc::gen::inRange(-400, 400) / 1000.0;
        }
        const auto middle = [&](std::size_t a, std::size_t b) {
            return Vec3{(p[a][0] + p[b][0]) / 2, (p[a][1] + p[b][1]) / 2, (p[a][2] + p[b][2]) / 2};
        };
        const Vec3 a = middle(0, 1), b = middle(3, 2), c = middle(4, 5), d = middle(7, 6);
        const double left = hexahedron_volume({p[0], a, b, p[3], p[4], c, d, p[7]});
        const double right = hexahedron_volume({a, p[1], p[2], b, c, p[5], p[6], d});
        RC_ASSERT(std::abs(left + right - hexahedron_volume(p)) < 1e-12);
    });
}

TEST(CellVolume, DoesNotLoseDigitsFarFromTheOrigin) {
    const Vec3 utm = {4.5e5, 6.8e6, -3000};
    vector<Vec3> small = cube;
    for (Vec3& p : small) {
        for (double& x : p) x *= 0.5;
    }
    const auto far = moved(small, utm);
    EXPECT_DOUBLE_EQ(cell_volume(one_cell(CellType::hexahedron, far), 0), 0.125);
    EXPECT_DOUBLE_EQ(cell_volume(polyhedron(far, cube_faces), 0), 0.125);
    EXPECT_DOUBLE_EQ(cell_volume(one_cell(CellType::tetrahedron, {far[0], far[1], far[3], far[4]}), 0), 0.125 / 6);
}

TEST(CellVolume, OfSecondOrderCellsIsThatOfTheirCorners) {
    vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    p.resize(10, Vec3{9, 9, 9});
    EXPECT_DOUBLE_EQ(cell_volume(one_cell(CellType::quadratic_tetrahedron, p), 0), 1.0 / 6);
    p = cube;
    p.resize(27, Vec3{9, 9, 9});
    EXPECT_DOUBLE_EQ(cell_volume(one_cell(CellType::triquadratic_hexahedron, p), 0), 1);
}

TEST(CellVolume, OfFlatCellsIsZero) {
    EXPECT_EQ(cell_volume(one_cell(CellType::quad, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), 0), 0);
    EXPECT_EQ(cell_volume(one_cell(CellType::poly_line, {{0, 0, 0}, {1, 0, 0}}), 0), 0);
}

TEST(PolyhedronVolume, FollowsTheWindingOfItsFirstFace) {
    EXPECT_DOUBLE_EQ(cell_volume(polyhedron(cube, cube_faces), 0), 1);
    auto faces = cube_faces;
    for (auto& face : faces) std::ranges::reverse(face);
    EXPECT_DOUBLE_EQ(cell_volume(polyhedron(cube, faces), 0), -1);
}

TEST(PolyhedronVolume, TurnsFacesThatAreWoundTheOtherWay) {
    for (unsigned mask = 0; mask < 64; ++mask) {
        auto faces = cube_faces;
        for (std::size_t f = 0; f < 6; ++f) {
            if ((mask >> f & 1) != 0) std::ranges::reverse(faces[f]);
        }
        EXPECT_DOUBLE_EQ(cell_volume(polyhedron(cube, faces), 0), (mask & 1) != 0 ? -1 : 1) << mask;
    }
}

TEST(PolyhedronVolume, SplitsWarpedFacesAtTheirLowestCorner) {
    // Top raised by 1 at corner 6. Split at corner 4 the diagonal 4-6 lies on the ridge: 1 + 1/3 in all; the
    // bilinear top has 1 + 1/4.
    auto points = cube;
    points[6][2] = 2;
    EXPECT_DOUBLE_EQ(cell_volume(polyhedron(points, cube_faces), 0), 1 + 1.0 / 3);
}

TEST(PolyhedronVolume, OfAnOpenOrEmptyCellIsFinite) {
    auto faces = cube_faces;
    faces.pop_back();
    EXPECT_TRUE(std::isfinite(cell_volume(polyhedron(cube, faces), 0)));
    EXPECT_EQ(cell_volume(polyhedron(cube, {}), 0), 0);
    EXPECT_EQ(cell_volume(polyhedron(cube, {{}, {1, 2}}), 0), 0);
}

TEST(VolumeOfAMesh, IsTheSameForAnyNumberOfThreads) {
    CellMesh mesh;
    std::uint64_t state = 1;
    const auto random = [&state] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state >> 11) * 0x1p-53;
    };
    for (std::uint32_t cell = 0; cell < 50000; ++cell) {
        for (int i = 0; i < 4; ++i) mesh.points.push_back({random(), random(), random()});
        mesh.add_cell(CellType::tetrahedron, std::array<std::uint32_t, 4>{4 * cell, 4 * cell + 1, 4 * cell + 2, 4 * cell + 3});
    }
    const auto with_threads = [&](std::size_t threads) {
        const ThreadBudget budget(threads);
        return volume(mesh);
    };
    const double one = with_threads(1);
    EXPECT_GT(one, 0);
    for (int repeat = 0; repeat < 5; ++repeat) {
        EXPECT_EQ(one, with_threads(2));
        EXPECT_EQ(one, with_threads(4));
    }
}

}  // namespace
}  // namespace geomend
