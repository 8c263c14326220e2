// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/improve.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <random>

#include "geometry/predicates.h"
#include "volume/cell_quality.h"

namespace geomend::volumes {
namespace {

constexpr int n = 4;  // cubes along each side

/// A block of n x n x n cubes of six tetrahedra each, a sheet of n / 2 by n triangles inside of it; vertices inside are moved.
struct Block {
    RegionFacets facets;
    RegionCells cells;
};

bool is_on_border(const std::array<int, 3>& at) {
    return std::ranges::any_of(at, [](int x) { return x == 0 || x == n; });
}
bool is_on_sheet(const std::array<int, 3>& at) { return at[2] == n / 2 && at[0] <= n / 2; }

template <class Moved>
Block block(const Moved& moved) {
    Block b;
    std::map<std::array<int, 3>, std::uint32_t> number;
    std::vector<std::array<int, 3>> all;
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) all.push_back({i, j, k});
    std::ranges::stable_partition(all, [](const auto& at) { return is_on_border(at) || is_on_sheet(at); });
    for (const auto& at : all) {
        const auto v = static_cast<std::uint32_t>(number.size());
        number[at] = v;
        const Vec3 p{double(at[0]), double(at[1]), double(at[2])};
        if (is_on_border(at) || is_on_sheet(at)) b.facets.positions.push_back(p);
        else b.cells.new_vertices.push_back(moved(p));
    }
    b.facets.vertices.resize(b.facets.positions.size());
    std::iota(b.facets.vertices.begin(), b.facets.vertices.end(), 0u);
    const auto position = [&](std::uint32_t v) {
        return v < b.facets.positions.size() ? b.facets.positions[v] : b.cells.new_vertices[v - b.facets.positions.size()];
    };
    std::map<Triangle, Triangle> open;  // faces of one cell, by their sorted corners, wound outwards
    const auto add_cell = [&](std::array<std::uint32_t, 4> c) {
        if (orientation(position(c[0]), position(c[1]), position(c[2]), position(c[3])) < 0) std::swap(c[2], c[3]);
        b.cells.cells.push_back(c);
        for (const Triangle& f : {Triangle{c[1], c[2], c[3]}, {c[0], c[3], c[2]}, {c[0], c[1], c[3]}, {c[0], c[2], c[1]}}) {
            Triangle key = f;
            std::ranges::sort(key);
            if (open.erase(key) == 0) open[key] = f;
        }
    };
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                std::array<std::size_t, 3> axes{0, 1, 2};
                do {
                    std::array<int, 3> at{i, j, k};
                    std::array<std::uint32_t, 4> c{number[at]};
                    for (std::size_t s = 0; s < 3; ++s) {
                        ++at[axes[s]];
                        c[s + 1] = number[at];
                    }
                    add_cell(c);
                } while (std::ranges::next_permutation(axes).found);
            }
    for (const auto& [key, face] : open) {
        b.facets.triangles.push_back(face);
        b.facets.sides.push_back(behind);
    }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n / 2; ++i) {
            const int k = n / 2;
            b.facets.triangles.push_back({number[{i, j, k}], number[{i + 1, j, k}], number[{i + 1, j + 1, k}]});
            b.facets.triangles.push_back({number[{i, j, k}], number[{i + 1, j + 1, k}], number[{i, j + 1, k}]});
            b.facets.sides.insert(b.facets.sides.end(), {on_both, on_both});
        }
    b.facets.surfaces.assign(b.facets.triangles.size(), 0);
    b.facets.volume = n * n * n;
    b.facets.region = 0;
    measure(b.facets, b.cells);
    return b;
}

double worst_sine(const Block& b) {
    const auto position = [&](std::uint32_t v) {
        return v < b.facets.positions.size() ? b.facets.positions[v] : b.cells.new_vertices[v - b.facets.positions.size()];
    };
    double worst = 2;
    for (const auto& c : b.cells.cells)
        worst = std::min(worst, least_sine({position(c[0]), position(c[1]), position(c[2]), position(c[3])}));
    return worst;
}

