// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/cell_volume.h"
#include "grid/cell_mesh.h"
#include "grid/connections.h"
#include "grid/edge_crossings.h"
#include "grid/face_triangles.h"
#include "support/corner_point_grids.h"

namespace geomend::grid {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Triangles triangles_of(const std::vector<std::uint32_t>& polygon, const std::vector<Vec3>& points) {
    Triangles triangles;
    face_triangles(polygon, points, triangles);
    return triangles;
}

double fan_flux(const std::vector<std::uint32_t>& polygon, const std::vector<Vec3>& points) {
    const auto lowest = static_cast<std::size_t>(std::ranges::min_element(polygon) - polygon.begin());
    const auto p = [&](std::size_t n) { return points[polygon[(lowest + n) % polygon.size()]]; };
    double sum = 0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) sum += flux6(p(0), p(k), p(k + 1));
    return sum;
}

void expect_same_surface(const std::vector<std::uint32_t>& polygon, const std::vector<Vec3>& points) {
    const Triangles triangles = triangles_of(polygon, points);
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
    double sum = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : triangles) {
        const Vec3 n = cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
        EXPECT_GT(dot(n, n), 1e-12) << t[0] << ' ' << t[1] << ' ' << t[2] << " has no area";
        sum += flux6(points[t[0]], points[t[1]], points[t[2]]);
        for (unsigned e = 0; e < 3; ++e) ++edges[{t[e], t[(e + 1) % 3]}];
    }
    EXPECT_NEAR(sum, fan_flux(polygon, points), 1e-9);
    // What is left when inner edges are struck out is the polygon's own border.
    for (std::size_t n = 0; n < polygon.size(); ++n) --edges[{polygon[n], polygon[(n + 1) % polygon.size()]}];
    for (const auto& [edge, times] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        EXPECT_EQ(times, back == edges.end() ? 0 : back->second) << edge.first << ' ' << edge.second;
    }
}

TEST(FaceTriangles, of_a_bent_quadrangle_share_the_diagonal_at_the_lowest_corner) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 3}};
    EXPECT_EQ(triangles_of({0, 1, 2, 3}, points), (Triangles{{0, 1, 2}, {2, 3, 0}}));
    EXPECT_EQ(triangles_of({2, 3, 0, 1}, points), (Triangles{{0, 1, 2}, {2, 3, 0}}));
    const std::vector<Vec3> turned{{1, 0, 1}, {1, 1, 0}, {0, 1, 3}, {0, 0, 0}};
    EXPECT_EQ(triangles_of({3, 0, 1, 2}, turned), (Triangles{{0, 1, 2}, {2, 3, 0}}));
}

TEST(FaceTriangles, have_area_and_the_volume_of_the_fan_where_points_lie_on_edges) {
    // Corners of a bent square, with points on each edge; numbers start at every corner in turn.
    const std::vector<Vec3> round{{0, 0, 0}, {0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {8, 3, 1.5}, {8, 4, 2},
                                  {8, 8, 4}, {2, 8, 1}, {0, 8, 0}, {0, 5, 0}, {0, 2, 0}};
    std::vector<Vec3> ring(round.begin() + 1, round.end());
    for (std::size_t start = 0; start < ring.size(); ++start) {
        std::vector<Vec3> points(ring.size());
        std::vector<std::uint32_t> polygon;
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const std::size_t number = (n + ring.size() - start) % ring.size();
            points[number] = ring[n];
            polygon.push_back(static_cast<std::uint32_t>(number));
        }
        expect_same_surface(polygon, points);
    }
}

TEST(FaceTriangles, of_a_triangle_with_points_on_two_edges_have_area) {
    expect_same_surface({0, 1, 2, 3, 4, 5, 6}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 2, 0}, {0, 1, 0}});
    expect_same_surface({0, 1, 2, 3}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 3, 0}});
    expect_same_surface({0, 1, 2, 3}, {{0, 0, 0}, {1, 0, 0}, {0, 3, 0}, {0, 2, 0}});
}

