// SPDX-License-Identifier: AGPL-3.0-or-later
// Options are checked against the tables of what is in play, before anything is read.
#include "formats/options.h"

#include <gtest/gtest.h>

#include <set>

#include "formats/registry.h"
#include "pipeline/command_options.h"
#include "pipeline/convert.h"
#include "support/temporary_folder.h"

namespace geomend {
namespace {

using test::TemporaryFolder;
using test::write_file;

OptionsInPlay in_play(const char* read, const char* written) {
    OptionsInPlay all{{format_by_name(read)}, written == nullptr ? nullptr : format_by_name(written), convert_option_rows()};
    EXPECT_NE(all.read[0], nullptr) << read;
    return all;
}

std::string why_not(const FormatOptions& options, const OptionsInPlay& all) {
    const auto checked = checked_options(options, all);
    if (checked) return "taken";
    EXPECT_EQ(checked.why().kind, FailureKind::usage);
    EXPECT_EQ(checked.why().error.code, "F018");
    return checked.why().error.message;
}

TEST(CheckedOptions, AMisspeltKeyNamesTheNearestOne) {
    EXPECT_EQ(why_not({{"encodig", "ascii"}}, in_play("gocad-ts", "vtm")),
              "--option encodig=ascii: no such option; the nearest is encoding");
}

TEST(CheckedOptions, AKeyLikeNoneListsThoseThatAreKnown) {
    const std::string why = why_not({{"az", "brep"}}, in_play("gocad-ts", "vtm"));
    EXPECT_EQ(why.find("--option az=brep: no such option; expected "), 0u) << why;
    for (const OptionRow& row : format_by_name("vtm")->options)
        EXPECT_EQ(row.use != OptionUse::reading, why.find(" " + std::string(row.key)) != std::string::npos) << why;
    EXPECT_EQ(why.find("nearest"), std::string::npos) << "one of two letters is not near: " << why;
    EXPECT_EQ(why_not({{"crz", "ignore"}}, in_play("gocad-ts", "vtm")), "--option crz=ignore: no such option; the nearest is crs");
}

TEST(CheckedOptions, AMisspeltValueNamesTheNearestOne) {
    EXPECT_EQ(why_not({{"encoding", "asci"}}, in_play("gocad-ts", "vtm")),
              "--option encoding=asci: expected appended or ascii (nearest: ascii)");
    EXPECT_EQ(why_not({{"z", "dowm"}}, in_play("zmap", "cps3")), "--option z=dowm: expected elevation or depth");
    EXPECT_EQ(why_not({{"z", "dept"}}, in_play("zmap", "cps3")), "--option z=dept: expected elevation or depth (nearest: depth)");
}

TEST(CheckedOptions, AnOptionOfAnotherFormatSaysWhereItBelongs) {
    const std::string why = why_not({{"compress", "yes"}}, in_play("gocad-ts", "msh"));
    EXPECT_EQ(why.find("--option compress=yes: it belongs to writing vtu, "), 0u) << why;
    EXPECT_EQ(why_not({{"dims", "1,2,3"}}, in_play("grdecl", "vtu")), "taken") << "a reader's option, where it is read";
    EXPECT_NE(why_not({{"dims", "1,2,3"}}, in_play("egrid", "grdecl")), "taken") << "and not where it is written";
}

TEST(CheckedOptions, NumbersAreNumbers) {
    EXPECT_EQ(why_not({{"dims", "10,ten,3"}}, in_play("grdecl", "vtu")), "--option dims=10,ten,3: expected NX,NY,NZ");
    EXPECT_EQ(why_not({{"horizons", "3;7"}}, in_play("grdecl", "vtm")), "--option horizons=3;7: expected N,M,...");
    EXPECT_EQ(why_not({{"horizons", "3,7"}}, in_play("grdecl", "vtm")), "taken");
    EXPECT_EQ(why_not({{"gap", "-1"}}, {{}, nullptr, repair_option_rows()}), "--option gap=-1: expected L");
}

TEST(CheckedOptions, WordsAreTakenInEitherCaseAndComeAsTheTableHasThem) {
    const auto checked = checked_options({{"compress", "YES"}}, in_play("gocad-ts", "vtu"));
    ASSERT_TRUE(checked);
    EXPECT_EQ(option_value(*checked, "compress"), "yes");
}

TEST(CheckedOptions, TablesHaveEachKeyOnceAndEveryRowAMeaning) {
    const auto look = [](std::span<const OptionRow> rows, std::string_view where) {
        std::set<std::string_view> keys;
        for (const OptionRow& row : rows) {
            EXPECT_TRUE(keys.insert(row.key).second) << where << ' ' << row.key;
            EXPECT_FALSE(row.values.empty() || row.meaning.empty()) << where << ' ' << row.key;
        }
    };
    for (const Format& format : all_formats()) look(format.options, format.name);
    for (const auto rows : {info_option_rows(), convert_option_rows(), validate_option_rows(), repair_option_rows()}) look(rows, "command");
}

TEST(CheckedOptions, LibraryCallersGetTheSameCheckBeforeAnythingIsRead) {
    const TemporaryFolder folder;
    write_file(folder / "broken.ts", "GOCAD TSurf 1\nthis cannot be read\n");
    ConvertRequest request;
    request.inputs = {(folder / "broken.ts").string()};
    request.output = (folder / "out.vtp").string();
    request.load.options = {{"encoding", "asci"}};
    const auto converted = convert(request);
    ASSERT_FALSE(converted);
    EXPECT_EQ(converted.why().kind, FailureKind::usage);
    const auto loaded = load(request.inputs[0], {"", {{"z", "depth"}}, nullptr});
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.why().kind, FailureKind::usage) << "z is of horizon formats";
}

}  // namespace
}  // namespace geomend
