// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>

#include "validators/checks_testing.h"
#include "validators/rewritten.h"

// Loose surfaces that close around nothing, or lie inside a region with both sides: what their roles decide is an error, what no
// role decides a warning, and either says where.

namespace geomend {
namespace {

using namespace testing;
using test::Triangle;
using Triangles = std::vector<Triangle>;

Vec3 at(double x, double y, double z) { return {x, y, z}; }

/// The sides of a box of 4 x 3 x `height`, each of two triangles, with normals outwards.
std::map<std::string, Triangles> sides_of_box(double height) {
    std::map<std::string, Triangles> sides;
    sides["bottom"] = test::quad(at(0, 0, 0), at(0, 3, 0), at(4, 3, 0), at(4, 0, 0));
    sides["top"] = test::quad(at(0, 0, height), at(4, 0, height), at(4, 3, height), at(0, 3, height));
    sides["south"] = test::quad(at(0, 0, 0), at(4, 0, 0), at(4, 0, height), at(0, 0, height));
    sides["north"] = test::quad(at(4, 3, 0), at(0, 3, 0), at(0, 3, height), at(4, 3, height));
    sides["west"] = test::quad(at(0, 3, 0), at(0, 0, 0), at(0, 0, height), at(0, 3, height));
    sides["east"] = test::quad(at(4, 0, 0), at(4, 3, 0), at(4, 3, height), at(4, 0, height));
    return sides;
}

Surface surface_of(const std::string& name, FeatureRole role, const Triangles& triangles) {
    test::ModelMaker maker;
    maker.add(name, role, triangles);
    return maker.surface(0);
}

Dataset loose(const std::map<std::string, Triangles>& surfaces, FeatureRole role) {
    Dataset data;
    for (const auto& [name, triangles] : surfaces) data.objects.emplace_back(surface_of(name, role, triangles));
    return data;
}

std::vector<Finding> judged(const Dataset& data) {
    auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    return checked->findings;
}

std::set<std::string> errors_and_warnings(const Dataset& data) {
    std::set<std::string> codes;
    for (const std::string& code : codes_of(judged(data))) {
        if (!code.ends_with(" info")) codes.insert(code);
    }
    return codes;
}

constexpr FeatureRole unknown = FeatureRole::unknown, boundary = FeatureRole::boundary;

TEST(ABoxWithoutASide, IsAnErrorWhereItsSidesAreStatedAsOuter) {
    for (const double height : {0.02, 2.0}) {
        for (const char* missing : {"west", "top"}) {
            auto sides = sides_of_box(height);
            sides.erase(missing);
            for (const Dataset& data : {loose(sides, boundary), moved(loose(sides, boundary), rotated)}) {
                const auto found = find(judged(data), "B06", Severity::error);
                EXPECT_EQ(found.entities.size(), 5u) << missing << height;
                EXPECT_FALSE(found.polylines.empty());
                EXPECT_EQ(measure(found, "edges"), 4);
            }
            EXPECT_EQ(errors_and_warnings(loose(sides, unknown)).count("B29 warning"), 1u) << missing << height;
        }
    }
    EXPECT_TRUE(errors_and_warnings(loose(sides_of_box(2), boundary)).empty());
    EXPECT_TRUE(errors_and_warnings(loose(sides_of_box(2), unknown)).empty());
}

TEST(ABoxWithAHole, SaysWhere) {
    auto sides = sides_of_box(2);
    sides["top"] = test::joined(
        {test::quad(at(0, 0, 2), at(4, 0, 2), at(3, 1, 2), at(1, 1, 2)), test::quad(at(4, 0, 2), at(4, 3, 2), at(3, 2, 2), at(3, 1, 2)),
         test::quad(at(4, 3, 2), at(0, 3, 2), at(1, 2, 2), at(3, 2, 2)), test::quad(at(0, 3, 2), at(0, 0, 2), at(1, 1, 2), at(1, 2, 2))});
    const auto error = find(judged(loose(sides, boundary)), "B06", Severity::error);
    EXPECT_EQ(measure(error, "edges"), 4);
    EXPECT_DOUBLE_EQ(measure(error, "length"), 6);
    EXPECT_NE(error.message.find("4 edges, 6 long, around (2, 1.5, 2)"), std::string::npos) << error.message;
    ASSERT_EQ(error.polylines.size(), 1u);
    const auto warning = find(judged(loose(sides, unknown)), "B29", Severity::warning);
    EXPECT_NE(warning.message.find("around (2, 1.5, 2)"), std::string::npos) << warning.message;
    // All of it one surface.
    Triangles all;
    for (const auto& [name, triangles] : sides) all.insert(all.end(), triangles.begin(), triangles.end());
    EXPECT_EQ(errors_and_warnings(loose({{"skin", all}}, boundary)), std::set<std::string>{"B06 error"});
    EXPECT_EQ(errors_and_warnings(loose({{"skin", all}}, unknown)), std::set<std::string>{"B29 warning"});
}

TEST(ALayeredBoxWithAHoleInTheHorizon, IsUndecidedWithoutRoles) {
    auto sides = sides_of_box(2);
    for (const char* name : {"south", "north", "west", "east"}) {
        // Each wall in two storeys.
        const auto& t = sides[name];
        const Vec3 a = t[0][0], b = t[0][1];
        const auto up = [](Vec3 p, double z) { return Vec3{p[0], p[1], z}; };
        sides[name] = test::joined({test::quad(a, b, up(b, 1), up(a, 1)), test::quad(up(a, 1), up(b, 1), up(b, 2), up(a, 2))});
    }
    Triangles middle = test::joined(
        {test::quad(at(0, 0, 1), at(4, 0, 1), at(3, 1, 1), at(1, 1, 1)), test::quad(at(4, 0, 1), at(4, 3, 1), at(3, 2, 1), at(3, 1, 1)),
         test::quad(at(4, 3, 1), at(0, 3, 1), at(1, 2, 1), at(3, 2, 1)), test::quad(at(0, 3, 1), at(0, 0, 1), at(1, 1, 1), at(1, 2, 1))});
    sides["middle"] = middle;
    const Dataset data = loose(sides, unknown);
    EXPECT_EQ(errors_and_warnings(data), std::set<std::string>{"B29 warning"});
    const auto warning = find(judged(data), "B29", Severity::warning);
    EXPECT_NE(warning.message.find("4 edges, 6 long, around (2, 1.5, 1)"), std::string::npos) << warning.message;
    Dataset decided = data;
    for (Object& object : decided.objects) {
        if (info_of(object).name == "middle") info_of(object).role = FeatureRole::fault;
    }
    EXPECT_TRUE(errors_and_warnings(decided).empty());
    for (Object& object : decided.objects) {
        if (info_of(object).name == "middle") info_of(object).role = FeatureRole::horizon;
    }
    EXPECT_EQ(errors_and_warnings(decided).count("B12 error"), 1u);
    const auto holes = test::quad(at(1, 1, 1), at(3, 1, 1), at(3, 2, 1), at(1, 2, 1));
    middle.insert(middle.end(), holes.begin(), holes.end());
    sides["middle"] = middle;
    EXPECT_TRUE(errors_and_warnings(loose(sides, unknown)).empty());
}

TEST(SurfacesThatMayBeOpen, AreLeftAlone) {
    // A sheet by itself, tiles of one map, and a horizon and a fault that say what they are.
    const auto sheet = test::quad(at(0, 0, 0), at(4, 0, 0), at(4, 3, 0.4), at(0, 3, 0));
    const auto next = test::quad(at(4, 0, 0), at(8, 0, 0), at(8, 3, 0), at(4, 3, 0.4));
    const auto wall = test::quad(at(4, 0, 0), at(4, 3, 0.4), at(4, 3, 5), at(4, 0, 5));
    EXPECT_TRUE(errors_and_warnings(loose({{"sheet", sheet}}, unknown)).empty());
    EXPECT_TRUE(errors_and_warnings(loose({{"sheet", sheet}}, FeatureRole::topography)).empty());
    EXPECT_TRUE(errors_and_warnings(loose({{"one", sheet}, {"two", next}}, unknown)).empty());
    EXPECT_TRUE(errors_and_warnings(loose({{"one", sheet}, {"two", next}}, FeatureRole::topography)).empty());
    EXPECT_TRUE(errors_and_warnings(loose({{"one", sheet}, {"two", next}, {"wall", wall}}, unknown)).empty()) << "goes up from both";
    Dataset data = loose({{"one", sheet}, {"two", next}}, FeatureRole::horizon);
    data.objects.emplace_back(surface_of("wall", FeatureRole::fault, wall));
    EXPECT_TRUE(errors_and_warnings(data).empty());
}

TEST(AnOpenBox, IsJudgedAlikeBesideAClosedOne) {
    auto sides = sides_of_box(2);
    sides.erase("top");
    Dataset data = loose(sides, boundary);
    const auto whole = test::box({4.5, 0, 0}, {8.5, 3, 2});
    data.objects.emplace_back(surface_of("whole", boundary, whole));
    const auto found = find(judged(data), "B06", Severity::error);
    EXPECT_EQ(found.entities.size(), 5u);
    EXPECT_EQ(errors_and_warnings(data).count("B12 error"), 0u);
}

}  // namespace
}  // namespace geomend
