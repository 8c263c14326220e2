// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/near_misses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "base/parallel.h"
#include "geometry/vectors.h"
#include "soups.h"

namespace geomend {
namespace {

using test::Soup;
using Edge = std::array<std::uint32_t, 2>;

/// The free borders: edges of one triangle only.
struct Borders {
    std::vector<Edge> edges;
    std::vector<std::uint32_t> groups;
};

Borders borders_of(const Soup& s) {
    std::map<Edge, std::vector<std::uint32_t>> uses;
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [p, q] = std::minmax(s.triangles[t][i], s.triangles[t][(i + 1) % 3]);
            uses[{p, q}].push_back(s.groups[t]);
        }
    }
    Borders b;
    for (const auto& [edge, groups] : uses) {
        if (groups.size() > 1) continue;
        b.edges.push_back(edge);
        b.groups.push_back(groups[0]);
    }
    return b;
}

struct Found {
    Borders borders;
    std::vector<NearMiss> misses;

    /// Ends of the edges of one group that were told, ascending without repetition.
    std::vector<std::uint32_t> vertices(std::uint32_t group) const {
        std::vector<std::uint32_t> found;
        for (const NearMiss& m : misses) {
            if (borders.groups[m.border_edge] == group)
                found.insert(found.end(), borders.edges[m.border_edge].begin(), borders.edges[m.border_edge].end());
        }
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }
    double smallest() const {
        double d = 1e9;
        for (const NearMiss& m : misses) d = std::min(d, m.distance);
        return d;
    }
};

Found search(const Soup& s, double near) {
    Found f{borders_of(s), {}};
    f.misses = near_misses(s.vertices, s.triangles, s.groups, f.borders.edges, f.borders.groups, near);
    for (const NearMiss& m : f.misses) {
        EXPECT_GT(m.distance, 0);
        EXPECT_LT(m.distance, near);
        const Vec3 d = minus(m.on_edge, m.on_triangle);
        EXPECT_NEAR(std::sqrt(dot(d, d)), m.distance, 1e-6 * near);
    }
    return f;
}

std::vector<ClosePair> pairs(const Soup& s, double near) { return closest_pairs(s.vertices, s.triangles, s.groups, near).pairs; }

/// Takes equal positions for one vertex.
Soup welded(const Soup& s) {
    Soup w;
    w.groups = s.groups;
    std::map<Vec3, std::uint32_t> known;
    for (const Triangle& t : s.triangles) {
        Triangle u{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [at, added] = known.try_emplace(s.vertices[t[i]], static_cast<std::uint32_t>(w.vertices.size()));
            if (added) w.vertices.push_back(s.vertices[t[i]]);
            u[i] = at->second;
        }
        w.triangles.push_back(u);
    }
    return w;
}

/// A flat horizon, 0..20 each way, and a fault from z = gap(y) upwards in the plane x = 10.5.
template <class Gap>
Soup fault_above_horizon(const Gap& gap) {
    Soup s;
    s.add_sheet(20, 20, [](double i, double j) { return Vec3{i, j, 0}; });
    s.add_sheet(10, 8, [&](double i, double j) { return Vec3{10.5, 5.25 + i, gap(i) + j}; });
    return s;
}
constexpr std::uint32_t fault = 1, fault_start = 21 * 21;

std::vector<std::uint32_t> lowest_row() {
    std::vector<std::uint32_t> row;
    for (std::uint32_t i = 0; i <= 10; ++i) row.push_back(fault_start + i);
    return row;
}

TEST(NearMisses, AFaultThatEndsAboveAHorizonIsFoundAlongItsBorder) {
    const Found f = search(fault_above_horizon([](double) { return 0.3; }), 0.5);
    EXPECT_EQ(f.vertices(fault), lowest_row());
    EXPECT_EQ(f.misses.size(), 10u);
    for (const NearMiss& m : f.misses) EXPECT_DOUBLE_EQ(m.distance, 0.3);
    EXPECT_TRUE(search(fault_above_horizon([](double) { return 0.3; }), 0.29).misses.empty()) << "farther than near";
}

