// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validators/rewritten.h"
#include "validators/zoo.h"

// What a file states of a sound geometry may be wrong, and what is stated may be unusual without being wrong.

namespace geomend {
namespace {

using namespace testing;

Animal animal_of(const std::string& name) {
    for (const Species& species : whole_zoo()) {
        if (name == species.name) return species.make();
    }
    throw std::out_of_range(name);
}

std::vector<Finding> findings_of(const Dataset& data) {
    auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    return checked->findings;
}

bool has(const std::vector<Finding>& findings, const std::string& code, const std::string& kind, const std::string& name) {
    return std::ranges::any_of(findings, [&](const Finding& f) {
        return f.code == code && std::ranges::any_of(f.entities, [&](const EntityRef& e) { return e.kind == kind && e.name == name; });
    });
}
std::string text(const std::vector<Finding>& findings) {
    std::string all;
    for (const Finding& f : findings) all += f.code + " " + f.message + "\n";
    return all;
}

TEST(StatedRegions, ThatOverlapBecauseTheOuterOneDoesNotLeaveOutTheInner) {
    for (const char* name : {"box_in_box_in_box", "two_bodies"}) {
        Animal animal = animal_of(name);
        const auto& faces = animal.model.stated().faces;
        std::erase_if(animal.model.stated().regions[1].sides, [&](const auto& side) { return faces[side.face].interface_name != "skin"; });
        const auto findings = findings_of(animal.model.data);
        EXPECT_TRUE(has(findings, "B13", "region", "R1")) << name << "\n" << text(findings);
    }
}

TEST(StatedRegions, ThatDoNotExistAreTold) {
    Animal animal = animal_of("sine_fold");
    StatedModel::Region ghost;
    ghost.name = "Ghost";
    animal.model.stated().regions.push_back(ghost);
    const auto findings = findings_of(animal.model.data);
    EXPECT_TRUE(has(findings, "F121", "region", "Ghost")) << text(findings);
    EXPECT_TRUE(has(findings, "B05", "region", "Ghost")) << text(findings);
}

TEST(StatedRegions, OfTwoLayersInOneAreTold) {
    Animal animal = animal_of("erosion");
    auto& regions = animal.model.stated().regions;
    for (const auto& side : regions[2].sides) regions[1].sides.push_back(side);
    const auto findings = findings_of(animal.model.data);
    EXPECT_TRUE(has(findings, "B14", "region", "R1")) << text(findings);
    EXPECT_TRUE(has(findings, "B14", "region", "R2")) << text(findings);
}

TEST(SaltStatedAsAHorizon, IsInOrder) {
    for (const char* name : {"diapir", "mushroom", "bulb_in_a_layer"}) {
        Animal animal = animal_of(name);
        for (auto& face : animal.model.stated().faces) {
            if (face.interface_name == "salt") face.role = FeatureRole::horizon;
        }
        animal.model.surface("salt").info.role = FeatureRole::horizon;
        for (const Finding& f : findings_of(animal.model.data))
            EXPECT_EQ(f.severity, Severity::info) << name << ": " << f.code << " " << f.message;
    }
}

TEST(ATubeWithASeam, IsToldWhereNothingMeetsIt) {
    Surface tube;
    tube.info.name = "tube";
    constexpr std::uint32_t n = 12;
    for (std::uint32_t k = 0; k <= n; ++k) {  // the last two points are at the positions of the first two
        const double a = 2 * std::numbers::pi * (k % n) / n;
        for (const double z : {0.0, 1.0}) tube.points.push_back({std::cos(a), std::sin(a), z});
    }
    for (std::uint32_t k = 0; k < n; ++k) {
        tube.polygons.push_back(std::array{2 * k, 2 * k + 2, 2 * k + 3});
        tube.polygons.push_back(std::array{2 * k, 2 * k + 3, 2 * k + 1});
    }
    Dataset data;
    data.objects.emplace_back(tube);
    const auto findings = findings_of(data);
    ASSERT_TRUE(has(findings, "B07", "surface", "tube")) << text(findings);
    EXPECT_EQ(verdict(moved(data, rotated)), verdict(data));
}

TEST(AHorizonWithOtherVerticesThanItsWalls, IsTold) {
    auto m = test::two_blocks();
    auto& middle = m.surface(2);
    middle.points.clear();
    middle.polygons = {};
    constexpr std::uint32_t n = 3;
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j <= n; ++j) middle.points.push_back({i / 3.0, j / 3.0, 1});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = i * (n + 1) + j;
            middle.polygons.push_back(std::array{a, a + n + 1, a + n + 2});
            middle.polygons.push_back(std::array{a, a + n + 2, a + 1});
        }
    }
    m.model().faces[2].key.reset();
    const auto findings = findings_of(m.data);
    std::size_t walls = 0;
    for (const Finding& f : findings) walls += f.code == "B11" ? 1 : 0;
    EXPECT_EQ(walls, 8u) << text(findings);
    const Verdict known = verdict(m.data);
    EXPECT_EQ(verdict(moved(m.data, rotated)), known);
    EXPECT_EQ(verdict(on_the_map(m.data, 1000)), known);
    EXPECT_EQ(verdict(on_the_map(moved(m.data, rotated), 1000)), known);
}

}  // namespace
}  // namespace geomend
