// SPDX-License-Identifier: AGPL-3.0-or-later
#include "drawing/changes.h"

#include <gtest/gtest.h>

namespace geomend {
namespace {

/// Two triangles over four points, and a line along them.
Scene made() {
    Scene scene;
    ScenePart surface;
    surface.kind = "surface";
    surface.name = "F1";
    surface.id = 4;
    surface.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    surface.triangles = {{0, 1, 2}, {0, 2, 3}};
    ScenePart line;
    line.kind = "line";
    line.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    line.polylines = {{0, 1, 2, 3}};
    scene.parts = {surface, line};
    return scene;
}

TEST(Changes, TrianglesThatWereAddedAndNewEdgesBecomePartsOfTheirOwn) {
    Scene scene = made();
    repair::ModelChanges changes;
    changes.surfaces = {"F1"};
    changes.added = {{{{1, 1, 0}, {0, 0, 0}, {0, 1, 0}}}};
    changes.lines = {{{2, 0, 0}, {1, 0, 0}, false}, {{2, 0, 0}, {3, 0, 0}, true}};
    mark_changes(scene, {}, changes);
    ASSERT_EQ(scene.parts.size(), 5u);
    EXPECT_EQ(scene.parts[0].triangles.size(), 1u);
    EXPECT_EQ(scene.parts[1].polylines, (std::vector<std::vector<std::uint32_t>>{{0, 1}}));
    const ScenePart& strip = scene.parts[2];
    EXPECT_EQ(strip.change, PartChange::added);
    EXPECT_EQ(strip.id, 4);
    EXPECT_EQ(strip.triangles.size(), 1u);
    EXPECT_EQ(strip.points.size(), 3u) << "only the points that it uses";
    EXPECT_EQ(scene.parts[3].change, PartChange::cut);
    EXPECT_EQ(scene.parts[3].points, (std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(scene.parts[4].change, PartChange::joined);
}

TEST(Changes, PointsThatMovedSayHowFarInTheirOwnSurfaceAlone) {
    Scene scene = made();
    scene.parts[1] = scene.parts[0];
    scene.parts[1].name = "F2";
    repair::ModelChanges changes;
    changes.surfaces = {"F1", "F2"};
    changes.moved = {{0, {1, 1, 0}, 0.5}};
    mark_changes(scene, {}, changes);
    EXPECT_EQ(scene.parts[0].moved, (std::vector<float>{0, 0, 0.5f, 0}));
    EXPECT_TRUE(scene.parts[1].moved.empty());
}

TEST(Changes, WhatWasLeftOutGoesIntoTheSceneBefore) {
    repair::ModelChanges changes;
    changes.removed.push_back({"F1", {"tails", repair::Removal::tail, 0, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}}});
    changes.erased_edges = {{{{0, 0, 0}, {1, 0, 0}}}};
    const auto reported = reported_changes(made(), changes);
    ASSERT_EQ(reported.before.parts.size(), 4u);
    EXPECT_EQ(reported.before.parts[2].change, PartChange::removed);
    EXPECT_EQ(reported.before.parts[2].name, "F1");
    EXPECT_EQ(reported.before.parts[3].change, PartChange::erased);
    EXPECT_EQ(reported.before.triangles, 3u);
    ASSERT_EQ(reported.removed.size(), 1u);
    EXPECT_EQ(reported.removed[0].step, "tails");
    EXPECT_EQ(reported.removed[0].word, "tail");
}

}  // namespace
}  // namespace geomend
