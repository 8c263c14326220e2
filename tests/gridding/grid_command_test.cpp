// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// The command grid as a user runs it.

namespace geomend {
namespace {

using nlohmann::json;
using test::run_geomend;
using test::TemporaryFolder;

std::string sample(const std::string& name) { return std::string(GEOMEND_SOURCE_DIR) + "/samples/" + name; }

json make(const std::vector<std::string>& in, const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"grid"};
    arguments.insert(arguments.end(), in.begin(), in.end());
    arguments.insert(arguments.end(), {"-o", out, "--json"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return json::parse(run_geomend(arguments).out, nullptr, false);
}

std::vector<std::string> two_maps() { return {sample("top_map.irap"), sample("base_map.irap"), sample("top_faults.pol")}; }

TEST(Grid, ItsVolumeIsComparedWithMapsWhereTheyHaveValuesOnly) {
    const TemporaryFolder folder;
    for (const double depth : {1000.0, 1020.0}) {
        std::string text = "-996 5 10 10\n0 50 0 40\n6 0 0 0\n0 0 0 0 0 0 0\n";
        for (int n = 0; n < 30; ++n) text += (n == 14 || n == 15 ? "9999900" : std::to_string(depth)) + "\n";
        test::write_file(folder / (depth == 1000 ? "top.irap" : "base.irap"), text);
    }
    const json made = make({folder / "top.irap", folder / "base.irap"}, folder / "g.grdecl", {"--cells", "10x8", "--rotate", "0"});
    ASSERT_TRUE(made.is_object());
    const json& zone = made["zones"][0];
    EXPECT_GT(zone["map_volume"].get<double>(), 0.5 * 20 * 50 * 40);
    EXPECT_NEAR(zone["volume_where_maps"].get<double>() / zone["map_volume"].get<double>(), 1, 1e-9);
}

TEST(Grid, ARingThatSaysWhereTheGridIsIsNoFault) {
    const TemporaryFolder folder;
    for (const int depth : {1000, 1020}) {
        std::string text = "-996 9 10 10\n0 80 0 80\n9 0 0 0\n0 0 0 0 0 0 0\n";
        for (int n = 0; n < 81; ++n) text += std::to_string(depth + (n % 9) * (n % 9)) + "\n";
        test::write_file(folder / (depth == 1000 ? "top.irap" : "base.irap"), text);
    }
    test::write_file(folder / "ring.pol", "20 20 0\n60 20 0\n60 50 0\n20 50 0\n20 20 0\n999 999 999\n");
    const json made =
        make({folder / "top.irap", folder / "base.irap"}, folder / "g.grdecl", {"--cells", "8x6", "--area", folder / "ring.pol"});
    ASSERT_TRUE(made.is_object());
    EXPECT_EQ(made["faults"].size(), 0u);
    EXPECT_EQ(made["blocks"], 1);
    EXPECT_NEAR(made["zones"][0]["volume"].get<double>(), 20 * 40 * 30, 1e-6);
    test::write_file(folder / "point.pol", "40 30 0\n999 999 999\n");
    const json point = make({folder / "top.irap", folder / "base.irap", folder / "point.pol"}, folder / "p.grdecl", {"--cells", "8x6"});
    ASSERT_EQ(point["left_out"].size(), 1u) << "a line of one point was dropped silently";
    EXPECT_NE(point["left_out"][0]["why"].get<std::string>().find("single point"), std::string::npos);
}

TEST(Grid, MapsAndPolygonsMakeAGridWithoutErrorsInEveryFormat) {
    const TemporaryFolder folder;
    for (const char* extension : {".grdecl", ".egrid", ".roff", ".vtu", ".data"}) {
        const std::string out = folder / (std::string("out") + extension);
        std::vector<std::string> how{"--cells", "20x15", "--layers", "reservoir=proportional:4"};
        if (std::string(extension) == ".vtu") how.insert(how.end(), {"--option", "faces=conformal"});  // else cells hang at the fault
        const json made = make(two_maps(), out, how);
        ASSERT_TRUE(made.is_object()) << extension;
        EXPECT_EQ(made["dims"], json({20, 15, 4}));
        EXPECT_EQ(made["zones"][0]["name"], "reservoir");
        EXPECT_NEAR(made["zones"][0]["volume"].get<double>() / made["zones"][0]["map_volume"].get<double>(), 1, 0.005);
        ASSERT_EQ(made["faults"].size(), 1u);
        EXPECT_GT(made["faults"][0]["max_throw"].get<double>(), 35);
        EXPECT_LT(made["faults"][0]["max_throw"].get<double>(), 41);
        EXPECT_EQ(run_geomend({"validate", out}).status, 0) << extension;
    }
}

TEST(Grid, ASealedModelIsGriddedInItsBox) {
    const TemporaryFolder folder;
    const std::string out = folder / "box.grdecl";
    const json made = make({sample("layered_box.ml")}, out, {"--cells", "20x16", "--layers", "proportional:2"});
    ASSERT_TRUE(made.is_object());
    EXPECT_EQ(made["rotation"], 0);
    EXPECT_EQ(made["blocks"], 2);
    EXPECT_EQ(made["zones"].size(), 3u);
    double sum = 0;
    for (const json& zone : made["zones"]) sum += zone["volume"].get<double>();
    EXPECT_NEAR(sum, 8e8, 1);
    EXPECT_EQ(made["regions"].size(), 6u);
    EXPECT_EQ(made["faults"][0]["ends_on"].size(), 0u);
    EXPECT_NEAR(made["faults"][0]["max_throw"].get<double>(), 100, 15);  // the horizons wave, and the fault dips
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
}

TEST(Grid, WrongCommandLinesAreRefused) {
    const TemporaryFolder folder;
    const auto status = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"grid", sample("top_map.irap"), sample("base_map.irap"), "-o", folder / "x.grdecl"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_geomend(arguments).status;
    };
    EXPECT_EQ(status({}), 2);
    EXPECT_EQ(status({"--cells", "20"}), 2);
    EXPECT_EQ(status({"--cells", "20x0"}), 2);
    EXPECT_EQ(status({"--size", "10,-1"}), 2);
    EXPECT_EQ(status({"--cells", "20x15", "--layers", "up:3"}), 2);
    EXPECT_EQ(status({"--cells", "20x15", "--layers", "a=proportional:1,b=proportional:2"}), 2);
    EXPECT_EQ(status({"--cells", "20x15", "--horizons", "top_map,bottom_map"}), 2);
    EXPECT_EQ(status({"--cells", "20x15", "--fault-polygons", "nothing"}), 2);
    EXPECT_EQ(status({"--cells", "20x15", "--horizons", "top_map"}), 4);
    for (const char* angle : {"inf", "nan", "400"}) EXPECT_EQ(status({"--cells", "20x15", "--rotate", angle}), 2) << angle;
    EXPECT_EQ(status({"--cells", "20x15"}), 0);
}

TEST(Grid, PropertiesOfAMeshOfCellsComeAlong) {
    const TemporaryFolder folder;
    const std::string out = folder / "box.roff", mesh = sample("layered_box.so");
    const json all = make({sample("layered_box.ml")}, out, {"--cells", "10x8", "--layers", "proportional:2", "--properties-of", mesh});
    ASSERT_TRUE(all.is_object());
    ASSERT_EQ(all["properties"].size(), 2u) << all["properties"];  // porosity and permeability; regions are those of the model
    for (const json& property : all["properties"]) {
        EXPECT_EQ(property["without_value"], 0) << property;
        EXPECT_EQ(property["with_value"], all["active_cells"]);
    }
    const std::string name = all["properties"][1]["name"];
    const json one =
        make({sample("layered_box.ml")}, out, {"--cells", "10x8", "--properties-of", mesh, "--properties", name + "=harmonic"});
    ASSERT_EQ(one["properties"].size(), 1u);
    EXPECT_EQ(one["properties"][0]["method"], "harmonic");
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--properties-of", mesh, "--properties", "nothing"},
                                                  {"--properties-of", mesh, "--properties", name + "=most"},
                                                  {"--properties", name}}) {
        std::vector<std::string> arguments{"grid", sample("layered_box.ml"), "-o", out, "--cells", "10x8"};
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run_geomend(arguments).status, 2);
    }
}

