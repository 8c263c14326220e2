// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "grdecl/grdecl_support.h"

// What OPM Flow 2022.10 stops at although it can be understood: each was tried with the program.

namespace geomend::test {

namespace {

const std::string geometry =
    "SPECGRID\n 2 1 2 1 F /\nCOORD\n 0 0 0 0 0 9 1 0 0 1 0 9 2 0 0 2 0 9 0 1 0 0 1 9 1 1 0 1 1 9 2 1 0 2 1 9 /\n"
    "ZCORN\n 8*1 8*2 8*2 8*3 /\n";
const std::string two_cells = geometry + "PORO\n 4*0.2 /\nPERMX\n 4*100 /\nMULTNUM\n 2*1 2*2 /\nFAULTS\n A 1 1 1 1 1 2 X /\n/\n";

std::string codes_of(const std::string& text) {
    const auto d = read_text(text);
    EXPECT_TRUE(d) << why(d) << text;
    std::string all;
    if (!d) return "unreadable";
    for (const Finding& f : d->findings) all += (all.empty() ? "" : " ") + f.code;
    return all;
}

std::string codes(const std::string& text) { return codes_of(two_cells + text); }

}  // namespace

TEST(FlowWords, WordsInLowerCaseOrWithBlanks) {
    for (const char* text :
         {"FAULTS\n B 1 1 1 1 1 2 x /\n/\n", "FAULTS\n B 1 1 1 1 1 2 'X ' /\n/\n", "FAULTS\n B 1 1 1 1 1 2 'i-' /\n/\n",
          "PINCH\n 0.1 gap /\n", "GRIDUNIT\n metres /\n", "MULTREGT\n 1 2 0.5 xyz /\n/\n", "MULTREGT\n 1 2 0.5 XYZ all /\n/\n",
          "MULTREGT\n 1 2 0.5 XYZ ALL m /\n/\n", "EQUALS\n poro 0.1 /\n/\n", "EQUALS\n 'PORO ' 0.1 /\n/\n", "COPY\n permx PERMY /\n/\n",
          "COPYREG\n PERMX permy 1 M /\n/\n", "EQUALREG\n PORO 0.1 1 m /\n/\n", "OPERATE\n PERMY 1 2 1 1 1 2 multx PERMX 2 /\n/\n"})
        EXPECT_EQ(codes(text), "F146") << text;
}

TEST(FlowWords, RecordsThatOnlyFlowDoesNotTake) {
    for (const char* text :
         {"MULTFLT\n 'A*' 0.1 /\n/\n", "MULTFLT\n A /\n/\n", "MULTREGT\n 1 2 0.5 QQ /\n/\n", "MULTREGT\n 1 2 0.5 XYZ NOAQUNNC /\n/\n",
          "MULTREGT\n 0 0 0.5 /\n/\n", "GRIDUNIT\n FURLONG /\n", "EQUALS\n DX 1 /\n/\n", "COPY\n PORO HEATCR /\n/\n",
          "SPECGRID\n 2 1 2 1 f /\n", "FACIES\n 4*1 /\n", "PERMXX\n 4*1 /\n"})
        EXPECT_EQ(codes(text), "F149") << text;
    EXPECT_EQ(codes("MARVEL\n 1 2 3 /\n"), "F102 F149");
    const auto d = read_text("\xEF\xBB\xBF" + two_cells);
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "F149"));
}

TEST(FlowWords, WhatFlowTakesIsNoFinding) {
    for (const char* text : {"FAULTS\n B 1 1 1 1 1 2 'X-' /\n C 1 1 1 1 1 1 K+ /\n/\nMULTFLT\n A 0.1 /\n/\n", "PINCH\n 0.1 GAP /\n",
                             "GRIDUNIT\n METRES MAP /\n", "MULTREGT\n 1 2 0.5 XY NNC M /\n 1 1* 0.5 /\n/\n", "EQUALS\n 'PORO' 0.1 /\n/\n",
                             "COPY\n PERMX PERMY /\n/\n", "permy\n 4*1 /\n", "EQUALREG\n FACIES 0.1 1 M /\n/\n", "FIPXYZ\n 4*1 /\n",
                             "SWL\n 4*0.1 /\n", "MULTX-\n 4*0.1 /\n", "AQUCT\n 1 /\n/\n"})
        EXPECT_EQ(codes(text).find("F14"), std::string::npos) << text << codes(text);
}

