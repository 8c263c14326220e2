// SPDX-License-Identifier: AGPL-3.0-or-later
// The free format: comments, quotes, repeats, defaults, includes, boxes and operations.
#include "grdecl/grdecl_support.h"

namespace geomend::test {
namespace {

using Dims = std::array<std::uint32_t, 3>;

// Two columns of two layers.
const std::string small =
    "SPECGRID\n 2 1 2 1 F /\nCOORD\n 0 0 0 0 0 10  1 0 0 1 0 10  2 0 0 2 0 10\n 0 1 0 0 1 10  1 1 0 1 1 10  2 1 0 2 1 10 /\n"
    "ZCORN\n 8*0 16*1 8*2 /\n";

TEST(Grammar, CommentsTabsCommasAndCarriageReturnsPartItems) {
    const auto g =
        good(small + "PORO -- of the rock / not the end\r\n\t0.1,0.2 -- two\r\n 0.3\f.4/ and this is a remark\r\nNTG\r\n4*1 /\r\n");
    EXPECT_EQ(values(g, "PORO"), (std::vector<double>{0.1, 0.2, 0.3, 0.4}));
    EXPECT_EQ(values(g, "NTG"), (std::vector<double>{1, 1, 1, 1}));
}

TEST(Grammar, FortranExponentsAndSigns) {
    const auto g = good(small + "PORO\n 1.5D-1 +2.5e-01 .3E0 4.d-1 /\n");
    EXPECT_EQ(values(g, "PORO"), (std::vector<double>{0.15, 0.25, 0.3, 0.4}));
}

TEST(Grammar, NumbersAreReadToTheLastBit) {
    const auto g = good(small + "PORO\n 0.1234567890123456789 123456789012345678 1e-300 9007199254740993 /\n");
    EXPECT_EQ(values(g, "PORO"), (std::vector<double>{0.1234567890123456789, 123456789012345678.0, 1e-300, 9007199254740993.0}));
}

TEST(Grammar, DefaultsInArraysAreWhatSimulatorsTakeOrMissing) {
    const auto g = good(small + "NTG\n 2* 0.5 * /\nPORO\n 0.1 1* 0.2 1* /\nSATNUM\n 3* 2 /\nFLUXNUM\n 1 3* /\n");
    EXPECT_EQ(values(g, "NTG"), (std::vector<double>{1, 1, 0.5, 1}));
    EXPECT_EQ(values(g, "SATNUM"), (std::vector<double>{1, 1, 1, 2}));
    ASSERT_TRUE(attribute(g, "PORO").no_data);
    EXPECT_TRUE(is_no_data(attribute(g, "PORO"), values(g, "PORO")[1]));
    ASSERT_TRUE(attribute(g, "FLUXNUM").no_data);
    EXPECT_EQ(values(g, "FLUXNUM")[3], *attribute(g, "FLUXNUM").no_data);
}

TEST(Grammar, KeywordsMayBeQuotedPaddedOrLongerThanTheirEightLetters) {
    const auto g = good(small + "'PORO    '\n 4*0.25 /\n  SPECGRIDS\n 2 1 2 /\n");
    EXPECT_EQ(values(g, "PORO"), std::vector<double>(4, 0.25));
}

TEST(Grammar, AnUnknownKeywordWithOneValueForEachCellIsAProperty) {
    const auto g = good(small + "FACIES\n 1 2 2 1 /\nRHOB\n 2.5 2.6 2.7 2.8 /\nZONE\n 'top' 'top' 'a/b' \"it's\" /\n");
    EXPECT_TRUE(std::holds_alternative<std::vector<std::int32_t>>(attribute(g, "FACIES").values));
    EXPECT_TRUE(std::holds_alternative<std::vector<double>>(attribute(g, "RHOB").values));
    EXPECT_EQ(std::get<std::vector<std::string>>(attribute(g, "ZONE").values), (std::vector<std::string>{"top", "top", "a/b", "it's"}));
}

TEST(Grammar, WhatIsNotKnownIsKeptAsItStandsAndTold) {
    const auto d = read_text(small + "WONDER\n 'a' 1 /\n 'b' 2 /\n/\nINIT\nMARVEL\nPORO\n 4*0.1 /\n");
    ASSERT_TRUE(d) << why(d);
    const auto& kept = grid_of(*d).info.annotations;
    ASSERT_EQ(kept.size(), 3U);
    EXPECT_EQ(kept[0].value, "WONDER\n 'a' 1 /\n 'b' 2 /\n/");
    EXPECT_EQ(kept[1].value, "INIT");
    EXPECT_EQ(kept[2].value, "MARVEL");
    EXPECT_EQ(values(grid_of(*d), "PORO")[3], 0.1);
    EXPECT_TRUE(has_finding(*d, "F102"));
}

TEST(Grammar, SkippedTextAndEnd) {
    const auto d = read_text(small + "SKIP\nPORO\n 1 / nonsense\nENDSKIP\nPORO\n 4*0.1 /\nEND\nPORO 17\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_EQ(values(grid_of(*d), "PORO")[0], 0.1);
    ASSERT_EQ(d->losses.size(), 2U);
    EXPECT_EQ(d->losses[0].loss_class, LossClass::style);
    EXPECT_EQ(d->losses[1].what, "text behind END");
}

TEST(Grammar, ABoxIsFilledAndTheRestStaysAsItWas) {
    const auto g = good(small + "PORO\n 4*0.1 /\nBOX\n 2 2 1 1 1 2 /\nPORO\n 0.5 0.6 /\nENDBOX\nNTG\n 4*0.7 /\n");
    EXPECT_EQ(values(g, "PORO"), (std::vector<double>{0.1, 0.5, 0.1, 0.6}));
    EXPECT_EQ(values(g, "NTG"), std::vector<double>(4, 0.7));
}

TEST(Grammar, ABoxOfTheUppermostLayerHoldsForThoseBelow) {
    const auto g = good(small + "BOX\n 1 2 1 1 1 1 /\nPORO\n 0.5 0.6 /\nNTG\n 0.5 0.6 /\nENDBOX\nPERMX\n 5 6 2* /\n");
    EXPECT_EQ(values(g, "PORO"), (std::vector<double>{0.5, 0.6, 0.5, 0.6}));
    EXPECT_EQ(values(g, "NTG"), (std::vector<double>{0.5, 0.6, 1, 1}));
    const double none = *attribute(g, "PERMX").no_data;  // defaults are no values
    EXPECT_EQ(values(g, "PERMX"), (std::vector<double>{5, 6, none, none}));
}

TEST(Grammar, OperationsAreDoneInTheirOrder) {
    const auto g =
        good(small +
             "EQUALS\n 'PORO' 0.2 / \n PORO 0.3 1 1 1 1 2 2 / a box\n PERMX 100 1 2 1 1 1 2 /\n SATNUM 1 /\n SATNUM 2 2 2 4* /\n/\n"
             "COPY\n PERMX PERMY /\n PERMX PERMZ 1 2 1 1 1 1 /\n/\nMULTIPLY\n PERMZ 0.1 /\n/\nADD\n PERMY 5 2 2 4* /\n/\n"
             "MINVALUE\n PORO 0.25 /\n/\nMAXVALUE\n PERMX 50 1 1 1 1 1 1 /\n/\n");
    EXPECT_EQ(values(g, "PORO"), (std::vector<double>{0.25, 0.25, 0.3, 0.25}));
    EXPECT_EQ(values(g, "PERMX"), (std::vector<double>{50, 100, 100, 100}));
    EXPECT_EQ(values(g, "PERMY"), (std::vector<double>{100, 105, 100, 105}));
    const double none = *attribute(g, "PERMZ").no_data;
    EXPECT_EQ(values(g, "PERMZ"), (std::vector<double>{10, 10, none, none}));  // an operation says nothing of other layers
    EXPECT_EQ(values(g, "SATNUM"), (std::vector<double>{1, 2, 1, 2}));
}

TEST(Grammar, OperationsByRegion) {
    const auto g =
        good(small +
             "FLUXNUM\n 1 2 1 2 /\nMULTNUM\n 1 1 3 3 /\nPORO\n 4*0.5 /\nMULTIREG\n PORO 0.5 2 F /\n PORO 0.1 3 /\n/\nEQUALREG\n NTG 0.8 "
             "1 F /\n/\nCOPYREG\n PORO PERMX 1 F /\n/\nADDREG\n PERMX 1 1 M /\n/\n");
    EXPECT_EQ(values(g, "PORO"), (std::vector<double>{0.5, 0.25, 0.05, 0.025}));
    EXPECT_EQ(values(g, "NTG"), (std::vector<double>{0.8, 1, 0.8, 1}));
    EXPECT_EQ(values(g, "PERMX")[0], 1.5);
    EXPECT_EQ(values(g, "PERMX")[2], 0.05);
}

TEST(Grammar, OperateComputes) {
    const auto g =
        good(small + "PORO\n 0.1 0.2 0.3 0.4 /\nOPERATE\n PERMX 1 2 1 1 1 2 MULTA PORO 100 1 /\n PERMX 1 1 1 1 1 1 SLOG PORO 1 10 /\n/\n");
    EXPECT_EQ(values(g, "PERMX"), (std::vector<double>{100, 21, 31, 41}));
}

TEST(Grammar, AnOperationOnAnArrayThatIsNotThereIsKept) {
    const auto d = read_text(small + "COPY\n PERMX PERMY /\n/\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "F142"));
    ASSERT_EQ(grid_of(*d).info.annotations.size(), 1U);
    EXPECT_EQ(grid_of(*d).info.annotations[0].value, "COPY\n PERMX PERMY /\n/");
}

TEST(Grammar, SpecgridMayComeLast) {
    const std::size_t coord = small.find("COORD");
    const auto g = good("PORO\n 4*0.1 /\n" + small.substr(coord) + small.substr(0, coord));
    EXPECT_EQ(g.dims, (Dims{2, 1, 2}));
    EXPECT_EQ(misfit(g), "");
}

TEST(Grammar, SpecgridThatDiffersFromDimensIsTold) {
    const auto d =
        read_text("RUNSPEC\nDIMENS\n 2 1 2 /\nGRID\n" + std::string("SPECGRID\n 1 2 2 1 F /\n") + small.substr(small.find("COORD")));
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "C14"));
    EXPECT_EQ(grid_of(*d).dims, (Dims{2, 1, 2}));
}

TEST(Includes, AreRelativeToTheRootAndMayUseAliases) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "inc");
    write_file(folder / "CASE.DATA",
               "RUNSPEC\nDIMENS\n 2 1 2 /\nPATHS\n 'P' 'inc' /\n/\nGRID\nINCLUDE\n '$P/grid.inc' /\nINCLUDE\n inc\\poro.inc /\nEDIT\n");
    write_file(folder / "inc/grid.inc", small + "INCLUDE\n  'inc/ntg.inc' /\nENDINC\nnonsense\n");
    write_file(folder / "inc/ntg.inc", "NTG\n 4*0.5 /\n");
    write_file(folder / "inc/poro.inc", "PORO\n 4*0.25 /");
    const auto d = read_path(folder / "CASE.DATA");
    ASSERT_TRUE(d) << why(d);
    EXPECT_EQ(values(grid_of(*d), "NTG"), std::vector<double>(4, 0.5));
    EXPECT_EQ(values(grid_of(*d), "PORO"), std::vector<double>(4, 0.25));
    EXPECT_EQ(grid_of(*d).info.name, "CASE");
    EXPECT_EQ(d->variant, "DATA deck");
}