/// A map in IRAP text with its heights multiplied and moved; what has none stays without.
void write_moved(const std::string& from, const std::string& to, double factor, double by) {
    std::ifstream in(from);
    std::ofstream out(to);
    out.precision(12);
    double value = 0;
    for (int n = 0; in >> value; ++n) {
        const bool is_height = n >= 19 && value < 9999000;  // the header has 19 numbers in lines of four and seven
        out << (is_height ? factor * value + by : value) << (n == 3 || n == 7 || n == 11 || n == 18 || n > 18 ? '\n' : ' ');
    }
}

TEST(Grid, WithoutActiveCellsAndLayersWithoutEndAreRefusedWithTheReason) {
    const TemporaryFolder folder;
    const std::string out = folder / "grid.grdecl";
    const auto refused = [&](std::vector<std::string> how) {
        std::vector<std::string> arguments{"grid", sample("layered_box.ml"), "-o", out, "--cells", "6x6"};
        arguments.insert(arguments.end(), how.begin(), how.end());
        return run_geomend(arguments);
    };
    const auto elsewhere = refused({"--area-box", "1e6,2e6,1e6,2e6"});
    EXPECT_EQ(elsewhere.status, 4);
    EXPECT_NE(elsewhere.err.find("no cell is active: horizon 'top' has no value where the grid lies, from x 1000000"), std::string::npos)
        << elsewhere.err;
    const auto endless = refused({"--layers", "from-top:1e-9"});
    EXPECT_EQ(endless.status, 2);
    EXPECT_NE(endless.err.find("e+11, more than 1000000"), std::string::npos) << endless.err;
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Grid, SuccessiveStepsKeepTheirCells) {
    const TemporaryFolder folder;
    const std::string first = folder / "first.grdecl";
    const std::vector<std::string> layers{"--layers", "from-top:10:5", "--option", "z=depth"};
    std::vector<std::string> how = layers;
    how.insert(how.end(), {"--cells", "20x15"});
    const json before = make(two_maps(), first, how);
    write_moved(sample("top_map.irap"), folder / "top_map.irap", 1.1, 150);
    write_moved(sample("base_map.irap"), folder / "base_map.irap", 1.1, 180);
    how = layers;
    how.insert(how.end(), {"--pillars-of", first});
    const json after = make({folder / "top_map.irap", folder / "base_map.irap", sample("top_faults.pol")}, folder / "second.grdecl", how);
    ASSERT_TRUE(before.is_object() && after.is_object());
    EXPECT_EQ(before["dims"], after["dims"]);
    EXPECT_EQ(before["blocks"], after["blocks"]);
    EXPECT_EQ(before["zones"][0]["last_layer"], after["zones"][0]["last_layer"]);
    ASSERT_EQ(before["faults"].size(), after["faults"].size());
    EXPECT_EQ(before["faults"][0]["faces"], after["faults"][0]["faces"]);
    EXPECT_NEAR(after["faults"][0]["max_throw"].get<double>() / before["faults"][0]["max_throw"].get<double>(), 1.1, 0.01);
}

