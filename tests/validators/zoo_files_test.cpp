// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "formats/gocad/write_gocad.h"
#include "support/program.h"
#include "validators/zoo.h"

// The models with known answers as files, judged by the program itself: Gocad models with and without region lists, loose
// surfaces, and the tagged mesh and the model that the program writes from them.

namespace geomend {
namespace {

using namespace testing;
using nlohmann::json;

void write_as(const Dataset& data, const std::filesystem::path& path) {
    OutputSet files(path);
    const auto losses = path.extension() == ".ml" ? gocad::write_model3d(data, files, {}) : gocad::write_objects(data, files, {});
    ASSERT_TRUE(losses) << path;
    ASSERT_TRUE(files.commit()) << path;
}

std::set<std::string> codes_of_file(const json& report, const std::string& file) {
    std::set<std::string> codes;
    for (const json& one : report.at("files")) {
        if (one.at("file") != file) continue;
        for (const json& f : one.at("findings")) codes.insert(f.at("code"));
        codes.erase("F111");
        return codes;
    }
    return {"no such file"};
}

void expect_brep(const json& b, const Animal& animal, const std::string& file) {
    const Counts& known = animal.counts;
    EXPECT_EQ(b.at("corners"), known.corners) << file;
    EXPECT_EQ(b.at("lines"), known.lines) << file;
    EXPECT_EQ(b.at("surfaces"), known.surfaces) << file;
    EXPECT_EQ(b.at("regions"), known.regions) << file;
    EXPECT_EQ(b.at("interfaces"), known.interfaces) << file;
    EXPECT_EQ(b.at("contacts"), known.contacts) << file;
    EXPECT_EQ(b.at("internal_lines").at("region"), known.lines_in_regions) << file;
    EXPECT_EQ(b.at("internal_lines").at("surface"), known.lines_in_surfaces) << file;
    std::vector<double> volumes, wanted = animal.model.volumes;
    if (b.contains("region_volumes")) {
        for (const json& region : b.at("region_volumes")) volumes.push_back(region.at("volume"));
    }
    std::ranges::sort(volumes);
    std::ranges::sort(wanted);
    ASSERT_EQ(volumes.size(), wanted.size()) << file;
    for (std::size_t r = 0; r < volumes.size(); ++r) EXPECT_NEAR(volumes[r], wanted[r], 1e-9 * wanted[r]) << file;
}

class ZooFiles : public ::testing::TestWithParam<Species> {};

TEST_P(ZooFiles, AreJudgedAsTheyAreKnown) {
    const Animal animal = GetParam().make();
    const test::TemporaryFolder folder;
    write_as(animal.model.data, folder / "listed.ml");
    write_as(without_lists(animal.model.data), folder / "unlisted.ml");
    write_as(loose_surfaces(animal.model.data), folder / "loose.ts");
    std::vector<std::string> models{(folder / "listed.ml").string(), (folder / "unlisted.ml").string()};
    for (const char* name : {"tagged.msh", "again.ml"}) {
        const auto run = test::run_geomend({"convert", models[0], "-o", (folder / name).string()});
        ASSERT_EQ(run.status, 0) << name << ": " << run.err;
        models.push_back((folder / name).string());
    }
    std::vector<std::string> arguments{"info", "--json"};
    arguments.insert(arguments.end(), models.begin(), models.end());
    const auto info = json::parse(test::run_geomend(arguments).out, nullptr, false);
    ASSERT_EQ(info.size(), models.size());
    for (std::size_t i = 0; i < models.size(); ++i) expect_brep(info[i].at("brep"), animal, models[i]);

    arguments = {"validate", "--quiet", "--report", (folder / "report.json").string()};
    arguments.insert(arguments.end(), models.begin(), models.end());
    arguments.push_back((folder / "loose.ts").string());
    EXPECT_EQ(test::run_geomend(arguments).status, 0);
    const auto report = json::parse(test::read_file(folder / "report.json"), nullptr, false);
    ASSERT_TRUE(report.is_object());
    for (std::size_t i = 4; i < arguments.size(); ++i) {
        const bool is_listed = !arguments[i].ends_with("unlisted.ml") && !arguments[i].ends_with("loose.ts");
        EXPECT_EQ(codes_of_file(report, arguments[i]), is_listed ? animal.codes : animal.codes_of_unlisted()) << arguments[i];
    }
}

INSTANTIATE_TEST_SUITE_P(Models, ZooFiles, ::testing::ValuesIn(whole_zoo()), [](const auto& species) { return species.param.name; });

}  // namespace
}  // namespace geomend
