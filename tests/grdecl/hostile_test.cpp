// SPDX-License-Identifier: AGPL-3.0-or-later
// Wrong decks give the exact place; broken ones give an answer.
#include <atomic>

#include "grdecl/grdecl_support.h"

namespace geomend::test {
namespace {

const std::string head = "SPECGRID\n 2 1 2 1 F /\n";
const std::string coord = "COORD\n 0 0 0 0 0 10  1 0 0 1 0 10  2 0 0 2 0 10\n 0 1 0 0 1 10  1 1 0 1 1 10  2 1 0 2 1 10 /\n";
const std::string zcorn = "ZCORN\n 8*0 16*1 8*2 /\n";
const std::string small = head + coord + zcorn;

std::string message(const std::string& text) {
    const auto d = read_text(text);
    return d ? "" : d.why().error.message;
}

TEST(WrongDecks, ArraysThatAreTooShortOrTooLong) {
    const std::string shorter = head + coord + "ZCORN\n 8*0 16*1 7*2\n/\n";
    EXPECT_EQ(bad(shorter), "F008 grid.grdecl:8:1");
    EXPECT_EQ(message(shorter), "expected 32 values of ZCORN, found 31");
    const std::string longer = head + coord + "ZCORN\n 8*0 16*1 8*2\n  3 4 /\n";
    EXPECT_EQ(bad(longer), "F008 grid.grdecl:8:3");
    EXPECT_EQ(message(longer), "expected 32 values of ZCORN, found 34");
    EXPECT_EQ(bad(small + "PORO\n 3*0.1 /\n"), "F008 grid.grdecl:9:8");
    EXPECT_EQ(bad(small + "PORO\n 0.1 0.2 0.3 0.4 0.5 /\n"), "F008 grid.grdecl:9:18");
    EXPECT_EQ(bad(small + "BOX\n 1 1 1 1 1 2 /\nPORO\n 4*0.1 /\n"), "F008 grid.grdecl:11:2");
}

TEST(WrongDecks, AMissingSlash) {
    EXPECT_EQ(bad(small + "ACTNUM\n 1 1 1 1\nPORO\n 4*0.1 /\n"), "F005 grid.grdecl:10:1");
    EXPECT_NE(message(small + "ACTNUM\n 1 1 1 1\nPORO\n 4*0.1 /\n").find("'/'"), std::string::npos);
    EXPECT_EQ(bad(small + "ACTNUM\n 1 1 1 1\n"), "F004 grid.grdecl:10:1");
    EXPECT_EQ(bad(small + "MAPAXES\n 1 2 3 4 5 6\nPORO\n 4*1 /\n").substr(0, 4), "F008");
    EXPECT_EQ(bad(small + "FAULTS\n 'A' 1 1 1 1 1 1 X\n 'B' 1 1 1 1 1 1 X /\n/\n"), "F008 grid.grdecl:10:2");
    EXPECT_EQ(bad(small + "INCLUDE\n 'a.inc'\nPORO\n"), "F012 grid.grdecl:10:1");
}

TEST(WrongDecks, NumbersThatAreNone) {
    EXPECT_EQ(bad(small + "PORO\n 0.1 0.2x 0.3 0.4 /\n"), "F005 grid.grdecl:9:6");
    EXPECT_EQ(bad(small + "PORO\n 0.1 nan 0.3 0.4 /\n"), "F006 grid.grdecl:9:6");
    EXPECT_EQ(bad(small + "PORO\n 0.1 0.2 -inf 0.4 /\n"), "F006 grid.grdecl:9:10");
    EXPECT_EQ(bad(small + "PORO\n 0.1 0.2 0.3 1e999 /\n"), "F006 grid.grdecl:9:14");
    EXPECT_EQ(bad(small + "SATNUM\n 1 2.0 3 4 /\n"), "F005 grid.grdecl:9:4");
    EXPECT_EQ(bad(small + "SATNUM\n 1 2 3 3000000000 /\n"), "F005 grid.grdecl:9:8");
    EXPECT_EQ(message(small + "SATNUM\n 1 2.0 3 4 /\n"), "expected a whole number of SATNUM, found '2.0'");
    EXPECT_EQ(message(small + "PORO\n 1 2,5x 3 4 /\n").substr(0, 25), "expected a number of PORO");
    EXPECT_EQ(bad(small + "MAPAXES\n 1 2 3 nan 5 6 /\n"), "F006 grid.grdecl:9:8");
}

TEST(WrongDecks, RepeatCounts) {
    for (const char* count : {"*2", "0*2", "-1*2", "1.5*2", "2**3", "99999999999999999999*1"}) {
        const std::string found = bad(small + "PORO\n " + count + " 1 1 1 /\n");
        EXPECT_TRUE(found == "F012 grid.grdecl:9:2" || found == "F005 grid.grdecl:9:2") << count << found;
    }
    EXPECT_EQ(bad("SPECGRID\n 2 0*1 2 /\n"), "F012 grid.grdecl:2:4");
    EXPECT_EQ(bad("SPECGRID\n 1000000000*2 /\n").substr(0, 4), "F014");
}

TEST(WrongDecks, DimsAndBoxes) {
    EXPECT_EQ(bad("SPECGRID\n 0 1 2 /\n"), "F012 grid.grdecl:2:2");
    EXPECT_EQ(bad("SPECGRID\n -3 1 2 /\n"), "F012 grid.grdecl:2:2");
    EXPECT_EQ(bad("SPECGRID\n 1.5 1 2 /\n"), "F005 grid.grdecl:2:2");
    EXPECT_EQ(bad(coord), "F024 grid.grdecl:1:1");
    EXPECT_EQ(bad(small + "BOX\n 1 3 1 1 1 1 /\n"), "F012 grid.grdecl:9:4");
    EXPECT_EQ(bad(small + "BOX\n 2 1 1 1 1 1 /\n"), "F012 grid.grdecl:9:2");
    EXPECT_EQ(bad(small + "EQUALS\n PORO 1 1 2 1 1 0 1 /\n/\n"), "F012 grid.grdecl:9:17");
    EXPECT_EQ(bad(small + "NNC\n 1 1 1 3 1 1 /\n/\n"), "F007 grid.grdecl:9:8");
    EXPECT_EQ(bad(head + coord).substr(0, 4), "F012");
    EXPECT_EQ(bad(small + "ACTNUM\n 1 1 1 -1 /\n").substr(0, 4), "F012");
    EXPECT_EQ(bad(small, {{"dims", "2,1"}}).substr(0, 4), "F018");
}

TEST(WrongDecks, HugeCountsTakeNoMemory) {
    EXPECT_EQ(bad("SPECGRID\n 100000 100000 100000 /\nZCORN\n 1 2 3 /\n").substr(0, 4), "F008");
    EXPECT_EQ(bad("SPECGRID\n 100000 100000 100000 /\nPORO\n 1000000000000000*0.1 /\n").substr(0, 4), "F014");
    EXPECT_EQ(bad("SPECGRID\n 2000000000 2000000000 2000000000 /\n").substr(0, 4), "F014");
    EXPECT_EQ(bad("SPECGRID\n 100000 100000 10 /\nEQUALS\n PORO 1 /\n/\n").substr(0, 4), "F014");
    EXPECT_EQ(bad("SPECGRID\n 100000 100000 10 /\nDXV\n 100000*1 /\nDYV\n 100000*1 /\nDZV\n 10*1 /\nTOPS\n 10000000000*1 /\n").substr(0, 4),
              "F014");
    EXPECT_EQ(bad("SPECGRID\n 2 1 2 /\nPORO\n 9223372036854775807*0.1 9223372036854775807*0.1 /\n").substr(0, 4), "F008");
}

TEST(WrongDecks, LargeValuesAreReadForTheChecksToJudge) {
    std::string text = small;
    text.replace(text.find("8*2"), 3, "7*2 1e30");
    EXPECT_EQ(good(text).depths.back(), 1e30);
}

TEST(WrongDecks, StoppedReadingSaysSo) {
    const std::atomic<bool> stop = true;
    Monitor monitor;
    monitor.stop = &stop;
    ReadOptions options;
    options.monitor = &monitor;
    const auto d = row("grdecl").read(Input::from_memory(small, "grid.grdecl"), options);
    ASSERT_FALSE(d);
    EXPECT_EQ(d.why().kind, FailureKind::cancelled);
}

std::string rich() {
    return "RUNSPEC\nTITLE\n of ours\nDIMENS\n 2 1 2 /\nMETRIC\nGRID\nMAPAXES\n 0 1 0 0 1 0 /\nGRIDUNIT\n METRES /\n" + small +
           "ACTNUM\n 1 1 0 1 /\nPORO\n 0.1 2*0.2 1* /\nFACIES\n 1 2 2 1 /\nZONE\n 'a' 'b' 'a' 'b' /\nBOX\n 1 1 1 1 1 2 /\nNTG\n 2*0.5 "
           "/\nENDBOX\n"
           "EQUALS\n SATNUM 1 /\n PERMX 5 2 2 4* /\n/\nCOPY\n PERMX PERMY /\n/\nFAULTS\n 'A' 1 1 1 1 1 2 X /\n/\nMULTFLT\n A 0.1 /\n/\n"
           "NNC\n 1 1 1 2 1 2 0.5 /\n/\nPINCH\n/\nMINPV\n 1 /\nMULTREGT\n 1 2 0.1 /\n/\nCARFIN\n L 2 2 1 1 1 1 2 2 2 /\nPORO\n 8*0.3 "
           "/\nENDFIN\n"
           "WONDER\n 'x' 1 /\n/\nEDIT\nPORV\n 4*2 /\nPROPS\nROCK\n 1 2 /\nSCHEDULE\nTSTEP\n 1 /\nEND\n";
}

std::string expect_answer(const std::string& text) {
    const auto d = read_text(text, {{"max-values", "100000"}});
    if (d) return {};
    EXPECT_FALSE(d.why().error.code.empty());
    EXPECT_FALSE(d.why().error.message.empty());
    return d.why().error.code;
}

TEST(WrongDecks, DimsThatChangeAfterArraysWereRead) {
    const auto d = read_text("PORO\n 4*0.25 /\nDIMENS\n 3 1 1 /\n", {{"dims", "2,1,2"}});
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "C14"));
    EXPECT_EQ(grid_of(*d).cell_count(), 4U);
    EXPECT_EQ(bad(small + "SPECGRID\n 2 1 2 2 F /\nCOORDSYS\n 1 1 /\n 2 2 /\n").substr(0, 4), "F008");
}

