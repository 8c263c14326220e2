// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "validators/block_model.h"
#include "validators/registry.h"

// Basins, which are many times as wide as they are thick: their layers, dying faults and slow slopes are no near misses, but gaps
// of some metres are.

namespace geomend {
namespace {

using namespace testing;

struct Basin {
    double length, width, height;  ///< metres
    int layers;
    double gap = 0;  ///< above the horizon in the middle that a fault ends on; 0: it dies away from it
};
std::ostream& operator<<(std::ostream& out, const Basin& b) {
    return out << b.length << " x " << b.width << " x " << b.height << ", " << b.layers << " layers";
}

/// Bent layers, and a fault from the top down to a horizon: its lower border lies `gap` above that.
BlockModel basin_model(const Basin& basin) {
    constexpr int nx = 10, ny = 8;
    const int under = basin.layers / 2, cells = basin.layers + 1;  // one layer is two cells high
    const double layer = basin.height / basin.layers;
    Blocks b;
    b.size = {nx, ny, cells};
    b.node = [=](int i, int j, int k) {
        double level = k <= under ? k : k - 1;  // in layers
        if (k == under + 1) level = under + (basin.gap > 0 ? basin.gap / layer : 0.4);
        const double x = double(i) / nx, y = double(j) / ny;
        const double bend = k == 0 || k == cells ? 0 : 0.2 * layer * std::sin(5 * x + 3 * y) * std::sin(3.1 * level / basin.layers);
        return Vec3{basin.length * x + 2 * level * layer, basin.width * y, level * layer + bend};
    };
    b.region = [=](int, int, int k) { return k <= under ? k + 1 : k; };
    b.surface = [](const BlockWall& w) { return box_side_or(w, "H" + std::to_string(std::max(w.low_region, w.high_region))); };
    b.sheet = [=](const BlockWall& w) {
        const bool is_fault = w.axis == 0 && w.plane() == nx / 2 && w.low[1] > 1 && w.low[1] < ny - 2 && w.low[2] == under + 1;
        return is_fault ? "fault" : "";
    };
    b.roles = {{"fault", FeatureRole::fault}};
    for (int r = 2; r <= basin.layers; ++r) b.roles["H" + std::to_string(r)] = FeatureRole::horizon;
    return make_block_model(b);
}

std::set<std::string> codes_in(const BlockModel& model) {
    const auto checked = validators::check_models(model.data, {});
    EXPECT_TRUE(checked);
    std::set<std::string> codes;
    for (const Finding& f : checked->findings) {
        if (f.code[0] != 'Q') codes.insert(f.code);
    }
    codes.erase("F111");
    return codes;
}

class Basins : public ::testing::TestWithParam<Basin> {};

TEST_P(Basins, AreSoundWhereTheyAre) { EXPECT_EQ(codes_in(basin_model(GetParam())), std::set<std::string>{"B25"}); }

TEST_P(Basins, HaveANearMissWhereAFaultEndsSomeMetresAboveAHorizon) {
    for (const double gap : {0.5, 3.0, 6.0}) {
        Basin basin = GetParam();
        basin.gap = gap;
        const auto codes = codes_in(basin_model(basin));
        EXPECT_TRUE(codes.contains("B23")) << gap;
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Basins,
                         ::testing::Values(Basin{4e5, 3.2e5, 4000, 4}, Basin{4e5, 3.2e5, 4000, 8}, Basin{4e5, 3.2e5, 2000, 4},
                                           Basin{4e5, 4e5, 10000, 20}, Basin{1e5, 8e4, 2000, 4}, Basin{1e5, 8e4, 2000, 2},
                                           Basin{1e6, 5e5, 5000, 10}, Basin{2e4, 2e4, 1500, 6}));

}  // namespace
}  // namespace geomend