TEST(NearMisses, ASlopingGapIsFoundAsFarAsItIsNear) {
    const Found f = search(fault_above_horizon([](double i) { return 0.1 + 0.1 * i; }), 0.55);
    EXPECT_DOUBLE_EQ(f.smallest(), 0.1);
    EXPECT_EQ(f.vertices(fault).size(), 5u) << "0.1 to 0.5";
    const Found wavy = search(fault_above_horizon([](double i) { return 0.3 + 0.1 * std::cos(2 * i); }), 0.5);
    EXPECT_EQ(wavy.vertices(fault), lowest_row()) << "from each smallest distance up to the largest";
}

TEST(NearMisses, ALongEdgeThatIsNearWithOneEndIsFound) {
    Soup s;
    s.vertices = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}, {0, 0, 0.25}, {5, 0, 5}, {-5, 1, 5}};
    s.triangles = {{0, 1, 2}, {3, 4, 5}};
    s.groups = {0, 1};
    const Found f = search(s, 0.5);
    EXPECT_EQ(f.misses.size(), 2u) << "both edges at the corner";
    EXPECT_EQ(f.smallest(), 0.25);
}

TEST(NearMisses, TouchingAndCrossingIsNotNear) {
    EXPECT_TRUE(search(fault_above_horizon([](double) { return 0; }), 0.5).misses.empty()) << "on the horizon";
    EXPECT_TRUE(search(fault_above_horizon([](double) { return -0.3; }), 0.25).misses.empty()) << "0.3 beyond it";
}

// The lower border passes through the horizon between two of its vertices.
TEST(NearMisses, ABorderThatCrossesIsNotNearBesideTheCrossing) {
    const Found f = search(fault_above_horizon([](double i) { return 0.3 * (i - 4.5); }), 0.25);
    EXPECT_TRUE(f.vertices(fault).empty());
}

/// A horizon and a fault that meet in a line of common vertices; the fault rises at an angle.
Soup wedge(double degrees, double roughness = 0) {
    const double c = std::cos(degrees * std::numbers::pi / 180), h = std::sin(degrees * std::numbers::pi / 180);
    const auto rough = [=](double i, double j) { return roughness * std::sin(12.9898 * i + 78.233 * j); };
    Soup s;
    s.add_sheet(20, 20, [&](double i, double j) { return Vec3{i, j, i == 6 ? 0 : rough(i, j)}; });
    s.add_sheet(8, 8, [&](double i, double j) { return Vec3{6 + c * i, 5 + j, h * i + (i == 0 ? 0 : rough(i + 30, j))}; });
    return welded(s);
}

TEST(NearMisses, SurfacesThatMeetInALineAreNoMissBesideIt) {
    for (const double degrees : {1.0, 5.0, 30.0, 90.0, 150.0}) {
        for (const double near : {0.01, 0.2, 0.9, 3.0}) {
            const Soup s = wedge(degrees);
            if (8 * std::sin(degrees * std::numbers::pi / 180) > near) {  // else all of it is a narrow strip
                EXPECT_TRUE(search(s, near).misses.empty()) << degrees << " degrees, near " << near;
            }
            EXPECT_TRUE(pairs(s, near).empty()) << degrees << " degrees, near " << near;
        }
    }
    EXPECT_TRUE(search(wedge(20, 0.02), 0.9).misses.empty()) << "rough surfaces";
    EXPECT_TRUE(pairs(wedge(20, 0.02), 0.9).empty());
}

TEST(NearMisses, AHoleInAContactIsFound) {
    for (const std::uint32_t pulled : {1u, 2u, 3u}) {
        Soup s;
        s.add_sheet(20, 20, [](double i, double j) { return Vec3{i, j, 0}; });
        s.add_sheet(8, 8, [&](double i, double j) {
            return Vec3{6, 5 + i, j + (j == 0 && i >= 3 && i < 3 + pulled ? 0.1 * (i - 2) : 0.0)};
        });
        const Found f = search(welded(s), 0.5);
        EXPECT_EQ(f.vertices(fault).size(), pulled + 2) << "the vertices pulled off, and the ends of the hole";
        EXPECT_EQ(f.misses.size(), pulled + 1);
        double largest = 0;
        for (const NearMiss& m : f.misses) largest = std::max(largest, m.distance);
        EXPECT_DOUBLE_EQ(largest, 0.1 * pulled);
    }
}

