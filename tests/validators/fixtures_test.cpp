// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/fixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/codes.h"
#include "pipeline/validate.h"

// Every code of a check has a model in which it is found and one, nearly the same, in which it is not.

namespace geomend {
namespace {

using testing::all_fixtures;
using testing::Fixture;

std::vector<Finding> findings_of(const Dataset& data, const Fixture& fixture) {
    validators::CheckOptions options;
    options.target = fixture.target;
    if (fixture.as_brep) options.grid_model.emplace();
    const auto file = validate("fixture", data, options);
    EXPECT_TRUE(file) << fixture.code;
    return file ? file->findings : std::vector<Finding>{};
}

std::string codes_in(const std::vector<Finding>& findings) {
    std::string text;
    for (const Finding& f : findings) text += f.code + " (" + f.message + "); ";
    return text;
}

class CodeFixture : public ::testing::TestWithParam<Fixture> {};

TEST_P(CodeFixture, FindsTheDefectAndNothingWithoutIt) {
    const Fixture& fixture = GetParam();
    const auto has_code = [&](const Finding& f) { return f.code == fixture.code; };
    const auto broken = findings_of(fixture.fails(), fixture);
    const auto found = std::ranges::find_if(broken, has_code);
    ASSERT_NE(found, broken.end()) << "found " << codes_in(broken);
    EXPECT_FALSE(found->message.empty());
    EXPECT_TRUE(!found->entities.empty() || found->where.line > 0 || fixture.code[0] == 'S') << "nothing is named";
    EXPECT_GT(found->count + (fixture.code[0] == 'S' || fixture.code[0] == 'C' ? 1 : 0), 0u);
    const auto sound = findings_of(fixture.passes(), fixture);
    EXPECT_TRUE(std::ranges::none_of(sound, has_code)) << "found " << codes_in(sound);
    EXPECT_TRUE(std::ranges::none_of(sound, [](const Finding& f) { return f.severity == Severity::error; })) << codes_in(sound);
}

INSTANTIATE_TEST_SUITE_P(Every, CodeFixture, ::testing::ValuesIn(all_fixtures()),
                         [](const auto& fixture) { return std::string(fixture.param.code); });

TEST(Fixtures, ThereIsOneForEachCodeOfACheck) {
    std::set<std::string> with;
    for (const Fixture& fixture : all_fixtures()) EXPECT_TRUE(with.insert(fixture.code).second) << fixture.code << " is there twice";
    for (const CodeInfo& row : code_catalogue()) {
        if (row.code.starts_with('F')) continue;  // readers and writers tell these
        EXPECT_TRUE(with.contains(std::string(row.code))) << row.code << " has no fixture";
        const auto checks = validators::all_checks();
        EXPECT_NE(std::ranges::find(checks, row.code, &validators::Check::code), checks.end()) << row.code << " is of no check";
    }
    for (const std::string& code : with) EXPECT_NE(find_code(code), nullptr) << code;
    for (const validators::Check& check : validators::all_checks()) EXPECT_NE(find_code(check.code), nullptr) << check.code;
}

}  // namespace
}  // namespace geomend
