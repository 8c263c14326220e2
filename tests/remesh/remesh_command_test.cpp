// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// The command remesh as a user runs it.

namespace geomend {
namespace {

using nlohmann::json;
using test::run_geomend;
using test::TemporaryFolder;

std::string sample(const std::string& name) { return std::string(GEOMEND_SOURCE_DIR) + "/samples/" + name; }

json remesh(const std::string& in, const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> arguments{"remesh", in, "-o", out, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return json::parse(run_geomend(arguments).out, nullptr, false);
}

TEST(Remesh, RegionsOfOneNameAreComparedWithThemselves) {
    const TemporaryFolder folder;
    std::string text = test::read_file(sample("layered_box.ml"));
    for (const char* name : {"west_1", "east_1", "west_2", "east_2", "west_3", "east_3"}) {
        const auto at = text.find(std::string("  ") + name, text.find("REGION"));
        ASSERT_NE(at, std::string::npos) << name;
        text.replace(at + 2, 6, "same");
    }
    test::write_file(folder / "same.ml", text);
    const auto run = run_geomend({"remesh", folder / "same.ml", "-o", folder / "out.ml", "--size", "60"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out.find("had the volume"), std::string::npos) << run.out;
    const auto filled = run_geomend({"mesh", folder / "same.ml", "-o", folder / "out.vtu"});
    EXPECT_NE(filled.out.find("in 6 regions written"), std::string::npos) << filled.out;
}

TEST(Remesh, ASampleKeepsItsCornersLinesSurfacesAndRegions) {
    const TemporaryFolder folder;
    const std::string out = folder / "out.ml";
    const json report = remesh(sample("layered_box.ml"), out, {"--size", "60"});
    ASSERT_TRUE(report.is_object() && report["written"] == true);
    const json before = test::info(sample("layered_box.ml"))["brep"], after = test::info(out)["brep"];
    for (const char* what : {"corners", "lines", "surfaces", "regions", "interfaces", "contacts"})
        EXPECT_EQ(before[what], after[what]) << what;
    EXPECT_GT(after["triangles"].get<std::uint64_t>(), before["triangles"].get<std::uint64_t>());
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
    EXPECT_GT(report["models"][0]["after"]["mean_quality"].get<double>(), 0.9);
}

TEST(Remesh, ASizeLargerThanTheModelDoesNotMeltItDown) {
    const TemporaryFolder folder;
    const std::string out = folder / "out.ml";
    const json report = remesh(sample("layered_box.ml"), out, {"--size", "1e6"});
    ASSERT_TRUE(report.is_object() && report["written"] == true);
    std::map<std::string, double> before;
    const json in = test::info(sample("layered_box.ml")), remeshed = test::info(out);
    for (const json& r : in["brep"]["region_volumes"]) before[r["name"]] = r["volume"];
    ASSERT_EQ(remeshed["brep"]["region_volumes"].size(), before.size());
    for (const json& r : remeshed["brep"]["region_volumes"])
        EXPECT_NEAR(r["volume"].get<double>(), before.at(r["name"]), 0.05 * before.at(r["name"])) << r["name"];
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
}

TEST(Remesh, ASizeOfASurfaceThatIsNotThereIsNamedWithTheNearest) {
    const TemporaryFolder folder;
    const auto run = run_geomend({"remesh", sample("layered_box.ml"), "-o", folder / "out.ml", "--size", "60", "--size-of", "fautl=3"});
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("'fault'"), std::string::npos) << run.err;
}

TEST(Remesh, ASizeThatMakesTooManyTrianglesIsRefusedAtOnce) {
    const TemporaryFolder folder;
    for (const char* command : {"remesh", "mesh"}) {
        const auto run =
            run_geomend({command, sample("layered_box.ml"), "-o", folder / "out.ml", "--size", "1e-6", "--method", "isotropic", "--lossy"});
        EXPECT_EQ(run.status, 5);
        EXPECT_NE(run.err.find(*command == 'r' ? "triangles" : "cells"), std::string::npos) << run.err;
        EXPECT_NE(run.err.find("choose larger sizes"), std::string::npos) << run.err;
    }
}

TEST(Remesh, SizesOfOneInterfaceAreSmallerThere) {
    const TemporaryFolder folder;
    const auto triangles = [](const json& report, const std::string& interface) {
        std::uint64_t sum = 0;
        for (const json& s : report["models"][0]["surfaces"]) {
            if (s["interface"] == interface) sum += s["after"]["triangles"].get<std::uint64_t>();
        }
        return sum;
    };
    const json even = remesh(sample("layered_box.ml"), folder / "even.ml", {"--size", "100"});
    const json graded = remesh(sample("layered_box.ml"), folder / "graded.ml", {"--size", "100", "--size-of", "fault=40"});
    ASSERT_TRUE(even["written"] == true && graded["written"] == true);
    EXPECT_GT(triangles(graded, "fault"), 3 * triangles(even, "fault"));
    EXPECT_LT(triangles(graded, "west"), 2 * triangles(even, "west"));
}

TEST(Remesh, SizesByDistanceCurvatureAndProperty) {
    const TemporaryFolder folder;
    const auto triangles = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"--size", "100"};
        words.insert(words.end(), more.begin(), more.end());
        const json report = remesh(sample("layered_box.ml"), folder / "out.ml", words);
        EXPECT_TRUE(report.is_object() && report["written"] == true);
        return report.is_object() ? report["models"][0]["after"]["triangles"].get<double>() : 0;
    };
    const double even = triangles({}), near = triangles({"--size-by", "distance=fault:30"}),
                 thick = triangles({"--size-by", "distance=fault:30:200"}), one = triangles({"--size-of", "fault=30"});
    EXPECT_GT(near, one);  // other surfaces are finer beside the fault, too
    EXPECT_GT(near, 1.5 * even);
    EXPECT_GT(thick, 1.5 * near);
    EXPECT_EQ(triangles({"--size-by", "curvature=20"}), even);  // all is flat
    for (const char* wrong : {"distance=fault", "distance=fault:0", "distance=fault:10:5:1", "distance=fautl:10", "property=x:1",
                              "property=none:1:2", "curvature=0", "size=3", "x"}) {
        const auto run = run_geomend({"remesh", sample("layered_box.ml"), "-o", folder / "out.ml", "--size", "60", "--size-by", wrong});
        EXPECT_EQ(run.status, 2) << wrong;
    }
}

TEST(Remesh, EdgesOfABoxThatIsOneSurfaceStaySharp) {
    const auto in = test::real_data("gocad/split_cube.ml");
    if (!in) GTEST_SKIP() << "the real files are not there";
    const TemporaryFolder folder;
    const std::string out = folder / "out.ml";
    const json report = remesh(in->string(), out, {"--size", "0.1"});
    ASSERT_TRUE(report.is_object() && report["written"] == true);
    EXPECT_LT(report["models"][0]["distance"]["hausdorff"].get<double>(), 1e-12);
    for (const json& s : report["models"][0]["surfaces"]) EXPECT_FALSE(s.contains("kept")) << s;
    const json remeshed = test::info(out);
    ASSERT_EQ(remeshed["brep"]["region_volumes"].size(), 2u);
    for (const json& region : remeshed["brep"]["region_volumes"])
        EXPECT_NEAR(region["volume"].get<double>(), region["name"] == "Top" ? 0.3 : 0.7, 1e-12);
}

TEST(Remesh, CornersThatOnlyATouchMakesStayTheSame) {
    const auto in = test::real_data("gocad/CloudSpin_fixed.ml");
    if (!in) GTEST_SKIP() << "the real files are not there";
    const TemporaryFolder folder;
    const json report = remesh(in->string(), folder / "out.ml", {"--size", "400"});
    ASSERT_TRUE(report.is_object() && report["written"] == true);
    EXPECT_EQ(report["models"][0]["entities"], report["models"][0]["entities_after"]);
}

TEST(Remesh, TheResultDoesNotDependOnTheNumberOfThreads) {
    const TemporaryFolder folder;
    const std::string one = folder / "one.ml", two = folder / "two.ml";
    remesh(sample("layered_box.ml"), one, {"--size", "50", "--threads", "1"});
    remesh(sample("layered_box.ml"), two, {"--size", "50", "--threads", "4"});
    EXPECT_EQ(test::read_file(one), test::read_file(two));
}

TEST(Remesh, MeshGivesSurfacesNewTrianglesFirstWhereItIsAskedTo) {
    const TemporaryFolder folder;
    const auto run =
        run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "out.vtu", "--size", "60", "--method", "isotropic", "--json"});
    const json report = json::parse(run.out, nullptr, false);
    ASSERT_TRUE(report.is_object() && report["written"] == true) << run.err;
    EXPECT_GT(report["remesh"]["models"][0]["after"]["mean_quality"].get<double>(), 0.9);
    EXPECT_EQ(run_geomend({"validate", folder / "out.vtu"}).status, 0);
    EXPECT_EQ(run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "no.vtu", "--method", "isotropic"}).status, 2);
}

