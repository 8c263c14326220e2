// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/program.h"

// info and convert with --option as=brep: the model that validate finds in loose surfaces, or in a grid.

namespace geomend::test {
namespace {

using nlohmann::json;

std::string sample(const std::string& name) { return std::string(GEOMEND_SOURCE_DIR) + "/samples/" + name; }

std::vector<double> volumes_of(const json& info) {
    std::vector<double> all;
    if (!info.contains("brep")) return all;
    for (const json& r : info["brep"]["region_volumes"]) all.push_back(r["volume"]);
    std::ranges::sort(all);
    return all;
}

/// The surfaces of the sealed sample, without its model.
std::string loose_surfaces(const TemporaryFolder& folder) {
    const std::string file = folder / "loose.ts";
    EXPECT_EQ(run_geomend({"convert", sample("layered_box.ml"), "-o", file, "--lossy"}).status, 0);
    return file;
}

TEST(FoundModels, InfoShowsTheModelOfLooseSurfacesWhenAsked) {
    const TemporaryFolder folder;
    const std::string loose = loose_surfaces(folder);
    EXPECT_FALSE(info(loose).contains("brep"));
    const json found = info(loose, {"--option", "as=brep"});
    ASSERT_TRUE(found.contains("brep"));
    EXPECT_EQ(found["brep"]["found"], true);
    const auto wanted = volumes_of(info(sample("layered_box.ml"))), got = volumes_of(found);
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], wanted[i], 1e-9 * wanted[i]);
    EXPECT_NE(run_geomend({"info", loose, "--option", "as=brep"}).out.find("(found, not stated)"), std::string::npos);
}

TEST(FoundModels, ConvertStatesTheModelOfLooseSurfacesWhenAsked) {
    const TemporaryFolder folder;
    const std::string loose = loose_surfaces(folder);
    for (const char* extension : {".ml", ".vtm", ".msh"}) {
        const std::string out = folder / (std::string("stated") + extension);
        const auto run = run_geomend({"convert", loose, "-o", out, "--option", "as=brep"});
        ASSERT_EQ(run.status, 0) << extension << run.err;
        const auto wanted = volumes_of(info(sample("layered_box.ml"))), got = volumes_of(info(out));
        ASSERT_EQ(got.size(), wanted.size()) << extension;
        for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], wanted[i], 1e-9 * wanted[i]);
        EXPECT_EQ(run_geomend({"validate", out}).status, 0) << extension;
    }
    // Without it surfaces stay as they are, and where that cannot be, the option is named.
    ASSERT_EQ(run_geomend({"convert", loose, "-o", folder / "plain.vtm"}).status, 0);
    EXPECT_FALSE(info(folder / "plain.vtm").contains("brep"));
    const auto refused = run_geomend({"convert", loose, "-o", folder / "plain.ml"});
    EXPECT_EQ(refused.status, 4);
    EXPECT_NE(refused.err.find("--option as=brep"), std::string::npos) << refused.err;
}

TEST(FoundModels, InfoShowsTheModelOfAGridWhenAsked) {
    const std::string grid = sample("faulted_grid.grdecl");
    EXPECT_FALSE(info(grid).contains("brep"));
    const json found = info(grid, {"--option", "as=brep", "--option", "horizons=2"});
    ASSERT_TRUE(found.contains("brep"));
    EXPECT_GE(found["brep"]["regions"], 2);
    EXPECT_EQ(run_geomend({"info", grid, "--option", "as=nothing"}).status, 2);
}

TEST(FoundModels, LayersAreListedWithTheirRegionsAndVolumes) {
    const json brep = info(sample("layered_box.ml"))["brep"];
    ASSERT_EQ(brep["layer_list"].size(), 3u);
    std::map<std::string, double> volume;
    for (const json& r : brep["region_volumes"]) volume[r["name"]] = r["volume"];
    for (const json& layer : brep["layer_list"]) {
        double sum = 0;
        ASSERT_EQ(layer["regions"].size(), 2u);
        for (const json& region : layer["regions"]) sum += volume.at(region);
        EXPECT_NEAR(layer["volume"], sum, 1e-6);
    }
    const std::string text = run_geomend({"info", sample("layered_box.ml")}).out;
    EXPECT_NE(text.find("volume (m3)"), std::string::npos) << text;
    EXPECT_NE(text.find("west_1, east_1"), std::string::npos) << text;
}

}  // namespace
}  // namespace geomend::test
