// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/check_selection.h"

#include <gtest/gtest.h>

#include "base/codes.h"
#include "pipeline/validate.h"
#include "validators/checks_testing.h"
#include "validators/layered_model.h"

namespace geomend {
namespace {

using namespace testing;
using Codes = std::set<std::string>;
using validators::stands_for;

CheckOptions only(std::vector<std::string> words) {
    CheckOptions o;
    o.only = std::move(words);
    return o;
}
CheckOptions without(std::vector<std::string> words) {
    CheckOptions o;
    o.skip = std::move(words);
    return o;
}

TEST(AWordOfTheLists, IsACodeAFamilyOrAPattern) {
    EXPECT_TRUE(stands_for("B08", "B08"));
    EXPECT_FALSE(stands_for("B08", "B09"));
    EXPECT_TRUE(stands_for("B", "B08"));
    EXPECT_FALSE(stands_for("B", "M08"));
    EXPECT_TRUE(stands_for("B*", "B08"));
    EXPECT_TRUE(stands_for("*8", "B08"));
    EXPECT_TRUE(stands_for("F1*", "F113"));
    EXPECT_FALSE(stands_for("F1*", "F004"));
    EXPECT_TRUE(stands_for("M2?", "M28"));
    EXPECT_FALSE(stands_for("M2?", "M2"));
    EXPECT_FALSE(stands_for("", "M28"));
    EXPECT_TRUE(stands_for("*", "M28"));
    EXPECT_FALSE(stands_for("?", "M28"));
}

TEST(AWordOfTheLists, MustStandForSomething) {
    for (const char* word : {"B08", "F122", "F", "S*", "*", "M0?", "C22"}) EXPECT_TRUE(validators::known_codes(only({word}))) << word;
    for (const char* word : {"", "B99", "b08", "X", "B08 ", "B**9?", "F2*", "B8"}) {
        const auto known = validators::known_codes(only({word}));
        ASSERT_FALSE(known) << word;
        EXPECT_EQ(known.why().kind, FailureKind::usage);
        EXPECT_FALSE(validators::known_codes(without({word}))) << word;
    }
    EXPECT_FALSE(validators::known_codes(only({std::string(100000, '*') + "!"}))) << "and that in no time";
}

TEST(AnUnknownCode, IsRefusedWithTheOneThatIsMostLikeIt) {
    EXPECT_EQ(validators::nearest_code("b08"), "B08");
    EXPECT_EQ(validators::nearest_code("B8"), "B08");
    EXPECT_EQ(validators::nearest_code("F0112"), "F011");
    EXPECT_EQ(validators::nearest_code("m-27"), "M27");
    EXPECT_NE(validators::known_codes(only({"b08"})).why().error.message.find("did you mean B08?"), std::string::npos);
}

TEST(Choice, NoCodeThatSaysThatNothingWasJudgedCanBeLeftOut) {
    for (const CodeInfo& row : code_catalogue()) {
        const bool always = row.code.starts_with("F0") || row.code == "M09";
        EXPECT_EQ(validators::always_reported(row.code), always) << row.code;
        const std::string code(row.code);
        EXPECT_EQ(validators::known_codes(without({code})).ok(), !always) << code;
        EXPECT_EQ(validators::wanted(without({code.substr(0, 1)}), code), always) << code;
        EXPECT_EQ(validators::wanted(only({code == "B01" ? "B02" : "B01"}), code), always) << code;
        EXPECT_TRUE(validators::wanted(only({code}), code));
        EXPECT_TRUE(validators::wanted({}, code));
    }
}

Finding remark(const char* code, Severity severity) {
    Finding f;
    f.code = code;
    f.severity = severity;
    return f;
}

TEST(Choice, AppliesToWhatReadersSay) {
    Dataset data = LayeredModel().data();
    data.findings = {remark("F122", Severity::info), remark("F105", Severity::warning), remark("F022", Severity::error)};
    const auto codes = [&](const CheckOptions& options) {
        const auto file = validate("made", data, options);
        EXPECT_TRUE(file);
        return codes_of(file->findings);
    };
    EXPECT_EQ(codes({}), (Codes{"F022 error", "F105 warning", "F111 info", "F122 info", "G03 info"}));
    EXPECT_EQ(codes(without({"F122"})), (Codes{"F022 error", "F105 warning", "F111 info", "G03 info"}));
    EXPECT_EQ(codes(without({"F"})), (Codes{"F022 error", "G03 info"})) << "what cannot be read is always told";
    EXPECT_EQ(codes(only({"F122"})), (Codes{"F022 error", "F122 info"}));
    EXPECT_EQ(codes(only({"G"})), (Codes{"F022 error", "G03 info"}));
    EXPECT_EQ(validate("made", data, without({"F"}))->valid, false);
}

TEST(Choice, OfNothingThatJudgesMakesNoModelValid) {
    const Dataset data = LayeredModel().data();
    EXPECT_EQ(validate("made", data, {})->valid, true);
    EXPECT_FALSE(validate("made", data, only({"G03"}))->valid.has_value());
    EXPECT_FALSE(validate("made", data, only({"F1*"}))->valid.has_value());
}

TEST(Choice, OfAPartOfTheChecksSaysWhatWasJudged) {
    const Dataset data = LayeredModel().data();
    const auto part = validate("made", data, without({"B05"}));
    EXPECT_FALSE(part->valid.has_value());
    ASSERT_TRUE(part->chosen.has_value());
    EXPECT_EQ(part->chosen->skip, std::vector<std::string>{"B05"});
    EXPECT_FALSE(validate("made", data, {})->chosen.has_value());
    // What cannot be found in such a file, or is a note at most, is no part of the verdict.
    for (const char* word : {"C", "S", "F122", "B25"}) EXPECT_EQ(validate("made", data, without({word}))->valid, true) << word;
    Dataset broken = data;
    std::get<Surface>(broken.objects[0]).polygons.corners[1] = std::get<Surface>(broken.objects[0]).polygons.corners[0];
    EXPECT_EQ(validate("made", broken, without({"B05"}))->valid, false) << "an error is an error";
    EXPECT_TRUE(validate("made", broken, without({"B05"}))->chosen.has_value());
}

TEST(Choice, OfAFindingThatFollowsFromOthersRunsThese) {
    LayeredModel model;
    Surface& top = model.surface("top");
    const std::uint32_t last = top.polygons.corners.back(), before = *std::prev(top.polygons.corners.end(), 2);
    add_triangle(top, last, before, before);
    const auto codes = [&](const CheckOptions& options) { return codes_of(validate("made", model.data(), options)->findings); };
    EXPECT_TRUE(codes({}).contains("B01 error"));
    EXPECT_EQ(codes(only({"B18"})), Codes{"B18 error"});
    EXPECT_FALSE(codes(without({"B01"})).contains("B18 error")) << "what is skipped is not passed on";
    CheckOptions ready = only({"S02"});
    ready.target = "tetgen";
    EXPECT_TRUE(codes(ready).contains("S02 error"));
    EXPECT_FALSE(codes(ready).contains("B01 error")) << "only S02 was asked for";
    ready.skip = {"B01", "B18"};
    EXPECT_FALSE(codes(ready).contains("S02 error"));
}

TEST(Choice, AFileOfWhichAPartCouldNotBeReadIsNotCalledValid) {
    Dataset data = LayeredModel().data();
    data.findings = {remark("F010", Severity::warning)};
    EXPECT_FALSE(validate("made", data, {})->valid.has_value());
    EXPECT_FALSE(validate("made", data, without({"F"}))->valid.has_value());
}

TEST(Choice, CannotMakeAGridValidThatCannotBeJudged) {
    CornerPointGrid grid = brick_grid(2, 2, 2);
    grid.depths.pop_back();
    Dataset data;
    data.objects.emplace_back(grid);
    EXPECT_EQ(validate("grid", data, without({"C"}))->valid, false);
}

}  // namespace
}  // namespace geomend