TEST(Remesh, WrongOptionsAreRefused) {
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--size", "0"},
                                                  {"--size", "-1"},
                                                  {"--size", "10", "--max-distance", "0"},
                                                  {"--size", "10", "--size-of", "fault"},
                                                  {"--size", "10", "--size-of", "fault=x"},
                                                  {"--size", "10", "--sites", "100"},
                                                  {"--sites", "0"},
                                                  {"--size", "10", "--max-triangles", "-1"},
                                                  {"--size", "10", "--max-triangles", "0"},
                                                  {"--size", "10", "--method", "keep"},
                                                  {"--size", "10", "--method", "best"},
                                                  {}}) {
        std::vector<std::string> arguments{"remesh", sample("layered_box.ml"), "-o", "/dev/null"};
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run_geomend(arguments).status, 2);
    }
}

TEST(Remesh, ASizeOfTooManyTrianglesIsRefusedWithOneThatDoes) {
    const TemporaryFolder folder;
    const auto run = [&](const std::string& size) {
        return run_geomend({"remesh", sample("layered_box.ml"), "-o", folder / "out.ml", "--size", size, "--max-triangles", "3000"});
    };
    const auto refused = run("1e-9");
    EXPECT_EQ(refused.status, 5) << refused.err;
    const std::string before = "3000 are allowed: edges of ";
    const auto at = refused.err.find(before);
    ASSERT_NE(at, std::string::npos) << refused.err;
    const std::string offered = refused.err.substr(at + before.size(), refused.err.find(' ', at + before.size()) - at - before.size());
    EXPECT_EQ(run(offered).status, 0) << offered;
    const auto by_rule =
        run_geomend({"remesh", sample("layered_box.ml"), "-o", folder / "out.ml", "--size", "50", "--size-by", "distance=fault:1e-6"});
    EXPECT_EQ(by_rule.status, 5) << by_rule.err;
    EXPECT_NE(by_rule.err.find(" times as large make fewer"), std::string::npos) << by_rule.err;
}

