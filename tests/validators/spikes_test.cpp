// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
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

INSTANTIATE_TEST_SUITE_P(Models, Spike, ::testing::ValuesIn(whole_zoo()), [](const auto& species) { return species.param.name; });

}  // namespace
}  // namespace geomend
