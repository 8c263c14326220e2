// SPDX-License-Identifier: AGPL-3.0-or-later
#include "editing/trace.h"

#include <random>

#include "../arrangement/cut_soups.h"

namespace geomend::test {
namespace {

using editing::EditedSoup;
using editing::ErasedTrace;

/// A soup after it was cut by its last patches, and these were taken out again: what is left is a scar.
struct Scarred {
    TriangleSoup before;  ///< the patches that stay, as they were
    TriangleSoup soup;
    std::vector<std::uint32_t> trace;  ///< vertices that the patches that are gone have in common with those that stay
};

TriangleSoup without_patches(const TriangleSoup& soup, std::uint32_t first_gone) {
    TriangleSoup kept;
    kept.vertices = soup.vertices;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        if (soup.patches[t] >= first_gone) continue;
        kept.triangles.push_back(soup.triangles[t]);
        kept.patches.push_back(soup.patches[t]);
    }
    return kept;
}

Scarred scarred(const TriangleSoup& soup, std::uint32_t first_gone, double tolerance = 1e-7) {
    const auto cut = expect_arranged(soup, tolerance);
    Scarred made{without_patches(soup, first_gone), without_patches(cut.soup, first_gone), {}};
    std::set<std::uint32_t> gone, stays;
    for (std::size_t t = 0; t < cut.soup.triangles.size(); ++t) {
        for (const std::uint32_t v : cut.soup.triangles[t]) (cut.soup.patches[t] >= first_gone ? gone : stays).insert(v);
    }
    std::ranges::set_intersection(gone, stays, std::back_inserter(made.trace));
    return made;
}

EditedSoup erased(const Scarred& scar, ErasedTrace& sum, double tolerance = 1e-7) {
    editing::SoupMesh mesh(scar.soup);
    sum = editing::erase_trace(mesh, scar.trace, {{tolerance, tolerance}, true, false, {}});
    return std::move(mesh).take();
}

/// Triangles by their corners' places, in no order: what must come back.
std::multiset<std::array<Vec3, 3>> places(const TriangleSoup& soup) {
    std::multiset<std::array<Vec3, 3>> all;
    for (const Triangle& t : soup.triangles) {
        std::array<Vec3, 3> p{soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]};
        std::ranges::rotate(p, std::ranges::min_element(p));
        all.insert(p);
    }
    return all;
}

