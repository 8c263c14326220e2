// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "base/vectors.h"
#include "fault_blocks.h"
#include "made_boxes.h"
#include "repair/surface_driver.h"
#include "repair/surface_edits.h"
#include "support/program.h"
#include "support/seeds.h"
#include "validators/registry.h"

// Surfaces of sealed models that are moved, replaced, added and removed by recipe.

namespace geomend {
namespace {

using repair::EditQueue;
using repair::SurfaceEdit;
using test::Ending;
using test::run_geomend;
using test::TemporaryFolder;
using test::write_file;

const std::string layered_box = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml";

std::string move_recipe(const std::string& surface, const std::string& by) {
    return "[[edit]]\naction = \"move\"\nsurface = \"" + surface + "\"\nby = [" + by + "]\n";
}

std::vector<int> sizes(const nlohmann::json& brep) {
    std::vector<int> all;
    for (const char* key : {"corners", "lines", "surfaces", "regions"}) all.push_back(brep[key].get<int>());
    return all;
}

std::map<std::string, double> region_volumes(const nlohmann::json& brep) {
    std::map<std::string, double> volumes;
    for (const auto& region : brep["region_volumes"]) volumes[region["name"].get<std::string>()] = region["volume"].get<double>();
    return volumes;
}

double sum_of(const std::map<std::string, double>& volumes) {
    double sum = 0;
    for (const auto& [name, volume] : volumes) sum += volume;
    return sum;
}

/// Runs a recipe and gives the result's model, or null.
nlohmann::json edited(const std::string& input, const std::string& recipe, const std::string& output, const TemporaryFolder& folder) {
    write_file(folder / "recipe.toml", recipe);
    const auto run = run_geomend({"repair", input, "--recipe", folder / "recipe.toml", "-o", output});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    return run.status == 0 ? test::info(output)["brep"] : nlohmann::json();
}

// Two regions that become one: the larger by volume gives its name, though the other one has most of the border, which is rough there.
TEST(EditRegions, ThatBecomeOneHaveTheNameOfTheLargerOne) {
    const TemporaryFolder folder;
    std::string box = test::box_text();
    const std::size_t bottom = box.find("GOCAD", box.find("name: side_3")), top = box.find("GOCAD", bottom + 1);
    test::Sheet rough{"side_4", {0, 0, 0}, {0, 10, 0}, {10, 0, 0}, 20, "boundary", [](const Vec3& p) {
                          const bool inside = p[0] > 0.1 && p[0] < 9.9 && p[1] > 0.1 && p[1] < 9.9;
                          const bool odd = (std::lround(2 * p[0]) + std::lround(2 * p[1])) % 2 != 0;
                          return Vec3{p[0], p[1], inside ? (odd ? 1.0 : -1.0) : 0.0};
                      }};
    box = box.substr(0, bottom) + test::tsurf_text(rough) + box.substr(top);
    write_file(folder / "in.ts", box + test::tsurf_text(test::level("H", 3)));
    ASSERT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "two.ml"}).status, 0);
    const auto two = region_volumes(test::info(folder / "two.ml")["brep"]);
    ASSERT_EQ(two.size(), 2u);
    const auto larger = std::ranges::max_element(two, {}, [](const auto& r) { return r.second; });
    ASSERT_NEAR(larger->second, 700, 1);
    const auto one =
        region_volumes(edited(folder / "two.ml", "[[edit]]\naction = \"remove\"\nsurface = \"H\"\n", folder / "one.ml", folder));
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one.begin()->first, larger->first);
}

// N. Euler's acceptance test 26.
TEST(EditQueue, TakesTheHighestPriorityFirstAndEqualOnesAsTheyCame) {
    const auto edit = [](const char* name) { return SurfaceEdit{SurfaceEdit::remove, name, {}, {}, {}, {}}; };
    EditQueue queue;
    EXPECT_TRUE(queue.push(edit("five"), 5));
    EXPECT_TRUE(queue.push(edit("seven"), 7));
    EXPECT_TRUE(queue.push(edit("five again"), 5));
    EXPECT_TRUE(queue.push(edit("six"), 6));
    EXPECT_FALSE(queue.push(edit("five"), 5)) << "the same one waits already";
    EXPECT_EQ(queue.pop().surface, "seven");
    EXPECT_EQ(queue.pop().surface, "six");
    EXPECT_FALSE(queue.push(edit("late"), 7)) << "what is being done cannot ask for what comes before it";
    EXPECT_FALSE(queue.push(edit("seven"), 7)) << "it is done";
    EXPECT_TRUE(queue.push(edit("late"), 6));
    EXPECT_EQ(queue.pop().surface, "late");
    EXPECT_EQ(queue.pop().surface, "five");
    EXPECT_EQ(queue.pop().surface, "five again");
    EXPECT_TRUE(queue.empty());
}