TEST(BrokenDecks, EveryCutGivesAnAnswer) {
    const std::string whole = rich();
    EXPECT_EQ(expect_answer(whole), "");
    for (std::size_t size = 1; size < whole.size(); ++size) expect_answer(whole.substr(0, size));
    for (const int percent : {10, 50, 90})
        EXPECT_NE(expect_answer(small.substr(0, small.size() * static_cast<std::size_t>(percent) / 100)), "");
}

TEST(BrokenDecks, ChangedBytesGiveAnAnswer) {
    const std::string whole = rich();
    std::uint64_t state = 11;
    const auto random = [&state](std::size_t below) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::size_t>(state >> 33) % below;
    };
    constexpr std::string_view telling = "/*'\"-\n 09.eE\0$";
    for (int i = 0; i < 4000; ++i) {
        std::string changed = whole;
        for (std::size_t n = 1 + random(4); n > 0; --n)
            changed[random(changed.size())] = i % 2 == 0 ? static_cast<char>(random(256)) : telling[random(telling.size())];
        expect_answer(changed);
    }
}

TEST(BrokenDecks, HugeNumbersAnywhereGiveAnAnswer) {
    const std::string whole = rich();
    for (std::size_t at = 1; at < whole.size(); ++at) {
        if (whole[at] < '0' || whole[at] > '9' || (whole[at - 1] >= '0' && whole[at - 1] <= '9')) continue;
        for (const char* number : {"1000000000000000000", "-1", "1e30", "2147483648", "nan"})
            expect_answer(whole.substr(0, at) + number + whole.substr(at + 1));
    }
}

