// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/curved_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace geomend {
namespace {

using Places = std::vector<Vec3>;
using Map = std::function<Vec3(const Vec3&)>;

/// Nodes between others: the middle of those named.
void add_middles(Places& p, const std::vector<std::vector<std::size_t>>& of) {
    for (const auto& some : of) {
        Vec3 sum{};
        for (const std::size_t k : some) {
            for (std::size_t m = 0; m < 3; ++m) sum[m] += p[k][m] / static_cast<double>(some.size());
        }
        p.push_back(sum);
    }
}

Places tetrahedron() {
    Places p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    add_middles(p, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}});
    return p;
}
Places hexahedron(bool with_middles) {
    Places p{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    add_middles(p, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}});
    if (with_middles)
        add_middles(p, {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}});
    return p;
}
Places wedge(bool with_middles) {
    Places p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    add_middles(p, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}});
    if (with_middles) add_middles(p, {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}});
    return p;
}
Places pyramid() {
    Places p{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
    add_middles(p, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}});
    return p;
}

/// The volume of a cell whose nodes are mapped, turned, and moved onto a map.
double volume_of(CellType type, const Places& places, const Map& map) {
    CellMesh mesh;
    std::vector<std::uint32_t> nodes;
    for (const Vec3& p : places) {
        const Vec3 q = map(p);
        nodes.push_back(static_cast<std::uint32_t>(mesh.points.size()));
        mesh.points.push_back({0.6 * q[0] - 0.8 * q[1] + 4096, 0.8 * q[0] + 0.6 * q[1] - 512, q[2] + 64});
    }
    mesh.add_cell(type, nodes);
    return unsigned_volume(mesh, 0);
}

Vec3 as_it_is(const Vec3& p) { return p; }
/// Its determinant is 1 + 0.6 x.
Vec3 along_itself(const Vec3& p) { return {p[0] + 0.3 * p[0] * p[0], p[1], p[2]}; }
/// Its determinant is 1 + 2 y (1 - y).
Vec3 bulged(const Vec3& p) { return {p[0] * (1 + 2 * p[1] * (1 - p[1])), p[1], p[2]}; }
/// Its determinant is 1 + 2 x (1 - x).
Vec3 raised(const Vec3& p) { return {p[0], p[1], p[2] * (1 + 2 * p[0] * (1 - p[0]))}; }

constexpr double near = 1e-9;

TEST(CurvedVolume, StraightCellsHaveTheVolumeOfTheirCorners) {
    EXPECT_NEAR(volume_of(CellType::quadratic_tetrahedron, tetrahedron(), as_it_is), 1.0 / 6, near);
    EXPECT_NEAR(volume_of(CellType::quadratic_hexahedron, hexahedron(false), as_it_is), 1, near);
    EXPECT_NEAR(volume_of(CellType::triquadratic_hexahedron, hexahedron(true), as_it_is), 1, near);
    EXPECT_NEAR(volume_of(CellType::quadratic_wedge, wedge(false), as_it_is), 0.5, near);
    EXPECT_NEAR(volume_of(CellType::biquadratic_wedge, wedge(true), as_it_is), 0.5, near);
    EXPECT_NEAR(volume_of(CellType::quadratic_pyramid, pyramid(), as_it_is), 1.0 / 3, near);
}

TEST(CurvedVolume, CurvedCellsHaveTheIntegralOfTheirMap) {
    EXPECT_NEAR(volume_of(CellType::quadratic_tetrahedron, tetrahedron(), along_itself), 1.0 / 6 + 0.6 / 24, near);
    for (const bool middles : {false, true}) {
        const CellType hexa = middles ? CellType::triquadratic_hexahedron : CellType::quadratic_hexahedron;
        const CellType prism = middles ? CellType::biquadratic_wedge : CellType::quadratic_wedge;
        EXPECT_NEAR(volume_of(hexa, hexahedron(middles), bulged), 1 + 2.0 / 6, near);
        EXPECT_NEAR(volume_of(hexa, hexahedron(middles), raised), 1 + 2.0 / 6, near);
        EXPECT_NEAR(volume_of(prism, wedge(middles), raised), 0.5 + 2 * (1.0 / 6 - 1.0 / 12), near);
    }
}

/// A side of a cell of 27 nodes whose middle stands out by h has 4/9 of that beyond it: the mean of (1 - u^2) (1 - v^2).
TEST(CurvedVolume, MiddlesOfFacesCount) {
    for (std::size_t face = 20; face < 26; ++face) {
        Places p = hexahedron(true);
        for (double& x : p[face]) x += 0.5 * (x - 0.5);  // from 0.5 to 0.75 away from the centre
        EXPECT_NEAR(volume_of(CellType::triquadratic_hexahedron, p, as_it_is), 1 + 0.25 * 4 / 9, near) << face;
    }
}

TEST(CurvedVolume, LinearCellsAreAsTheyWere) {
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    mesh.add_cell(CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
    EXPECT_DOUBLE_EQ(unsigned_volume(mesh, 0), 1.0 / 6);
}

}  // namespace
}  // namespace geomend