// Test 28, and the recipe that users are shown.
TEST(Edits, ALoweredHorizonLeavesASealedModelWithoutAScarAndComesBack) {
    const TemporaryFolder folder;
    const auto before = test::info(layered_box)["brep"];
    const auto lower = edited(layered_box, move_recipe("H2", "0, 0, -20"), folder / "lower.ml", folder);
    ASSERT_FALSE(lower.is_null());
    EXPECT_EQ(sizes(lower), sizes(before));
    const auto was = region_volumes(before), is = region_volumes(lower);
    EXPECT_NEAR(sum_of(is), 8e8, 1e-3);
    for (const auto& [name, volume] : was) {
        ASSERT_TRUE(is.contains(name)) << name;
        const double grown = is.at(name) - volume;
        if (name.ends_with("_1")) {
            EXPECT_NEAR(grown, 0, 1e-6 * volume) << "above H1 nothing changes";
        } else {
            EXPECT_GT(name.ends_with("_2") ? grown : -grown, 20 * 350 * 800) << "what lies between grew by 20 m";
        }
    }
    const auto again = edited(folder / "lower.ml", move_recipe("H2", "0, 0, 20"), folder / "again.ml", folder);
    ASSERT_FALSE(again.is_null());
    EXPECT_EQ(sizes(again), sizes(before));
    for (const auto& [name, volume] : region_volumes(again)) EXPECT_NEAR(volume, was.at(name), 1e-6 * volume) << name;
}

using Points = std::set<std::array<double, 3>>;

/// All nodes of a Model3d, or those of the faces of one surface. Its faces come with the number that their TFACE record gives them.
Points points_of(const std::string& file, const std::string& surface = {}) {
    std::map<std::string, std::set<std::string>> faces;
    std::map<std::string, std::array<double, 3>> node;
    std::string current, face;
    Points points;
    int count = 0;
    std::istringstream lines(test::read_file(file));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string key, a, b, c;
        words >> key >> a >> b >> c;
        if (key == "TFACE" && !c.empty()) faces[c].insert(a);
        else if (key == "TFACE") face = std::to_string(++count);
        const bool wanted = surface.empty() || faces[surface].contains(face);
        if (key == "VRTX" || key == "PVRTX") {
            std::istringstream again(line);
            auto& p = node[a];
            again >> key >> a >> p[0] >> p[1] >> p[2];
            if (wanted) points.insert(p);
        } else if (key == "ATOM" || key == "PATOM") {
            node[a] = node[b];
            if (wanted) points.insert(node[a]);
        }
    }
    return points;
}

TEST(Edits, NothingIsLeftWhereTheHorizonEndedOnTheOthers) {
    const TemporaryFolder folder;
    ASSERT_FALSE(edited(layered_box, move_recipe("H2", "0, 0, -20"), folder / "lower.ml", folder).is_null());
    const Points old = points_of(layered_box, "H2"), now = points_of(folder / "lower.ml");
    ASSERT_GT(old.size(), 30u);
    EXPECT_GT(now.size(), old.size());
    for (const auto& p : old) EXPECT_FALSE(now.contains(p)) << p[0] << ' ' << p[1] << ' ' << p[2];
}

TEST(Edits, EverySurfaceOfTheBoxCanBeMovedInAnyDirection) {
    const TemporaryFolder folder;
    const auto before = test::info(layered_box)["brep"];
    const std::map<std::string, double> growth = {{"top", 3. / 1000},
                                                  {"bottom", -3. / 1000},
                                                  {"west", -14. / 1000},
                                                  {"east", 14. / 1000},
                                                  {"south", -5. / 800},
                                                  {"north", 5. / 800},
                                                  {"fault", 0},
                                                  {"H1", 0},
                                                  {"H2", 0}};
    for (const auto& [surface, share] : growth) {
        const auto moved = edited(layered_box, move_recipe(surface, "14, 5, 3"), folder / "moved.ml", folder);
        ASSERT_FALSE(moved.is_null()) << surface;
        EXPECT_EQ(sizes(moved), sizes(before)) << surface;
        EXPECT_NEAR(sum_of(region_volumes(moved)), 8e8 * (1 + share), 1) << surface;
    }
}