TEST(CellQuality, OfTheRegularAndOfAFlatTetrahedron) {
    const std::array<Vec3, 4> regular{Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}};
    EXPECT_NEAR(least_sine(regular), std::sqrt(8) / 3, 1e-15);
    EXPECT_NEAR(dihedral_cosines(regular).of_least, 1.0 / 3, 1e-15);
    EXPECT_NEAR(shape(regular), 1, 1e-15);
    const std::array<Vec3, 4> flat{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}};
    EXPECT_NEAR(least_sine(flat), 0, 1e-15);
    EXPECT_NEAR(shape(flat), 0, 1e-15);
    const std::array<Vec3, 4> corner{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    const double inner = 1 / (3 + std::sqrt(3)), outer = std::sqrt(3) / 2;
    EXPECT_NEAR(shape(corner), 3 * inner / outer, 1e-15);
}

TEST(Improve, AFlatCellInsideGoes) {
    Block b = block([](Vec3 p) { return p == Vec3{3, 1, 1} ? Vec3{3, 1.98, 1.98} : p; });
    ASSERT_TRUE(cells_of_region(b.facets, {b.cells.new_vertices, b.cells.cells}));
    const double before = worst_sine(b);
    EXPECT_LT(before, 0.05);
    const Improvement done = improve(b.facets, b.cells, nullptr);
    EXPECT_GT(done.bad_before, 0u);
    EXPECT_EQ(done.bad_after, 0u);
    EXPECT_GT(worst_sine(b), std::sin(0.1745));
    const auto proven = cells_of_region(b.facets, {b.cells.new_vertices, b.cells.cells});
    EXPECT_TRUE(proven) << proven.why().error.message;
}

TEST(Improve, GoodCellsStayAsTheyAre) {
    Block b = block([](Vec3 p) { return p; });
    const auto before = b.cells.cells;
    const Improvement done = improve(b.facets, b.cells, nullptr);
    EXPECT_EQ(done.flips + done.moves, 0u);
    EXPECT_EQ(b.cells.cells, before);
}

RC_GTEST_PROP(Improve, CellsFillTheSameRegionAroundTheSameFacetsAndTheWorstGetsNoWorse, (unsigned seed)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-0.45, 0.45);
    Block b = block([&](Vec3 p) { return Vec3{p[0] + part(random), p[1] + part(random), p[2] + part(random)}; });
    RC_PRE(cells_of_region(b.facets, {b.cells.new_vertices, b.cells.cells}).ok());
    const double before = worst_sine(b);
    Block again = b;
    const Improvement done = improve(b.facets, b.cells, nullptr);
    RC_ASSERT(worst_sine(b) >= before);
    RC_ASSERT(done.bad_after <= done.bad_before);
    const auto proven = cells_of_region(b.facets, {b.cells.new_vertices, b.cells.cells});
    if (!proven) RC_FAIL(proven.why().error.message);
    RC_ASSERT(proven->cells.size() == b.cells.cells.size());
    improve(again.facets, again.cells, nullptr);
    RC_ASSERT(again.cells.cells == b.cells.cells);
    RC_ASSERT(again.cells.new_vertices == b.cells.new_vertices);
}

