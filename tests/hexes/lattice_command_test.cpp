// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "hexes/layered_sheets.h"
#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// mesh --cells hex-dominant on models written here, whose volumes and best cells are known.

namespace geomend {
namespace {

using nlohmann::json;
using test::layers;
using test::run_geomend;
using test::TemporaryFolder;

json meshed(const TemporaryFolder& folder, const std::string& model, const std::vector<std::string>& options) {
    test::write_file(folder / "model.ts", model);
    std::vector<std::string> arguments{"mesh", folder / "model.ts", "-o", folder / "cells.vtu", "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto run = run_geomend(arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run_geomend({"validate", folder / "cells.vtu"}).status, 0);
    return json::parse(run.out, nullptr, false);
}

double share(const json& report, const char* type) { return report["quality"]["shares"][type]["volume"].get<double>(); }

double volume(const json& report) {
    double sum = 0;
    for (const json& region : report["regions"]) sum += region["volume"].get<double>();
    return sum;
}

const std::vector<double> heights{0, 130, 310, 400, 600};
const std::vector<double> whole{1000, 1000, 1000, 1000};

TEST(HexDominant, LevelLayersInABoxBecomeHexahedraAlone) {
    const TemporaryFolder folder;
    const json report = meshed(folder,
                               layers(
                                   5, [](std::size_t k, double) { return heights[k]; }, whole),
                               {"--cells", "hex-dominant", "--size", "40"});
    ASSERT_TRUE(report.is_object());
    EXPECT_NEAR(share(report, "hexahedron"), 1, 1e-9);
    EXPECT_GE(report["quality"]["min_scaled_jacobian"].get<double>(), 0.99);
    EXPECT_NEAR(volume(report), 4.8e8, 1e-9 * 4.8e8);
}

TEST(HexDominant, SoTheyDoTurnedAndInMapCoordinates) {
    const TemporaryFolder folder;
    const auto turned = [](const Vec3& p) {
        return Vec3{500000 + std::cos(0.5) * p[0] - std::sin(0.5) * p[1], 6000000 + std::sin(0.5) * p[0] + std::cos(0.5) * p[1],
                    p[2] - 3000};
    };
    const json report = meshed(folder,
                               layers(
                                   5, [](std::size_t k, double) { return heights[k]; }, whole, turned),
                               {"--cells", "hex-dominant", "--size", "40"});
    ASSERT_TRUE(report.is_object());
    EXPECT_GE(share(report, "hexahedron"), 0.99);
    EXPECT_NEAR(volume(report), 4.8e8, 1e-9 * 4.8e8);
}

struct DippingLayers {
    std::vector<double> z;  ///< of the borders at x = 0
    double dip;             ///< of those inside
    const char* size;
    double turn;
};

void expect_hexahedra(const DippingLayers& c) {
    const TemporaryFolder folder;
    const auto height = [&](std::size_t k, double x) { return c.z[k] + (k == 0 || k + 1 == c.z.size() ? 0 : c.dip * x); };
    const auto turned = [&](const Vec3& p) {
        return Vec3{500000 + std::cos(c.turn) * p[0] - std::sin(c.turn) * p[1], 6000000 + std::sin(c.turn) * p[0] + std::cos(c.turn) * p[1],
                    p[2] - 3000};
    };
    const std::vector<double> ends(c.z.size() - 1, 1000);
    const json report = meshed(folder, layers(c.z.size(), height, ends, turned), {"--cells", "hex-dominant", "--size", c.size});
    ASSERT_TRUE(report.is_object());
    EXPECT_GE(share(report, "hexahedron"), 0.99) << c.dip << " at " << c.size;
    EXPECT_GE(report["quality"]["min_scaled_jacobian"].get<double>(), 0.3);
    EXPECT_NEAR(volume(report), 8e5 * c.z.back(), 1e-9 * 8e5 * c.z.back());
}

TEST(HexDominant, LayersThatDipBelowALevelTopBecomeHexahedra) {
    const std::vector<DippingLayers> cases{{{0, 150, 250, 330, 600}, 0.15, "40", 0},
                                           {{0, 150, 250, 330, 600}, 0.15, "50", 0.5},
                                           {{0, 100, 160, 220, 280, 340, 600}, 0.15, "40", 0},
                                           {{0, 150, 250, 330, 700}, 0.25, "50", 0},
                                           {{0, 350, 430, 520, 700}, -0.2, "45", 1.2}};
    for (const DippingLayers& c : cases) expect_hexahedra(c);
}

// Layers inside of these are a third of a step thin on one side and twice as thick as one on the other.
TEST(HexDominant, SoDoWedgesOfSixfoldThickness) {
    const std::vector<DippingLayers> cases{{{0, 100, 700}, 0.5, "40", 0},
                                           {{0, 100, 700}, 0.5, "60", 0.4},
                                           {{0, 60, 160, 500}, 0.3, "50", 0},
                                           {{0, 60, 160, 500}, 0.2, "60", 1}};
    for (const DippingLayers& c : cases) expect_hexahedra(c);
}

// The sides and horizons of the sample are even: tetrahedra over a lattice are flat there but for rounding.
TEST(HexDominant, TheLayeredBoxWithAFaultIsValidAndNearlyAllHexahedra) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml", out = (folder / "box.vtu").string();
    for (const char* size : {"40", "60"}) {
        const auto run = test::run_geomend({"mesh", sample, "--cells", "hex-dominant", "--size", size, "-o", out, "--lossy", "--json"});
        ASSERT_EQ(run.status, 0) << run.err;
        const json report = json::parse(run.out);
        EXPECT_GE(share(report, "hexahedron"), 0.98) << size;
        for (const json& region : report["regions"]) EXPECT_GT(region["cells"]["hexahedron"].get<int>(), 0) << region["name"];
        const auto valid = test::run_geomend({"validate", out});
        EXPECT_EQ(valid.status, 0) << valid.out;
    }
}

/// The sample turned about two axes and moved, with so many digits.
std::string turned_sample(double about_z, double about_x, double east, int digits) {
    std::ifstream file(std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml");
    std::ostringstream text;
    text.precision(digits);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string what, number;
        double x = 0, y = 0, z = 0;
        const bool is_vertex = line.starts_with("VRTX") || line.starts_with("PVRTX");
        if (!is_vertex || !(words >> what >> number >> x >> y >> z)) {
            text << line << '\n';
            continue;
        }
        const double u = std::cos(about_z) * x - std::sin(about_z) * y, v = std::sin(about_z) * x + std::cos(about_z) * y;
        std::string values;
        std::getline(words, values);
        text << what << ' ' << number << ' ' << u + east << ' ' << std::cos(about_x) * v - std::sin(about_x) * z + 10 * east << ' '
             << std::sin(about_x) * v + std::cos(about_x) * z << values << '\n';
    }
    return text.str();
}

// Points of walls and layers that share a plane do so only but for rounding, which is another each time.
TEST(HexDominant, SoItIsHoweverItIsTurnedAndRounded) {
    struct Case {
        double about_z, about_x, east;
        int digits;
        const char* size;
    };
    for (const Case& c : {Case{0.2, 0.6, 0, 17, "60"}, {0.31, 0.17, 0, 13, "50"}, {0.4, 0.4, 0, 14, "75"}, {0.7, 0.4, 5e5, 11, "60"}}) {
        const TemporaryFolder folder;
        const std::string model = (folder / "turned.ml").string(), out = (folder / "turned.vtu").string();
        test::write_file(folder / "turned.ml", turned_sample(c.about_z, c.about_x, c.east, c.digits));
        const auto run = run_geomend({"mesh", model, "--cells", "hex-dominant", "--size", c.size, "-o", out, "--lossy", "--json"});
        ASSERT_EQ(run.status, 0) << run.err;
        const json report = json::parse(run.out);
        EXPECT_GE(share(report, "hexahedron"), 0.99) << c.about_z << " at " << c.size;
        for (const json& region : report["regions"]) {
            EXPECT_TRUE(region["as_asked"].get<bool>());
            EXPECT_EQ(region["rung"].get<std::string>().find("moved"), std::string::npos) << region["why_not"];
        }
        EXPECT_EQ(run_geomend({"validate", out}).status, 0);
    }
}

}  // namespace
}  // namespace geomend
