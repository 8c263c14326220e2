// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "repair/plans.h"
#include "validators/registry.h"
#include "validators/zoo_defects.h"

// Each planted defect of the zoo, repaired: the result has no kind of error that was not there, and not more of them in all.

namespace geomend {
namespace {

using namespace testing;

struct Tally {
    unsigned planted = 0, sound = 0, mended = 0;
};

std::uint64_t total(const repair::ErrorCounts& errors) {
    std::uint64_t sum = 0;
    for (const auto& [code, count] : errors) sum += count;
    return sum;
}

std::string text_of(const repair::ErrorCounts& errors) {
    std::string text;
    for (const auto& [code, count] : errors) text += ' ' + code + " x" + std::to_string(count);
    return text;
}

void repair_and_judge(const Dataset& data, const std::string& where, Tally& tally) {
    const auto before = validators::check_models(data, {});
    ASSERT_TRUE(before) << where;
    const auto had = repair::errors_of(before->findings);
    ++tally.planted;
    tally.sound += had.empty() ? 1u : 0u;
    repair::PlanFacts facts;
    facts.findings = facts.strict = before->findings;
    if (before->closing) facts.closing = before->closing->tolerance;
    facts.closes_whole = before->closing && before->closing->left == 0;
    const auto plans = repair::plans_for(facts);
    if (plans.empty()) return;
    const auto planned = repair::repair_by_plans(data, before->findings, plans, {}, false);
    ASSERT_TRUE(planned) << where << ": " << planned.why().error.message;
    const auto after = validators::check_models(planned->repair.result.dataset, {});
    ASSERT_TRUE(after) << where;
    const auto has = repair::errors_of(after->findings);
    tally.mended += !had.empty() && has.empty() ? 1u : 0u;
    EXPECT_EQ(repair::why_worse(had, has), "") << where << ", before" << text_of(had) << ", after" << text_of(has);
    EXPECT_LE(total(has), total(had)) << where;
}

TEST(RepairedZoo, IsNeverWorse) {
    const auto zoo = whole_zoo();
    const auto defects = all_defects();
    Tally tally;
    for (unsigned seed = 0; seed < wanted_seeds(120); ++seed) {
        Random random(seed);
        const Species& species = zoo[seed % zoo.size()];
        const Defect& defect = defects[(seed / zoo.size() + seed) % defects.size()];
        Patient patient(species.make());
        if (plant(patient, defect, random).empty()) continue;
        repair_and_judge(patient.data(), std::string(species.name) + " with " + defect.name + ", seed " + std::to_string(seed), tally);
    }
    std::printf("planted %u, %u of them no error; mended %u\n", tally.planted, tally.sound, tally.mended);
    EXPECT_GT(tally.mended, 0u);
}

}  // namespace
}  // namespace geomend