RC_GTEST_PROP(Improve, NewVerticesKeepTheRegionItsFacetsAndGivenEdges, (unsigned seed)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-0.45, 0.45);
    Block b = block([&](Vec3 p) { return Vec3{p[0] + part(random), p[1] + part(random), p[2] + part(random)}; });
    RC_PRE(cells_of_region(b.facets, {b.cells.new_vertices, b.cells.cells}).ok());
    for (int k = 0; k < 4; ++k) {  // edges of cells that are to stay, which cells_of_region() looks for
        const auto& cell = b.cells.cells[random() % b.cells.cells.size()];
        const auto known = static_cast<std::uint32_t>(b.facets.positions.size());
        if (cell[0] < known && cell[1] < known) b.facets.edges.push_back({cell[0], cell[1]});
    }
    const double before = worst_sine(b);
    const Improvement done = improve(b.facets, b.cells, nullptr, {}, true);
    RC_ASSERT(worst_sine(b) >= before);
    RC_ASSERT(done.bad_after <= done.bad_before);
    const auto proven = cells_of_region(b.facets, {b.cells.new_vertices, b.cells.cells});
    if (!proven) RC_FAIL(proven.why().error.message);
    RC_ASSERT(proven->cells.size() == b.cells.cells.size());
    RC_ASSERT(proven->new_vertices.size() == b.cells.new_vertices.size());
    RC_ASSERT(lie_apart(b.cells.cells));
}

/// A cube whose top has an edge of so much in its middle, so that two of its triangles are needles; all cells meet in its centre.
Block cube_with_needles(double edge) {
    Block b;
    b.facets.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    b.facets.positions.push_back({0.5 - edge / 2, 0.5, 1});
    b.facets.positions.push_back({0.5 + edge / 2, 0.5, 1});
    b.facets.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6},
                          {3, 0, 4}, {3, 4, 7}, {4, 5, 8}, {5, 9, 8}, {5, 6, 9}, {6, 7, 9}, {7, 8, 9}, {7, 4, 8}};
    b.facets.vertices.resize(b.facets.positions.size());
    std::iota(b.facets.vertices.begin(), b.facets.vertices.end(), 0u);
    b.facets.sides.assign(b.facets.triangles.size(), behind);
    b.facets.surfaces.assign(b.facets.triangles.size(), 0);
    b.facets.volume = 1;
    b.cells.new_vertices = {{0.5, 0.5, 0.5}};
    for (const Triangle& t : b.facets.triangles) b.cells.cells.push_back({10, t[0], t[1], t[2]});
    for (auto& c : b.cells.cells) {
        const auto at = [&](std::size_t k) { return c[k] < 10 ? b.facets.positions[c[k]] : b.cells.new_vertices[0]; };
        if (orientation(at(0), at(1), at(2), at(3)) < 0) std::swap(c[2], c[3]);
    }
    return b;
}

TEST(Improve, NeedlesOfASurfaceGetCellsThatAreNotFlat) {
    for (const double edge : {0.1, 0.03, 0.01, 0.003}) {
        Block b = cube_with_needles(edge);
        ASSERT_TRUE(cells_of_region(b.facets, {b.cells.new_vertices, b.cells.cells}));
        improve(b.facets, b.cells, nullptr, {}, true);
        const auto proven = cells_of_region(b.facets, {b.cells.new_vertices, b.cells.cells});
        ASSERT_TRUE(proven) << proven.why().error.message;
        EXPECT_GT(proven->least_dihedral, 5) << edge;
    }
}

// The top of a pyramid is even but for rounding, and a cell lies in it across the other diagonal.
TEST(Improve, ACellThatLiesFlatOnTwoFacetsGoes) {
    RegionFacets facets;
    facets.vertices = {0, 1, 2, 3, 4};
    facets.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, -1e-13}, {0.5, 0.5, -1}};
    facets.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}};
    facets.sides.assign(6, behind);
    facets.surfaces.assign(6, 0);
    RegionCells region;
    region.cells = {{0, 1, 2, 3}, {0, 1, 3, 4}, {1, 2, 3, 4}};
    for (auto& c : region.cells) {
        const auto at = [&](std::size_t k) { return facets.positions[c[k]]; };
        if (orientation(at(0), at(1), at(2), at(3)) < 0) std::swap(c[2], c[3]);
    }
    const Improvement done = remove_flat_cells(facets, region);
    EXPECT_EQ(done.flips, 1u);
    ASSERT_EQ(region.cells.size(), 2u);
    for (const auto& c : region.cells) {
        for (const std::uint32_t v : {0u, 2u, 4u}) EXPECT_NE(std::ranges::find(c, v), c.end()) << "the diagonal of the facets";
    }
    EXPECT_EQ(remove_flat_cells(facets, region).flips, 0u);
}