// N. Euler's acceptance test 8: the two squares of test 7, of which the second is gone.
TEST(Trace, TwoInnerNodesOfACutSquareGoAndItsBorderKeepsItsExtremities) {
    TriangleSoup soup;
    add_patch(soup, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
    add_patch(soup, {{0.3, -1, -1}, {0.3, 1, -1}, {0.3, 1, 1}, {0.3, -1, 1}}, {{0, 1, 2}, {0, 2, 3}});
    ErasedTrace sum;
    const auto left = erased(scarred(soup, 1), sum);
    EXPECT_EQ(left.soup.vertices.size(), 6u);
    EXPECT_EQ(left.soup.triangles.size(), 4u);
    EXPECT_EQ(sum.erased, 2u);
    EXPECT_EQ(sum.border, 2u);
    EXPECT_NEAR(area_of(left.soup), 4, 1e-12);
}

// Test 9, and more: the mesh is again the one before the cut, to the bit.
TEST(Trace, ASlitThatEndsInsideLeavesTheMeshAsItWasBeforeTheCut) {
    TriangleSoup soup;
    add_patch(soup, {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}, {{0, 1, 2}, {0, 2, 3}});
    add_patch(soup, {{0.3, -1, -1}, {0.3, 1, -1}, {0.3, 1, 1}, {0.3, -1, 1}}, {{0, 1, 2}, {0, 2, 3}});
    ErasedTrace sum;
    const Scarred scar = scarred(soup, 1);
    const auto left = erased(scar, sum);
    EXPECT_EQ(left.soup.vertices.size(), 4u);
    EXPECT_EQ(places(left.soup), places(scar.before));
}

TEST(Trace, SheetsThatWereCutComeBackToTheBit) {
    std::mt19937 engine(7);
    const auto dice = [&] { return static_cast<double>(engine()) / 4294967296.0; };
    for (int seed = 0; seed < 40; ++seed) {
        TriangleSoup soup;
        std::vector<double> heights(64);
        for (double& h : heights) h = 0.1 * dice();
        add_sheet(soup, 7, 7, [&](double u, double v) {
            const auto i = static_cast<std::size_t>(std::lround(7 * u) + 8 * std::lround(7 * v));
            return Vec3{u, v, heights[i]};
        });
        const double x = 0.2 + 0.1 * dice(), slope = 0.6 * dice(), lean = dice() - 0.5;
        add_sheet(soup, 3, 3, [&](double u, double v) {
            const double w = 0.1 + 0.8 * u, z = 2 * v - 1;
            return Vec3{x + slope * w + lean * z, w, z};
        });
        ErasedTrace sum;
        const Scarred scar = scarred(soup, 1);
        const auto left = erased(scar, sum);
        EXPECT_EQ(places(left.soup), places(scar.before)) << seed;
        EXPECT_EQ(sum.not_flat, 0u) << seed;
        EXPECT_TRUE(check(left.origin, scar.soup, left.soup).ok());
    }
}

// Test 10: two scars that cross, of which one is taken away: the vertex at the crossing is on the border of what stays parted.
TEST(Trace, WhereAnotherScarStaysTheCrossingSurvives) {
    TriangleSoup soup;
    add_patch(soup, {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}, {{0, 1, 2}, {0, 2, 3}});
    add_patch(soup, {{0.5, -1, -1}, {0.5, 1, -1}, {0.5, 1, 1}, {0.5, -1, 1}}, {{0, 1, 2}, {0, 2, 3}});
    add_patch(soup, {{-4, 0.25, -1}, {4, 0.25, -1}, {4, 0.25, 1}, {-4, 0.25, 1}}, {{0, 1, 2}, {0, 2, 3}});
    Scarred scar = scarred(soup, 1);
    std::erase_if(scar.trace, [&](std::uint32_t v) { return scar.soup.vertices[v][0] != 0.5; });
    ASSERT_GE(scar.trace.size(), 3u);
    const std::vector<std::uint32_t> one_surface{0, 0};
    for (std::size_t t = 0; t < scar.soup.triangles.size(); ++t) {
        double y = 0;
        for (const std::uint32_t v : scar.soup.triangles[t]) y += scar.soup.vertices[v][1] / 3;
        scar.soup.patches[t] = y > 0.25 ? 1 : 0;  // the lips of the scar that stays
    }
    editing::SoupMesh mesh(scar.soup);
    const auto sum = editing::erase_trace(mesh, scar.trace, {{1e-7, 1e-7}, true, false, one_surface});
    EXPECT_EQ(sum.border, 1u);
    EXPECT_EQ(sum.erased + 1, scar.trace.size());
    const auto left = std::move(mesh).take();
    EXPECT_EQ(std::ranges::count(left.soup.vertices, Vec3{0.5, 0.25, 0}), 1);
}

TEST(Trace, ALineOfSeveralSurfacesIsMendedInAllOfThem) {
    // A floor and a wall on it, both with a vertex too many on their common line, and one inside.
    TriangleSoup soup;
    soup.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, -1, 0}, {2, -1, 0}, {0, 1, 0}, {2, 1, 0}, {0, 0, 1}, {2, 0, 1}};
    soup.triangles = {{0, 3, 1}, {3, 4, 1}, {4, 2, 1}, {1, 2, 6}, {1, 6, 5}, {1, 5, 0}, {0, 1, 7}, {1, 8, 7}, {1, 2, 8}};
    soup.patches = {0, 0, 0, 1, 1, 1, 2, 2, 2};
    const std::vector<std::uint32_t> surfaces{0, 0, 1};
    editing::SoupMesh mesh(soup);
    const std::vector<std::uint32_t> trace{1};
    EXPECT_EQ(editing::erase_trace(mesh, trace, {{1e-9, 1e-9}, true, false, surfaces}).erased, 1u);
    const auto left = std::move(mesh).take();
    EXPECT_EQ(left.soup.triangles.size(), 6u);
    EXPECT_NEAR(area_of(left.soup), 6, 1e-12);
    std::map<std::array<std::uint32_t, 2>, int> uses;
    for (const Triangle& t : left.soup.triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++uses[{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}];
    }
    EXPECT_EQ((uses[{0, 1}]), 3) << "all of them end at one edge of the line";
}

TEST(Trace, ALineThatBendsKeepsItsVertex) {
    TriangleSoup soup;
    soup.vertices = {{0, 0, 0}, {1, 0.1, 0}, {2, 0, 0}, {1, -1, 0}, {1, 1, 0}};
    soup.triangles = {{0, 3, 1}, {3, 2, 1}, {1, 2, 4}, {0, 1, 4}};
    soup.patches = {0, 0, 1, 1};
    editing::SoupMesh mesh(soup);
    const std::vector<std::uint32_t> trace{1};
    const auto sum = editing::erase_trace(mesh, trace, {{1e-9, 1e-9}, true, false, {}});
    EXPECT_EQ(sum.needed, 1u);
    EXPECT_EQ(std::move(mesh).take().soup.triangles, soup.triangles);
}

