// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "support/program.h"

namespace geomend::test {
namespace {

nlohmann::json table_of_checks() {
    const ProgramRun run = run_geomend({"checks", "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return nlohmann::json::parse(run.out);
}

TEST(Checks, SayWhichStepsMendACodeOrWhyNoneDoes) {
    for (const auto& row : table_of_checks()) {
        EXPECT_NE(row.at("steps").empty(), !row.contains("why_no_steps")) << row.at("code");
        if (row.at("code") != "C04") continue;
        EXPECT_EQ(row.at("steps"), nlohmann::json::array({"close-gaps"}));
    }
}

TEST(Checks, SayWhereACodeHasAnotherSeverity) {
    std::size_t others = 0;
    for (const auto& row : table_of_checks()) {
        if (!row.contains("other_severity")) continue;
        ++others;
        EXPECT_NE(row.at("other_severity").at("severity"), row.at("severity")) << row.at("code");
    }
    EXPECT_GT(others, 0u);
    EXPECT_NE(run_geomend({"checks"}).out.find("C04  error; warning where they leave a gap: "), std::string::npos);
}

}  // namespace
}  // namespace geomend::test
