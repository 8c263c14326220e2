// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/intersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "base/parallel.h"
#include "geometry/predicates.h"
#include "soups.h"

namespace geomend {
namespace {

using test::Soup;

struct Found {
    std::uint32_t a, b;
    Meeting kind;
    auto operator<=>(const Found&) const = default;
    friend std::ostream& operator<<(std::ostream& out, const Found& f) { return out << f.a << '-' << f.b << ':' << int(f.kind); }
};

std::vector<Found> kinds(const std::vector<TriangleMeetingPair>& pairs) {
    std::vector<Found> found;
    for (const auto& p : pairs) found.push_back({p.a, p.b, p.how.kind});
    return found;
}

/// Every pair asked one by one.
std::vector<Found> brute_force(const Soup& s) {
    const auto skipped = [&](const Triangle& t) {
        return t[0] == t[1] || t[1] == t[2] || t[0] == t[2] || in_line(s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]);
    };
    std::vector<Found> found;
    for (std::uint32_t a = 0; a < s.triangles.size(); ++a) {
        for (std::uint32_t b = a + 1; b < s.triangles.size(); ++b) {
            if (skipped(s.triangles[a]) || skipped(s.triangles[b])) continue;
            const Meeting kind = meeting(s.vertices, s.triangles[a], s.triangles[b]).kind;
            if (kind != Meeting::none) found.push_back({a, b, kind});
        }
    }
    return found;
}

std::vector<Found> searched(const Soup& s) { return kinds(intersections(s.vertices, s.triangles)); }

/// Triangles of any size anywhere; half of the corners are at integers and shared between triangles.
Soup random_soup(unsigned seed, std::size_t count, double size) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0, 10), part(-size, size);
    Soup s;
    while (s.triangles.size() < count) {
        const auto first = static_cast<std::uint32_t>(s.vertices.size());
        const Vec3 centre{any(random), any(random), any(random)};
        for (int i = 0; i < 3; ++i) {
            Vec3 p{centre[0] + part(random), centre[1] + part(random), centre[2] + part(random)};
            if (random() % 2 == 0) p = {std::round(p[0]), std::round(p[1]), std::round(p[2])};
            s.vertices.push_back(p);
        }
        Triangle t{first, first + 1, first + 2};
        if (first > 0 && random() % 2 == 0) t[random() % 3] = static_cast<std::uint32_t>(random() % first);
        s.triangles.push_back(t);
    }
    return s;
}

TEST(Intersections, AreThoseOfAllPairsAskedOneByOne) {
    for (unsigned seed = 0; seed < 12; ++seed) {
        const Soup s = random_soup(seed, seed < 2 ? 3 + seed * 14 : 400, seed % 3 == 0 ? 4 : 1);
        const auto expected = brute_force(s);
        EXPECT_EQ(searched(s), expected) << "seed " << seed;
        EXPECT_TRUE(seed < 2 || expected.size() > 20);
    }
}

TEST(Intersections, OfSoupsAtIntegersHaveAllKinds) {
    std::map<Meeting, int> seen;
    for (unsigned seed = 0; seed < 6; ++seed) {
        Soup s = random_soup(100 + seed, 300, 2);
        for (Vec3& p : s.vertices) p = {std::round(p[0]), std::round(p[1]), std::round(p[2])};
        const auto expected = brute_force(s);
        EXPECT_EQ(searched(s), expected);
        for (const Found& f : expected) ++seen[f.kind];
    }
    for (const Meeting kind : {Meeting::point, Meeting::touch, Meeting::crossing, Meeting::overlap}) EXPECT_GT(seen[kind], 10);
}

TEST(Intersections, OfSmallAndEmptySoups) {
    EXPECT_TRUE(intersections({}, {}).empty());
    for (std::uint32_t n = 1; n < 40; ++n) {
        Soup s;
        s.add_sheet(n, 1, [](double i, double j) { return Vec3{i, j, 0}; });
        s.add_sheet(1, 1, [n](double i, double j) { return Vec3{n - 0.5, 0.25 + 0.25 * j, i - 0.5}; });
        EXPECT_EQ(searched(s), brute_force(s)) << n;
        EXPECT_FALSE(searched(s).empty());
    }
}

/// A folded height field with a steep fault plane through it.
Soup folded(std::uint32_t n, bool crossed) {
    Soup s;
    const double step = 1000.0 / n;
    s.add_sheet(n, n, [&](double i, double j) {
        return Vec3{step * i, step * j, 40 * std::sin(0.01 * step * i) + 30 * std::cos(0.013 * step * j)};
    });
    if (crossed)
        s.add_sheet(n, n / 4, [&](double i, double j) {
            return Vec3{400.37 + 0.31 * step * j, -7.7 + 1.021 * step * i, -140.21 + 1.13 * step * j};
        });
    return s;
}

