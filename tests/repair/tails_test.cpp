// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

#include "base/vec3.h"
#include "made_boxes.h"
#include "region_volumes.h"
#include "support/program.h"

// What sticks out by little goes; what parts regions stays, however small it is.

namespace geomend {
namespace {

using test::box_text;
using test::region_volumes;
using test::run_geomend;
using test::Sheet;
using test::TemporaryFolder;
using test::tsurf_text;
using test::write_file;

/// A plane fault through the line (5, y, at) of a box of size 10, that leans by `slope`, and sticks out of the box by `over` all around.
std::string fault_text(const std::string& name, double slope, double at, double over) {
    const auto x = [&](double z) { return 5 + slope * (z - at); };
    const double low = -over, high = 10 + over;
    return tsurf_text({name, {x(low), low, low}, {x(high) - x(low), 0, high - low}, {0, high - low, 0}, 3, "fault", {}});
}

TEST(Tails, FaultsThatCrossNearTheBasePartFourRegionsHoweverLittleTheyStickOut) {
    const TemporaryFolder folder;
    constexpr double slope = 0.4;
    for (const double at : {0.012, 0.004}) {
        for (const double over : {0.0, 1e-4, 1e-3, 5e-3}) {
            write_file(folder / "in.ts", box_text() + fault_text("west", slope, at, over) + fault_text("east", -slope, at, over));
            const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml"});
            ASSERT_EQ(run.status, 0) << at << ' ' << over << '\n' << run.out << run.err;
            const auto volumes = region_volumes(folder / "out.ml");
            const double below = 10 * slope * at * at, above = 10 * slope * (10 - at) * (10 - at), beside = (1000 - below - above) / 2;
            ASSERT_EQ(volumes.size(), 4u) << at << ' ' << over << '\n' << run.out;
            EXPECT_NEAR(volumes[0], below, 1e-6) << at << ' ' << over;
            EXPECT_NEAR(volumes[1], beside, 1e-6) << at << ' ' << over;
            EXPECT_NEAR(volumes[2], beside, 1e-6) << at << ' ' << over;
            EXPECT_NEAR(volumes[3], above, 1e-6) << at << ' ' << over;
        }
    }
}

TEST(Tails, AFaultThatMeetsAHorizonNearTheTopPartsWhatLiesOnBothSides) {
    const TemporaryFolder folder;
    constexpr double depth = 0.01;  // of the horizon below the top, where the fault ends on it
    for (const double over : {0.0, 1e-4, 1e-3}) {
        const Sheet horizon{"horizon", {-over, -over, 10 - depth}, {10 + 2 * over, 0, 0}, {0, 10 + 2 * over, 0}, 5, "top", {}};
        const Sheet fault{"fault", {5, -over, -over}, {0, 10 + 2 * over, 0}, {0, 0, 10 - depth + 2 * over}, 4, "fault", {}};
        write_file(folder / "in.ts", box_text() + tsurf_text(horizon) + tsurf_text(fault));
        const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml"});
        ASSERT_EQ(run.status, 0) << over << '\n' << run.out << run.err;
        const auto volumes = region_volumes(folder / "out.ml");
        ASSERT_EQ(volumes.size(), 3u) << over << '\n' << run.out;
        EXPECT_NEAR(volumes[0], 100 * depth, 1e-6) << over;
        EXPECT_NEAR(volumes[1], 500 - 50 * depth, 1e-6) << over;
        EXPECT_NEAR(volumes[2], 500 - 50 * depth, 1e-6) << over;
    }
}

/// The six sides of a box of size 10 from (x, 0, 0) on, each of n by n squares.
std::string box_at(double x, int n) {
    const std::array<std::pair<Vec3, std::array<Vec3, 2>>, 6> sides{{{{x, 0, 0}, {{{0, 0, 10}, {0, 10, 0}}}},
                                                                     {{x + 10, 0, 0}, {{{0, 10, 0}, {0, 0, 10}}}},
                                                                     {{x, 0, 0}, {{{10, 0, 0}, {0, 0, 10}}}},
                                                                     {{x, 10, 0}, {{{0, 0, 10}, {10, 0, 0}}}},
                                                                     {{x, 0, 0}, {{{0, 10, 0}, {10, 0, 0}}}},
                                                                     {{x, 0, 10}, {{{10, 0, 0}, {0, 10, 0}}}}}};
    std::string text;
    int number = 0;
    for (const auto& [corner, along] : sides)
        text += tsurf_text({"side_" + std::to_string(++number), corner, along[0], along[1], n, "boundary", {}});
    return text;
}

TEST(Models, ThatAreSealedEachByItselfBecomeOneWhereTheyMeet) {
    const TemporaryFolder folder;
    int n = 3;
    for (const char* name : {"a", "b"}) {
        write_file(folder / "in.ts", box_at(n == 3 ? 0 : 10, n));
        ++n;
        const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / (std::string(name) + ".ml")});
        ASSERT_EQ(run.status, 0) << run.out << run.err;
    }
    const auto run = run_geomend({"repair", folder / "a.ml", folder / "b.ml", "-o", folder / "out.ml"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    const auto volumes = region_volumes(folder / "out.ml");
    ASSERT_EQ(volumes.size(), 2u) << run.out;
    EXPECT_NEAR(volumes[0], 1000, 1e-6);
    EXPECT_NEAR(volumes[1], 1000, 1e-6);
    EXPECT_EQ(run_geomend({"validate", folder / "out.ml"}).status, 0);
}

}  // namespace
}  // namespace geomend