TEST(Remesh, ModelA1KeepsItsEntitiesAndItsTrianglesBecomeEquilateral) {
    const TemporaryFolder folder;
    const auto in = test::real_data("gocad/modelA1.ml");
    if (!in) GTEST_SKIP() << "the real files are not there";
    const std::string out = folder / "out.ml";
    const json report = remesh(in->string(), out, {"--size", "300"});
    ASSERT_TRUE(report.is_object() && report["written"] == true);
    const json& model = report["models"][0];
    EXPECT_EQ(model["entities"], model["entities_after"]);
    EXPECT_LE(model["distance"]["hausdorff"].get<double>(), model["max_distance"].get<double>());
    EXPECT_GT(model["after"]["above_30"].get<double>(), 0.98);
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
}

TEST(Remesh, CentroidsKeepTheModelAndMakeBetterTriangles) {
    const TemporaryFolder folder;
    const std::string out = folder / "out.ml";
    const json even = remesh(sample("layered_box.ml"), folder / "even.ml", {"--size", "60", "--growth", "0.1"});
    const json report = remesh(sample("layered_box.ml"), out, {"--size", "60", "--method", "cvt"});
    ASSERT_TRUE(report.is_object() && report["written"] == true && even["written"] == true);
    const json &after = report["models"][0]["after"], &other = even["models"][0]["after"];
    EXPECT_EQ(report["models"][0]["entities"], report["models"][0]["entities_after"]);
    EXPECT_GT(after["mean_quality"].get<double>(), other["mean_quality"].get<double>() + 0.005);
    EXPECT_LE(report["models"][0]["distance"]["hausdorff"].get<double>(), report["models"][0]["max_distance"].get<double>());
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
}

