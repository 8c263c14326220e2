// SPDX-License-Identifier: AGPL-3.0-or-later
#include "fault_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "repair/plans.h"
#include "support/seeds.h"
#include "validators/registry.h"

// Made models whose regions and volumes are known from half-spaces, taken apart into loose surfaces in four ways.

namespace geomend {
namespace {

using test::Ending;

struct Mended {
    std::vector<double> volumes;
    repair::ErrorCounts errors;
    std::string undone;
};

Mended mend(const Dataset& dataset, double max_gap) {
    validators::CheckOptions checks;
    auto before = validators::check_models(dataset, checks);
    EXPECT_TRUE(before);
    repair::SurfaceDriverOptions options;
    options.steps.max_gap = max_gap;
    repair::PlanFacts facts;
    facts.findings = facts.strict = before->findings;
    facts.close_gaps = max_gap >= 0;
    auto planned = repair::repair_by_plans(dataset, before->findings, repair::plans_for(facts), options, false);
    EXPECT_TRUE(planned);
    const repair::SurfaceRepair* repaired = &planned->repair;
    Mended mended;
    for (const auto& region : repaired->result.brep->regions) mended.volumes.push_back(region.volume);
    std::ranges::sort(mended.volumes);
    auto after = validators::check_models(repaired->result.dataset, checks);
    EXPECT_TRUE(after);
    mended.errors = repair::errors_of(after->findings);
    for (const auto& step : repaired->steps) mended.undone += step.kept ? "" : step.step + ": " + step.why;
    return mended;
}

const std::uint32_t first_of_seeds = test::first_seed(1);

void expect_mended(std::uint32_t seed, Ending ending, double share, bool shuffled) {
    auto made = test::fault_blocks(seed, ending);
    if (shuffled) test::shuffle(made.dataset, seed);
    const Mended mended = mend(made.dataset, made.max_gap);
    EXPECT_TRUE(mended.errors.empty()) << "seed " << seed << ": " << mended.errors.begin()->first;
    EXPECT_EQ(mended.undone, "") << "seed " << seed;
    ASSERT_EQ(mended.volumes.size(), made.volumes.size()) << "seed " << seed;
    for (std::size_t i = 0; i < made.volumes.size(); ++i) {
        EXPECT_NEAR(mended.volumes[i], made.volumes[i], share * made.volumes[i]) << "seed " << seed;
    }
}

TEST(FaultBlocks, TheGeneratorsVolumesSumToTheBox) {
    for (std::uint32_t seed = 1; seed < 40; ++seed) {
        const auto made = test::fault_blocks(seed, Ending::exact);
        double sum = 0;
        for (const double v : made.volumes) sum += v;
        EXPECT_NEAR(sum, 0.32 * made.size * made.size * made.size, 1e-9 * sum) << seed;
    }
}

TEST(FaultBlocks, PatchesThatEndExactlyAreCutToTheirRegions) {
    for (std::uint32_t seed = first_of_seeds, end = seed + test::seeds(25); seed < end; ++seed)
        expect_mended(seed, Ending::exact, 1e-6, seed % 2 == 0);
}

TEST(FaultBlocks, WhatSticksOutOfTheBoxIsTakenAway) {
    for (std::uint32_t seed = first_of_seeds, end = seed + test::seeds(25); seed < end; ++seed)
        expect_mended(seed, Ending::out_of_box, 1e-6, seed % 2 == 0);
}

TEST(FaultBlocks, PatchesThatRunThroughFaultsAreTrimmed) {
    for (std::uint32_t seed = first_of_seeds, end = seed + test::seeds(25); seed < end; ++seed)
        expect_mended(seed, Ending::through_faults, 1e-6, seed % 2 == 0);
}

TEST(FaultBlocks, PatchesThatStopShortAreClosed) {
    for (std::uint32_t seed = first_of_seeds, end = seed + test::seeds(25); seed < end; ++seed)
        expect_mended(seed, Ending::short_of, 0.03, seed % 2 == 0);
}

}  // namespace
}  // namespace geomend
