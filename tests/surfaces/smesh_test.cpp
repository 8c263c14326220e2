// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdlib>
#include <fstream>

#include "support/temporary_folder.h"
#include "surfaces/surface_files.h"

namespace geomend::test {
namespace {

const std::string nodes = "# first the nodes\n5 3 0 0\n0 0 0 0\n1 1 0 0\n2 1 1 0\n3 0 1 0\n4 0 0 1\n";

TEST(Smesh, EachMarkerIsASurface) {
    const Dataset data = good_surface("smesh", nodes + "# marker 2: Top bed\n2 1\n4 0 1 2 3 2\n3 0 1 4 7 # side\n0\n0\n");
    ASSERT_EQ(data.objects.size(), 2u);
    EXPECT_EQ(surface_at(data, 0).info.name, "Top bed");
    EXPECT_EQ(surface_at(data, 1).info.name, "surface 7");
    EXPECT_EQ(surface_at(data, 0).polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(surface_at(data, 1).points.size(), 3u);
    EXPECT_TRUE(data.findings.empty());
}

TEST(Smesh, PointsInHolesAndRegionsAreListed) {
    const Dataset data = good_surface("smesh", nodes + "1 0\n3 0 1 4\n1\n1 0.5 0.5 0.5\n2\n1 0 0 0 3 0.1\n2 1 1 1 4\n");
    ASSERT_EQ(data.objects.size(), 1u);
    ASSERT_EQ(data.losses.size(), 2u);
    EXPECT_EQ(data.losses[1].count, 2u);
}

TEST(Smesh, WhatIsDamagedIsRefusedWithItsLine) {
    for (const char* rest : {"", "1 1\n3 0 1 5 1\n", "1 1\n3 0 1\n", "9 1\n3 0 1 2 1\n", "1 1\n3 0 x 2 1\n"}) {
        const auto data = read_surface("smesh", nodes + rest);
        EXPECT_FALSE(data.ok()) << rest;
    }
    EXPECT_FALSE(read_surface("smesh", "4 2 0 0\n1 0 0\n").ok()) << "a plane";
}

/// The sides of a tetrahedron, three in one surface and one in another, each with points of its own.
Dataset closed() {
    Dataset data;
    Surface sides, base;
    sides.info.name = "sides";
    base.info.name = "base";
    sides.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    base.points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    for (const auto& t : {std::vector<std::uint32_t>{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) sides.polygons.push_back(t);
    base.polygons.push_back(std::vector<std::uint32_t>{0, 1, 2});
    data.objects.emplace_back(std::move(sides));
    data.objects.emplace_back(std::move(base));
    return data;
}

TEST(Smesh, BothFormsComeBackWithNamesAndOneNodeAPosition) {
    for (const char* extension : {".smesh", ".poly"}) {
        const TemporaryFolder folder;
        const std::filesystem::path path = folder / ("closed" + std::string(extension));
        OutputSet out(path);
        ASSERT_TRUE(surface_format("smesh").write(closed(), out, {}).ok());
        ASSERT_TRUE(out.commit().ok());
        EXPECT_TRUE(read_file(path).starts_with("4 3 0 0\n")) << extension;
        const auto input = Input::open(path.string());
        ASSERT_TRUE(input.ok());
        const auto back = surface_format("smesh").read(*input, {});
        ASSERT_TRUE(back.ok()) << back.why().error.message;
        ASSERT_EQ(back->objects.size(), 2u);
        EXPECT_EQ(surface_at(*back, 0).info.name, "sides");
        EXPECT_EQ(surface_at(*back, 1).info.name, "base");
        const Dataset before = closed();
        for (std::size_t s = 0; s < 2; ++s) {
            const Surface &own = surface_at(before, s), &read = surface_at(*back, s);
            ASSERT_EQ(read.polygons.corners.size(), own.polygons.corners.size());
            for (std::size_t c = 0; c < own.polygons.corners.size(); ++c)
                EXPECT_EQ(read.points[read.polygons.corners[c]], own.points[own.polygons.corners[c]]);
        }
        if (std::system("command -v tetgen > /dev/null 2>&1") != 0) continue;
        ASSERT_EQ(std::system(("tetgen -pQ " + path.string() + " > /dev/null 2>&1").c_str()), 0);
        EXPECT_TRUE(read_file(folder / "closed.1.ele").find_first_not_of(' ') == read_file(folder / "closed.1.ele").find('1'));
    }
}

}  // namespace
}  // namespace geomend::test