/// A cell that lies flat on two facets, between vertices 0 to 3, with two more vertices above the edge from 0 to 1 and three cells around
/// it. The two are free to move where they are new.
struct OnAWall {
    RegionFacets facets;
    RegionCells region;

    OnAWall(const std::array<Vec3, 6>& places, bool are_new) {
        const auto known = are_new ? places.begin() + 4 : places.end();
        facets.positions.assign(places.begin(), known);
        region.new_vertices.assign(known, places.end());
        for (std::uint32_t v = 0; v < facets.positions.size(); ++v) facets.vertices.push_back(v);
        facets.triangles = {{0, 2, 3}, {1, 3, 2}};
        facets.sides.assign(2, in_front);
        facets.surfaces.assign(2, 0);
        region.cells = {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 5, 2}};
    }
    Vec3 at(std::uint32_t v) const {
        return v < facets.positions.size() ? facets.positions[v] : region.new_vertices[v - facets.positions.size()];
    }
    /// Nothing where a cell is flat or turned over.
    std::optional<double> volume() const {
        double six = 0;
        for (const auto& c : region.cells) {
            if (orientation(at(c[0]), at(c[1]), at(c[2]), at(c[3])) <= 0) return std::nullopt;
            six += six_volumes(at(c[0]), at(c[1]), at(c[2]), at(c[3]));
        }
        return six / 6;
    }
    bool has_edge(std::uint32_t a, std::uint32_t b) const {
        return std::ranges::any_of(region.cells,
                                   [&](const auto& c) { return std::ranges::find(c, a) != c.end() && std::ranges::find(c, b) != c.end(); });
    }
};

// In a cube what takes the place of the flat cell has four corners in a plane, too: inside, where they may move.
TEST(Improve, WhatTakesThePlaceOfAFlatCellIsNotTurnedOver) {
    for (const double off : {0.0, 1e-9, -1e-9}) {
        OnAWall wall({{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 1 + off}, {1, 1, 1}}}, true);
        EXPECT_FALSE(wall.volume());
        const Improvement done = remove_flat_cells(wall.facets, wall.region);
        EXPECT_EQ(done.flips, 1u);
        EXPECT_FALSE(wall.has_edge(0, 1));
        EXPECT_EQ(wall.region.cells.size(), 4u);
        ASSERT_TRUE(wall.volume()) << off;
        EXPECT_NEAR(*wall.volume(), 0.5, 1e-5);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(wall.region.new_vertices[0][k], (std::array{0.0, 1.0, 1.0})[k], 1e-5);
    }
}

TEST(Improve, AFlatCellThatNothingElseRemovesGetsAVertexBesideIt) {
    OnAWall wall({{{0, 0, 0}, {2, 0, 0}, {1, -1, 0}, {1, 1, 0}, {3, 0.5, 0.5}, {-1, -0.5, 0.5}}}, false);
    const Improvement as_it_is = remove_flat_cells(wall.facets, wall.region);
    EXPECT_EQ(as_it_is.flips + as_it_is.vertices, 0u);
    EXPECT_FALSE(wall.volume());
    double before = 0;
    for (const auto& c : wall.region.cells) before += six_volumes(wall.at(c[0]), wall.at(c[1]), wall.at(c[2]), wall.at(c[3])) / 6;
    const Improvement done = remove_flat_cells(wall.facets, wall.region, 1);
    EXPECT_EQ(done.vertices, 1u);
    EXPECT_EQ(wall.region.new_vertices.size(), 1u);
    EXPECT_EQ(wall.region.cells.size(), 8u);
    ASSERT_TRUE(wall.volume());
    EXPECT_NEAR(*wall.volume(), before, 1e-14);
}

}  // namespace
}  // namespace geomend::volumes
