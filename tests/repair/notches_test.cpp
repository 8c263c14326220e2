// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "made_boxes.h"
#include "support/program.h"

// Triangles that are missing at a border, next to another surface.

namespace geomend {
namespace {

using test::box_text;
using test::info;
using test::run_geomend;
using test::Sheet;
using test::TemporaryFolder;
using test::tsurf_text;
using test::write_file;

/// The text of a sheet without one of its triangles.
std::string text_without(const std::string& text, int triangle) {
    std::size_t at = text.find("TRGL");
    for (int t = 0; t < triangle; ++t) at = text.find("TRGL", at + 1);
    return text.substr(0, at) + text.substr(text.find('\n', at) + 1);
}

std::vector<double> volumes_of_regions(const std::string& file) {
    std::vector<double> volumes;
    const nlohmann::json all = info(file);
    for (const auto& region : all["brep"]["region_volumes"]) volumes.push_back(region.value("volume", -1.0));
    std::ranges::sort(volumes);
    return volumes;
}

/// Takes each triangle of a sheet out of a box with it, one at a time, and expects the volumes of the whole model again.
void expect_each_filled(const std::string& others, const Sheet& sheet, const std::vector<double>& right) {
    const TemporaryFolder folder;
    for (int t = 0; t < 2 * sheet.n * sheet.n; ++t) {
        write_file(folder / "in.ts", others + text_without(tsurf_text(sheet), t));
        const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml"});
        ASSERT_EQ(run.status, 0) << t << ":\n" << run.out << run.err;
        const auto volumes = volumes_of_regions(folder / "out.ml");
        ASSERT_EQ(volumes.size(), right.size()) << t;
        for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(volumes[i], right[i], 1e-9 * right[i]) << t;
    }
}

const Sheet across_the_box{"F", {5, 0, 0}, {0, 10, 0}, {0, 0, 10}, 4, "fault", {}};
const Sheet west_of_it{"H", {0, 0, 5}, {5, 0, 0}, {0, 10, 0}, 4, "top", {}};

TEST(Notches, ATriangleMissingAnywhereInTheSideOfABoxIsFilled) {
    const std::string box = box_text(), last = box.substr(box.rfind("GOCAD TSurf"));
    const Sheet top{"side_5", {0, 0, 10}, {10, 0, 0}, {0, 10, 0}, 4, "boundary", {}};
    ASSERT_EQ(tsurf_text(top), last);
    expect_each_filled(box.substr(0, box.size() - last.size()), top, {1000});
}

// The sides have points at the quarters of the edges of the top, which has its own at the thirds: only the cut joins them.
TEST(Notches, ATriangleMissingBesideSurfacesWithOtherPointsIsFilled) {
    const std::string box = box_text(), last = box.substr(box.rfind("GOCAD TSurf"));
    const Sheet top{"side_5", {0, 0, 10}, {10, 0, 0}, {0, 10, 0}, 3, "boundary", {}};
    expect_each_filled(box.substr(0, box.size() - last.size()), top, {1000});
}

// The horizon ends on the side of the box along an edge of the triangle that is missing there.
TEST(Notches, ATriangleMissingInASideAtTheEndOfAHorizonIsFilled) {
    const std::string box = box_text(), last = box.substr(box.rfind("GOCAD TSurf"));
    const Sheet top{"side_5", {0, 0, 10}, {10, 0, 0}, {0, 10, 0}, 4, "boundary", {}};
    Sheet wall = across_the_box;
    wall.role = "top";
    expect_each_filled(box.substr(0, box.size() - last.size()) + tsurf_text(wall), top, {500, 500});
}

TEST(Notches, ATriangleMissingInASteepHorizonThatPartsTheBoxIsFilled) {
    Sheet steep = across_the_box;
    steep.role = "top";
    expect_each_filled(box_text(), steep, {500, 500});
}

// Where H meets the south and the north of the box, its points stand between those of the sides, so that only the cut joins them.
TEST(Notches, ATriangleMissingInAHorizonThatEndsOnAFaultIsFilled) {
    expect_each_filled(box_text() + tsurf_text(across_the_box), west_of_it, {250, 250, 500});
}

TEST(Notches, WhatIsFilledIsNamedBySurfaceAndHoldsItsValues) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", box_text() + tsurf_text(across_the_box) + text_without(tsurf_text(west_of_it), 30));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--json"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("1 notch at a border closed in 'H' with 1 triangle"), std::string::npos) << run.out;
}

// A border that ends freely, as a fault's tip does, is no notch, whatever stands around it.
TEST(Notches, AFaultThatEndsInsideStaysAsItIs) {
    const TemporaryFolder folder;
    Sheet dying = across_the_box;
    dying.u = {0, 5, 0};
    write_file(folder / "in.ts", box_text() + text_without(tsurf_text(dying), 31));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--json"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(run.out.find("notch"), std::string::npos) << run.out;
}

}  // namespace
}  // namespace geomend