// From the first to the last point of a folded horizon a border goes straight, and is farthest from it where both limbs are as far.
TEST(NearMisses, AHoleUnderOneEdgeIsAsWideAsItIsAtItsWidest) {
    Soup s;
    s.vertices = {{0, 0, 0}, {3, 0, 0}, {4, 0, -1}, {0, 2, 0}, {3, 2, 0}, {4, 2, -1}, {0, 0, -9}, {4, 0, -9}};
    s.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {0, 2, 7}, {0, 7, 6}};
    s.groups = {0, 0, 0, 0, 1, 1};
    const Found f = search(s, 1);
    const double widest = 0.25 * 3 / (0.75 + std::numbers::sqrt2 / 4);
    const auto hole = std::ranges::find_if(f.misses, [&](const NearMiss& m) { return f.borders.edges[m.border_edge] == Edge{0, 2}; });
    ASSERT_NE(hole, f.misses.end());
    EXPECT_NEAR(hole->distance, widest, 1e-6);
}

TEST(NearMisses, AContactThatComesApartTowardsTheEndOfTheBorderIsFound) {
    // A wall at y = 13 closes the model: the fault is joined to it, and the horizon is, too.
    Soup s;
    s.add_sheet(8, 13, [](double i, double j) { return Vec3{i, j, 0}; });
    s.add_sheet(8, 8, [](double i, double j) { return Vec3{6, 5 + i, j > 0 ? j : i > 4 ? 0.1 * (i - 4) : 0.0}; });
    s.add_sheet(8, 8, [](double i, double j) { return Vec3{i, 13, i == 6 && j == 0 ? 0.0 : j}; });
    Soup w = welded(s);
    // The wall has the fault's border as well: one more vertex on its line x = 6.
    const auto at = [&](const Vec3& p) {
        return static_cast<std::uint32_t>(std::find(w.vertices.begin(), w.vertices.end(), p) - w.vertices.begin());
    };
    const std::uint32_t low = at({6, 13, 0}), gap = at({6, 13, 0.4}), top = at({6, 13, 1});
    ASSERT_LT(std::max({low, gap, top}), w.vertices.size());
    for (std::size_t t = 0, count = w.triangles.size(); t < count; ++t) {
        if (w.groups[t] != 2) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            Triangle& v = w.triangles[t];
            if ((v[i] == low && v[(i + 1) % 3] == top) || (v[i] == top && v[(i + 1) % 3] == low)) {
                Triangle other = v;
                v[i] = gap;
                other[(i + 1) % 3] = gap;
                w.triangles.push_back(other);
                w.groups.push_back(2);
                break;
            }
        }
    }
    const Found f = search(w, 0.5);
    EXPECT_EQ(f.vertices(fault).size(), 5u) << "from the last common vertex to the wall";
}

TEST(NearMisses, ASurfaceIsNoMissOfItself) {
    Soup s;
    s.add_sheet(30, 30, [](double i, double j) { return Vec3{0.1 * i, 0.1 * j, 0.05 * std::sin(0.3 * i)}; });
    for (const double near : {0.05, 0.25, 0.7}) EXPECT_TRUE(search(s, near).misses.empty()) << "many edges shorter than " << near;
}

TEST(NearMisses, ABorderThatNearlyMeetsItsOwnSurfaceIsFound) {
    Soup s;  // a pipe that does not quite close
    s.add_sheet(40, 5, [](double i, double j) {
        const double angle = i / 40 * 0.99 * 2 * std::numbers::pi;
        return Vec3{10 * std::cos(angle), 10 * std::sin(angle), j};
    });
    const double gap = 2 * 10 * std::sin(0.01 * std::numbers::pi);
    const Found f = search(s, 1);
    EXPECT_EQ(f.vertices(0).size(), 12u) << "both lips";
    EXPECT_NEAR(f.smallest(), gap, 0.01 * gap);
    EXPECT_TRUE(search(s, 0.5).misses.empty());
}