TEST(FlowWords, MultipliersGoByTheRegionsThatFlowTakes) {
    const auto deck = [](const std::string& runspec, const std::string& grid) {
        return "RUNSPEC\nDIMENS\n 2 1 2 /\n" + runspec + "GRID\n" + geometry + grid;
    };
    const std::string rule = "MULTREGT\n 1 2 0.5 /\n/\n", of_multnum = "MULTNUM\n 4*1 /\n", of_fluxnum = "FLUXNUM\n 4*1 /\n",
                      room = "GRIDOPTS\n 'YES' 2 /\n";
    const auto letter_of = [](const std::string& text) {
        const auto d = read_text(text);
        return d ? std::get<CornerPointGrid>(d->objects[0]).region_multipliers.at(0).regions : '?';
    };
    EXPECT_EQ(codes_of(deck("", of_fluxnum + rule)).find("F149"), std::string::npos);
    EXPECT_EQ(letter_of(deck("", of_fluxnum + of_multnum + rule)), 'F');
    EXPECT_NE(codes_of(deck("", of_multnum + rule)).find("F149"), std::string::npos);
    EXPECT_NE(codes_of(deck("", rule)).find("F149"), std::string::npos);
    EXPECT_EQ(codes_of(deck(room, of_multnum + rule)).find("F149"), std::string::npos);
    EXPECT_EQ(letter_of(deck(room, of_fluxnum + of_multnum + rule)), 'M');
    EXPECT_NE(codes_of(deck(room, of_fluxnum + rule)).find("F149"), std::string::npos);
    EXPECT_EQ(letter_of(geometry + of_multnum + rule), 'M') << "without RUNSPEC";
    EXPECT_EQ(letter_of(geometry + of_fluxnum + rule), 'F') << "without RUNSPEC";
}

TEST(FlowWords, LeverettScalingNeedsEndPointScaling) {
    const std::string grid = "GRID\n" + geometry + "JFUNC\n WATER 20 /\n", runspec = "RUNSPEC\nDIMENS\n 2 1 2 /\n";
    EXPECT_NE(codes_of(runspec + grid).find("F149"), std::string::npos);
    EXPECT_EQ(codes_of(runspec + "ENDSCALE\n/\n" + grid).find("F149"), std::string::npos);
}

TEST(FlowWords, TheSameRecordsAreCounted) {
    const auto d = read_text(two_cells + "EQUALS\n DX 1 /\n DX 2 /\n DX 3 /\n/\n");
    ASSERT_TRUE(d) << why(d);
    const auto f = std::ranges::find(d->findings, "F149", &Finding::code);
    ASSERT_NE(f, d->findings.end());
    EXPECT_EQ(f->count, 3U);
}

// ---- text beside keywords: a remark, as simulators take it ----

TEST(LineRemarks, TextBesideKeywordsIsARemark) {
    for (const char* remark : {"12", "1 2 3", "/", "//", "  / x", "*****", "( 12 cells )", "====", "PROPS", "END", "GRID"}) {
        for (const char* keyword : {"PORO", "MULTNUM", "SPECGRID", "ZCORN", "FAULTS"}) {
            std::string text = two_cells;
            const std::size_t at = text.find(keyword) + std::string_view(keyword).size();
            text.insert(at, std::string(" ") + remark);
            const auto d = read_text(text);
            if (std::string_view(keyword) == "FAULTS" && std::string_view(remark) == "1 2 3") continue;  // begins a record as well
            ASSERT_TRUE(d) << why(d) << '\n' << keyword << ' ' << remark;
            const CornerPointGrid& g = grid_of(*d);
            EXPECT_EQ(g.dims, (std::array<std::uint32_t, 3>{2, 1, 2})) << keyword << ' ' << remark;
            EXPECT_EQ(values(g, "PORO"), std::vector<double>(4, 0.2)) << keyword << ' ' << remark;
            ASSERT_EQ(g.faults.size(), 1U) << keyword << ' ' << remark;
            EXPECT_EQ(g.faults[0].name, "A") << keyword << ' ' << remark;
        }
    }
}

