// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

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

TEST(HexDominant, LayersThatDipBelowALevelTopBecomeHexahedra) {
    struct Case {
        std::vector<double> z;  ///< of the borders at x = 0
        double dip;             ///< of those inside
        const char* size;
        double turn;
    };
    const std::vector<Case> cases{{{0, 150, 250, 330, 600}, 0.15, "40", 0},
                                  {{0, 150, 250, 330, 600}, 0.15, "50", 0.5},
                                  {{0, 100, 160, 220, 280, 340, 600}, 0.15, "40", 0},
                                  {{0, 150, 250, 330, 700}, 0.25, "50", 0},
                                  {{0, 350, 430, 520, 700}, -0.2, "45", 1.2}};
    for (const Case& c : cases) {
        const TemporaryFolder folder;
        const auto height = [&](std::size_t k, double x) { return c.z[k] + (k == 0 || k + 1 == c.z.size() ? 0 : c.dip * x); };
        const auto turned = [&](const Vec3& p) {
            return Vec3{500000 + std::cos(c.turn) * p[0] - std::sin(c.turn) * p[1],
                        6000000 + std::sin(c.turn) * p[0] + std::cos(c.turn) * p[1], p[2] - 3000};
        };
        const std::vector<double> ends(c.z.size() - 1, 1000);
        const json report = meshed(folder, layers(c.z.size(), height, ends, turned), {"--cells", "hex-dominant", "--size", c.size});
        ASSERT_TRUE(report.is_object());
        EXPECT_GE(share(report, "hexahedron"), 0.99) << c.dip << " at " << c.size;
        EXPECT_GE(report["quality"]["min_scaled_jacobian"].get<double>(), 0.3);
        EXPECT_NEAR(volume(report), 8e5 * c.z.back(), 1e-9 * 8e5 * c.z.back());
    }
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

}  // namespace
}  // namespace geomend