TEST(FaceTriangles, leave_out_what_coincides) {
    EXPECT_EQ(triangles_of({0, 1, 2, 3}, {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 1u);
}

TEST(EdgeCrossings, keep_their_number_until_the_table_is_emptied) {
    CrossingTable table;
    for (int round = 0; round < 2; ++round) {
        for (std::uint32_t n = 0; n < 1000; ++n) EXPECT_EQ(table.number({0.5 * n, 1}, {2, 3}, n), n);
        for (std::uint32_t n = 0; n < 1000; ++n) EXPECT_EQ(table.number({0.5 * n, 1}, {2, 3}, 7777), n);
        EXPECT_EQ(table.number({0.0, 1}, {3, 2}, 5000), 5000u);
        EXPECT_EQ(table.number({-0.0, 1}, {2, 3}, 5000), 0u) << "both zeros are one depth";
        table.clear();
    }
}

// Columns on both sides of faults in I and J whose layers dip against each other, so that edges cross off the pillars.
CornerPointGrid crossing_layers(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz) {
    CornerPointGrid grid = testing::brick_grid(nx, ny, nz);
    for (std::size_t p = 0; p < grid.pillars.size(); p += 6) grid.pillars[p + 3] += 7 * std::sin(double(p));
    testing::reshape(grid, [](std::uint32_t i, std::uint32_t j, auto, unsigned c, double depth) {
        const double x = i + (c & 1u), y = j + ((c >> 1) & 1u);
        return depth + (i % 4 < 2 ? 7 * y : -5 * y) + (j % 6 < 3 ? 3 * x : -4 * x);
    });
    return grid;
}

// Each edge of a cell's faces is run along as often one way as the other.
void expect_closed_cells(const CellMesh& mesh) {
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (std::uint64_t f = mesh.cell_faces[c]; f < mesh.cell_faces[c + 1]; ++f) {
            const std::uint64_t first = mesh.face_offsets[f], last = mesh.face_offsets[f + 1];
            for (std::uint64_t n = first; n < last; ++n) {
                const std::uint32_t a = mesh.face_nodes[n], b = mesh.face_nodes[n + 1 < last ? n + 1 : first];
                edges[std::minmax(a, b)] += a < b ? 1 : -1;
            }
        }
        for (const auto& [edge, times] : edges) ASSERT_EQ(times, 0) << "cell " << c << ", edge " << edge.first << ' ' << edge.second;
    }
}

TEST(Faces, share_a_face_for_every_connection_and_leave_no_cell_open) {
    const CornerPointGrid grid = crossing_layers(9, 20, 7);
    const GridFaces faces = conforming_faces(grid);
    const Connections found = connections(grid);
    std::set<std::pair<std::uint32_t, std::uint32_t>> shared;
    for (std::size_t f = 0; f < faces.faces.size(); ++f) {
        const auto& face = faces.faces[f];
        const bool fresh = face.second == 0xffffffffu || shared.insert(std::minmax(face.first, face.second)).second;
        EXPECT_TRUE(fresh) << "a pair of cells shares one face";
        std::map<std::uint32_t, int> times;
        for (const std::uint32_t n : faces.polygon(f)) {
            ASSERT_LT(n, faces.points.size());
            EXPECT_EQ(++times[n], 1);
        }
    }
    EXPECT_EQ(shared.size(), found.internal);
    EXPECT_GT(found.others.size(), 100u);
    expect_closed_cells(conforming_cells(grid).mesh);
}

// Depths from a few whole numbers: edges meet, coincide and cross in points that they share, layers wedge out and end.
TEST(Faces, of_columns_with_many_coincidences_close) {
    std::uint64_t state = 1;
    const auto below = [&](std::uint32_t n) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::uint32_t>((state >> 33) % n);
    };
    for (int round = 0; round < 400; ++round) {
        SCOPED_TRACE(round);
        CornerPointGrid grid = testing::brick_grid(3, 3, 5);
        const double lean = round % 3 == 0 ? 0 : 0.37 * (round % 3), unit = round % 2 == 0 ? 1.0 : 0.1;
        for (std::size_t p = 0; p < grid.pillars.size(); p += 6) {
            grid.pillars[p + 3] += lean * below(20);
            grid.pillars[p + 4] -= lean * below(20);
        }
        // Each column has its own depths on its pillars, downwards; steps of 0 are frequent, gaps are rare.
        for (std::uint32_t j = 0; j < 3; ++j) {
            for (std::uint32_t i = 0; i < 3; ++i) {
                for (unsigned c = 0; c < 4; ++c) {
                    double depth = 1000 + unit * below(6);
                    for (std::uint32_t k = 0; k < 5; ++k) {
                        depth += below(8) == 0 ? unit : 0;
                        grid.depths[corner_index(grid.dims, i, j, k, c)] = depth;
                        depth += unit * below(4);
                        grid.depths[corner_index(grid.dims, i, j, k, c + 4)] = depth;
                    }
                }
            }
        }
        grid.activity.assign(grid.cell_count(), 1);
        for (int n = 0; n < 5; ++n) grid.activity[below(45)] = 0;
        const GridFaces faces = conforming_faces(grid);
        EXPECT_EQ(faces.unmatched_columns, 0u);
        const auto shared = std::ranges::count_if(faces.faces, [](const auto& f) { return f.second != 0xffffffffu; });
        EXPECT_EQ(static_cast<std::uint64_t>(shared), connections(grid).internal);
        expect_closed_cells(conforming_cells(grid).mesh);
        if (::testing::Test::HasFailure()) return;
    }
}

TEST(Faces, where_cells_of_a_column_overlap_are_shared_if_they_are_alike) {
    CornerPointGrid grid = testing::brick_grid(3, 1, 3);
    testing::reshape(grid, [](auto, auto, std::uint32_t k, unsigned c, double depth) { return k == 1 && c < 4 ? depth - 4 : depth; });
    const GridFaces faces = conforming_faces(grid);
    EXPECT_EQ(faces.unmatched_columns, 0u);
    const auto shared = std::ranges::count_if(faces.faces, [](const auto& f) { return f.second != 0xffffffffu; });
    EXPECT_EQ(shared, 3 * 2 + 3) << "three pairs between columns, twice; the lower pair of each column";
}

}  // namespace
}  // namespace geomend::grid
