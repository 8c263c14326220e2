// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/scene_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace geomend {
namespace {

Scene made_scene() {
    Scene scene;
    scene.parts.push_back({"surface",
                           "fault \"1\"",
                           7,
                           FeatureRole::fault,
                           {{0.1, 2, 3}, {1e17, 0, 0}, {0, 0, -1}},
                           {{0, 1, 2}},
                           {{0, 1}, {2}},
                           PartChange::none,
                           {}});
    scene.parts.push_back({"points", "", -1, FeatureRole::unknown, {{1, 1, 1}}, {}, {}, PartChange::none, {}});
    SceneMark mark;
    mark.points = {{1, 2, 3}};
    mark.polylines = {{{0, 0, 0}, {1, 1, 1}}, {}};
    mark.triangles = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
    mark.outlines = {{{5, 5, 5}}};
    scene.marks = {mark, {}};
    scene.crs.name = "local";
    scene.crs.axis_units = {"m", "m", "ft"};
    scene.crs.z_positive = ZPositive::depth;
    scene.origin = {500000, 4e6, -1000};
    scene.triangles = 123456;
    scene.simplified = true;
    return scene;
}

TEST(SceneText, GivesTheSceneBack) {
    const Scene scene = made_scene();
    const auto back = scene_from_text(scene_text(scene));
    ASSERT_TRUE(back.has_value());
    ASSERT_EQ(back->parts.size(), 2u);
    EXPECT_EQ(back->parts[0].name, scene.parts[0].name);
    EXPECT_EQ(back->parts[0].role, FeatureRole::fault);
    EXPECT_EQ(back->parts[0].points, scene.parts[0].points);
    EXPECT_EQ(back->parts[0].triangles, scene.parts[0].triangles);
    EXPECT_EQ(back->parts[0].polylines, scene.parts[0].polylines);
    ASSERT_EQ(back->marks.size(), 2u);
    EXPECT_EQ(back->marks[0].triangles, scene.marks[0].triangles);
    EXPECT_EQ(back->marks[0].polylines, scene.marks[0].polylines);
    EXPECT_EQ(back->marks[0].outlines, scene.marks[0].outlines);
    EXPECT_TRUE(back->marks[1].empty());
    EXPECT_EQ(back->crs, scene.crs);
    EXPECT_EQ(back->origin, scene.origin);
    EXPECT_EQ(back->triangles, 123456u);
    EXPECT_TRUE(back->simplified);
}

TEST(SceneText, RefusesWhatWouldReachBeyondItsPoints) {
    auto j = nlohmann::json::parse(scene_text(made_scene()));
    for (const char* place : {"/parts/0/triangles/2", "/parts/0/polylines/1/0"}) {
        auto bad = j;
        bad[nlohmann::json::json_pointer(place)] = 3;
        EXPECT_FALSE(scene_from_text(bad.dump()).has_value()) << place;
    }
    j["parts"][0]["role"] = 99;
    EXPECT_FALSE(scene_from_text(j.dump()).has_value());
}

TEST(SceneText, SurvivesWrongTypesAnywhere) {
    const auto good = nlohmann::json::parse(scene_text(made_scene()));
    const auto flat = good.flatten();
    std::size_t refused = 0;
    for (const auto& [path, value] : flat.items()) {
        for (const char* other : {"null", "-1", "\"x\"", "[[1]]", "{\"a\": 1}"}) {
            auto bad = good;
            bad[nlohmann::json::json_pointer(path)] = nlohmann::json::parse(other);
            refused += !scene_from_text(bad.dump()).has_value();
        }
    }
    EXPECT_GT(refused, 3 * flat.size());
    EXPECT_FALSE(scene_from_text("").has_value());
}

}  // namespace
}  // namespace geomend
