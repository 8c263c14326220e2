// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "made_boxes.h"
#include "support/program.h"
#include "support/seeds.h"

// Curved made models: wavy horizons, listric and bent faults, two that cross, one that dies. All stick out of a box of 10, but the one
// that dies. Horizons do not meet each other, so the number of regions is known, and volumes sum to the box.

namespace geomend {
namespace {

using test::Sheet;

constexpr double size = 10, beyond = 0.3;

struct CurvedModel {
    std::string text;
    std::size_t regions = 1;
};

class Maker {
public:
    explicit Maker(unsigned seed) : engine_(seed) {}

    CurvedModel make() {
        model_.text = test::box_text();
        const int horizons = 1 + static_cast<int>(engine_() % 3);
        for (int h = 0; h < horizons; ++h) add_horizon("H" + std::to_string(h + 1), size * (h + 1) / (horizons + 1));
        model_.regions = static_cast<std::size_t>(horizons) + 1;
        const unsigned kind = engine_() % 4;
        if (kind == 0) add_dying_fault();
        else add_fault("F", 0, kind == 1);
        if (kind == 3) add_fault("G", 1, false);
        return model_;
    }

private:
    double between(double low, double high) { return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0; }

    void add_horizon(const std::string& name, double z) {
        const double height = between(0.1, 0.5), a = between(0, 6), b = between(0, 6);
        Sheet sheet{name, {-beyond, -beyond, z}, {size + 2 * beyond, 0, 0}, {0, size + 2 * beyond, 0}, 14, "top", {}};
        sheet.move = [=](const Vec3& p) { return Vec3{p[0], p[1], z + height * std::sin(0.6 * p[0] + a) * std::cos(0.5 * p[1] + b)}; };
        model_.text += test::tsurf_text(sheet);
    }

    /// From side to side across an axis, flattening out with depth where it is listric.
    void add_fault(const std::string& name, std::size_t axis, bool listric) {
        const double start = between(3, 4.5);
        Sheet sheet{name, {}, {}, {}, 13, "fault", {}};
        sheet.corner[1 - axis] = sheet.corner[2] = -beyond;
        sheet.u[1 - axis] = sheet.v[2] = size + 2 * beyond;
        sheet.move = [=](const Vec3& p) {
            Vec3 q = p;
            const double depth = (size - p[2]) / size;
            q[axis] = listric ? start + 3 * depth * depth : start + 0.8 * std::sin(0.5 * p[1 - axis]) + 0.1 * p[2];
            return q;
        };
        model_.text += test::tsurf_text(sheet);
        model_.regions *= 2;
    }

    /// Ends inside of the box all around: it parts nothing.
    void add_dying_fault() {
        Sheet sheet{"D", {4, 2, 2}, {0, 6, 0}, {0, 0, 6}, 9, "fault", {}};
        sheet.move = [](const Vec3& p) { return Vec3{p[0] + 0.3 * std::sin(p[1]) + 0.2 * p[2], p[1], p[2]}; };
        model_.text += test::tsurf_text(sheet);
    }

    std::mt19937 engine_;
    CurvedModel model_;
};

TEST(CurvedModels, BecomeAsManyRegionsAsTheirSurfacesBoundAndFillTheirBox) {
    const test::TemporaryFolder folder;
    for (unsigned seed = test::first_seed(1), end = seed + test::seeds(15); seed < end; ++seed) {
        const CurvedModel model = Maker(seed).make();
        test::write_file(folder / "in.ts", model.text);
        const auto run = test::run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--max-gap", "0.5", "--quiet"});
        ASSERT_EQ(run.status, 0) << "seed " << seed << run.out << run.err;
        const nlohmann::json all = test::info(folder / "out.ml");
        double sum = 0;
        for (const auto& region : all["brep"]["region_volumes"]) sum += region["volume"].get<double>();
        EXPECT_EQ(all["brep"]["regions"], model.regions) << "seed " << seed;
        EXPECT_NEAR(sum, size * size * size, 1e-9 * size * size * size) << "seed " << seed;
    }
}

}  // namespace
}  // namespace geomend