TEST(Intersections, OfASoundSurfaceAreNone) {
    for (const bool flat : {false, true}) {
        Soup s = folded(60, false);
        if (flat) {
            for (Vec3& p : s.vertices) p[2] = 0.5 * p[0] - 0.25 * p[1];
        }
        EXPECT_TRUE(searched(s).empty());
        for (Vec3& p : s.vertices) p = {451234.5 + p[2], 6812345.25 + p[0], p[1]};
        EXPECT_TRUE(searched(s).empty()) << "upright, far from the origin";
        for (Vec3& p : s.vertices) p = {1e-3 * p[0], 1e-3 * p[1], 1e-3 * p[2]};
        EXPECT_TRUE(searched(s).empty());
    }
}

// The fault goes through the horizon from one side of it to the other.
// inside.
TEST(Intersections, OfAFaultAndAHorizonFollowOneLine) {
    const Soup s = folded(40, true);
    const auto pairs = intersections(s.vertices, s.triangles);
    EXPECT_EQ(kinds(pairs), brute_force(s));
    std::map<Vec3, int> ends;
    for (const auto& p : pairs) {
        EXPECT_EQ(p.how.kind, Meeting::crossing);
        EXPECT_LT(p.a, 3200u);
        EXPECT_GE(p.b, 3200u);
        ++ends[p.how.segment[0]];
        ++ends[p.how.segment[1]];
    }
    int loose = 0;
    double low = 1e9, high = -1e9;
    for (const auto& [p, count] : ends) {
        EXPECT_LE(count, 2);
        if (count == 1) ++loose, low = std::min(low, p[1]), high = std::max(high, p[1]);
    }
    EXPECT_EQ(loose, 2) << "one polyline, equal to the bit at its joints";
    EXPECT_NEAR(low, 0, 1e-9);
    EXPECT_NEAR(high, 1000, 1e-9);
}

TEST(Intersections, AFoldOntoItselfIsFound) {
    Soup s;
    s.add_sheet(10, 1, [](double i, double j) { return Vec3{i < 6 ? i : 10 - i, j, 0}; });
    const auto pairs = searched(s);
    EXPECT_EQ(pairs, brute_force(s));
    EXPECT_FALSE(pairs.empty());
    for (const Found& f : pairs) EXPECT_NE(f.kind, Meeting::crossing);
}

TEST(Intersections, DegenerateTrianglesAreSkipped) {
    Soup s;
    s.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {1, 1, 3}, {2, 2, 2}};
    s.triangles = {{0, 1, 2}, {3, 4, 5}, {3, 4, 4}, {3, 3, 3}, {3, 4, 6}};
    EXPECT_EQ(searched(s), (std::vector<Found>{{0, 4, Meeting::crossing}}));
    s.triangles = {{3, 4, 5}, {3, 3, 4}};
    EXPECT_TRUE(searched(s).empty()) << "nothing else there";
}

TEST(Intersections, DoNotDependOnTheOrderOfTrianglesAndVertices) {
    std::mt19937 random(3);
    const Soup s = random_soup(77, 500, 1.5);
    std::set<std::array<std::uint32_t, 2>> expected;
    for (const Found& f : brute_force(s)) expected.insert({f.a, f.b});
    for (int round = 0; round < 5; ++round) {
        std::vector<std::uint32_t> place(s.triangles.size()), rename(s.vertices.size());
        for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
        for (std::uint32_t i = 0; i < rename.size(); ++i) rename[i] = i;
        std::shuffle(place.begin(), place.end(), random);
        std::shuffle(rename.begin(), rename.end(), random);
        Soup shuffled;
        shuffled.vertices.resize(s.vertices.size());
        for (std::uint32_t v = 0; v < rename.size(); ++v) shuffled.vertices[rename[v]] = s.vertices[v];
        for (const std::uint32_t t : place) {
            Triangle corners{rename[s.triangles[t][0]], rename[s.triangles[t][1]], rename[s.triangles[t][2]]};
            std::shuffle(corners.begin(), corners.end(), random);
            shuffled.triangles.push_back(corners);
        }
        std::set<std::array<std::uint32_t, 2>> found;
        for (const Found& f : searched(shuffled)) {
            const auto [a, b] = std::minmax(place[f.a], place[f.b]);
            found.insert({a, b});
        }
        EXPECT_EQ(found, expected);
    }
}

