// SPDX-License-Identifier: AGPL-3.0-or-later
// What section EDIT does to multipliers, pore volumes and transmissibilities: as OPM Flow 2022.10 does it.
#include <algorithm>

#include "grdecl/grdecl_support.h"
#include "grid/pore_volume.h"

namespace geomend::test {
namespace {

/// Two columns of two layers; each cell has a pore volume of 0.5.
const std::string grid_text =
    "RUNSPEC\nDIMENS\n 2 1 2 /\nMETRIC\nGRID\nSPECGRID\n 2 1 2 1 F /\nCOORD\n 0 0 0 0 0 10  1 0 0 1 0 10  2 0 0 2 0 10\n"
    " 0 1 0 0 1 10  1 1 0 1 1 10  2 1 0 2 1 10 /\nZCORN\n 8*0 16*1 8*2 /\nPORO\n 4*0.5 /\nPERMX\n 4*100 /\n";

Dataset deck(const std::string& more, const std::string& edit) {
    auto d = read_text(grid_text + more + "EDIT\n" + edit + "SCHEDULE\nEND\n");
    if (d) return std::move(*d);
    ADD_FAILURE() << why(d);
    return {};
}

/// The same after it was written and read again.
Dataset again(const Dataset& d) {
    TemporaryFolder folder;
    const auto back = read_path(write(d, folder / "again.DATA").path);
    if (back) return *back;
    ADD_FAILURE() << why(back);
    return {};
}

void expect_pores(const std::string& more, const std::string& edit, const std::vector<double>& expected) {
    const Dataset d = deck(more, edit);
    ASSERT_FALSE(d.objects.empty());
    EXPECT_EQ(grid::pore_volumes(grid_of(d)), expected) << edit;
    const Dataset back = again(d);
    ASSERT_FALSE(back.objects.empty());
    EXPECT_EQ(grid::pore_volumes(grid_of(back)), expected) << "written: " << edit;
}

bool stops(const Dataset& d, const std::string& part) {
    return std::ranges::any_of(d.findings, [&](const Finding& f) { return f.code == "F149" && f.message.find(part) != std::string::npos; });
}

TEST(EditSection, MultipliersOfConnectionsActBesideEachOther) {
    const Dataset d = deck("", "MULTX\n 4*0.5 /\nMULTIPLY\n TRANX 2 /\n/\nMULTX\n 4*0.25 /\n");
    ASSERT_FALSE(d.objects.empty());
    EXPECT_EQ(values(grid_of(d), "MULTX"), std::vector<double>(4, 0.125));
    EXPECT_EQ(values(grid_of(again(d)), "MULTX"), std::vector<double>(4, 0.125));
}

TEST(EditSection, MultpvBehindPorvChangesNothing) {
    expect_pores("", "MULTPV\n 4*2 /\n", {1, 1, 1, 1});
    expect_pores("", "MULTPV\n 4*2 /\nMULTPV\n 4*3 /\n", {1.5, 1.5, 1.5, 1.5});
    expect_pores("", "PORV\n 2* 2*7 /\nMULTPV\n 4*2 /\n", {0.5, 0.5, 7, 7});
    expect_pores("", "EQUALS\n PORV 7 1 2 1 1 2 2 /\n/\nMULTPV\n 4*2 /\n", {0.5, 0.5, 7, 7});
    expect_pores("", "MULTIPLY\n PORV 3 /\n/\nBOX\n 1 1 1 1 1 2 /\nMULTPV\n 2*2 /\nENDBOX\n", {1.5, 1.5, 1.5, 1.5});
    expect_pores("", "MULTPV\n 4*2 /\nMULTIPLY\n PORV 3 /\n/\nEQUALS\n MULTPV 5 /\n/\n", {3, 3, 3, 3});
    const Dataset d = deck("", "PORV\n 2* 2*7 /\nMULTPV\n 4*2 /\n");
    EXPECT_TRUE(has_finding(d, "F148"));
}

TEST(EditSection, PoreVolumesChangeByRegion) {
    const std::string regions = "OPERNUM\n 1 2 2 1 /\n";
    expect_pores(regions, "OPERATER\n PORV 2 MULTX PORV 0.5 /\n/\n", {0.5, 0.25, 0.25, 0.5});
    expect_pores(regions, "MULTIREG\n PORV 0.5 2 O /\n/\n", {0.5, 0.25, 0.25, 0.5});
    expect_pores(regions, "ADDREG\n PORV 3 1 O /\n/\n", {3.5, 0.5, 0.5, 3.5});
    expect_pores("", "OPERATE\n PORV 1 2 1 1 2 2 MULTA PORV 2 7 /\n/\n", {0.5, 0.5, 8, 8});
    expect_pores("", "OPERATE\n PORV 1 1 1 1 1 2 MAXLIM PORV 0.25 /\n/\n", {0.25, 0.5, 0.25, 0.5});
}

TEST(EditSection, WithoutMultnumAllCellsAreOfRegionOne) {
    const Dataset d = deck("EQUALREG\n PERMX 5 1 M /\n/\nMULTIREG\n PERMX 2 2 M /\n/\n", "");
    ASSERT_FALSE(d.objects.empty());
    EXPECT_EQ(values(grid_of(d), "PERMX"), std::vector<double>(4, 5));
}

TEST(EditSection, CopiesOfTransmissibilitiesStayTextAsFlowIgnoresThem) {
    const Dataset d = deck("", "TRANX\n 4*2 /\nCOPY\n TRANX TRANY /\n/\n");
    ASSERT_FALSE(d.objects.empty());
    for (const Dataset& one : {d, again(d)}) {
        EXPECT_EQ(find_attribute(grid_of(one).info.attributes, "TRANY", AttributeLocation::cell), nullptr);
        EXPECT_TRUE(has_finding(one, "F148"));
        EXPECT_EQ(std::ranges::count_if(grid_of(one).info.annotations,
                                        [](const Annotation& a) { return a.value.find("TRANX TRANY") != std::string::npos; }),
                  1);
    }
}

TEST(FlowStopsAt, RegionsAndArraysThatAreNotThere) {
    EXPECT_TRUE(stops(deck("OPERATER\n PERMX 2 MULTX PERMX 0.3 /\n/\nOPERNUM\n 4*1 /\n", ""), "OPERATER needs OPERNUM"));
    EXPECT_TRUE(stops(deck("OPERNUM\n 4*1 /\nOPERATER\n PERMX 1 MULTX PERMQ 0.3 /\n/\n", ""), "OPERATER reads PERMQ"));
    EXPECT_TRUE(stops(deck("ADDREG\n PERMX 5 1 O /\n/\n", ""), "ADDREG needs OPERNUM"));
    EXPECT_TRUE(stops(deck("OPERNUM\n 4*1 /\n", "MULTIREG\n TRANX 5 1 O /\n/\n"), "MULTIREG changes TRANX"));
    EXPECT_FALSE(stops(deck("OPERNUM\n 4*1 /\nOPERATER\n PERMX 1 MULTX PERMX 0.3 /\n/\n", ""), ""));
}

TEST(FlowStopsAt, RegionsOfOperaterThatAreNoNamesOfArrays) {
    const std::string regions = "OPERNUM\n 1 2 2 1 /\nMULTNUM\n 4*1 /\nFLUXNUM\n 4*1 /\n";
    const auto operates = [&](const std::string& item) {
        return deck(regions + "OPERATER\n PERMX 1 MULTX PERMX 0.5 0 " + item + " /\n/\n", "");
    };
    for (const char* letter : {"M", "F", "O"}) EXPECT_TRUE(stops(operates(letter), letter)) << letter;
    for (const char* word : {"NTG", "PERMX", "PINCHNUM"}) EXPECT_TRUE(stops(operates(word), word)) << word;
    for (const char* array : {"OPERNUM", "MULTNUM", "FLUXNUM", "1*", ""}) EXPECT_FALSE(stops(operates(array), "")) << array;
    const Dataset of_initial = operates("FIPNUM");  // not given: all cells are of region 1
    EXPECT_FALSE(stops(of_initial, ""));
    EXPECT_EQ(values(grid_of(of_initial), "PERMX"), std::vector<double>(4, 50));
    EXPECT_EQ(values(grid_of(operates("OPERNUM")), "PERMX"), (std::vector<double>{50, 100, 100, 50}));
}

TEST(Grammar, TellsOnceWhatStandsBehindEnd) {
    const auto told = [](const std::string& text) {
        const auto d = read_text(text);
        EXPECT_TRUE(d) << why(d);
        std::vector<std::uint64_t> lines;
        for (const Finding& f : d->findings) {
            if (f.code == "F150") lines.push_back(f.where.line);
        }
        EXPECT_EQ(d->losses.size(), lines.size());
        return lines;
    };
    const auto line = static_cast<std::uint64_t>(std::ranges::count(grid_text, '\n'));
    using Lines = std::vector<std::uint64_t>;
    EXPECT_EQ(told(grid_text + "END\n\n-- PERMY\nPERMY\n 4*1 /\nPERMZ\n 4*1 /\n"), Lines{line + 4});
    EXPECT_EQ(told(grid_text + "SCHEDULE\nTSTEP\n 1 /\nEND\nTSTEP\n 1 /\n"), Lines{line + 5});
    EXPECT_EQ(told(grid_text + "ENDINC\nPERMY\n 4*1 /\n"), Lines{line + 2});
    for (const char* nothing : {"END", "END\n", "END\n \n -- no more\n", "SCHEDULE\nEND\n-- no more", "ENDINC\n"})
        EXPECT_EQ(told(grid_text + nothing), Lines{}) << nothing;
}

TEST(FlowStopsAt, FaultsOfTheScheduleThatNobodyStates) {
    const auto with = [](const std::string& records) {
        auto d = read_text(grid_text + "FAULTS\n 'F1' 1 1 1 1 1 2 'X' /\n/\nSCHEDULE\nMULTFLT\n" + records + "/\nTSTEP\n 1 /\nEND\n");
        EXPECT_TRUE(d) << why(d);
        return d ? std::move(*d) : Dataset{};
    };
    EXPECT_TRUE(stops(with(" 'F1' 0.5 /\n 'F77' 0.5 / -- not there\n"), "F77"));
    EXPECT_FALSE(stops(with(" 'F1' 0.5 /\n F1 0.25 /\n"), ""));
}

TEST(Arrays, AFileNameThatBeginsWithADotIsSeenAsOne) {
    const auto d = read_text(grid_text + "NTG\n./prop.grdecl\n/\n");
    ASSERT_FALSE(d);
    EXPECT_NE(d.why().error.message.find("looks like the name of a file: INCLUDE './prop.grdecl'"), std::string::npos) << why(d);
}

}  // namespace
}  // namespace geomend::test
