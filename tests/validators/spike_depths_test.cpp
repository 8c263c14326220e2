// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <string>

#include "validators/checks_testing.h"
#include "validators/rewritten.h"

// A spike of one horizon through another: what is said depends on how deep it is, and not on how the model lies.

namespace geomend {
namespace {

using namespace testing;

/// A sheet of twelve triangles around a vertex in its middle, and beyond it.
Surface sheet(const std::string& name, double height, double middle, double shift) {
    Surface surface;
    surface.info.name = name;
    surface.info.role = FeatureRole::horizon;
    surface.points.push_back({shift, shift / 3, middle});
    constexpr std::uint32_t around = 6;
    for (const double radius : {250.0, 2000.0}) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            surface.points.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
        }
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { surface.polygons.push_back(std::array{a, b, c}); };
    for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t a = 1 + i, b = 1 + (i + 1) % around;
        add(0, a, b);
        add(a, a + around, b + around);
        add(a, b + around, b);
    }
    return surface;
}

/// The codes of errors and warnings for a spike of that depth, with a tolerance of 0.67.
std::set<std::string> said_of(double depth, double shift, unsigned frame) {
    Dataset data;
    data.objects.emplace_back(sheet("upper", 400, -depth, shift));
    data.objects.emplace_back(sheet("lower", 0, 0, 0));
    if (frame >= 1) data = moved(std::move(data), [](const Vec3& p) { return rotated(p); });
    if (frame >= 2) data = on_the_map(data, 1);
    if (frame >= 3) data = moved(std::move(data), [](const Vec3& p) { return rotated(rotated(p)); });
    CheckOptions options;
    options.tolerance = 0.67;
    options.closing_tolerance = false;
    auto checked = validators::check_models(data, options);
    EXPECT_TRUE(checked);
    std::set<std::string> codes;
    for (const Finding& f : checked->findings) {
        if (f.severity > Severity::info) codes.insert(f.code + (f.severity == Severity::error ? " error" : " warning"));
    }
    return codes;
}

TEST(SpikeDepth, DecidesWhatIsSaidHoweverTheModelIsTurned) {
    for (const double depth : {0.1, 0.5, 0.75, 0.9, 1.1, 1.5, 3.0, 30.0}) {
        for (const double shift : {0.0, 0.37}) {
            const auto known = said_of(depth, shift, 0);
            for (unsigned frame = 1; frame < 4; ++frame)
                EXPECT_EQ(said_of(depth, shift, frame), known) << depth << ' ' << shift << ' ' << frame;
            EXPECT_EQ(known.contains("B10 error"), depth > 0.67) << depth << ' ' << shift;
        }
    }
}

}  // namespace
}  // namespace geomend