TEST(Remesh, FrontsKeepTheModelAndMakeBetterTriangles) {
    const TemporaryFolder folder;
    const std::string out = folder / "out.ml";
    const json even = remesh(sample("layered_box.ml"), folder / "even.ml", {"--size", "40"});
    const json report = remesh(sample("layered_box.ml"), out, {"--size", "40", "--method", "frontal"});
    ASSERT_TRUE(report.is_object() && report["written"] == true && even["written"] == true);
    const json &after = report["models"][0]["after"], &other = even["models"][0]["after"];
    EXPECT_EQ(report["models"][0]["entities"], report["models"][0]["entities_after"]);
    EXPECT_GT(after["mean_quality"].get<double>(), other["mean_quality"].get<double>());
    EXPECT_GE(after["above_30"].get<double>(), 0.99);
    EXPECT_LE(report["models"][0]["distance"]["hausdorff"].get<double>(), report["models"][0]["max_distance"].get<double>());
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
    const auto filled = run_geomend({"mesh", sample("layered_box.ml"), "-o", folder / "out.vtu", "--size", "80", "--method", "frontal"});
    EXPECT_EQ(filled.status, 0) << filled.err;
}

TEST(Remesh, ANumberOfSitesIsThatOfVerticesInsideOfSurfaces) {
    const TemporaryFolder folder;
    for (const std::string method : {"isotropic", "cvt"}) {
        const json report = remesh(sample("layered_box.ml"), folder / "out.ml", {"--sites", "3000", "--method", method});
        ASSERT_TRUE(report.is_object() && report["written"] == true);
        EXPECT_NEAR(report["models"][0]["vertices"]["inside"].get<double>(), 3000, 150) << method;
        EXPECT_GT(report["size"].get<double>(), 0) << method;
    }
}

TEST(Remesh, FewSitesAreReachedWhereOnlyMuchLargerSizesGiveThem) {
    const TemporaryFolder folder;
    for (const std::string method : {"isotropic", "cvt"}) {
        for (const int sites : {50, 60, 100, 200}) {
            const auto run = run_geomend({"remesh", sample("layered_box.ml"), "-o", folder / "out.ml", "--json", "--lossy", "--method",
                                          method, "--sites", std::to_string(sites)});
            const json report = json::parse(run.out, nullptr, false);
            ASSERT_TRUE(report.is_object()) << run.err;
            EXPECT_NEAR(report["models"][0]["vertices"]["inside"].get<double>(), sites, 0.1 * sites) << method;
            EXPECT_EQ(report["sites"]["asked"], sites);
            EXPECT_EQ(report["sites"]["reached"], report["models"][0]["vertices"]["inside"]);
            EXPECT_EQ(run.err.find("--sites"), std::string::npos) << run.err;
        }
    }
}