TEST(Sniffing, TellsDecksFromOtherText) {
    EXPECT_GE(row("grdecl").sniff("-- a grid\r\n\r\n  SPECGRID -- of ours\r\n 1 1 1 /\n", "x"), 90);
    EXPECT_GE(row("grdecl").sniff("ACTNUM\n 1 /", "x"), 60);
    EXPECT_GE(row("grdecl").sniff("SPECGRID 2 2 2 1 F /\n", "x"), 90);
    EXPECT_GE(row("grdecl").sniff("specgrid\n 2 2 2 1 F /\n", "x"), 90);
    for (const char* other :
         {"import os\n", "copy files\n", "title Field study\n", "include \"a.h\"\n", "end\n", "BOX of tools\n", "grid layout\n"})
        EXPECT_EQ(row("grdecl").sniff(other, "x"), 0) << other;
    EXPECT_GE(row("data").sniff("-- c\nRUNSPEC\n", "x"), 95);
    for (const char* other : {"GOCAD TSurf 1\n", "roff-asc\n", " 'FILEHEAD'         100 'INTE'\n", "# vtk DataFile Version 3.0\n",
                              "$MeshFormat\n", "\xff\xfe\x01", "1 2 3\n"})
        EXPECT_EQ(row("grdecl").sniff(other, "x"), 0) << other;
}

}  // namespace
}  // namespace geomend::test
