// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/soup_reducer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "arrangement/exact_pairs.h"
#include "arrangement/soup_faults.h"
#include "arrangement/soup_kinds.h"
#include "arrangement/soup_of.h"
#include "support/seeds.h"

namespace geomend::test {
namespace {

bool has_crossing(const TriangleSoup& soup) { return pairs_that_meet_exactly(soup, 1) > 0; }

TEST(SoupReducer, ShrinksACrossingToTwoTrianglesOfFewDigits) {
    for (const char* kind : {"uniform", "near_contacts", "grids", "common_line"}) {
        const auto small = reduced(random_soup(kind, 3).soup, has_crossing);
        EXPECT_TRUE(has_crossing(small)) << kind;
        EXPECT_EQ(small.triangles.size(), 2u) << kind;
        EXPECT_LE(small.vertices.size(), 6u) << kind;
        EXPECT_LT(as_code(small).size(), 200u) << kind << ": " << as_code(small);
    }
}

// No single triangle of the result can be left out: that is what "shrunk" promises.
TEST(SoupReducer, LeavesNoTriangleThatIsNotNeeded) {
    const auto needs_three = [](const TriangleSoup& s) { return pairs_that_meet_exactly(s, 5) >= 4; };
    const auto small = reduced(random_soup("uniform", 2).soup, needs_three);
    ASSERT_TRUE(needs_three(small));
    for (std::size_t t = 0; t < small.triangles.size(); ++t) {
        TriangleSoup less = small;
        less.triangles.erase(less.triangles.begin() + static_cast<std::ptrdiff_t>(t));
        less.patches.erase(less.patches.begin() + static_cast<std::ptrdiff_t>(t));
        EXPECT_FALSE(needs_three(less));
    }
}

TEST(SoupReducer, GivesTheSameForTheSame) {
    const auto soup = random_soup("mixed", 7).soup;
    const auto once = reduced(soup, has_crossing), again = reduced(soup, has_crossing);
    EXPECT_EQ(once.vertices, again.vertices);
    EXPECT_EQ(once.triangles, again.triangles);
}

TEST(SoupReducer, KeepsEmbeddedEdgesOnlyWhereTheyMatter) {
    auto soup = random_soup("uniform", 3).soup;
    soup.edges = {{0, 4}, {5, 7}};
    soup.edge_ids = {1, 2};
    EXPECT_TRUE(reduced(soup, has_crossing).edges.empty());
    const auto kept = reduced(soup, [](const TriangleSoup& s) { return s.edges.size() == 2 && has_crossing(s); });
    EXPECT_EQ(kept.edge_ids, soup.edge_ids);
    EXPECT_TRUE(check(kept).ok());
}

TEST(SoupReducer, ReadsWhatItWritesToTheBit) {
    const auto soup = random_soup("needles", 23).soup;
    std::stringstream text;
    write_soup(text, soup);
    const auto back = read_soup(text);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->vertices, soup.vertices);
    EXPECT_EQ(back->triangles, soup.triangles);
    EXPECT_EQ(back->patches, soup.patches);
    std::istringstream wrong("v 1 2\n"), far("v 0 0 0\nf 0 0 1 2\n");
    EXPECT_FALSE(read_soup(wrong));
    EXPECT_FALSE(read_soup(far));
}

// The judge of cuts must tell what is wrong from what is not, by itself.
TEST(ExactPairs, KnowsContactsByHand) {
    const auto pairs = [](std::vector<Vec3> v, std::vector<Triangle> t) {
        return pairs_that_meet_exactly(soup_of(std::move(v), std::move(t)));
    };
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{1, 1, 0};
    EXPECT_EQ(pairs({a, b, c, d}, {{0, 1, 2}, {2, 1, 3}}), 0u) << "a shared edge";
    EXPECT_EQ(pairs({a, b, c, {-1, 0, 1}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}), 0u) << "a shared corner";
    EXPECT_EQ(pairs({a, b, c, b, c, d}, {{0, 1, 2}, {3, 4, 5}}), 1u) << "an edge shared by place alone";
    EXPECT_EQ(pairs({a, b, c, {0.2, 0.2, -1}, {0.3, 0.2, 1}, {3, 3, 1}}, {{0, 1, 2}, {3, 4, 5}}), 1u) << "crossing";
    EXPECT_EQ(pairs({a, b, c, {0.25, 0.25, 0}, {0, 0, 1}, {1, 0, 1}}, {{0, 1, 2}, {3, 4, 5}}), 1u) << "a corner on a face";
    EXPECT_EQ(pairs({a, b, c, {0.25, 0.25, 0x1p-50}, {0, 0, 1}, {1, 0, 1}}, {{0, 1, 2}, {3, 4, 5}}), 0u) << "not quite";
    EXPECT_EQ(pairs({a, b, c, {0.2, 0.2, 0}, {2, 0.2, 0}, {2, 2, 0}}, {{0, 1, 2}, {3, 4, 5}}), 1u) << "an overlap";
    EXPECT_EQ(pairs({a, b, c}, {{0, 1, 2}, {2, 1, 0}}), 0u) << "the same three vertices";
    EXPECT_EQ(pairs({a, b, c, {0.7, 0.7, 0}}, {{0, 1, 2}, {1, 2, 3}}), 0u) << "beyond the shared edge";
    EXPECT_EQ(pairs({a, b, c, {0.2, 0.2, 0}}, {{0, 1, 2}, {1, 2, 3}}), 1u) << "folded back over the shared edge";
}

TEST(SoupFaults, HaveNamesThatLeadBack) {
    for (int f = 1; f <= static_cast<int>(SoupFault::changed_again); ++f) {
        EXPECT_EQ(fault_named(to_string(static_cast<SoupFault>(f))), static_cast<SoupFault>(f));
    }
    EXPECT_EQ(fault_named("no such"), SoupFault::none);
}

TEST(SoupFaults, AreFoundWhereThereAreSome) {
    auto soup = random_soup("uniform", 1).soup;
    EXPECT_EQ(fault_in_child(soup, 1e-6, 60), SoupFault::none);
    EXPECT_EQ(fault_in_child(soup, -1, 60), SoupFault::refused);
    soup.triangles[0] = {0, 1, 4000000000u};  // beyond the vertices: refused, not read
    EXPECT_EQ(fault_in_child(soup, 1e-6, 60), SoupFault::refused);
}

class RandomSoupKinds : public testing::TestWithParam<std::string> {};

TEST_P(RandomSoupKinds, AreCutWithoutFault) {
    constexpr unsigned seconds = 20;
    for (unsigned seed = 0; seed < seeds(30); ++seed) {
        const auto [soup, tolerance] = random_soup(GetParam(), seed);
        const SoupFault fault = fault_in_child(soup, tolerance, seconds);
        if (fault == SoupFault::none) continue;
        const double length = tolerance;
        const auto small = reduced(soup, [&](const TriangleSoup& s) { return fault_in_child(s, length, seconds) == fault; });
        ADD_FAILURE() << to_string(fault) << ", seed " << seed << ", tolerance " << tolerance << ":\n" << as_code(small);
    }
}

const auto name_of = [](const testing::TestParamInfo<std::string>& kind) { return kind.param; };
INSTANTIATE_TEST_SUITE_P(Clean, RandomSoupKinds, testing::ValuesIn(soup_kinds()), name_of);

}  // namespace
}  // namespace geomend::test