TEST(Intersections, DoNotDependOnThreadsNorWithALimit) {
    const Soup s = random_soup(78, 2000, 1);
    const auto all = kinds(intersections(s.vertices, s.triangles));
    ASSERT_GT(all.size(), 1000u);
    std::vector<Found> limited;
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}, std::size_t{0}}) {
        const ThreadBudget budget(threads);
        EXPECT_EQ(kinds(intersections(s.vertices, s.triangles)), all);
        const auto some = kinds(intersections(s.vertices, s.triangles, nullptr, 100));
        EXPECT_EQ(some.size(), 100u);
        if (limited.empty()) limited = some;
        EXPECT_EQ(some, limited);
    }
    EXPECT_TRUE(std::includes(all.begin(), all.end(), limited.begin(), limited.end()));
    EXPECT_TRUE(std::is_sorted(limited.begin(), limited.end()));
    EXPECT_EQ(kinds(intersections(s.vertices, s.triangles, nullptr, all.size())), all) << "a limit that is not passed changes nothing";
}

TEST(Intersections, AreHandedOverPartByPart) {
    const Soup s = random_soup(80, 2500, 0.7);
    const TriangleTree tree(s.vertices, s.triangles);
    const auto all = kinds(intersections(tree));
    for (const std::size_t threads : {std::size_t{1}, std::size_t{0}}) {
        const ThreadBudget budget(threads);
        std::vector<PairTaker> takers(intersection_parts(tree));
        std::vector<std::vector<TriangleMeetingPair>> parts(takers.size());
        std::size_t done = 0;
        visit_intersections(
            tree,
            [&](std::size_t part) -> PairTaker& {
                takers[part].take = [&parts, part](const TriangleMeetingPair& pair) { parts[part].push_back(pair); };
                takers[part].wants = [](std::uint32_t a, std::uint32_t b) { return (a + b) % 3 != 0; };
                takers[part].is_choosy = part % 2 == 0;
                return takers[part];
            },
            [&](std::size_t first, std::size_t last) {
                EXPECT_EQ(first, done);
                done = last;
            });
        EXPECT_EQ(done, parts.size());
        std::vector<Found> found;
        std::set<std::pair<std::uint32_t, std::uint32_t>> here;
        for (std::size_t part = 0; part < parts.size(); ++part) {
            for (const Found& f : kinds(parts[part])) {
                EXPECT_TRUE(part % 2 != 0 || (f.a + f.b) % 3 != 0) << "not wanted";
                found.push_back(f);
                here.insert({f.a, f.b});
            }
        }
        EXPECT_EQ(here.size(), found.size()) << "each once";
        for (const Found& f : found) EXPECT_TRUE(std::binary_search(all.begin(), all.end(), f));
        for (const Found& f : all) EXPECT_TRUE((f.a + f.b) % 3 == 0 || here.contains({f.a, f.b}));
    }
}

TEST(Intersections, CanBeStopped) {
    const Soup s = random_soup(79, 100, 2);
    const std::atomic<bool> stop = true;
    Monitor monitor;
    monitor.stop = &stop;
    EXPECT_TRUE(intersections(s.vertices, s.triangles, &monitor).empty());
    double done = 0;
    Monitor watching;
    watching.on_progress = [&](std::string_view, double share) { done = share; };
    EXPECT_FALSE(intersections(s.vertices, s.triangles, &watching).empty());
    EXPECT_EQ(done, 1);
}

TEST(Intersections, AreFoundWhateverTheSizesOfTheTriangles) {
    Soup s;
    s.vertices = {{-1e7, -1e7, 0}, {1e7, -1e7, 0}, {0, 2e7, 0}};
    s.triangles = {{0, 1, 2}};
    for (std::uint32_t i = 0; i < 200; ++i) {
        const double x = 0.001 * i, z = i % 2 == 0 ? -1e-9 : 1e-9;
        const auto first = static_cast<std::uint32_t>(s.vertices.size());
        s.vertices.insert(s.vertices.end(), {{x, 0, z}, {x, 0.0005, 1e-3}, {x, 0, 1e-3}});
        s.triangles.push_back({first, first + 1, first + 2});
    }
    const auto pairs = searched(s);
    EXPECT_EQ(pairs.size(), 100u);
    for (const Found& f : pairs) EXPECT_EQ(f.b % 2, 1u) << "the even ones, counted from 1";
    EXPECT_EQ(pairs, brute_force(s));
}

}  // namespace
}  // namespace geomend
