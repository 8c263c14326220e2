// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <sstream>

#include "base/vec3.h"
#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// mesh --cells hex-dominant and hybrid on models written here, whose volumes and best cells are known.

namespace geomend {
namespace {

using nlohmann::json;
using test::run_geomend;
using test::TemporaryFolder;

/// Sheets of squares as a file of Gocad surfaces.
class Sheets {
public:
    using Map = std::function<Vec3(const Vec3&)>;
    explicit Sheets(Map map = [](const Vec3& p) { return p; }) : map_(std::move(map)) { text_.precision(17); }

    /// The squares between places a[i], b[j], each of two triangles; those with two equal corners are one triangle.
    void add(const std::string& name, const std::vector<double>& a, const std::vector<double>& b,
             const std::function<Vec3(double, double)>& place) {
        std::map<Vec3, std::size_t> number;
        std::ostringstream triangles;
        text_ << "GOCAD TSurf 1\nHEADER {\nname:" << name << "\n}\nTFACE\n";
        const auto vertex = [&](const Vec3& p) {
            const auto [at, is_new] = number.emplace(p, number.size() + 1);
            const Vec3 q = map_(p);
            if (is_new) text_ << "VRTX " << at->second << ' ' << q[0] << ' ' << q[1] << ' ' << q[2] << '\n';
            return at->second;
        };
        const auto triangle = [&](std::size_t p, std::size_t q, std::size_t r) {
            if (p != q && q != r && r != p) triangles << "TRGL " << p << ' ' << q << ' ' << r << '\n';
        };
        for (std::size_t j = 0; j + 1 < b.size(); ++j) {
            for (std::size_t i = 0; i + 1 < a.size(); ++i) {
                const std::size_t p = vertex(place(a[i], b[j])), q = vertex(place(a[i + 1], b[j])), r = vertex(place(a[i + 1], b[j + 1])),
                                  s = vertex(place(a[i], b[j + 1]));
                triangle(p, q, r);
                triangle(p, r, s);
            }
        }
        text_ << triangles.str() << "END\n";
    }
    std::string text() const { return text_.str(); }

private:
    Map map_;
    std::ostringstream text_;
};

std::vector<double> parts(double length, int n) {
    std::vector<double> all;
    for (int i = 0; i <= n; ++i) all.push_back(length * i / n);
    return all;
}

/// Layers between heights over a box of 1000 by 800. \param height of border k at a place \param ends per layer where it ends along x
std::string layers(
    std::size_t count, const std::function<double(std::size_t, double)>& height, const std::vector<double>& ends,
    const Sheets::Map& map = [](const Vec3& p) { return p; }) {
    Sheets sheets(map);
    const auto xs = parts(1000, 20), ys = parts(800, 16);
    const auto upto = [&](double end) {
        std::vector<double> own;
        for (const double x : xs) {
            if (x <= end) own.push_back(x);
        }
        return own;
    };
    for (std::size_t k = 0; k < count; ++k)
        sheets.add("h" + std::to_string(k), k > 0 ? upto(ends[k - 1]) : xs, ys, [&](double x, double y) {
            return Vec3{x, y, height(k, x)};
        });
    for (std::size_t k = 0; k + 1 < count; ++k) {
        const std::vector<double> sides{0, 1};
        const auto z = [&](double x, double side) { return height(side == 0 ? k : k + 1, x); };
        const std::string name = "side" + std::to_string(k);
        sheets.add(name + "s", upto(ends[k]), sides, [&](double x, double side) { return Vec3{x, 0, z(x, side)}; });
        sheets.add(name + "n", upto(ends[k]), sides, [&](double x, double side) { return Vec3{x, 800, z(x, side)}; });
        sheets.add(name + "w", ys, sides, [&](double y, double side) { return Vec3{0, y, z(0, side)}; });
        if (ends[k] == 1000) sheets.add(name + "e", ys, sides, [&](double y, double side) { return Vec3{1000, y, z(1000, side)}; });
    }
    return sheets.text();
}

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

TEST(Hybrid, AThinLayerThatPinchesOutBecomesPrisms) {
    const TemporaryFolder folder;
    const auto height = [](std::size_t k, double x) {
        const std::vector<double> z{0, 200, 200, 600};
        return z[k] + (k == 2 ? 0.05 * std::max(0.0, 700 - x) : 0);
    };
    // The layer between 1 and 2 ends at x = 700, and so does its top: the one above lies on 1 from there on.
    Sheets sheets;
    const auto xs = parts(1000, 20), ys = parts(800, 16), thin = parts(700, 14);
    const std::vector<double> sides{0, 1};
    for (const std::size_t k : {0, 1, 3})
        sheets.add("h" + std::to_string(k), xs, ys, [&](double x, double y) { return Vec3{x, y, height(k, x)}; });
    sheets.add("h2", thin, ys, [&](double x, double y) { return Vec3{x, y, height(2, x)}; });
    for (std::size_t k = 0; k < 3; ++k) {
        const auto z = [&](double x, double side) { return height(side == 0 ? k : k + 1, x); };
        for (const double y : {0.0, 800.0})
            sheets.add("s" + std::to_string(k) + (y > 0 ? "n" : "s"), k == 1 ? thin : xs, sides, [&](double x, double s) {
                return Vec3{x, y, z(x, s)};
            });
        for (const double x : {0.0, 1000.0}) {
            if (k != 1 || x == 0)
                sheets.add("s" + std::to_string(k) + (x > 0 ? "e" : "w"), ys, sides, [&](double y, double s) {
                    return Vec3{x, y, z(x, s)};
                });
        }
    }
    const json report = meshed(folder, sheets.text(), {"--cells", "hybrid", "--size", "50"});
    ASSERT_TRUE(report.is_object());
    EXPECT_NEAR(volume(report), 4.8e8, 1e-9 * 4.8e8);
    // 14 by 16 squares: those at the tip are pyramids and tetrahedra.
    EXPECT_GE(report["recombine"]["thin"]["prisms"].get<int>(), 2 * 2 * 13 * 16 * 9 / 10);
    EXPECT_EQ(report["recombine"]["folded"], 0);
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