TEST(Remesh, ANumberOfSitesThatCannotBeReachedIsReported) {
    const TemporaryFolder folder;
    const auto run = run_geomend({"remesh", sample("layered_box.ml"), "-o", folder / "out.ml", "--sites", "100", "--size-of", "fault=20"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.err.find("--sites 100: the nearest that was found are"), std::string::npos) << run.err;
    EXPECT_NE(run.out.find(" vertices inside of surfaces, of 100 asked for"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("edges of "), std::string::npos) << run.out;
}

TEST(Remesh, KeepLeavesAllTriangles) {
    const TemporaryFolder folder;
    const json report = remesh(sample("layered_box.ml"), folder / "out.ml", {"--method", "keep"});
    ASSERT_TRUE(report.is_object() && report["written"] == true);
    EXPECT_EQ(report["models"][0]["before"]["triangles"], report["models"][0]["after"]["triangles"]);
    EXPECT_EQ(report["models"][0]["before"]["mean_quality"], report["models"][0]["after"]["mean_quality"]);
}

// J. Pellerin (2014), table 4.2: Cloudspin with 5,000 and 10,000 sites, of which this model is a neighbouring version: with no more
// triangles. Distances are by the diagonal that the table states.
TEST(Remesh, CentroidsOnCloudSpinAreAsGoodAsThoseOfTheThesis) {
    struct Row {
        const char* sites;
        double triangles, shape, small_angles, hausdorff;
    };
    const auto in = test::real_data("gocad/CloudSpin_fixed.ml");
    if (!in) GTEST_SKIP() << "the real files are not there";
    const TemporaryFolder folder;
    for (const Row& row : {Row{"5500", 16'494, 0.82, 0.0352, 0.0077}, Row{"10000", 28'725, 0.85, 0.0225, 0.006}}) {
        SCOPED_TRACE(row.sites);
        const json report = remesh(in->string(), folder / "out.ml", {"--sites", row.sites, "--method", "cvt", "--lossy"});
        ASSERT_TRUE(report.is_object() && report["written"] == true);
        const json& model = report["models"][0];
        EXPECT_EQ(model["entities"], model["entities_after"]);
        EXPECT_LE(model["after"]["triangles"].get<double>(), row.triangles);
        EXPECT_GE(model["after"]["mean_shape"].get<double>(), row.shape);
        EXPECT_LE(model["after"]["small_angles"].get<double>(), row.small_angles);
        EXPECT_LE(model["distance"]["hausdorff"].get<double>(), row.hausdorff * 19'339.7);
    }
}

TEST(Remesh, NoSurfaceOfTheRealModelsStaysAsItWasAndAnglesAreLargeWhereLinesAllow) {
    const TemporaryFolder folder;
    const std::vector<std::pair<std::string, std::string>> models{{"gocad/modelA1.ml", "486"},
                                                                  {"gocad/modelA4.ml", "486"},
                                                                  {"gocad/split_cube.ml", "0.0433"},
                                                                  {"gocad/CloudSpin_fixed.ml", "576"},
                                                                  {"ringmesh/corbieres.gm", "95"}};
    for (const auto& [file, size] : models) {
        SCOPED_TRACE(file);
        const auto in = test::real_data(file);
        if (!in) GTEST_SKIP() << "the real files are not there";
        const json report = remesh(in->string(), folder / "out.ml", {"--size", size, "--lossy"});
        ASSERT_TRUE(report.is_object() && report["written"] == true);
        const json& model = report["models"][0];
        for (const json& surface : model["surfaces"]) EXPECT_FALSE(surface.contains("kept")) << surface["name"];
        const double all = model["after"]["triangles"], above = model["after"]["above_30"].get<double>() * all,
                     forced = model["after"]["below_30_between_lines"];
        EXPECT_GE((above + forced) / all, 0.99);
        EXPECT_GE(model["after"]["mean_quality"].get<double>(), 0.9);
        EXPECT_LE(model["distance"]["hausdorff"].get<double>(), model["max_distance"].get<double>());
    }
}

}  // namespace
}  // namespace geomend
