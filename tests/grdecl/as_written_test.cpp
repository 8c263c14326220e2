// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include "grdecl/grdecl_support.h"

// Decks as people and programs write them, beside the letter of the format.

namespace geomend::test {
namespace {

const std::string head = "SPECGRID\n 2 1 2 1 F /\n";
const std::string shape = "COORD\n 0 0 0 0 0 9 1 0 0 1 0 9 2 0 0 2 0 9\n 0 1 0 0 1 9 1 1 0 1 1 9 2 1 0 2 1 9 /\nZCORN\n 8*0 16*1 8*2 /\n";
const std::string blocks = "DX\n 4*10 /\nDY\n 4*10 /\nTOPS\n 2*100 /\n";

std::string said(const std::string& text) {
    const auto d = read_text(text);
    return d ? std::string() : d.why().error.message;
}

TEST(RemarksBehindKeywords, AreNoData) {
    const auto d =
        read_text("RUNSPEC ====\nTITLE the title\n A title\nDIMENS nx ny nz\n 2 1 2 /\nOIL phase\nGRID === 1\n" + head + shape +
                  "PORO (fraction)\n 4*0.2 /\nEQUALS what follows\n PORO 0.3 1 1 /\n/\nFACIES m2/s\n 4*7 /\nPROPS ===\nSWOF\n 1 2 /\n"
                  "SOLUTION of 12\nEND here\nrubbish\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "F144"));
    EXPECT_EQ(values(grid_of(*d), "PORO"), (std::vector<double>{0.3, 0.2, 0.3, 0.2}));
    EXPECT_EQ(values(grid_of(*d), "FACIES"), std::vector<double>(4, 7));
}

TEST(RemarksBehindKeywords, DataOnTheLineOfTheKeywordStayData) {
    const auto d = read_text("SPECGRID 2 1 2 1 F /\n" + shape +
                             "PORO 4*0.2 /\nEQUALS PORO 0.3 1 1 /\n/\nMAPUNITS METRES /\nBOX 1 1 1 1 1 1 /\nNTG 0.5 /\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_FALSE(has_finding(*d, "F144"));
    EXPECT_EQ(values(grid_of(*d), "PORO"), (std::vector<double>{0.3, 0.2, 0.3, 0.2}));
    EXPECT_EQ(grid_of(*d).map_unit, "METRES");
    EXPECT_EQ(values(grid_of(*d), "NTG"), (std::vector<double>{0.5, 1, 1, 1}));
}

TEST(ByteOrderMarks, BeginNoKeyword) { EXPECT_EQ(good("\xEF\xBB\xBF" + head + shape).cell_count(), 4U); }

TEST(MissingSlashes, SwallowNoKeyword) {
    EXPECT_NE(said("MAPUNITS\n METRES\nMAPAXES\n 0 1 0 0 1 0 /\n" + head + shape).find("'MAPAXES'"), std::string::npos);
    EXPECT_NE(said("GRIDUNIT\n METRES\n" + head + shape).find("the keyword 'SPECGRID'"), std::string::npos);
    EXPECT_NE(said("SPECGRID\n 2 1 2 1 F\n" + shape).find("'COORD'"), std::string::npos);
    EXPECT_NE(said(head + shape + "PINCH\n 0.1 GAP\nPORO\n 4*1 /\n").find("'PORO'"), std::string::npos);
    EXPECT_EQ(bad(head + shape + "MINPV\n 0.1 0.2 /\n").substr(0, 4), "F008") << "surplus items";
}

TEST(MissingSlashes, AtTheEndOfListsAreTakenAsRead) {
    const auto d = read_text(head + shape + "FAULTS\n 'F' 1 1 1 1 1 2 X /\nPORO\n 4*0.2 /\nEQUALS\n PORO 0.3 1 1 1 1 1 1 /\nNTG\n 4*1 /\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "F147"));
    EXPECT_EQ(grid_of(*d).faults.size(), 1U);
    EXPECT_EQ(values(grid_of(*d), "PORO").front(), 0.3);
    EXPECT_EQ(values(grid_of(*d), "NTG"), std::vector<double>(4, 1));
}

TEST(MissingSlashes, AtTheEndOfCompleteOperationsAreTakenAsRead) {
    const auto d = read_text(head + shape + "EQUALS\n PORO 0.3 1 1 1 1 1 1\n PORO 0.4 2 2 1 1 1 2\n/\nNTG\n 4*1 /\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "F147"));
    EXPECT_EQ(values(grid_of(*d), "PORO")[1], 0.4);
}

TEST(Operations, OfRegionsAreApplied) {
    const auto g = good(head + shape + "PERMX\n 4*100 /\nPERMZ\n 4*10 /\nOPERNUM\n 1 2 1 2 /\nOPERATER\n PERMZ 2 MULTX PERMX 0.3 /\n/\n");
    EXPECT_EQ(values(g, "PERMZ"), (std::vector<double>{10, 30, 10, 30}));
}

TEST(Operations, ActOnInitialValues) {
    const auto g = good(head + shape + "MULTIPLY\n MULTZ 0.1 /\n NTG 0.5 1 1 /\n/\n");
    EXPECT_EQ(values(g, "NTG"), (std::vector<double>{0.5, 1, 0.5, 1}));
    EXPECT_EQ(values(g, "MULTZ"), std::vector<double>(4, 0.1));
}

TEST(SectionEdit, ChangesWhatIsComputedLater) {
    const auto g = good("RUNSPEC\nDIMENS\n 2 1 2 /\nGRID\n" + head + shape +
                        "MULTX\n 4*0.5 /\nFAULTS\n 'F' 1 1 1 1 1 2 X /\n/\nMULTFLT\n 'F' 0.5 /\n/\n" +
                        "EDIT\nMULTIPLY\n TRANX 0.1 1 1 /\n/\nMULTX\n 4*0.1 /\nMULTFLT\n 'F' 0.2 /\n/\nEDITNNC\n 1 1 1 2 1 2 0.25 /\n/\n");
    ASSERT_EQ(g.edit_operations.size(), 1U);
    EXPECT_EQ(g.edit_operations[0].array, "TRANX");
    EXPECT_EQ(g.edit_operations[0].last[0], 0U);
    EXPECT_EQ(values(g, "MULTX"), std::vector<double>(4, 0.05));
    EXPECT_EQ(g.faults[0].edit_multiplier, 0.2);
    ASSERT_EQ(g.connection_factors.size(), 1U);
    EXPECT_EQ(g.connection_factors[0].second, 3U);
}

TEST(BlockSizes, ThatAreTooFewAreTold) {
    EXPECT_EQ(bad(head + blocks + "DZ\n 10 /\n").substr(0, 4), "F008");
    EXPECT_EQ(bad(head + blocks + "DZV\n 10 /\n").substr(0, 4), "F008");
    const auto d = read_text(head + blocks + "DZ\n 3*10 /\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "F145"));
    EXPECT_EQ(grid_of(*d).depths.back(), 120);
    const auto all = read_text(head + blocks + "DZ\n 4*10 /\n");
    ASSERT_TRUE(all) << why(all);
    EXPECT_FALSE(has_finding(*all, "F145"));
    const auto defaults = read_text(head + blocks + "DZ\n 2*10 2* /\n");
    ASSERT_TRUE(defaults) << why(defaults);
    EXPECT_TRUE(has_finding(*defaults, "F145"));
    EXPECT_EQ(grid_of(*defaults).depths.back(), 110) << "no thickness, as in OPM Flow";
}

TEST(SpiderGrids, HaveStraightSides) {
    const std::string rings = "INRAD\n 1 /\nDRV\n 1 2 /\nDTHETAV\n 90 /\nDZ\n 4*3 /\nTOPS\n 2*10 /\n";
    const auto round = good("RUNSPEC\nDIMENS\n 2 1 2 /\nRADIAL\nGRID\n" + rings);
    const auto straight = good("RUNSPEC\nDIMENS\n 2 1 2 /\nSPIDER\nGRID\n" + rings);
    EXPECT_TRUE(round.cylindrical);
    EXPECT_FALSE(straight.cylindrical);
    const double* last = straight.pillars.data() + 6 * 5;  // at radius 4 and 90 degrees
    EXPECT_NEAR(std::hypot(last[0], last[1]), 4, 1e-12);
    EXPECT_NEAR(std::min(std::abs(last[0]), std::abs(last[1])), 0, 1e-12);
}

TEST(FileNames, WhereNumbersBelongPointToInclude) {
    EXPECT_NE(said(head + "COORD\n COORD.dat /\n").find("INCLUDE"), std::string::npos);
    EXPECT_EQ(said(head + "COORD\n PERMX /\n").find("INCLUDE"), std::string::npos);
}

TEST(DecksWithoutDims, AreNoGrid) {
    EXPECT_EQ(bad("FACIES\n 12*1 12*2 /\n").substr(0, 4), "F024");
    EXPECT_EQ(bad("MULTFLT\n 'F1' 0.1 /\n/\n").substr(0, 4), "F024");
    EXPECT_EQ(bad("RUNSPEC\nOIL\nGRID\nMULTREGT\n 1 2 0.5 /\n/\n").substr(0, 4), "F024");
}

}  // namespace
}  // namespace geomend::test
