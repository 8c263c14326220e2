// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/code_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/codes.h"
#include "repair/grid_steps.h"
#include "repair/surface_steps.h"
#include "report/advice.h"

namespace geomend::repair {
namespace {

TEST(CodeSteps, EachCodeOfTheCatalogueHasAStepThatMendsItOrAReasonWhyNoneDoes) {
    for (const CodeInfo& row : code_catalogue()) EXPECT_NE(steps_for(row.code).empty(), why_unmended(row.code).empty()) << row.code;
}

TEST(CodeSteps, AreOfCodesThatThereAre) {
    for (const StepRow& row : grid_steps()) {
        for (const std::string_view code : row.mends) EXPECT_NE(find_code(code), nullptr) << row.name << ' ' << code;
    }
    for (const SurfaceStepRow& row : surface_steps()) {
        for (const std::string_view code : row.mends) EXPECT_NE(find_code(code), nullptr) << row.name << ' ' << code;
    }
}

TEST(CodeSteps, ComeInTheOrderInWhichTheyAreTaken) {
    EXPECT_EQ(steps_for("C03"), std::vector<std::string_view>{"monotone"});
    EXPECT_EQ(steps_for("B26"), (std::vector<std::string_view>{"clean", "cut"}));
    EXPECT_TRUE(steps_for("F999").empty());
    EXPECT_TRUE(why_unmended("F999").empty());
}

// The words behind each "--step " of a text.
std::vector<std::string> steps_named_in(const std::string& text) {
    constexpr std::string_view option = "--step ";
    std::vector<std::string> names;
    for (std::size_t at = text.find(option); at != std::string::npos; at = text.find(option, at)) {
        at += option.size();
        names.push_back(text.substr(at, text.find_first_of(" ,;", at) - at));
    }
    return names;
}

TEST(CodeSteps, TheAdviceInReportsNamesThemAndNoOthers) {
    for (const CodeInfo& row : code_catalogue()) {
        const auto named = steps_named_in(std::string(advice_for(row.code)));
        const auto steps = steps_for(row.code);
        for (const std::string& name : named) EXPECT_NE(std::ranges::find(steps, name), steps.end()) << row.code << ' ' << name;
        for (const StepRow& step : grid_steps()) {
            if (std::ranges::find(step.mends, row.code) == step.mends.end()) continue;
            EXPECT_NE(std::ranges::find(named, step.name), named.end()) << row.code << " is mended by " << step.name;
        }
    }
}

}  // namespace
}  // namespace geomend::repair