TEST(NearMisses, AnOpenSlitIsNone) {
    for (const double half_width : {0.002, 0.05, 0.3}) {
        Soup s;  // the row j = 5 is doubled for i > 4, and spread
        s.add_sheet(12, 5, [&](double i, double j) { return Vec3{i, j - (j == 5 && i > 4 ? half_width * (i - 4) : 0), 0}; });
        s.add_sheet(12, 5, [&](double i, double j) { return Vec3{i, 5 + j + (j == 0 && i > 4 ? half_width * (i - 4) : 0), 0}; });
        std::fill(s.groups.begin(), s.groups.end(), 0);
        EXPECT_TRUE(search(welded(s), 0.7).misses.empty()) << half_width;
    }
}

/// A wavy horizon and a fault that meets it along a wavy line of common vertices, with some of the fault's vertices on that line
/// pulled off by a gap.
struct Planted {
    Soup soup;
    std::vector<std::uint32_t> pulled;
    double largest_gap = 0;
};

Planted plant(unsigned seed, double near, bool with_defect) {
    std::mt19937 random(seed);
    const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const double a = any(0, 0.3), b = any(0, 6), angle = any(25, 155) * std::numbers::pi / 180, swing = any(0, 0.3);
    const auto height = [&](double x, double y) { return a * std::sin(0.7 * x + b) + a * std::cos(0.9 * y); };
    const std::uint32_t length = 10;
    Planted p;
    Soup& s = p.soup;
    const auto across = [&](double y) { return 8 + swing * std::sin(1.3 * y + b); };
    s.add_sheet(16, 16, [&](double i, double j) {
        const double x = i == 8 ? across(j) : i;
        return Vec3{x, j, height(x, j)};
    });
    const std::uint32_t start = s.add_sheet(length, 6, [&](double i, double j) {
        const double y = i + 3, x = across(y);
        return Vec3{x + std::cos(angle) * j, y, height(x, y) + std::sin(angle) * j};
    });
    if (with_defect) {
        auto first = static_cast<std::uint32_t>(any(0, length)), count = static_cast<std::uint32_t>(any(1, length));
        count = std::min(count, length - first);
        // A gap that opens towards the end of the border is one where it opens slowly, else the beginning of a border that leaves.
        const double gap = any(0.1, 0.6) * near;
        double slope = any(-0.03, 0.03) * near;
        if (gap + slope * length < 0.03 * near) slope = 0;  // it must not pass through
        const auto is_slow = [&] { return gap + std::max(0.0, slope * (count - 1)) <= 0.049 * count; };
        if (first == 0 && count + 1 < length && !is_slow()) first = 1;
        if (first + count >= length && first > 0 && !is_slow()) count = length - 1 - first;
        for (std::uint32_t i = first; i <= std::min(length, first + count); ++i) {
            Vec3& v = s.vertices[start + i];
            v[2] += gap + slope * (i - first);
            p.pulled.push_back(i);
            p.largest_gap = std::max(p.largest_gap, gap + slope * (i - first));
        }
    }
    // Numbers after welding: found again by position.
    std::vector<Vec3> places;
    for (const std::uint32_t i : p.pulled) places.push_back(s.vertices[start + i]);
    s = welded(s);
    p.pulled.clear();
    for (const Vec3& place : places)
        p.pulled.push_back(static_cast<std::uint32_t>(std::find(s.vertices.begin(), s.vertices.end(), place) - s.vertices.begin()));
    return p;
}

TEST(NearMisses, PlantedGapsAreFoundAndSoundContactsAreNot) {
    for (unsigned seed = 0; seed < 400; ++seed) {
        const double near = seed % 3 == 0 ? 0.1 : seed % 3 == 1 ? 0.5 : 1.2;
        const Planted sound = plant(seed, near, false);
        EXPECT_TRUE(search(sound.soup, near).misses.empty()) << "seed " << seed;
        const Planted broken = plant(seed, near, true);
        const Found f = search(broken.soup, near);
        const auto told = f.vertices(fault);
        for (const std::uint32_t v : broken.pulled) {
            EXPECT_TRUE(std::binary_search(told.begin(), told.end(), v))
                << "seed " << seed << ", " << broken.pulled.size() << " pulled off";
        }
        EXPECT_LE(f.smallest(), broken.largest_gap) << "seed " << seed;
    }
}