TEST(Includes, ThatIncludeThemselvesAreRefused) {
    const TemporaryFolder folder;
    write_file(folder / "a.grdecl", "INCLUDE\n 'b.inc' /\n");
    write_file(folder / "b.inc", "INCLUDE\n 'a.grdecl' /\n");
    const auto d = read_path(folder / "a.grdecl");
    ASSERT_FALSE(d);
    EXPECT_EQ(d.why().error.code, "F014");
    EXPECT_EQ(d.why().error.where.line, 2U);
}

TEST(Includes, MissingOnesAreToldOrPassedOver) {
    const TemporaryFolder folder;
    write_file(folder / "a.grdecl", small + "INCLUDE\n 'deep/poro.inc' /\n");
    const auto d = read_path(folder / "a.grdecl");
    ASSERT_FALSE(d);
    EXPECT_EQ(d.why().error.code, "F010");
    EXPECT_NE(d.why().error.message.find((folder / "deep/poro.inc").string()), std::string::npos) << d.why().error.message;
    const auto skipped = read_path(folder / "a.grdecl", {{"includes", "skip"}});
    ASSERT_TRUE(skipped) << why(skipped);
    EXPECT_TRUE(loses_substance(skipped->losses));
    write_file(folder / "poro.inc", "PORO\n 4*0.2 /\n");
    const auto beside = read_path(folder / "a.grdecl");
    ASSERT_TRUE(beside) << why(beside);
    EXPECT_TRUE(has_finding(*beside, "F131"));
}

