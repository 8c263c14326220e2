// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "validators/rewritten.h"
#include "validators/zoo.h"

// Models whose numbers of corners, lines, surfaces, regions and contacts, whose volumes and whose findings are known without
// the program: they come out so, however the model is stated and written.

namespace geomend {
namespace {

using namespace testing;

/// Codes without F111: that points of different surfaces at one position are one vertex is what these models want.
std::set<std::string> codes_in(const Dataset& data) {
    const auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    std::set<std::string> codes;
    for (const Finding& f : checked->findings) codes.insert(f.code);
    codes.erase("F111");
    return codes;
}

/// All that was found, to be read where a test fails.
std::string story(const Dataset& data) {
    const auto checked = validators::check_models(data, {});
    std::string text;
    for (const Finding& f : checked->findings) text += f.code + " " + f.message + "\n";
    return text;
}

void expect_counts(const BrepData& b, const Counts& known, const char* how) {
    EXPECT_EQ(b.corners.size(), known.corners) << how;
    EXPECT_EQ(b.lines.size(), known.lines) << how;
    EXPECT_EQ(b.surfaces.size(), known.surfaces) << how;
    EXPECT_EQ(b.regions.size(), known.regions) << how;
    EXPECT_EQ(b.interfaces.size(), known.interfaces) << how;
    EXPECT_EQ(b.contacts.size(), known.contacts) << how;
    EXPECT_EQ(b.internal_lines_of_regions, known.lines_in_regions) << how;
    EXPECT_EQ(b.internal_lines_of_surfaces, known.lines_in_surfaces) << how;
}

/// Volumes of regions in any order.
std::vector<double> sorted_volumes(const BrepData& b) {
    std::vector<double> volumes;
    for (const auto& region : b.regions) volumes.push_back(region.volume_known ? region.volume : -1);
    std::ranges::sort(volumes);
    return volumes;
}

void expect_volumes(const BrepData& b, std::vector<double> known, const char* how) {
    std::ranges::sort(known);
    const auto volumes = sorted_volumes(b);
    ASSERT_EQ(volumes.size(), known.size()) << how;
    double sum = 0;
    for (std::size_t r = 0; r < known.size(); ++r) {
        EXPECT_NEAR(volumes[r], known[r], 1e-12 * known[r]) << how;
        sum += known[r];
    }
    EXPECT_NEAR(b.universe_volume, sum, 1e-12 * sum) << how;
}

class Zoo : public ::testing::TestWithParam<Species> {};

TEST_P(Zoo, HasItsCountsVolumesAndFindings) {
    Animal animal = GetParam().make();
    if (!animal.volumes_by_hand.empty()) {
        ASSERT_EQ(animal.volumes_by_hand.size(), animal.model.volumes.size());
        for (std::size_t r = 0; r < animal.volumes_by_hand.size(); ++r)
            EXPECT_NEAR(animal.model.volumes[r], animal.volumes_by_hand[r], 1e-12 * animal.volumes_by_hand[r]);
    }
    EXPECT_EQ(codes_in(animal.model.data), animal.codes) << story(animal.model.data);
    Dataset stated = animal.model.data;
    topology::build_breps(stated);
    ASSERT_EQ(stated.breps.size(), 1u);
    expect_counts(*stated.breps[0], animal.counts, "as stated");
    expect_volumes(*stated.breps[0], animal.model.volumes, "as stated");
    for (std::size_t r = 0; r < animal.model.volumes.size(); ++r)
        EXPECT_NEAR(stated.breps[0]->regions[r].volume, animal.model.volumes[r], 1e-12 * animal.model.volumes[r])
            << "in the order of the lists";
}

TEST_P(Zoo, IsTheSameWithoutItsRegionLists) {
    Animal animal = GetParam().make();
    Dataset data = without_lists(animal.model.data);
    EXPECT_EQ(codes_in(data), animal.codes_of_unlisted()) << story(data);
    topology::build_breps(data);
    expect_counts(*data.breps.at(0), animal.counts, "without lists");
    expect_volumes(*data.breps[0], animal.model.volumes, "without lists");
}

TEST_P(Zoo, IsTheSameAsLooseSurfaces) {
    Animal animal = GetParam().make();
    const Dataset data = loose_surfaces(animal.model.data);
    EXPECT_EQ(codes_in(data), animal.codes_of_unlisted()) << story(data);
    const auto models = topology::models_to_judge(data, 1e-9);
    ASSERT_TRUE(models && models->size() == 1);
    expect_counts(*models->front().brep, animal.counts, "loose");
    expect_volumes(*models->front().brep, animal.model.volumes, "loose");
}

INSTANTIATE_TEST_SUITE_P(Models, Zoo, ::testing::ValuesIn(whole_zoo()), [](const auto& species) { return species.param.name; });

}  // namespace
}  // namespace geomend