TEST(Grid, CellsAreJoinedPastOthersWithoutThicknessWhereAsked) {
    const TemporaryFolder folder;
    std::ofstream sheets(folder / "wedge.ts");
    const auto sheet = [&](const char* name, double left, double right) {  // flat from x = 0 to 50, a plane from there to 100
        sheets << "GOCAD TSurf 1\nHEADER {\nname:" << name << "\n}\nTFACE\n";
        int n = 0;
        for (const double x : {0.0, 50.0, 100.0}) {
            for (const double y : {0.0, 40.0}) sheets << "VRTX " << ++n << ' ' << x << ' ' << y << ' ' << (x > 50 ? right : left) << '\n';
        }
        sheets << "TRGL 1 3 2\nTRGL 2 3 4\nTRGL 3 5 4\nTRGL 4 5 6\nEND\n";
    };
    sheet("a", -90, -90);
    sheet("b", -100, -100);
    sheet("c", -100, -110);
    sheet("d", -120, -120);
    sheets.close();
    for (const bool pinch : {false, true}) {
        std::vector<std::string> how{"--cells", "10x4", "--rotate", "0"};
        if (pinch) how.emplace_back("--pinch");
        const json made = make({folder / "wedge.ts"}, folder / "wedge.grdecl", how);
        ASSERT_TRUE(made.is_object());
        EXPECT_EQ(made["active_cells"], 100);  // 40 above, 20 in the wedge, 40 below
        std::ifstream file(folder / "wedge.grdecl");
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        EXPECT_EQ(text.find("\nPINCH\n") != std::string::npos, pinch);
        EXPECT_EQ(run_geomend({"validate", folder / "wedge.grdecl"}).status, 0);
    }
    const json beside = make({folder / "wedge.ts"}, folder / "wedge.egrid", {"--cells", "10x4", "--pinch"});
    ASSERT_TRUE(beside.is_object());
    std::ifstream include(beside["include"].get<std::string>());
    const std::string text{std::istreambuf_iterator<char>(include), {}};
    EXPECT_NE(text.find("PINCH"), std::string::npos);
}

