// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/arrange.h"

#include <atomic>
#include <numeric>
#include <random>

#include "base/parallel.h"
#include "cut_soups.h"

namespace geomend::test {
namespace {

constexpr double pi = 3.14159265358979323846;

// N. Euler's crossing squares (acceptance test 7 of the thesis' digest): the whole cut is known.
TriangleSoup crossing_squares() {
    TriangleSoup soup;
    add_patch(soup, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
    add_patch(soup, {{0.3, -1, -1}, {0.3, 1, -1}, {0.3, 1, 1}, {0.3, -1, 1}}, {{0, 1, 2}, {0, 2, 3}});
    return soup;
}

TEST(Arrange, CutsTwoCrossingSquaresIntoEightTrianglesEach) {
    const auto soup = crossing_squares();
    const auto cut = expect_arranged(soup, 1e-7);
    EXPECT_EQ(std::ranges::count(cut.soup.patches, 0u), 8);
    EXPECT_EQ(std::ranges::count(cut.soup.patches, 1u), 8);
    EXPECT_EQ(cut.made, 4u);
    std::set<double> on_line;
    for (std::size_t v = 0; v < cut.soup.vertices.size(); ++v) {
        if (cut.origin.vertices[v].vertex == no_index) on_line.insert(cut.soup.vertices[v][1]);
    }
    ASSERT_EQ(on_line.size(), 4u);
    const std::array<double, 4> expected{-1, 0, 0.3, 1};
    std::size_t i = 0;
    for (const double y : on_line) EXPECT_NEAR(y, expected[i++], 1e-9);
    EXPECT_NEAR(area_of(cut.soup), 8, 1e-9);
}

TEST(Arrange, LeavesAConformalSoupAsItIsToTheBit) {
    TriangleSoup soup;
    add_sheet(soup, 20, 20, [](double u, double v) { return Vec3{u / 3, v / 7, 0.1 * std::sin(5 * u) * v}; });
    const auto cut = expect_arranged(soup, 1e-7);
    EXPECT_EQ(cut.soup.triangles, soup.triangles);
    EXPECT_EQ(cut.soup.vertices, soup.vertices);
    EXPECT_EQ(cut.cut, 0u);
}

TEST(Arrange, MergesEqualSheetsOverTheSameVertices) {
    TriangleSoup soup;
    for (int copy = 0; copy < 2; ++copy) {
        add_sheet(soup, 8, 8, [](double u, double v) { return Vec3{u, v, 0.2 * u * v}; });
    }
    const auto cut = expect_arranged(soup, 1e-6);
    EXPECT_EQ(cut.soup.vertices.size(), 81u);
    EXPECT_EQ(distinct(cut.soup).size(), 128u);
    EXPECT_EQ(cut.soup.triangles.size(), 256u);
}

TEST(Arrange, MakesPartlyOverlappingSheetsShareTheirTriangles) {
    TriangleSoup soup;
    add_sheet(soup, 7, 5, [](double u, double v) { return Vec3{u, v, 0}; });
    add_sheet(soup, 6, 9, [](double u, double v) { return Vec3{0.35 + u, 0.21 + v, 0}; });
    const auto cut = expect_arranged(soup, 1e-6);
    EXPECT_NEAR(area_of(cut.soup), 2, 1e-9);
    TriangleSoup once = cut.soup;
    once.triangles = distinct(cut.soup);
    EXPECT_NEAR(area_of(once), 2 - 0.65 * 0.79, 1e-9);
}

TEST(Arrange, InsertsContactsThatDoNotPassThrough) {
    TriangleSoup soup;
    add_sheet(soup, 6, 6, [](double u, double v) { return Vec3{u, v, 0}; });
    add_sheet(soup, 5, 4, [](double u, double v) { return Vec3{0.1 + 0.8 * u, 0.37 + 0.1 * u, v}; });
    const auto cut = expect_arranged(soup, 1e-7);
    EXPECT_NEAR(area_of(cut.soup), 1 + std::hypot(0.8, 0.1), 1e-6);
}

TEST(Arrange, CutsFansThatOverlapOnALine) {
    TriangleSoup soup;
    for (int fan = 0; fan < 6; ++fan) {
        const double angle = fan * pi / 6 + 0.1;
        const Vec3 out{std::cos(angle), std::sin(angle), 0};
        const double low = 0.07 * fan;
        std::vector<Vec3> points{{out[0], out[1], 0.5}};
        for (int k = 0; k <= 4; ++k) points.push_back({0, 0, low + k * (0.9 - 0.05 * fan) / 4});
        add_patch(soup, points, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
    }
    expect_arranged(soup, 1e-7);
}

TEST(Arrange, CutsPlanesThroughOneLine) {
    for (const double shift : {0.0, 431000.25}) {
        TriangleSoup soup;
        for (int plane = 0; plane < 4; ++plane) {
            const double angle = 0.3 + plane * pi / 4;
            add_sheet(soup, 12, 10, [&](double u, double v) {
                return Vec3{shift + (u - 0.5) * std::cos(angle) + 0.1 * (v - 0.5), (u - 0.5) * std::sin(angle) + shift * 15,
                            v - 0.2 * (u - 0.5)};
            });
        }
        const auto cut = expect_arranged(soup, std::max(1e-7, 4 * shift * 15 * 0x1p-52));
        EXPECT_NEAR(area_of(cut.soup), area_of(soup), 1e-5);
    }
}

TEST(Arrange, DropsTrianglesThinnerThanTheTolerance) {
    TriangleSoup soup;
    add_patch(soup, {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 1e-9, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 1, 2}});
    const auto cut = expect_arranged(soup, 1e-6);
    EXPECT_EQ(cut.collapsed, 2u);
    EXPECT_EQ(cut.soup.triangles.size(), 2u);
}

TEST(Arrange, CutsASheetThatCrossesItself) {
    TriangleSoup soup;
    add_sheet(soup, 60, 12, [](double u, double v) {
        const double t = 1.75 * pi * u - 0.4;
        return Vec3{std::cos(t) * (0.6 + u * std::sin(3 * u)), v + 0.03 * std::sin(9 * u), std::sin(2 * t)};
    });
    const auto cut = expect_arranged(soup, 1e-7);
    EXPECT_GT(cut.made, 20u);
    EXPECT_NEAR(area_of(cut.soup), area_of(soup), 1e-6);
}

// Three families of planes: the pieces of the cut are known by counting.
TEST(Arrange, MakesOnePointOfThreePlanes) {
    TriangleSoup soup;
    add_patch(soup, {{-1, -1, 0.1}, {2, -1, 0.1}, {-1, 2, 0.1}}, {{0, 1, 2}});
    add_patch(soup, {{-1, 0.2, -1}, {2, 0.2, -1}, {-1, 0.2, 2}}, {{0, 1, 2}});
    add_patch(soup, {{0.13, -1, -1}, {0.13, 2, -1}, {0.13, -1, 2}}, {{0, 1, 2}});
    const auto cut = expect_arranged(soup, 1e-7);
    std::size_t at_point = 0;
    for (const Vec3& p : cut.soup.vertices) at_point += std::hypot(p[0] - 0.13, p[1] - 0.2, p[2] - 0.1) < 1e-9 ? 1 : 0;
    EXPECT_EQ(at_point, 1u);
    EXPECT_EQ(cut.made, 7u);  // the point, and two ends for each of three lines
    EXPECT_NEAR(area_of(cut.soup), 3 * 4.5, 1e-9);
}

class RandomSoups : public testing::TestWithParam<unsigned> {};

TEST_P(RandomSoups, AreCutClean) {
    std::mt19937 random(GetParam());
    std::uniform_real_distribution<double> place(-1, 1);
    TriangleSoup soup;
    const bool on_lattice = GetParam() % 2 == 1;
    const auto point = [&] {
        Vec3 p{place(random), place(random), place(random)};
        if (on_lattice) {
            for (double& x : p) x = std::round(3 * x) / 3;
        }
        return p;
    };
    for (int i = 0; i < 14; ++i) {
        const Vec3 a = point(), b = point(), c = point();
        add_patch(soup, {a, b, c}, {{0, 1, 2}});
    }
    expect_arranged(soup, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomSoups, testing::Range(0u, 400u));

TEST(Arrange, KeepsEmbeddedEdgesInPieces) {
    auto soup = crossing_squares();
    soup.edges = {{0, 2}};
    soup.edge_ids = {7};
    const auto cut = expect_arranged(soup, 1e-7);
    ASSERT_EQ(cut.soup.edges.size(), 2u);
    EXPECT_EQ(cut.soup.edge_ids, (std::vector<std::uint32_t>{7, 7}));
    EXPECT_EQ(cut.soup.edges[0][1], cut.soup.edges[1][0]);
}

TriangleSoup wavy_sheets(std::uint32_t n) {
    TriangleSoup soup;
    for (int h = 0; h < 4; ++h) {
        add_sheet(soup, n, n, [&](double u, double v) {
            return Vec3{1000 * u, 1000 * v, 200.0 * h + 150 + 60 * std::sin(6.1 * u + h) * std::cos(5.3 * v + 0.3 * h)};
        });
    }
    for (int f = 0; f < 4; ++f) {
        add_sheet(soup, n, n, [&](double u, double v) {
            const double across = 300 + 300.0 * (f % 2) + 60 * (v - 0.5) + 25 * std::sin(7.3 * u + f), along = -20 + 1040 * u,
                         up = -20 + 1010 * v;
            return f < 2 ? Vec3{across, along, up} : Vec3{along, across, up};
        });
    }
    return soup;
}

TEST(Arrange, GivesTheSameBytesForAnyNumberOfThreads) {
    const auto soup = wavy_sheets(24);
    std::vector<Arrangement> results;
    for (const std::size_t threads : {1u, 2u, 7u}) {
        const ThreadBudget budget(threads);
        auto cut = arrangement::arrange(soup, {.tolerance = 1e-4});
        ASSERT_TRUE(cut.ok());
        results.push_back(std::move(*cut));
    }
    for (std::size_t i = 1; i < results.size(); ++i) {
        EXPECT_EQ(results[i].soup.vertices, results[0].soup.vertices);
        EXPECT_EQ(results[i].soup.triangles, results[0].soup.triangles);
        EXPECT_EQ(results[i].origin.vertices, results[0].origin.vertices);
    }
}

// The pieces of an arrangement do not depend on the order of triangles and vertices, nor on where the model lies.
TEST(Arrange, CutsAlikeShuffledTurnedAndMoved) {
    const auto soup = wavy_sheets(16);
    const auto plain = expect_arranged(soup, 1e-4);
    std::mt19937 random(5);
    for (int trial = 0; trial < 4; ++trial) {
        TriangleSoup other = soup;
        std::vector<std::uint32_t> order(soup.triangles.size());
        std::iota(order.begin(), order.end(), 0u);
        std::shuffle(order.begin(), order.end(), random);
        for (std::size_t i = 0; i < order.size(); ++i) {
            other.triangles[i] = soup.triangles[order[i]];
            other.patches[i] = soup.patches[order[i]];
            std::rotate(other.triangles[i].begin(), other.triangles[i].begin() + trial % 3, other.triangles[i].end());
            if (trial % 2 == 1) std::swap(other.triangles[i][0], other.triangles[i][1]);
        }
        const double angle = 0.4 * trial, away = trial == 3 ? 4e5 : 0;
        for (Vec3& p : other.vertices) {
            p = {std::cos(angle) * p[0] - std::sin(angle) * p[1] + away, std::sin(angle) * p[0] + std::cos(angle) * p[1] + 10 * away, p[2]};
        }
        const auto cut = expect_arranged(other, 1e-4);
        EXPECT_EQ(cut.soup.triangles.size(), plain.soup.triangles.size());
        EXPECT_EQ(cut.made, plain.made);
        EXPECT_NEAR(area_of(cut.soup), area_of(soup), 1e-9 * area_of(soup));
    }
}

// What a cut makes of a triangle covers it: areas agree triangle by triangle.
TEST(Arrange, FillsEachTriangleWithItsPieces) {
    const auto soup = wavy_sheets(16);
    const auto cut = expect_arranged(soup, 1e-4);
    std::vector<double> before(soup.triangles.size()), after(soup.triangles.size(), 0);
    const auto area = [](const TriangleSoup& s, const Triangle& t) {
        const Vec3 n = cross(minus(s.vertices[t[1]], s.vertices[t[0]]), minus(s.vertices[t[2]], s.vertices[t[0]]));
        return 0.5 * std::sqrt(dot(n, n));
    };
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) before[t] = area(soup, soup.triangles[t]);
    for (std::size_t t = 0; t < cut.soup.triangles.size(); ++t) after[cut.origin.triangles[t]] += area(cut.soup, cut.soup.triangles[t]);
    for (std::size_t t = 0; t < before.size(); ++t) EXPECT_NEAR(after[t], before[t], 1e-4);
}

TEST(Arrange, StopsWhenAsked) {
    const std::atomic<bool> stop{true};
    const Monitor monitor{&stop, {}};
    const auto cut = arrangement::arrange(wavy_sheets(8), {.tolerance = 1e-4, .monitor = &monitor});
    ASSERT_TRUE(cut.ok());
    EXPECT_FALSE(cut->clean);
}

TEST(Arrange, RefusesWhatIsNotFinite) {
    TriangleSoup soup;
    add_patch(soup, {{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}, {{0, 1, 2}});
    EXPECT_FALSE(arrangement::arrange(soup, {.tolerance = 1e-6}).ok());
    soup.vertices[2] = {0, 1, 0};
    EXPECT_FALSE(arrangement::arrange(soup, {.tolerance = 0}).ok());
}

}  // namespace
}  // namespace geomend::test