// Test 13: what a cut through edges only leaves at the vertices of its line, and that the order of erasing makes use of it.
TEST(Trace, AlongACutThroughEdgesNoTwoNeighboursHaveFourOrSixTriangles) {
    TriangleSoup soup;
    add_sheet(soup, 20, 20, [](double u, double v) {
        return Vec3{u + 0.013 * std::sin(7 * v), v + 0.011 * std::sin(5 * u), 0.002 * std::sin(9 * u + 4 * v)};
    });
    add_sheet(soup, 1, 1, [](double u, double v) { return Vec3{0.1237 + 0.7 * u, 0.0713 + 0.83 * u, 2 * v - 0.02}; });
    const Scarred scar = scarred(soup, 1);
    std::map<double, std::size_t> around;  // along the line
    editing::SoupMesh mesh(scar.soup);
    for (const std::uint32_t v : scar.trace) around[scar.soup.vertices[v][0]] = mesh.around(v).size();
    ASSERT_GT(around.size(), 30u);
    std::vector<std::size_t> inside;
    for (const auto& [x, n] : around) inside.push_back(n);
    inside = {inside.begin() + 2, inside.end() - 2};  // the ends of the line lie inside of triangles
    for (std::size_t i = 0; i < inside.size(); ++i) {
        EXPECT_GE(inside[i], 4u);
        EXPECT_LE(inside[i], 6u);
        EXPECT_TRUE(i == 0 || inside[i] == 5 || inside[i] != inside[i - 1]) << i;
    }
    const auto sum = editing::erase_trace(mesh, scar.trace, {{1e-7, 1e-7}, true, false, {}});
    EXPECT_EQ(sum.erased, scar.trace.size());
    EXPECT_GT(static_cast<double>(sum.small_rings), 0.7 * static_cast<double>(sum.erased));
    EXPECT_EQ(places(std::move(mesh).take().soup), places(scar.before));
}

/// A line of vertices on the x axis from -1 to n, and triangles above and below it: as many at each of those from 0 to n - 1 as
/// said. What lies beside the line is so many times as far away as these are from each other.
TriangleSoup chain(const std::vector<std::size_t>& around, double away) {
    TriangleSoup soup;
    const auto n = static_cast<std::uint32_t>(around.size());
    for (std::uint32_t i = 0; i < n + 2; ++i) soup.vertices.push_back({static_cast<double>(i) - 1, 0, 0});
    for (const double side : {1.0, -1.0}) {
        bool more_here = side > 0;  // five triangles: three above and two below, then the other way round
        double x = -0.5;
        const auto add_apex = [&] { soup.vertices.push_back({x, side * away, 0}); };
        const auto add = [&](std::uint32_t a, std::uint32_t b) {
            const auto apex = static_cast<std::uint32_t>(soup.vertices.size() - 1);
            soup.triangles.push_back(side > 0 ? Triangle{a, b, apex} : Triangle{b, a, apex});
            soup.patches.push_back(0);
        };
        add_apex();
        add(0, 1);
        for (std::uint32_t i = 0; i < n; ++i) {
            const bool odd = around[i] % 2 == 1;
            const std::size_t here = around[i] / 2 + (odd && more_here ? 1 : 0);
            if (odd) more_here = !more_here;
            for (std::size_t k = 2; k < here; ++k) {
                x = i + 0.5;
                add_apex();
                add(static_cast<std::uint32_t>(soup.vertices.size() - 2), i + 1);
            }
            add(i + 1, i + 2);
        }
    }
    return soup;
}

/// How many triangles are around those vertices of a chain that are still there.
std::vector<std::size_t> around_those_left(const editing::SoupMesh& mesh, std::size_t n) {
    std::vector<std::size_t> left;
    for (std::uint32_t v = 1; v <= n; ++v) {
        if (!mesh.around(v).empty()) left.push_back(mesh.around(v).size());
    }
    return left;
}

/// Takes away all that have four triangles around them, until there are none: how often.
unsigned rounds_of_small_rings(editing::SoupMesh& mesh, std::size_t n) {
    std::vector<std::uint8_t> on_trace(mesh.soup().vertices.size(), 0);
    for (std::size_t v = 1; v <= n; ++v) on_trace[v] = 1;
    for (unsigned rounds = 0;; ++rounds) {
        std::vector<std::uint32_t> small;
        for (std::uint32_t v = 1; v <= n; ++v) {
            if (mesh.around(v).size() == 4) small.push_back(v);
        }
        if (small.empty()) return rounds;
        for (const std::uint32_t v : small) {
            EXPECT_EQ(editing::erase_vertex(mesh, v, {{1e-9, 1e-9}, true, false, {}}, on_trace), editing::Erasure::erased);
            on_trace[v] = 0;
        }
    }
}

// Test 12, as it is printed: each vertex with four triangles takes one from its neighbours on the trace, so that the edge between the two
// beside the trace comes back, however much longer it is than the one along it.
TEST(Trace, ChainsEmptyOrStickAsEulerSays) {
    struct Case {
        std::vector<std::size_t> around;
        unsigned rounds;
        std::vector<std::size_t> left;
    };
    const std::vector<Case> cases{{{4, 5, 5, 6, 4, 6, 4}, 4, {}},
                                  {{5, 5, 5, 5}, 0, {5, 5, 5, 5}},
                                  {{4, 6, 5, 6, 4}, 1, {5, 5, 5}},
                                  {{5, 5, 5, 6, 4}, 1, {5, 5, 5, 5}}};
    for (const double away : {0.2, 1.0, 3.0, 30.0}) {
        for (const Case& c : cases) {
            editing::SoupMesh mesh(chain(c.around, away));
            ASSERT_EQ(around_those_left(mesh, c.around.size()), c.around);
            EXPECT_EQ(rounds_of_small_rings(mesh, c.around.size()), c.rounds) << away;
            EXPECT_EQ(around_those_left(mesh, c.around.size()), c.left) << away;
        }
    }
}

}  // namespace
}  // namespace geomend::test
