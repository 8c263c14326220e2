// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "validators/registry.h"
#include "validators/rewritten.h"
#include "validators/zoo_defects.h"

// Defects are planted at random in models of many forms, one alone or several far from one another: each must come out with its
// code and its entity.

namespace geomend {
namespace {

using namespace testing;

/// "a|b" matches a and b.
bool is_one_of(const std::string& choice, const std::string& word) {
    std::size_t from = 0;
    while (from <= choice.size()) {
        const std::size_t to = std::min(choice.find('|', from), choice.size());
        if (choice.compare(from, to - from, word) == 0) return true;
        from = to + 1;
    }
    return false;
}

std::string text(const std::vector<Finding>& findings) {
    std::string all;
    for (const Finding& f : findings) {
        all += "\n  " + f.code + ":";
        for (const EntityRef& e : f.entities) all += " " + e.kind + " " + e.name;
    }
    return all;
}

void expect_found(const Dataset& data, const Found& expected, const std::string& where) {
    const auto checked = validators::check_models(data, {});
    ASSERT_TRUE(checked) << where;
    // Where another defect opens the only region there is none left in which a sheet could lie (B06 tells).
    const bool no_region = std::ranges::find(checked->findings, "B06", &Finding::code) != checked->findings.end();
    for (const Expected& e : expected) {
        if (no_region && e.code == "B25") continue;
        const bool found = std::ranges::any_of(checked->findings, [&](const Finding& f) {
            return is_one_of(e.code, f.code) && std::ranges::any_of(f.entities, [&](const EntityRef& entity) {
                       return is_one_of(e.kind, entity.kind) && (e.name.empty() || entity.name == e.name);
                   });
        });
        EXPECT_TRUE(found) << where << ": expected " << e.code << " of " << e.kind << " " << e.name << ", found" << text(checked->findings);
    }
}

/// As it stands, and turned, so that nothing lies exactly on anything.
void expect_found(Patient& patient, const Found& expected, const std::string& where) {
    expect_found(patient.data(), expected, where);
    expect_found(moved(patient.data(), rotated), expected, where + ", rotated");
}

class PlantedInZoo : public ::testing::TestWithParam<Defect> {};

TEST_P(PlantedInZoo, IsFoundInEachModel) {
    unsigned planted = 0;
    for (const Species& species : whole_zoo()) {
        const Animal animal = species.make();
        for (unsigned seed = 0; seed < wanted_seeds(2); ++seed) {
            Random random(seed);
            Patient patient(animal);
            const Found expected = plant(patient, GetParam(), random);
            if (expected.empty()) continue;
            ++planted;
            expect_found(patient, expected, std::string(species.name) + ", seed " + std::to_string(seed));
            if (HasFailure()) return;
        }
    }
    EXPECT_GT(planted, 3u);
}

INSTANTIATE_TEST_SUITE_P(Defects, PlantedInZoo, ::testing::ValuesIn(all_defects().begin(), all_defects().end()),
                         [](const auto& defect) { return defect.param.name; });

TEST(SeveralDefects, AreAllFound) {
    const auto zoo = whole_zoo();
    unsigned several = 0;
    for (unsigned seed = 0; seed < wanted_seeds(150); ++seed) {
        Random random(seed);
        const Species& species = zoo[pick(random, zoo.size())];
        Patient patient(species.make());
        Found expected;
        std::string names;
        unsigned planted = 0;
        for (std::size_t k = 2 + pick(random, 3); k-- > 0;) {
            const Defect& defect = all_defects()[pick(random, all_defects().size())];
            const Found more = plant(patient, defect, random);
            expected.insert(expected.end(), more.begin(), more.end());
            if (!more.empty()) names += std::string(" ") + defect.name;
            planted += more.empty() ? 0 : 1;
        }
        several += planted > 1 ? 1 : 0;
        expect_found(patient, expected, std::string(species.name) + ", seed " + std::to_string(seed) + ":" + names);
        if (::testing::Test::HasFailure()) return;
    }
    EXPECT_GT(4 * several, wanted_seeds(150));
}

}  // namespace
}  // namespace geomend
