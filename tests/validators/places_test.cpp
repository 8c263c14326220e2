// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "pipeline/validate.h"
#include "validators/fixtures.h"
#include "validators/zoo_defects.h"

// Every finding about the geometry of a model says where it is.

namespace geomend {
namespace {

using namespace testing;

/// Codes whose findings have no place, and why.
const std::map<std::string, std::string> without_place = {
    {"C01", "the array has no cells yet"},
    {"C12", "about the whole grid where all cells are left-handed"},
    {"C13", "about records of the head of the file"},
    {"C14", "about records of the head of the file"},
    {"C20", "records that reach outside of the grid have no faces there"},
    {"F111", "about the whole model: a count"},
    {"F160", "about kinds of objects"},
    {"F161", "there is no geometry"},
    {"F162", "about what was not judged"},
    {"G02", "a list without a region has no place"},
    {"S01", "about the whole file"},
    {"S02", "repeats findings that have places of their own"},
    {"S03", "about the whole grid: no cell is active"},
    {"S04", "about a property that is not there"},
    {"S06", "about names"},
    {"S09", "about keywords"},
    {"S12", "about defaults"},
};

bool is_finite(const Vec3& p) {
    return std::ranges::all_of(p, [](double x) { return std::isfinite(x); });
}

std::vector<Finding> findings_of(const Dataset& data, const Fixture& fixture) {
    validators::CheckOptions options;
    options.target = fixture.target;
    if (fixture.as_brep) options.grid_model.emplace();
    const auto file = validate("fixture", data, options);
    return file ? file->findings : std::vector<Finding>{};
}

void expect_places(const std::vector<Finding>& findings, const std::string& in, std::set<std::string>& told) {
    for (const Finding& f : findings) {
        if (without_place.contains(f.code)) continue;
        const bool of_whole_model = f.entities.size() == 1 && f.entities[0].kind == "model";
        if (of_whole_model && f.index.empty()) continue;  // about all of it, as where the signs of all regions are turned (B30)
        const bool placed = !f.points.empty() || std::ranges::any_of(f.polylines, [](const auto& line) { return !line.empty(); });
        if (!placed && told.insert(f.code + (f.entities.empty() ? "" : f.entities[0].kind)).second)
            ADD_FAILURE() << f.code << " in " << in << " has no place: " << f.message;
        if (f.code == "M09" || f.code == "C02") continue;  // about such coordinates
        EXPECT_TRUE(std::ranges::all_of(f.points, is_finite)) << f.code << " in " << in;
    }
}

TEST(Places, AreGivenByEachCheck) {
    std::set<std::string> told;
    for (const Fixture& fixture : all_fixtures()) expect_places(findings_of(fixture.fails(), fixture), fixture.code, told);
}

TEST(Places, AreGivenForDefectsInModelsOfManyForms) {
    std::set<std::string> told;
    for (const Species& species : whole_zoo()) {
        const Animal animal = species.make();
        expect_places(findings_of(animal.model.data, {}), species.name, told);
        for (const Defect& defect : all_defects()) {
            Random random(1);
            Patient patient(animal);
            if (plant(patient, defect, random).empty()) continue;
            expect_places(findings_of(patient.data(), {}), std::string(species.name) + ", " + defect.name, told);
        }
    }
}

TEST(Places, ExceptionsAreOfCodesThatThereAre) {
    std::set<std::string> codes;
    for (const validators::Check& check : validators::all_checks()) codes.emplace(check.code);
    for (const auto& [code, why] : without_place) EXPECT_TRUE(code.starts_with('F') || codes.contains(code)) << code << ": " << why;
}

/// The middle of the only surface of a model of the zoo does not depend on the order of its triangles.
TEST(Places, OfWholeSurfacesDoNotDependOnTheOrderOfTriangles) {
    const auto place_of = [](Dataset data) {
        const auto checked = validators::check_models(data, {});
        std::vector<Vec3> points;
        for (const Finding& f : checked->findings) {
            if (f.code == "B16") points.insert(points.end(), f.points.begin(), f.points.end());
        }
        return points;
    };
    const auto fixtures = model_fixtures();
    const auto outside = std::ranges::find(fixtures, std::string("B16"), [](const Fixture& f) { return std::string(f.code); });
    ASSERT_NE(outside, fixtures.end());
    Dataset turned = outside->fails();
    for (Object& object : turned.objects) {
        auto* surface = std::get_if<Surface>(&object);
        if (surface == nullptr || surface->parts.size() > 1) continue;
        auto& corners = surface->polygons.corners;
        const std::size_t triangles = corners.size() / 3;
        for (std::size_t t = 0; t < triangles / 2; ++t)
            std::swap_ranges(corners.begin() + static_cast<std::ptrdiff_t>(3 * t), corners.begin() + static_cast<std::ptrdiff_t>(3 * t + 3),
                             corners.begin() + static_cast<std::ptrdiff_t>(3 * (triangles - 1 - t)));
    }
    const auto before = place_of(outside->fails()), after = place_of(turned);
    ASSERT_FALSE(before.empty());
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(before[i][k], after[i][k], 1e-9);
    }
}

}  // namespace
}  // namespace geomend