TEST(Grid, PicturesAndAPageAreWritten) {
    const TemporaryFolder folder;
    const json made =
        make(two_maps(), folder / "a.egrid",
             {"--cells", "12x9", "--map", folder / "map.png", "--section", folder / "section.png", "--report", folder / "page.html"});
    ASSERT_TRUE(made.is_object());
    for (const char* name : {"map.png", "section.png", "page.html"}) {
        std::ifstream file(folder / name);
        std::string start(4, ' ');
        file.read(start.data(), 4);
        EXPECT_EQ(start.substr(1), std::string(name) == "page.html" ? "!DO" : "PNG") << name;
    }
}

TEST(Grid, HorizonsAndPolygonsMayBeNamedAsFiles) {
    const TemporaryFolder folder;
    const json by_name = make({}, folder / "a.grdecl",
                              {"--cells", "20x15", "--horizons", sample("top_map.irap") + "," + sample("base_map.irap"), "--fault-polygons",
                               sample("top_faults.pol") + ",-", "--option", "z=depth"});
    const json in_order = make(two_maps(), folder / "b.grdecl", {"--cells", "20x15", "--option", "z=depth"});
    ASSERT_TRUE(by_name.is_object() && in_order.is_object());
    EXPECT_EQ(by_name["notes"].size(), 0u);
    EXPECT_EQ(by_name["zones"], in_order["zones"]);
    EXPECT_EQ(by_name["faults"], in_order["faults"]);
}

TEST(Grid, ADeckHasTheZonesAndRunsInFlowWhereThatIsInstalled) {
    const TemporaryFolder folder;
    const json made = make(two_maps(), folder / "small.grdecl", {"--cells", "12x9", "--layers", "proportional:3", "--option", "deck=yes"});
    ASSERT_TRUE(made.is_object());
    const std::string deck = made["deck"];
    const json info = test::info(deck);
    ASSERT_TRUE(info.is_object());
    EXPECT_EQ(info["objects"][0]["counts"]["active_cells"], made["active_cells"]);
    EXPECT_EQ(run_geomend({"validate", deck}).status, 0);
    // Where depths are negative, too, there is no gas above the datum: its contact lies above the grid.
    std::ifstream text(deck);
    std::string word;
    while (text >> word && word != "EQUIL") {
    }
    double datum = 0, pressure = 0, water = 0, capillary = 0, gas = 0;
    text >> datum >> pressure >> water >> capillary >> gas;
    EXPECT_LT(gas, datum);
    EXPECT_LT(datum, water);
    if (std::system("command -v flow > /dev/null 2>&1") != 0) GTEST_SKIP() << "flow is not installed";
    const std::string run =
        "cd " + folder.path().string() + " && OMPI_MCA_orte_tmpdir_base=$PWD flow small.DATA --output-dir=out > log 2>&1";
    ASSERT_EQ(std::system(run.c_str()), 0);
    const json ran = test::info(folder / "out/SMALL.EGRID");
    EXPECT_EQ(ran["objects"][0]["counts"]["active_cells"], made["active_cells"]);
    EXPECT_EQ(ran["objects"][0]["counts"].value("stated_connections", 0u), made["nnc"]);
}

TEST(Grid, DecksOfRealModelsRunToTheirEndWithOurCellsAndConnections) {
    if (std::system("command -v flow > /dev/null 2>&1") != 0) GTEST_SKIP() << "flow is not installed";
    for (const char* name : {"modelA1", "modelA4"}) {
        const auto model = test::real_data(std::string("gocad/") + name + ".ml");
        if (!model) GTEST_SKIP() << "no real data";
        const TemporaryFolder folder;
        const json made =
            make({model->string()}, folder / "real.grdecl", {"--cells", "30x20", "--layers", "proportional:3", "--option", "deck=yes"});
        ASSERT_TRUE(made.is_object()) << name;
        const std::string run =
            "cd " + folder.path().string() + " && OMPI_MCA_orte_tmpdir_base=$PWD timeout 300 flow real.DATA --output-dir=out > log 2>&1";
        ASSERT_EQ(std::system(run.c_str()), 0) << name;
        std::ifstream log(folder / "log");
        const std::string text{std::istreambuf_iterator<char>(log), {}};
        EXPECT_NE(text.find("End of simulation"), std::string::npos) << name;
        EXPECT_EQ(text.find("Timestep chopped"), std::string::npos) << name;
        const json ran = test::info(folder / "out/REAL.EGRID");
        EXPECT_EQ(ran["objects"][0]["counts"]["active_cells"], made["active_cells"]) << name;
        EXPECT_EQ(ran["objects"][0]["counts"].value("stated_connections", 0u), made["nnc"]) << name;
    }
}