TEST(Edits, ARemovedHorizonMakesOneRegionOfTwoAndSaysSo) {
    const TemporaryFolder folder;
    write_file(folder / "recipe.toml", "[[edit]]\naction = \"remove\"\nsurface = \"H2\"\n");
    const auto run = run_geomend({"repair", layered_box, "--recipe", folder / "recipe.toml", "-o", folder / "out.ml"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("regions lost"), std::string::npos) << run.out;
    const auto before = test::info(layered_box)["brep"], brep = test::info(folder / "out.ml")["brep"];
    EXPECT_EQ(brep["regions"], 4);
    const auto was = region_volumes(before), is = region_volumes(brep);
    EXPECT_NEAR(is.at("west_2"), was.at("west_2") + was.at("west_3"), 1);
    EXPECT_NEAR(is.at("east_2"), was.at("east_2") + was.at("east_3"), 1);
    EXPECT_EQ(test::read_file(folder / "out.ml").find("TSURF H2"), std::string::npos);
}

TEST(Edits, OneFaceIsMovedByItsNumberInTheFile) {
    const TemporaryFolder folder;
    const auto was = region_volumes(test::info(layered_box)["brep"]);
    const auto brep =
        edited(layered_box, "[[edit]]\naction = \"move\"\nsurface = \"H2\"\nface = 5\nby = [0, 0, -20]\n", folder / "out.ml", folder);
    ASSERT_FALSE(brep.is_null());
    const auto is = region_volumes(brep);
    EXPECT_GT(is.at("west_2"), was.at("west_2") + 20 * 350 * 800);
    for (const char* east : {"east_2", "east_3"}) EXPECT_NEAR(is.at(east), was.at(east), 1e-6 * was.at(east)) << east;
}

TEST(Edits, AReplacedHorizonIsBroughtOntoWhatTheOldOneEndedOn) {
    const TemporaryFolder folder;
    // Two planes that stop short of the fault and the box by up to 30 m, 50 m above the old horizon on average.
    std::string text;
    const auto plane = [&](double x0, double x1, double z) {
        const auto row = [&](int id, double x, double y) {
            text += "VRTX " + std::to_string(id) + " " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
        };
        text += "GOCAD TSurf 1\nHEADER {\nname: new\n}\nTFACE\n";
        row(1, x0, 10);
        row(2, x1, 10);
        row(3, x1, 790);
        row(4, x0, 790);
        text += "TRGL 1 2 3\nTRGL 1 3 4\nEND\n";
    };
    plane(10, 490, -650);
    plane(540, 985, -750);
    write_file(folder / "new.ts", text);
    const auto brep =
        edited(layered_box, "[[edit]]\naction = \"replace\"\nsurface = \"H2\"\nfile = \"" + (folder / "new.ts").string() + "\"\n",
               folder / "out.ml", folder);
    ASSERT_FALSE(brep.is_null());
    EXPECT_EQ(sizes(brep), sizes(test::info(layered_box)["brep"]));
    const auto is = region_volumes(brep);
    EXPECT_NEAR(sum_of(is), 8e8, 1e-2);
    // Below z the western block is x < 450 - z / 10, the eastern one the rest.
    const auto west_below = [](double z) { return 800 * ((450 * 1000 + 0.05 * 1e6) - (450 * -z + 0.05 * z * z)); };
    const auto east_below = [&](double z) { return 800 * 1000 * (1000 + z) - west_below(z); };
    EXPECT_NEAR(is.at("west_3"), west_below(-650), 1);
    EXPECT_NEAR(is.at("east_3"), east_below(-750), 1);
}

TEST(Edits, AnAddedHorizonPartsWhatItRunsThrough) {
    const TemporaryFolder folder;
    write_file(
        folder / "new.ts",
        "GOCAD TSurf 1\nHEADER {\nname: new\n}\nTFACE\nVRTX 1 -50 -50 -900\nVRTX 2 1050 -50 -900\nVRTX 3 1050 850 -900\nVRTX 4 -50 850 "
        "-900\nTRGL 1 2 3\nTRGL 1 3 4\nEND\n");
    const auto brep = edited(layered_box, "[[edit]]\naction = \"add\"\nsurface = \"H3\"\nfile = \"" + (folder / "new.ts").string() + "\"\n",
                             folder / "out.ml", folder);
    ASSERT_FALSE(brep.is_null());
    EXPECT_EQ(brep["regions"], 8);
    EXPECT_NEAR(sum_of(region_volumes(brep)), 8e8, 1e-2);
    EXPECT_NE(test::read_file(folder / "out.ml").find("TSURF H3"), std::string::npos);
}

TEST(Edits, WhatCannotBeDoneIsRefusedAndNothingIsWritten) {
    const TemporaryFolder folder;
    const auto status = [&](const std::string& recipe) {
        write_file(folder / "recipe.toml", recipe);
        const auto run = run_geomend({"repair", layered_box, "--recipe", folder / "recipe.toml", "-o", folder / "out.ml"});
        EXPECT_FALSE(std::filesystem::exists(folder / "out.ml")) << recipe;
        EXPECT_FALSE(run.err.empty()) << recipe;
        return run.status;
    };
    EXPECT_EQ(status(move_recipe("H7", "0, 0, -20")), 2);
    EXPECT_EQ(status(move_recipe("H2", "0, 0")), 2);
    EXPECT_EQ(status("[[edit]]\naction = \"lift\"\nsurface = \"H2\"\n"), 2);
    EXPECT_EQ(status("[[edit]]\naction = \"move\"\nsurface = \"H2\"\n"), 2);
    EXPECT_EQ(status("[[edit]]\nsurface = \"H2\"\n"), 2);
    EXPECT_EQ(status("[[edit]]\naction = \"remove\"\nsurface = \"H2\"\nby = [0, 0, 1]\n"), 2);
    EXPECT_EQ(status("[[edit]]\naction = \"add\"\nsurface = \"H3\"\n"), 2);
    EXPECT_EQ(status(move_recipe("H2", "0, 0, -20") + move_recipe("H2", "0, 0, -10")), 2);
    EXPECT_EQ(status(move_recipe("east", "-900, 0, 0")), 6) << "a side through the fault and the other side";
}

TEST(Edits, TheRecipeOfAnEditIsWrittenAndGivesTheSameBytes) {
    const TemporaryFolder folder;
    write_file(folder / "recipe.toml", move_recipe("H2", "0.5, 0.25, -20"));
    ASSERT_EQ(run_geomend({"repair", layered_box, "--recipe", folder / "recipe.toml", "-o", folder / "one.ml", "--write-recipe",
                           folder / "again.toml"})
                  .status,
              0);
    ASSERT_EQ(run_geomend({"repair", layered_box, "--recipe", folder / "again.toml", "-o", folder / "two.ml", "--threads", "2"}).status, 0);
    EXPECT_EQ(test::read_file(folder / "one.ml"), test::read_file(folder / "two.ml"));
}

struct Result {
    std::vector<double> volumes;
    std::string undone;
};

Result repaired(const Dataset& dataset, std::span<const SurfaceEdit> edits, Dataset* out) {
    const validators::CheckOptions checks;
    auto before = validators::check_models(dataset, checks);
    EXPECT_TRUE(before);
    repair::SurfaceDriverOptions options;
    options.steps.edits = edits;
    const auto plan = edits.empty() ? repair::plan_for(before->findings, false) : std::vector<std::string>{"edit"};
    auto done = repair::repair_surfaces(dataset, before->findings, plan, options);
    EXPECT_TRUE(done);
    Result result;
    for (const auto& region : done->result.brep->regions) result.volumes.push_back(region.volume);
    std::ranges::sort(result.volumes);
    for (const auto& step : done->steps) result.undone += step.kept ? "" : step.step + ": " + step.why;
    if (out != nullptr) *out = std::move(done->result.dataset);
    return result;
}

TEST(Edits, HorizonsBetweenPlanarFaultsMoveToTheVolumesOfTheHalfSpaces) {
    for (std::uint32_t seed = 1; seed <= test::seeds(12); ++seed) {
        const auto whole = test::fault_blocks(seed, Ending::exact);
        const double s = whole.size;
        for (const Vec3& by : {Vec3{0, 0, -0.01 * s}, Vec3{0.004 * s, -0.006 * s, 0.012 * s}}) {
            const auto made = test::fault_blocks(seed, Ending::exact, by);
            if (made.volumes.size() != whole.volumes.size()) continue;  // it would leave its block
            std::vector<SurfaceEdit> edits;
            for (const Object& object : made.dataset.objects) {
                const std::string& name = std::get<Surface>(object).info.name;
                if (name.starts_with("horizon_1_")) edits.push_back({SurfaceEdit::move, name, {}, {}, by, {}});
            }
            Dataset sealed;
            ASSERT_EQ(repaired(made.dataset, {}, &sealed).undone, "") << seed;
            const Result moved = repaired(sealed, edits, nullptr);
            EXPECT_EQ(moved.undone, "") << seed;
            ASSERT_EQ(moved.volumes.size(), made.volumes.size()) << seed;
            for (std::size_t i = 0; i < made.volumes.size(); ++i)
                EXPECT_NEAR(moved.volumes[i], made.volumes[i], 1e-6 * made.volumes[i]) << seed;
        }
    }
}

}  // namespace
}  // namespace geomend