/// A horizon and an upright fault on it whose lower border leaves it after four edges and rises by `rise` with each of six more.
Soup slow_wedge(double rise) {
    Soup s;
    s.add_sheet(20, 20, [](double i, double j) { return Vec3{i, j, 0}; });
    s.add_sheet(10, 6, [&](double i, double j) { return Vec3{6, 5 + i, std::max(j, i > 4 && j < 1 ? rise * (i - 4) : 0.0)}; });
    return welded(s);
}

TEST(NearMisses, AContactThatComesApartSlowlyIsToldBeforeTheEndOfTheBorder) {
    for (const double near : {0.1, 0.3, 1.0}) {
        for (const double rise : {0.01, 0.03, 0.049}) {
            const Found f = search(slow_wedge(rise), near);
            // Where the end of the border is farther off than near, the wedge is told up to there.
            const auto edges = static_cast<std::size_t>(std::min(6.0, near / rise));
            EXPECT_GE(f.misses.size(), edges) << "near " << near << ", rise " << rise;
            EXPECT_LE(f.misses.size(), edges + 1);
        }
        EXPECT_TRUE(search(slow_wedge(0.06), near).misses.empty()) << "a wedge of more than 3 degrees";
        EXPECT_TRUE(search(slow_wedge(0), near).misses.empty());
    }
}

// The same wedge under edges of any length.
TEST(NearMisses, ASlowWedgeIsToldWhateverTheLengthsOfTheEdges) {
    for (const std::uint32_t pieces : {1u, 2u, 5u, 40u}) {
        Soup s;
        s.add_sheet(20, 20, [](double i, double j) { return Vec3{i, j, 0}; });
        s.add_sheet(1 + pieces, 1, [&](double i, double j) {
            return i == 0 ? Vec3{6, 5, 4 * j} : Vec3{6, 6 + 8 * (i - 1) / pieces, j > 0 ? 4 : 0.04 * 8 * (i - 1) / pieces};
        });
        const Found f = search(welded(s), 0.2);  // near for 5 of 8
        double farthest = 0;
        for (const NearMiss& m : f.misses) farthest = std::max(farthest, m.distance);
        EXPECT_GE(farthest, pieces == 1 ? 0.15 : 0.2 * 0.75) << pieces;
    }
}

// Beds that wedge out: the whole surface leaves the other one slowly, and its borders do.
TEST(NearMisses, ASurfaceThatWedgesOutIsNone) {
    for (const double degrees : {0.5, 1.0, 2.0, 2.8}) EXPECT_TRUE(search(wedge(degrees), 0.06).misses.empty()) << degrees;
}

/// Two flat sheets side by side in one plane, `gap` apart.
Soup side_by_side(double gap) {
    Soup s;
    s.add_sheet(6, 6, [](double i, double j) { return Vec3{i, j, 0}; });
    s.add_sheet(5, 7, [&](double i, double j) { return Vec3{6 + gap + i, 0.9 * j - 0.1, 0}; });
    return s;
}

TEST(NearMisses, BordersThatNearlyMeetBordersAreToldForBoth) {
    const Soup s = side_by_side(0.3);
    const Found f = search(s, 0.5);
    EXPECT_GE(f.vertices(0).size(), 7u);
    EXPECT_GE(f.vertices(1).size(), 7u);
    for (const NearMiss& m : f.misses) EXPECT_NEAR(m.distance, 0.3, 1e-12);
    EXPECT_TRUE(search(s, 0.29).misses.empty());
}