TEST(LineRemarks, NamesOfSectionsBesideKeywordsAloneBeginNone) {
    const auto d = read_text("RUNSPEC\nDIMENS\n 1 1 1 /\nOIL PROPS\nWATER END\nGRID\nINIT\nPORO\n 0.2 /\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_EQ(values(grid_of(*d), "PORO"), std::vector<double>{0.2});
}

TEST(LineRemarks, DataBesideTheirKeywordAreStillData) {
    const auto d = read_text("SPECGRID 2 1 2 1 F /\nPORO 4*0.2 /\nPERMX 1 2\n 3 4 /\nEQUALS PORO 0.3 /\n/\nMULTNUM 1\n 3*2 /\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_EQ(values(grid_of(*d), "PORO"), std::vector<double>(4, 0.3));
    EXPECT_EQ(values(grid_of(*d), "PERMX"), (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(values(grid_of(*d), "MULTNUM"), (std::vector<double>{1, 2, 2, 2}));
}

TEST(LocalGrids, CornersThatFollowFromTheHostAreNotWritten) {
    const TemporaryFolder folder;
    const auto d = read_text(two_cells + "CARFIN\n L 1 1 1 1 1 2 2 2 4 /\nENDFIN\nCARFIN\n M 2 2 1 1 1 1 2 1 1 /\nHXFIN\n 1 3 /\nENDFIN\n");
    ASSERT_TRUE(d) << why(d);
    OutputSet outputs(folder / "o.grdecl");
    ASSERT_TRUE(row("grdecl").write(*d, outputs, {}));
    ASSERT_TRUE(outputs.commit());
    const auto back = read_path(folder / "o.grdecl");
    ASSERT_TRUE(back) << why(back);
    ASSERT_EQ(back->objects.size(), 3U);
    for (std::size_t g = 1; g < 3; ++g) {
        EXPECT_TRUE(same(grid_of(*d, g).depths, grid_of(*back, g).depths));
        EXPECT_TRUE(same(grid_of(*d, g).pillars, grid_of(*back, g).pillars));
    }
    const auto input = Input::open((folder / "o.grdecl").string());
    ASSERT_TRUE(input);
    const std::string_view text = input->bytes();
    const std::size_t local = text.find("CARFIN"), second = text.find("CARFIN", local + 1);
    EXPECT_GT(text.find("COORD", local), second);                   // the first goes without saying
    EXPECT_NE(text.find("COORD", second), std::string_view::npos);  // the second has widths of its own
}

TEST(RadialGrids, SpidersGoRoundOnceOnly) {
    const auto text = [](const std::string& kind) {
        return "SPECGRID\n 1 4 1 /\n" + kind + "\nINRAD\n 1 /\nDRV\n 1 /\nDTHETAV\n 4*100 /\nDZV\n 1 /\nTOPS\n 4*0 /\n";
    };
    const auto d = read_text(text("SPIDER"));
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "C31"));
}

TEST(FlowWords, KeywordsOfLaterSectionsThatFlowDoesNotKnow) {
    const auto all = [](const std::string& text) {
        const auto d = read_text("RUNSPEC\nGRID\n" + two_cells + text);
        EXPECT_TRUE(d) << why(d) << text;
        std::string found;
        for (const Finding& f : d->findings) found += f.code + f.message;
        return found;
    };
    for (const char* text : {"PROPS\nMARVEL\n 1 2 /\n", "PROPS\nPVTW\n 200 1 4e-5 0.5 0 /\nMARVEL\n",
                             "SOLUTION\nEQUIL\n 2000 200 /\nMARVEL\n 1 /\n", "SUMMARY\nMARVEL\nFOPR\n", "SUMMARY\nFOPR\nFOPT\nMARVEL\n",
                             "SUMMARY\nWOPR\n P1 /\nMARVEL\n", "SCHEDULE\nTSTEP\n 1 /\nmarvel -- a remark\n 1 2 /\n/\n"})
        EXPECT_NE(all(text).find("MARVEL"), std::string::npos) << text;
    for (const char* text :
         {"PROPS\nPVTW\n 200 1 4e-5 0.5 0 /\nROCK\n 200 1E-5 /\n",
          "SUMMARY\nALL\nFOPR\nWOPR\nP1\nP2\n/\nRPR\n/\nTCPU\nTIMESTEP\nPERFORMA\nEXCEL\n",
          "SCHEDULE\nRPTSCHED\nRESTART\nFIP\n/\nWELSPECS\n'P1' 'G' 1 1 2000 OIL /\n/\nWCONPROD\nP1 OPEN BHP 5* 100 /\n/\nTSTEP\n 1 /\n",
          "PROPS\n-- MARVEL\n", "SOLUTION\nRPTSOL\nFIP\n/\n"})
        EXPECT_EQ(all(text), "") << text;
}

}  // namespace geomend::test
