// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "pipeline/validate.h"
#include "support/real_data.h"
#include "validators/checks_testing.h"

namespace geomend {
namespace {

using namespace testing;
using Codes = std::set<std::string>;

// Findings of a real file; nothing where it is not there, which skips the test.
std::optional<ReportedFile> report_of(const std::string& name) {
    const auto path = test::real_data("cornerpoint/" + name);
    if (!path) return {};
    auto file = validate(path->string(), LoadOptions{}, CheckOptions{});
    EXPECT_TRUE(file) << name << ": " << (file ? "" : file.why().error.message);
    if (!file) return ReportedFile{};
    return std::move(*file);
}

#define REPORT_OF(variable, name)          \
    const auto variable = report_of(name); \
    if (!variable) GTEST_SKIP() << "no real data"

std::uint64_t count(const ReportedFile& file, const std::string& code) {
    for (const Finding& f : file.findings) {
        if (f.code == code) return f.count;
    }
    return 0;
}

TEST(RealGrids, CollapsedCellsOf20X20X6AreCounted) {
    REPORT_OF(file, "pygrdecl/20X20X6.GRDECL");
    EXPECT_EQ(count(*file, "C05"), 49u);
    EXPECT_EQ(file->valid, true);
}

TEST(RealGrids, WedgesOfReekAreCountedInBothEncodings) {
    for (const char* name : {"reek/reek_sim_grid.grdecl", "reek/REEK.EGRID"}) {
        REPORT_OF(file, name);
        EXPECT_EQ(count(*file, "C06"), 20u) << name;
        EXPECT_EQ(file->valid, true) << name;
    }
}

TEST(RealGrids, WedgesOfTheSecondReekAreCounted) {
    REPORT_OF(file, "reek3/reek_sim.grdecl");
    EXPECT_EQ(count(*file, "C06"), 516u);
    EXPECT_EQ(count(*file, "C05"), 0u);
    EXPECT_EQ(file->valid, true);
}

TEST(RealGrids, ReekIsLeftHandedInItsDeckAndByItsMapAxesInItsEgrid) {
    REPORT_OF(deck, "reek/reek_sim_grid.grdecl");
    REPORT_OF(egrid, "reek/REEK.EGRID");
    const Finding in_deck = find(deck->findings, "C12", Severity::info), in_egrid = find(egrid->findings, "C12", Severity::info);
    EXPECT_EQ(measure(in_deck, "left_handed"), 35838);
    EXPECT_EQ(measure(in_egrid, "right_handed"), 35838);
}

TEST(RealGrids, TheConcaveCellIsFound) {
    REPORT_OF(file, "small/concave.grdecl");
    EXPECT_EQ(cells_of(find(file->findings, "C07", Severity::error)), (std::vector<Cell>{{1, 1, 1}}));
    EXPECT_TRUE(codes_of(file->findings).contains("C08 warning"));
    EXPECT_EQ(file->valid, false);
}

TEST(RealGrids, TheOverlapOfTwentyMetresIsFound) {
    REPORT_OF(file, "small/sixcells2_described_zoverlap.grdecl");
    const Finding f = find(file->findings, "C04", Severity::error);
    EXPECT_EQ(f.count, 1u);
    EXPECT_NEAR(measure(f, "overlap"), 20, 1e-3);
}

TEST(RealGrids, TheGapOfOneMetreIsFound) {
    REPORT_OF(file, "small/banal4.grdecl");
    const Finding f = find(file->findings, "C04", Severity::warning);
    EXPECT_EQ(f.count, 1u);
    EXPECT_NEAR(measure(f, "gap"), 1, 1e-3);
    EXPECT_EQ(file->valid, true);
}

TEST(RealGrids, TheHandednessPairDiffers) {
    REPORT_OF(left, "small/sixcells_described_hdr1.grdecl");
    REPORT_OF(right, "small/sixcells_lefthanded_hdr1.grdecl");
    EXPECT_NE(codes_of(left->findings).contains("C12 info"), codes_of(right->findings).contains("C12 info"));
}

TEST(RealGrids, SoundOnesHaveNoErrors) {
    for (const char* name :
         {"spe9/SPE9.GRDECL", "pygrdecl/Simple20x20x5_Fault.grdecl", "pygrdecl/Simple10x10x3_Fault.grdecl", "pygrdecl/CP.GRDECL",
          "pygrdecl/40X48x1_3fatults.GRDECL", "upscaling/27cellsIso.grdecl", "upscaling/EightCells.grdecl", "small/banal1.grdecl",
          "small/banal3.grdecl", "small/banal6.grdecl", "simpleb8/E100_BO.EGRID", "simpleb8/simpleb8.grdecl", "small/twocell.grdecl"}) {
        REPORT_OF(file, name);
        EXPECT_EQ(file->valid, true) << name;
        EXPECT_FALSE(codes_of(file->findings).contains("C04 warning")) << name;
    }
}

// Counted from the records by a program of its own.
TEST(RealGrids, SidesOfTwoFaultsAreCounted) {
    REPORT_OF(reek, "reek3/reek_sim_faults.grdecl");
    EXPECT_EQ(measure(find(reek->findings, "C26", Severity::info), "sides"), 14);
    EXPECT_EQ(cells_of(find(reek->findings, "C26", Severity::info)).front(), (Cell{31, 8, 1}));
}

// The records of Norne on bricks: which faults lie between no active cells, and which sides two faults have, were counted
// by a program of its own.
TEST(RealGrids, FaultsOfNorneWithoutEffectAreNamed) {
    const auto at = [](const char* name) { return test::real_data(std::string("cornerpoint/norne/") + name); };
    if (!at("FAULT_JUN_05.INC")) GTEST_SKIP() << "no real data";
    LoadOptions options;
    options.options = {{"dims", "46,112,22"}};
    CornerPointGrid grid = brick_grid(46, 112, 22);
    for (const char* name : {"ACTNUM_0704.prop", "FAULT_JUN_05.INC", "FAULTMULT_AUG-2006.INC"}) {
        auto part = load(at(name)->string(), options);
        ASSERT_TRUE(part.ok()) << name;
        auto& records = std::get<CornerPointGrid>(part->objects[0]);
        if (!records.activity.empty()) grid.activity = records.activity;
        for (auto& fault : records.faults) {
            const auto same = std::ranges::find(grid.faults, fault.name, &CornerPointGrid::Fault::name);
            if (same == grid.faults.end()) grid.faults.push_back(fault);
            else if (fault.multiplier) same->multiplier = fault.multiplier;
        }
    }
    CheckOptions only;
    only.only = {"C25", "C26"};
    const auto found = findings_of(grid, only);
    std::set<std::string> multiplied, plain;
    for (const EntityRef& e : find(found, "C25", Severity::warning).entities) multiplied.insert(e.name);
    for (const EntityRef& e : find(found, "C25", Severity::info).entities) plain.insert(e.name);
    EXPECT_EQ(multiplied, (std::set<std::string>{"bricks", "BC", "G_08"}));
    EXPECT_EQ(plain, (std::set<std::string>{"bricks", "B2", "H_03", "IH", "m_east", "m_east_2", "m_north", "m_northe", "m_west"}));
    EXPECT_EQ(measure(find(found, "C26", Severity::info), "sides"), 66);
}

// One column of the lower layers bears the number of the upper ones; found by a program of its own, too.
TEST(RealGrids, AStrayColumnOfReeksRegionsIsFound) {
    REPORT_OF(file, "reek/reek_grd_w_props.roffasc");
    std::uint64_t arrays = 0;
    for (const Finding& f : file->findings) {
        if (f.code != "C23") continue;
        ++arrays;
        EXPECT_EQ(cells_of(f), (std::vector<Cell>{{12, 31, 11}, {12, 31, 12}, {12, 31, 13}, {12, 31, 14}}));
    }
    EXPECT_EQ(arrays, 2u) << "EQLNUM and FIPNUM";
}

TEST(RealGrids, WithTheirFaultRecordsHaveThrowAtAllOfThem) {
    const auto grid = test::real_data("cornerpoint/reek3/reek_sim.grdecl"),
               faults = test::real_data("cornerpoint/reek3/reek_sim_faults.grdecl");
    if (!grid || !faults) GTEST_SKIP() << "no real data";
    auto dataset = load(grid->string(), {}), records = load(faults->string(), {});
    ASSERT_TRUE(dataset.ok() && records.ok());
    auto& whole = std::get<CornerPointGrid>(dataset->objects[0]);
    whole.faults = std::get<CornerPointGrid>(records->objects[0]).faults;
    ASSERT_EQ(whole.faults.size(), 6u);
    const Codes codes = codes_of(whole);
    for (const char* code : {"C18 info", "C25 info", "G03 info"}) EXPECT_FALSE(codes.contains(code)) << code;
}

// As boundary representation sound grids have no more errors or warnings than by themselves, whatever their faults.
TEST(RealGrids, SoundOnesAreSoundAsBoundaryRepresentation) {
    CheckOptions as_brep;
    as_brep.grid_model.emplace();
    for (const char* name : {"reek/reek_sim_grid.grdecl",
                             "reek/REEK.EGRID",
                             "reek3/reek_sim.grdecl",
                             "spe9/SPE9.GRDECL",
                             "pygrdecl/20X20X6.GRDECL",
                             "pygrdecl/Simple20x20x5_Fault.grdecl",
                             "pygrdecl/Simple10x10x3_Fault.grdecl",
                             "pygrdecl/CP.GRDECL",
                             "pygrdecl/40X48x1_3fatults.GRDECL",
                             "upscaling/27cellsIso.grdecl",
                             "upscaling/EightCells.grdecl",
                             "small/banal1.grdecl",
                             "small/banal3.grdecl",
                             "small/banal4.grdecl",
                             "small/banal6.grdecl",
                             "small/gridqc1.roff",
                             "small/concave.grdecl",
                             "small/dual_distorted1.grdecl",
                             "small/sixcells_described_hdr1.grdecl",
                             "simpleb8/E100_BO.EGRID",
                             "simpleb8/IX_BO.EGRID",
                             "simpleb8/simpleb8.grdecl",
                             "small/twocell.grdecl",
                             "opm/CORNERPOINT_ACTNUM.DATA"}) {
        const auto path = test::real_data(std::string("cornerpoint/") + name);
        if (!path) GTEST_SKIP() << "no real data";
        auto plain = validate(path->string(), LoadOptions{}, CheckOptions{}), brep = validate(path->string(), LoadOptions{}, as_brep);
        ASSERT_TRUE(plain.ok() && brep.ok()) << name;
        Codes more = codes_of(brep->findings);
        for (const std::string& code : codes_of(plain->findings)) more.erase(code);
        more.erase("C28 info");
        EXPECT_EQ(more, Codes{}) << name;
    }
}

TEST(RealGrids, AreToldOfBentFacesWhereTheyHaveThem) {
    CheckOptions as_brep;
    as_brep.grid_model.emplace();
    const auto bent = [&](const char* name) {
        const auto path = test::real_data(std::string("cornerpoint/") + name);
        auto file = validate(path->string(), LoadOptions{}, as_brep);
        return file && codes_of(file->findings).contains("C28 info");
    };
    if (!test::real_data("cornerpoint/spe9/SPE9.GRDECL")) GTEST_SKIP() << "no real data";
    EXPECT_FALSE(bent("spe9/SPE9.GRDECL"));
    EXPECT_FALSE(bent("pygrdecl/CP.GRDECL"));
    EXPECT_TRUE(bent("reek/reek_sim_grid.grdecl"));
}

TEST(RealGrids, Spe9HasNothingToTell) {
    REPORT_OF(file, "spe9/SPE9.GRDECL");
    EXPECT_EQ(codes_of(file->findings), Codes{});
}

}  // namespace
}  // namespace geomend