TEST(NearMisses, ACornerThatNearlyMeetsALineIsTold) {
    // A contact of two surfaces at x = 6, and the corner of a third one beside it.
    Soup s = side_by_side(0);
    s = welded(s);
    const auto first = static_cast<std::uint32_t>(s.vertices.size());
    s.vertices.insert(s.vertices.end(), {{6, 3.3, 0.2}, {6, 8, 5}, {7, 3, 5}});
    s.triangles.push_back({first, first + 1, first + 2});
    s.groups.push_back(2);
    const Found f = search(s, 0.5);
    std::map<std::uint32_t, int> groups;
    for (const NearMiss& m : f.misses) {
        if (f.borders.groups[m.border_edge] != 2) continue;
        ++groups[s.groups[m.triangle]];
        EXPECT_NEAR(m.distance, 0.2, 1e-12);
    }
    EXPECT_GE(groups[0] + groups[1], 2) << "both edges at the corner";
}

// One edge meets the surface in one place and nearly meets it in another.
TEST(NearMisses, AnEdgeThatTouchesElsewhereIsToldAllTheSame) {
    Soup s;
    s.add_sheet(2, 1, [](double i, double j) { return Vec3{10 * i, 4 * j - 2, i == 1 ? -1.0 : i == 0 ? -0.2 : 0.5}; });
    s.add_sheet(1, 1, [](double i, double j) { return Vec3{22 * i - 1, 0, 3 * j}; });
    const Found f = search(s, 0.4);
    EXPECT_EQ(f.vertices(1).size(), 2u);
    EXPECT_NEAR(f.smallest(), 0.2, 1e-2);
}

TEST(NearMisses, OneBorderNearTwoSurfacesIsToldForEach) {
    Soup s = fault_above_horizon([](double) { return 0.3; });
    s.add_sheet(20, 20, [](double i, double j) { return Vec3{10.9, i, 0.1 + 0.2 * j}; });
    const Found f = search(s, 0.5);
    std::map<std::uint32_t, int> groups;
    for (const NearMiss& m : f.misses) {
        if (f.borders.groups[m.border_edge] == fault) ++groups[s.groups[m.triangle]];
    }
    EXPECT_EQ(groups[0], 10);
    EXPECT_GE(groups[2], 10);
}

/// The same under another order of triangles, vertices and corners, elsewhere and at another size.
TEST(NearMisses, AreTheSameInAnyOrderAndFrame) {
    std::mt19937 random(4);
    const Soup s = fault_above_horizon([](double i) { return 0.3 + 0.05 * std::sin(3 * i); });
    const Found expected = search(s, 0.5);
    ASSERT_EQ(expected.misses.size(), 10u);
    for (const auto& [scale, offset] :
         {std::pair{1.0, Vec3{}}, std::pair{1.0, Vec3{451234.5, 6812345.25, -1200}}, std::pair{1e-3, Vec3{}}, std::pair{1e3, Vec3{}}}) {
        std::vector<std::uint32_t> rename(s.vertices.size());
        for (std::uint32_t i = 0; i < rename.size(); ++i) rename[i] = i;
        std::shuffle(rename.begin(), rename.end(), random);
        Soup moved;
        moved.vertices.resize(s.vertices.size());
        for (std::size_t v = 0; v < rename.size(); ++v) {  // turned about the vertical axis, too
            const Vec3& p = s.vertices[v];
            moved.vertices[rename[v]] = plus(offset, times(scale, {0.6 * p[0] - 0.8 * p[1], 0.8 * p[0] + 0.6 * p[1], p[2]}));
        }
        std::vector<std::size_t> order(s.triangles.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::shuffle(order.begin(), order.end(), random);
        for (const std::size_t t : order) {
            Triangle v{rename[s.triangles[t][0]], rename[s.triangles[t][1]], rename[s.triangles[t][2]]};
            std::shuffle(v.begin(), v.end(), random);
            moved.triangles.push_back(v);
            moved.groups.push_back(s.groups[t]);
        }
        const Found f = search(moved, 0.5 * scale);
        EXPECT_EQ(f.misses.size(), 10u);
        EXPECT_NEAR(f.smallest(), scale * expected.smallest(), 1e-8 * scale);
    }
}

TEST(NearMisses, DoNotDependOnThreadsAndCanBeStopped) {
    const Soup s = fault_above_horizon([](double i) { return 0.3 + 0.05 * std::sin(3 * i); });
    const Borders b = borders_of(s);
    std::vector<NearMiss> first;
    for (const std::size_t threads : {std::size_t{1}, std::size_t{0}}) {
        const ThreadBudget budget(threads);
        const auto found = near_misses(s.vertices, s.triangles, s.groups, b.edges, b.groups, 0.5);
        if (first.empty()) first = found;
        ASSERT_EQ(found.size(), first.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].border_edge, first[i].border_edge);
            EXPECT_EQ(found[i].triangle, first[i].triangle);
            EXPECT_EQ(found[i].distance, first[i].distance);
        }
    }
    const std::atomic<bool> stop = true;
    Monitor monitor;
    monitor.stop = &stop;
    EXPECT_TRUE(near_misses(s.vertices, s.triangles, s.groups, b.edges, b.groups, 0.5, &monitor).empty());
    EXPECT_TRUE(closest_pairs(s.vertices, s.triangles, s.groups, 0.5, &monitor).pairs.empty());
    EXPECT_TRUE(near_misses({}, {}, {}, {}, {}, 1).empty());
}

