// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/debris.h"

#include <gtest/gtest.h>

#include "pipeline/load.h"
#include "support/temporary_folder.h"

namespace geomend {
namespace {

Finding made(const std::string& code, Severity severity, std::vector<EntityRef> entities) {
    Finding f;
    f.code = code;
    f.severity = severity;
    f.message = "message of " + code;
    f.entities = std::move(entities);
    return f;
}

// A note with two triangles, an error with a line and a point, a warning that marks nothing.
ReportedFile reported() {
    ReportedFile file;
    file.file = "a.ml";
    file.findings = {made("M03", Severity::info, {{"surface", "top/1", 1}}),
                     made("B08", Severity::error, {{"surface", "fault_1", 2}, {"surface", "horizon_2", 3}}),
                     made("B01", Severity::warning, {})};
    file.scene.emplace();
    file.scene->marks.resize(3);
    file.scene->marks[0].triangles = {{{{4e5, 0, -5}, {4e5 + 1, 0, -5}, {4e5, 1, -5}}},
                                      {{{4e5 + 1, 0, -5}, {4e5 + 1, 1, -5}, {4e5, 1, -5}}}};
    file.scene->marks[0].outlines = {{{4e5, 0, -5}, {4e5 + 1, 0, -5}}};
    file.scene->marks[1].polylines = {{{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.2, 0.3}}};
    file.scene->marks[1].points = {{0.1, 0.2, 0.3}};
    return file;
}

TEST(Debris, HasTheMarksOfEachFindingInBothFormats) {
    const test::TemporaryFolder folder;
    DebrisFolder debris((folder / "new").string());
    ASSERT_TRUE(debris.open());
    ReportedFile file = reported();
    ASSERT_TRUE(debris.write(file));
    const std::string start = (folder / "new").string() + "/";
    EXPECT_EQ(file.debris[1],
              (std::vector<std::string>{start + "0001-B08-fault_1-horizon_2.vtp", start + "0001-B08-fault_1-horizon_2.ts"}));
    EXPECT_EQ(file.debris[0], (std::vector<std::string>{start + "0003-M03-top_1.vtp", start + "0003-M03-top_1.ts"}));
    EXPECT_TRUE(file.debris[2].empty());
    for (const std::string& path : file.debris[0]) {
        const auto back = load(path, {});
        ASSERT_TRUE(back) << path;
        ASSERT_EQ(back->objects.size(), 1u) << path;
        const auto& surface = std::get<Surface>(back->objects[0]);
        EXPECT_EQ(surface.polygons.size(), 2u);
        EXPECT_EQ(surface.points.size(), 4u) << "points at one place are one";
        EXPECT_EQ(surface.points[0], (Vec3{4e5, 0, -5}));
    }
    for (const std::string& path : file.debris[1]) {
        const auto back = load(path, {});
        ASSERT_TRUE(back) << path;
        ASSERT_EQ(back->objects.size(), 2u) << path;
        EXPECT_EQ(std::get<PolylineSet>(back->objects[0]).edges.size(), 2u);
        EXPECT_EQ(std::get<PolylineSet>(back->objects[0]).points[2], (Vec3{0.1, 0.2, 0.3}));
        EXPECT_EQ(std::get<PointSet>(back->objects[1]).points.size(), 1u);
    }
}

TEST(Debris, KeepsTheFilesOwnSignOfHeights) {
    const test::TemporaryFolder folder;
    ReportedFile file = reported();
    file.scene->crs.stated = true;
    file.scene->crs.z_positive = ZPositive::depth;
    DebrisFolder debris(folder.path().string());
    ASSERT_TRUE(debris.write(file));
    EXPECT_NE(test::read_file(file.debris[0][1]).find("ZPOSITIVE Depth"), std::string::npos);
    EXPECT_EQ(std::get<Surface>(load(file.debris[0][1], {})->objects[0]).points[0], (Vec3{4e5, 0, -5}));
}

TEST(Debris, NumbersGoOnFromFileToFileAndStopWhereTheListStops) {
    const test::TemporaryFolder folder;
    DebrisFolder debris(folder.path().string(), 1);
    ReportedFile first = reported(), second = reported();
    ASSERT_TRUE(debris.write(first));
    ASSERT_TRUE(debris.write(second));
    EXPECT_FALSE(first.debris[1].empty());
    EXPECT_TRUE(first.debris[0].empty()) << "the second worst is not listed";
    EXPECT_NE(second.debris[1].at(0).find("/0002-B08-"), std::string::npos);
}

TEST(Debris, HoldsEachPieceThatARepairLeftOutWithItsReason) {
    const test::TemporaryFolder folder;
    DebrisFolder debris(folder.path().string());
    ReportedFile file = reported();
    ASSERT_TRUE(debris.write(file));
    ReportedChanges changes;
    for (const char* word : {"tail", "overlap"}) {
        ReportedRemoval removed{"tails", word, "it is in the way", {}, {}};
        removed.part.name = "F}1/a";
        removed.part.points = {{4e5, 0, -5}, {4e5 + 1, 0, -5}, {4e5, 1, -5}};
        removed.part.triangles = {{0, 1, 2}};
        changes.removed.push_back(removed);
    }
    CoordinateSystem crs;
    crs.stated = true;
    crs.z_positive = ZPositive::depth;
    ASSERT_TRUE(debris.write(changes, crs));
    const std::string start = folder.path().string() + "/";
    EXPECT_EQ(changes.removed[0].debris, (std::vector<std::string>{start + "0004-tail-F_1_a.vtp", start + "0004-tail-F_1_a.ts"}))
        << "numbers go on behind those of findings";
    EXPECT_EQ(changes.removed[1].debris.at(1), start + "0005-overlap-F_1_a.ts");
    for (const std::string& path : changes.removed[0].debris) {
        const auto back = load(path, {});
        ASSERT_TRUE(back) << path;
        ASSERT_EQ(back->objects.size(), 1u) << path;
        EXPECT_EQ(std::get<Surface>(back->objects[0]).points, changes.removed[0].part.points) << path;
        EXPECT_NE(test::read_file(path).find("it is in the way (tails)"), std::string::npos) << path;
    }
    EXPECT_NE(test::read_file(changes.removed[0].debris[1]).find("ZPOSITIVE Depth"), std::string::npos);
}

TEST(Debris, OfAnEarlierRunIsNotMixedWithNew) {
    const test::TemporaryFolder folder;
    test::write_file(folder / "notes.txt", "mine");
    EXPECT_TRUE(DebrisFolder(folder.path().string()).open()) << "other files do not matter";
    test::write_file(folder / "0007-B08-x.vtp", "old");
    const auto opened = DebrisFolder(folder.path().string()).open();
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.why().kind, FailureKind::unwritable);
    EXPECT_NE(opened.why().error.message.find("0007-B08-x.vtp"), std::string::npos);
    EXPECT_EQ(test::read_file(folder / "0007-B08-x.vtp"), "old");
    EXPECT_FALSE(DebrisFolder((folder / "notes.txt").string()).open());
}

TEST(Debris, NamesAreSafeForEverySystem) {
    EXPECT_EQ(debris_name(12, made("C04", Severity::error, {{"surface", "../../etc/p\xc3\xa4 \n?*", 1}})), "0012-C04-.._.._etc_p______");
    EXPECT_EQ(debris_name(12345, made("C04", Severity::error, {})), "12345-C04");
    EXPECT_LE(debris_name(1, made("C04", Severity::error, {{"surface", std::string(5000, 'x'), 1}})).size(), 80u);
}

}  // namespace
}  // namespace geomend