TEST(Decks, SectionsBesideTheGridAreKeptAsTheyStand) {
    const std::string props = "\n-- of the fluids\nPVTW\n 1 2 3 /\nSWOF\n 0 0 1 0\n 1 1 0 0 /\n\n";
    const auto d =
        read_text("RUNSPEC\nTITLE\n a case / of ours\nDIMENS\n 2 1 2 /\nFIELD\nOIL\nWATER\nSTART\n 1 'JAN' 2020 /\nGRID\nINIT\n" + small +
                  "PORO\n 4*0.1 /\nPROPS\n" + props + "REGIONS\nSATNUM\n 4*2 /\nSCHEDULE\nTSTEP\n 10 /\nEND\nnot read\n");
    ASSERT_TRUE(d) << why(d);
    ASSERT_EQ(d->annotations.size(), 3U);
    EXPECT_EQ(d->annotations[0].value, "RUNSPEC\nTITLE\n a case / of ours\n\nOIL\n\nWATER\n\nSTART\n 1 'JAN' 2020 /\n\n");
    EXPECT_EQ(d->annotations[1].value, "PROPS\n" + props);
    EXPECT_EQ(d->annotations[2].value, "SCHEDULE\nTSTEP\n 10 /\n");
    EXPECT_EQ(grid_of(*d).unit_system, "FIELD");
    EXPECT_EQ(grid_of(*d).info.crs.axis_units[2], "FEET");
    EXPECT_EQ(values(grid_of(*d), "SATNUM"), std::vector<double>(4, 2));
}

}  // namespace
}  // namespace geomend::test