TEST(ClosestPairs, AreFoundInsideSurfaces) {
    Soup s;
    s.add_sheet(20, 20, [](double i, double j) { return Vec3{i, j, 0}; });
    s.add_sheet(20, 20, [](double i, double j) {
        return Vec3{0.97 * i, 0.97 * j, 0.25 + 0.05 * ((i - 9) * (i - 9) + (j - 12) * (j - 12))};
    });
    s.add_sheet(20, 20, [](double i, double j) { return Vec3{i, j, 40}; });
    const auto found = pairs(s, 0.5);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].group_a, 0u);
    EXPECT_EQ(found[0].group_b, 1u);
    EXPECT_DOUBLE_EQ(found[0].distance, 0.25);
    EXPECT_EQ(s.groups[found[0].triangle_a], 0u);
    EXPECT_EQ(s.groups[found[0].triangle_b], 1u);
    EXPECT_EQ(found[0].on_b, (Vec3{0.97 * 9, 0.97 * 12, 0.25}));
    EXPECT_TRUE(pairs(s, 0.2).empty());
}

TEST(ClosestPairs, GoOnFromVerticesToWhereEdgesAreClosest) {
    Soup s;  // two roofs, ridge across ridge, with vertices beside the crossing
    s.add_sheet(11, 2, [](double i, double j) { return Vec3{i - 5.4, j - 1, j == 1 ? 0.0 : -1.0}; });
    s.add_sheet(2, 11, [](double i, double j) { return Vec3{i - 1, j - 5.3, i == 1 ? 0.2 : 1.2}; });
    const auto found = pairs(s, 0.6);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].distance, 0.2, 1e-12);
    EXPECT_NEAR(found[0].on_a[0], 0, 1e-12);
    EXPECT_NEAR(found[0].on_a[1], 0, 1e-12);
}

TEST(ClosestPairs, BarsThatPassEachOtherAreFound) {
    Soup s;  // long triangles with all vertices far away
    s.vertices = {{-10, 0, 0}, {10, 0, 0}, {0, 1, -9}, {0, -10, 0.3}, {0, 10, 0.3}, {1, 0, 9}};
    s.triangles = {{0, 1, 2}, {3, 4, 5}};
    s.groups = {0, 1};
    const auto found = pairs(s, 0.5);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].distance, 0.3, 1e-12);
    EXPECT_NEAR(found[0].on_b[0], 0, 1e-12);
    EXPECT_TRUE(pairs(s, 0.3).empty());
}

TEST(ClosestPairs, RidgesWithoutAVertexNearAreFound) {
    for (const double gap : {0.01, 0.2, 0.49}) {
        Soup s;
        s.add_sheet(3, 2, [](double i, double j) { return Vec3{40 * i - 50, 20 * j - 20, j == 1 ? 0.0 : -10.0}; });
        s.add_sheet(2, 3, [&](double i, double j) { return Vec3{20 * i - 20, 40 * j - 50, i == 1 ? gap : 10}; });
        const auto found = pairs(s, 0.5);
        ASSERT_EQ(found.size(), 1u);
        EXPECT_NEAR(found[0].distance, gap, 1e-12);
    }
}

