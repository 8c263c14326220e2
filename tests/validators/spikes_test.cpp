// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

#include "validators/rewritten.h"
#include "validators/zoo_defects.h"

// A single height of a model that is no height: one finding names the point, and nothing that follows from it is reported.

namespace geomend {
namespace {

using namespace testing;

std::map<std::string, std::uint64_t> told(const Dataset& data) {
    const auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    std::map<std::string, std::uint64_t> codes;
    for (const Finding& f : checked->findings) ++codes[f.code];
    return codes;
}

/// Every surface of a model that has points away from its borders, with one of these put at a height.
void each_spike(const Animal& animal, double height, const std::function<void(Dataset, const std::string&)>& visit) {
    Patient patient(animal);
    std::set<std::uint32_t> done;
    for (std::size_t face = 0; face < patient.faces(); ++face) {
        const auto inner = patient.inner_points(face);
        if (inner.empty() || !done.insert(patient.model().faces[face].object).second) continue;
        Dataset data = animal.model.data;
        Surface& surface = std::get<Surface>(data.objects[patient.model().faces[face].object]);
        surface.points[inner[inner.size() / 2]][2] = height;
        visit(std::move(data), patient.name(face));
    }
}

class Spike : public ::testing::TestWithParam<Species> {};

TEST_P(Spike, IsReportedAloneWhateverStatesTheModel) {
    const Animal animal = GetParam().make();
    const auto sound = told(animal.model.data), sound_loose = told(loose_surfaces(animal.model.data));
    for (const double height : {-99999.0, 1e9}) {
        each_spike(animal, height, [&](const Dataset& data, const std::string& name) {
            auto found = told(data);
            EXPECT_EQ(found["M15"], 1u) << name;
            found.erase("M15");
            EXPECT_EQ(found, sound) << name << " at " << height;
            found = told(loose_surfaces(data));
            EXPECT_EQ(found["M15"], 1u) << name;
            found.erase("M15");
            EXPECT_EQ(found, sound_loose) << name << " at " << height << ", loose";
        });
    }
}

/// The number of edges at a point that one triangle of a face alone has, by positions.
std::size_t free_edges_at(Patient& patient, std::size_t face, std::uint32_t point) {
    const Vec3 here = patient.at(face, point);
    std::map<Vec3, int> uses;
    for (std::uint64_t t = patient.first(face); t < patient.last(face); ++t) {
        const Corners corners = patient.corners(face, t);
        const bool has_it = std::ranges::any_of(corners, [&](std::uint32_t c) { return patient.at(face, c) == here; });
        for (const std::uint32_t c : corners) uses[patient.at(face, c)] += has_it && patient.at(face, c) != here ? 1 : 0;
    }
    return static_cast<std::size_t>(std::ranges::count_if(uses, [](const auto& use) { return use.second == 1; }));
}

/// A point on the border of each triangle of each surface of a model, in that surface alone, is put far down.
void each_border_spike(const Animal& animal, const std::function<void(Dataset, const std::string&)>& visit) {
    Patient patient(animal);
    std::set<std::pair<std::uint32_t, std::uint32_t>> done;
    for (std::size_t face = 0; face < patient.faces(); ++face) {
        const std::uint32_t object = patient.model().faces[face].object;
        const auto inner = patient.inner_points(face);
        if (inner.empty()) continue;
        for (std::uint64_t t = patient.first(face); t < patient.last(face); ++t) {
            const std::uint32_t point = patient.corners(face, t)[0];
            if (std::ranges::find(inner, point) != inner.end() || !done.emplace(object, point).second) continue;
            Dataset data = animal.model.data;
            auto& points = std::get<Surface>(data.objects[object]).points;
            if (free_edges_at(patient, face, point) != 2) continue;  // other surfaces end on this one there, or it touches itself
            points[point][2] = -99999;
            visit(std::move(data), patient.name(face) + ", triangle " + std::to_string(t));
        }
    }
}

TEST_P(Spike, IsReportedAloneOnBordersToo) {
    const Animal animal = GetParam().make();
    const auto sound = told(animal.model.data);
    each_border_spike(animal, [&](const Dataset& data, const std::string& name) {
        auto found = told(data);
        EXPECT_EQ(found["M15"], 1u) << name;
        found.erase("M15");
        EXPECT_EQ(found, sound) << name;
    });
}

/// Points inside of several surfaces that stand above each other, all put far down: at one position, though they are not one point.
TEST_P(Spike, OfSurfacesAboveEachOtherAreReportedAlone) {
    const Animal animal = GetParam().make();
    Patient patient(animal);
    std::map<std::array<double, 2>, std::map<std::uint32_t, std::uint32_t>> at;  // by place on the map, then by object
    for (std::size_t face = 0; face < patient.faces(); ++face) {
        for (const std::uint32_t point : patient.inner_points(face)) {
            const Vec3 p = patient.at(face, point);
            at[{p[0], p[1]}].emplace(patient.model().faces[face].object, point);
        }
    }
    const auto sound = told(animal.model.data);
    unsigned tried = 0;
    for (const auto& [place, points] : at) {
        if (points.size() < 2 || ++tried > 5) continue;
        Dataset data = animal.model.data;
        for (const auto& [object, point] : points) std::get<Surface>(data.objects[object]).points[point][2] = -99999;
        auto found = told(data);
        EXPECT_EQ(found["M15"], points.size()) << place[0] << ' ' << place[1];
        found.erase("M15");
        EXPECT_EQ(found, sound) << points.size() << " at " << place[0] << ' ' << place[1];
    }
}

TEST(Spikes, AlongASideOfASurfaceAreReportedAlone) {
    for (const std::uint32_t rows : {1u, 2u, 4u}) {
        Dataset data;
        Surface surface;
        surface.info.name = "hz";
        surface.info.role = FeatureRole::horizon;
        for (std::uint32_t p = 0; p < 25; ++p) {
            const std::uint32_t i = p % 5, j = p / 5;
            surface.points.push_back({100.0 * i, 100.0 * j, j < rows ? -99999.0 : -1500.0 - i - 3.0 * j});
        }
        for (std::uint32_t p = 0; p + 6 < 25; ++p) {
            if (p % 5 == 4) continue;
            surface.polygons.corners.insert(surface.polygons.corners.end(), {p, p + 1, p + 6, p, p + 6, p + 5});
        }
        data.objects.emplace_back(std::move(surface));
        EXPECT_EQ(told(data), (std::map<std::string, std::uint64_t>{{"M15", 1}})) << rows;
    }
}

INSTANTIATE_TEST_SUITE_P(Models, Spike, ::testing::ValuesIn(whole_zoo()), [](const auto& species) { return species.param.name; });

}  // namespace
}  // namespace geomend
