// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "topology/model_maker.h"
#include "validators/registry.h"

// The order of horizons, faults without throw and surfaces that pass through each other, in vertical sections drawn out along
// y: what folds, reverse faults, erosion and faults that end do to a column without anything being wrong.

namespace geomend {
namespace {

using Point = std::array<double, 2>;  // x and z
using Way = std::vector<Point>;

/// A section: named surfaces as ways in it, which meet in common points; the front and the back are closed by triangles over
/// the stated areas, so that regions are bounded.
class Section {
public:
    /// Each way is a part of the surface of that name; its normal points to the left of the way (up for ways to larger x).
    void add(const std::string& name, FeatureRole role, const std::vector<Way>& ways) {
        std::vector<std::vector<test::Triangle>> parts;
        for (const Way& way : ways) {
            std::vector<test::Triangle> t;
            for (std::size_t k = 0; k + 1 < way.size(); ++k) {
                const Vec3 a = at(way[k], 0), b = at(way[k + 1], 0), c = at(way[k + 1], 1), d = at(way[k], 1);
                t.push_back({a, b, c});
                t.push_back({a, c, d});
            }
            parts.push_back(t);
        }
        maker_.add_parts(name, role, parts);
    }
    /// An area of the section as triangles over its outline, which is star-shaped about a point.
    void area(const Point& middle, const Way& outline) {
        for (const int side : {0, 1}) {
            std::vector<test::Triangle> t;
            for (std::size_t k = 0; k < outline.size(); ++k) {
                t.push_back({at(middle, side), at(outline[k], side), at(outline[(k + 1) % outline.size()], side)});
            }
            ends_.push_back(t);
        }
    }
    Dataset data() {
        if (!ends_.empty()) maker_.add_parts("ends", FeatureRole::boundary, ends_);
        ends_.clear();
        return maker_.data;
    }

private:
    static Vec3 at(const Point& p, int side) { return {p[0], double(side), p[1]}; }
    test::ModelMaker maker_;
    std::vector<std::vector<test::Triangle>> ends_;
};

/// Codes of family G, B10 and all errors.
std::multiset<std::string> codes_of(Section section) {
    const auto checked = validators::check_models(section.data(), {});
    EXPECT_TRUE(checked);
    std::multiset<std::string> codes;
    if (!checked) return codes;
    for (const Finding& f : checked->findings) {
        if (f.code[0] == 'G' || f.severity == Severity::error)
            codes.insert(f.code + (f.severity == Severity::error ? " error" : f.severity == Severity::warning ? " warning" : " info"));
    }
    return codes;
}
using Codes = std::multiset<std::string>;

constexpr auto horizon = FeatureRole::horizon;
constexpr auto fault = FeatureRole::fault;
constexpr auto boundary = FeatureRole::boundary;

/// Two blocks side by side, parted by a fault at x = 1, with horizons through both: their names from below, block by block.
Section two_columns(const std::vector<std::string>& left, const std::vector<std::string>& right, double fault_throw) {
    Section s;
    std::set<double> heights{0, 10};
    std::map<std::string, std::vector<Way>> ways;
    const auto height = [&](std::size_t k, bool second) { return 2.0 * double(k + 1) + (second ? fault_throw : 0); };
    for (std::size_t k = 0; k < left.size(); ++k) ways[left[k]].push_back({{0, height(k, false)}, {1, height(k, false)}});
    for (std::size_t k = 0; k < right.size(); ++k) ways[right[k]].push_back({{1, height(k, true)}, {2, height(k, true)}});
    for (const auto& [name, all] : ways) s.add(name, horizon, all);
    for (std::size_t k = 0; k < left.size(); ++k) heights.insert(height(k, false));
    for (std::size_t k = 0; k < right.size(); ++k) heights.insert(height(k, true));
    std::vector<Way> pieces;
    for (auto h = heights.begin(); std::next(h) != heights.end(); ++h) pieces.push_back({{1, *h}, {1, *std::next(h)}});
    s.add("fault", fault, pieces);
    s.add("bottom", boundary, {{{0, 0}, {1, 0}}, {{1, 0}, {2, 0}}});
    s.add("top", boundary, {{{0, 10}, {1, 10}}, {{1, 10}, {2, 10}}});
    for (const bool second : {false, true}) {
        const auto& names = second ? right : left;
        std::vector<Way> walls;
        double low = 0;
        for (std::size_t k = 0; k <= names.size(); ++k) {
            const double high = k < names.size() ? height(k, second) : 10;
            const double outer = second ? 2 : 0;
            walls.push_back({{outer, low}, {outer, high}});
            Way outline{{outer, low}, {outer, high}};
            for (auto h = heights.rbegin(); h != heights.rend(); ++h) {
                if (*h >= low && *h <= high) outline.push_back({1, *h});
            }
            s.area({second ? 1.5 : 0.5, (low + high) / 2}, outline);
            low = high;
        }
        s.add(second ? "east" : "west", boundary, walls);
    }
    return s;
}

TEST(TheOrderOfHorizons, HoldsAcrossAFault) {
    EXPECT_EQ(codes_of(two_columns({"A", "B", "C"}, {"A", "B", "C"}, 1)), Codes{});
    EXPECT_EQ(codes_of(two_columns({"A", "B", "C"}, {"A", "B", "C"}, 3)), Codes{}) << "the section is repeated or left out";
    EXPECT_EQ(codes_of(two_columns({"A", "B", "C"}, {"A", "B", "C"}, -1)), Codes{}) << "a reverse fault";
}

TEST(TheOrderOfHorizons, HoldsWhereOneIsErodedInABlock) {
    EXPECT_EQ(codes_of(two_columns({"A", "B", "C"}, {"A", "C"}, 1)), Codes{});
    EXPECT_EQ(codes_of(two_columns({"A", "B", "C"}, {"B"}, 1)), Codes{});
    EXPECT_EQ(codes_of(two_columns({"A", "B", "C"}, {}, 1)), Codes{});
}

TEST(TheOrderOfHorizons, IsBrokenWhereTwoChangePlaces) {
    EXPECT_EQ(codes_of(two_columns({"A", "B", "C"}, {"A", "C", "B"}, 1)), Codes{"G04 error"});
    EXPECT_EQ(codes_of(two_columns({"A", "B"}, {"B", "A"}, 1)), Codes{"G04 error"});
}

TEST(TheOrderOfHorizons, IsBrokenByACircleOfThreeAlthoughNoTwoChangePlaces) {
    EXPECT_EQ(codes_of(two_columns({"A", "B", "C"}, {"C", "A"}, 1)), Codes{"G04 error"});
    EXPECT_EQ(codes_of(two_columns({"A", "B", "C", "D"}, {"D", "A"}, 1)), Codes{"G04 error"});
}

/// A fold lying on its side whose lower limb is cut off by a fault: below it the layers are upside down, with all their normals.
TEST(TheOrderOfHorizons, MayBeReversedWhereLayersAreOverturned) {
    Section s;
    // The right block holds B below A, and the ways run to smaller x: their normals point down.
    s.add("A", horizon, {{{0, 2}, {1, 2}}, {{2, 6}, {1, 6}}});
    s.add("B", horizon, {{{0, 4}, {1, 4}}, {{2, 3}, {1, 3}}});
    s.add("fault", fault, {{{1, 0}, {1, 2}}, {{1, 2}, {1, 3}}, {{1, 3}, {1, 4}}, {{1, 4}, {1, 6}}, {{1, 6}, {1, 10}}});
    s.add("bottom", boundary, {{{0, 0}, {1, 0}}, {{1, 0}, {2, 0}}});
    s.add("top", boundary, {{{0, 10}, {1, 10}}, {{1, 10}, {2, 10}}});
    s.add("west", boundary, {{{0, 0}, {0, 2}}, {{0, 2}, {0, 4}}, {{0, 4}, {0, 10}}});
    s.add("east", boundary, {{{2, 0}, {2, 3}}, {{2, 3}, {2, 6}}, {{2, 6}, {2, 10}}});
    s.area({0.5, 1}, {{0, 0}, {0, 2}, {1, 2}, {1, 0}});
    s.area({0.5, 3}, {{0, 2}, {0, 4}, {1, 4}, {1, 3}, {1, 2}});
    s.area({0.5, 7}, {{0, 4}, {0, 10}, {1, 10}, {1, 6}, {1, 4}});
    s.area({1.5, 1}, {{2, 0}, {2, 3}, {1, 3}, {1, 2}, {1, 0}});
    s.area({1.5, 4.5}, {{2, 3}, {2, 6}, {1, 6}, {1, 4}, {1, 3}});
    s.area({1.5, 8}, {{2, 6}, {2, 10}, {1, 10}, {1, 6}});
    EXPECT_EQ(codes_of(s), Codes{"G04 warning"});
}

TEST(AFault, ThatDisplacesNothingIsNoted) {
    EXPECT_EQ(codes_of(two_columns({"A", "B"}, {"A", "B"}, 0)), Codes{"G03 info"});
    EXPECT_EQ(codes_of(two_columns({"A", "B"}, {"A", "B"}, 0.5)), Codes{});
    EXPECT_EQ(codes_of(two_columns({}, {}, 0)), Codes{}) << "there is no horizon that could tell";
}

/// A box with a horizon right through it at z = 5 and a fault below it that ends on it.
TEST(AFault, ThatEndsAtAHorizonSaysNothingOfThrow) {
    Section s;
    s.add("A", horizon, {{{0, 5}, {1, 5}}, {{1, 5}, {2, 5}}});
    s.add("fault", fault, {{{1, 0}, {1, 5}}});
    s.add("bottom", boundary, {{{0, 0}, {1, 0}}, {{1, 0}, {2, 0}}});
    s.add("top", boundary, {{{0, 10}, {2, 10}}});
    s.add("west", boundary, {{{0, 0}, {0, 5}}, {{0, 5}, {0, 10}}});
    s.add("east", boundary, {{{2, 0}, {2, 5}}, {{2, 5}, {2, 10}}});
    s.area({0.5, 2}, {{0, 0}, {0, 5}, {1, 5}, {1, 0}});
    s.area({1.5, 2}, {{2, 0}, {2, 5}, {1, 5}, {1, 0}});
    s.area({1, 7}, {{0, 5}, {0, 10}, {2, 10}, {2, 5}, {1, 5}});
    EXPECT_EQ(codes_of(s), Codes{});
}

/// Layers that are cut off below an unconformity, and others that end on it from above.
TEST(AnUnconformity, MayEndHorizonsFromBothSides) {
    Section s;
    s.add("U", FeatureRole::unconformity, {{{0, 5}, {1, 5}}, {{1, 5}, {1.5, 5}}, {{1.5, 5}, {2, 5}}});
    s.add("old", horizon, {{{0, 2}, {1, 5}}});
    s.add("young", horizon, {{{1.5, 5}, {2, 7}}});
    s.add("bottom", boundary, {{{0, 0}, {2, 0}}});
    s.add("top", boundary, {{{0, 10}, {2, 10}}});
    s.add("west", boundary, {{{0, 0}, {0, 2}}, {{0, 2}, {0, 5}}, {{0, 5}, {0, 10}}});
    s.add("east", boundary, {{{2, 0}, {2, 5}}, {{2, 5}, {2, 7}}, {{2, 7}, {2, 10}}});
    s.area({1, 1.5}, {{0, 0}, {0, 2}, {1, 5}, {1.5, 5}, {2, 5}, {2, 0}});
    s.area({0.3, 4}, {{0, 2}, {0, 5}, {1, 5}});
    s.area({1, 8}, {{0, 5}, {0, 10}, {2, 10}, {2, 7}, {1.5, 5}, {1, 5}});
    s.area({1.8, 5.5}, {{1.5, 5}, {2, 7}, {2, 5}});
    EXPECT_EQ(codes_of(s), Codes{});
}

TEST(Horizons, ThatPassThroughEachOtherAlongALineAreToldAndThoseThatTouchAreNot) {
    const auto codes = [](double end) {
        Section s;
        s.add("A", horizon, {{{0, 2}, {1, 5}}, {{1, 5}, {2, end}}});
        s.add("B", horizon, {{{0, 8}, {1, 5}}, {{1, 5}, {2, 10 - end}}});
        return codes_of(s);
    };
    EXPECT_EQ(codes(8), Codes{"G05 error"});
    EXPECT_EQ(codes(2), Codes{}) << "a lens that closes and opens again";
}

}  // namespace
}  // namespace geomend