TEST(Grid, ADeckOfReekHasTheConnectionsOfFlow) {
    if (std::system("command -v flow > /dev/null 2>&1") != 0) GTEST_SKIP() << "flow is not installed";
    const auto maps = test::real_data("maps/reek"), pillars = test::real_data("cornerpoint/reek/reek_sim_grid.grdecl");
    if (!maps || !pillars) GTEST_SKIP() << "no real data";
    const TemporaryFolder folder;
    std::vector<std::string> in;
    for (const char* name :
         {"01_topreek_rota.gri", "02_midreek_rota.gri", "03_lowreek_rota.gri", "04_basereek_rota.gri", "top_upper_reek_faultpoly.pol"})
        in.push_back((*maps / name).string());
    const json made =
        make(in, folder / "reek.grdecl", {"--pillars-of", pillars->string(), "--layers", "proportional:2", "--option", "deck=yes"});
    ASSERT_TRUE(made.is_object());
    const std::string run =
        "cd " + folder.path().string() + " && OMPI_MCA_orte_tmpdir_base=$PWD timeout 300 flow reek.DATA --output-dir=out > log 2>&1";
    ASSERT_EQ(std::system(run.c_str()), 0);
    const json ran = test::info(folder / "out/REEK.EGRID");
    EXPECT_EQ(ran["objects"][0]["counts"]["active_cells"], made["active_cells"]);
    EXPECT_EQ(ran["objects"][0]["counts"]["stated_connections"], made["nnc"]);  // 2103; one more pair touches along next to nothing
}

TEST(Grid, ReekIsMetByItsMaps) {
    const auto folder_of_maps = test::real_data("maps/reek");
    if (!folder_of_maps) GTEST_SKIP() << "no real data";
    const TemporaryFolder folder;
    const std::string out = folder / "reek.grdecl", maps = folder_of_maps->string() + "/";
    const json made = make({maps + "01_topreek_rota.gri", maps + "02_midreek_rota.gri", maps + "03_lowreek_rota.gri",
                            maps + "04_basereek_rota.gri", maps + "top_upper_reek_faultpoly.pol"},
                           out, {"--cells", "100x80", "--layers", "proportional:5"});
    ASSERT_TRUE(made.is_object());
    ASSERT_EQ(made["zones"].size(), 3u);
    for (const json& zone : made["zones"]) EXPECT_NEAR(zone["volume"].get<double>() / zone["map_volume"].get<double>(), 1, 0.005);
    EXPECT_EQ(made["faults"].size(), 7u);
    EXPECT_EQ(made["left_out"].size(), 0u);
    for (const json& fault : made["faults"]) EXPECT_LT(fault["max_deviation_cells"].get<double>(), 0.75) << fault["name"];
    for (std::size_t h = 0; h < 3; ++h) EXPECT_EQ(made["horizons"][h]["max_difference"], 0);
    EXPECT_EQ(run_geomend({"validate", out}).status, 0);
}

TEST(GridCommand, ADeckTakesPorosityAndPermeabilityUnderTheirNamesElsewhere) {
    const TemporaryFolder folder;
    const std::string samples = std::string(GEOMEND_SOURCE_DIR) + "/samples/";
    const std::string box = samples + "layered_box.ml", solid = samples + "layered_box.so";
    const auto grid = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"grid", box, "--cells", "8x8", "-o", (folder / "g.grdecl").string(), "--option", "deck=yes"};
        words.insert(words.end(), more.begin(), more.end());
        return run_geomend(words);
    };
    const auto sampled = grid({"--properties-of", solid});
    ASSERT_EQ(sampled.status, 0) << sampled.err;
    EXPECT_NE(sampled.out.find("'porosity' is PORO in the deck"), std::string::npos) << sampled.out;
    const std::string deck = test::read_file(folder / "g.DATA");
    EXPECT_EQ(deck.find("PORO 0.2"), std::string::npos);
    EXPECT_NE(deck.find("PERMX PERMZ"), std::string::npos) << "across layers it is a share of PERMX";
    const auto bare = grid({});
    ASSERT_EQ(bare.status, 0) << bare.err;
    EXPECT_NE(bare.out.find("there is no PORO among the properties: the deck has 0.2"), std::string::npos) << bare.out;
    EXPECT_NE(test::read_file(folder / "g.DATA").find("PORO 0.2"), std::string::npos);
}

}  // namespace
}  // namespace geomend