TEST(ClosestPairs, AVertexThatNearlyPiercesIsFound) {
    Soup s;
    s.add_sheet(2, 2, [](double i, double j) { return Vec3{i, j, 0}; });
    s.add_sheet(2, 2, [](double i, double j) { return Vec3{0.3 + i, 0.4 + j, i == 1 && j == 1 ? 0.05 : 3.0}; });
    const auto found = pairs(s, 0.1);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_DOUBLE_EQ(found[0].distance, 0.05);
}

// Rough sheets that part along a line: beside it there are many places where the distance is smallest.
TEST(ClosestPairs, BesideALineOfRoughSurfacesThereAreNone) {
    for (const double degrees : {10.0, 20.0, 45.0}) {
        for (const double near : {0.2, 0.5, 0.8}) EXPECT_TRUE(pairs(wedge(degrees, 0.08), near).empty()) << degrees << ' ' << near;
    }
}

TEST(ClosestPairs, SurfacesThatCrossOrTouchAreNone) {
    Soup s;
    s.add_sheet(20, 20, [](double i, double j) { return Vec3{i, j, 0}; });
    s.add_sheet(20, 20, [](double i, double j) { return Vec3{i + 0.3, 5.2 + 0.3 * j, j - 9.7}; });
    EXPECT_TRUE(pairs(s, 0.6).empty());
    EXPECT_TRUE(search(s, 0.29).vertices(1).empty());
}

// Two horizons end on one fault, a step apart: the fault joins them, they are no near miss of each other.
TEST(ClosestPairs, ContactsOfOneSurfaceAreNone) {
    Soup s;
    s.add_sheet(8, 20, [](double i, double j) { return Vec3{0, i, 0.125 * j - 1}; });
    s.add_sheet(8, 8, [](double i, double j) { return Vec3{j, i, 0}; });
    s.add_sheet(8, 8, [](double i, double j) { return Vec3{-j, i, 0.125}; });
    const Soup w = welded(s);
    EXPECT_TRUE(pairs(w, 0.3).empty());
    EXPECT_TRUE(search(w, 0.05).misses.empty());
}

TEST(ClosePairs, AreSoughtNoFurtherWhereEverythingIsNearEverything) {
    Soup s;
    for (const double z : {0.0, 0.3})
        s.add_sheet(80, 80, [&](std::uint32_t i, std::uint32_t j) { return Vec3{1.0 * i, 1.0 * j, z + 0.01 * i}; });
    const auto within = [&](double near) { return closest_pairs(s.vertices, s.triangles, s.groups, near); };
    EXPECT_EQ(within(2).pairs.size(), 1u);
    EXPECT_TRUE(within(2).cut_short.empty());
    EXPECT_EQ(within(40).cut_short, (std::vector<std::uint32_t>{0, 1}));  // several thousand triangles are as near as that
}

// Surfaces of parts that lie far from each other have lengths of their own.
TEST(ClosePairs, AreSoughtForEachGroupWithinItsOwnLength) {
    Soup s;
    for (const double x : {0.0, 1e6}) {
        for (const double z : {0.0, 0.3})
            s.add_sheet(8, 8, [&](std::uint32_t i, std::uint32_t j) { return Vec3{x + i, 1.0 * j, z + 0.01 * i}; });
    }
    const TriangleTree tree(s.vertices, s.triangles);
    const SurfaceDistance soup(tree, s.groups);
    const auto groups_within = [&](const std::array<double, 4>& near) {
        std::vector<std::array<std::uint32_t, 2>> found;
        for (const ClosePair& p : closest_pairs(soup, near).pairs) found.push_back({p.group_a, p.group_b});
        return found;
    };
    using Pairs = std::vector<std::array<std::uint32_t, 2>>;
    EXPECT_EQ(groups_within({1, 1, 2, 2}), (Pairs{{0, 1}, {2, 3}}));
    EXPECT_EQ(groups_within({0.1, 0.1, 2, 2}), (Pairs{{2, 3}}));
    EXPECT_EQ(groups_within({1, 1, 0, 0}), (Pairs{{0, 1}}));
}

}  // namespace
}  // namespace geomend
