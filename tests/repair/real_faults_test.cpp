// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "support/program.h"
#include "support/real_data.h"

// Real faults that cross, branch and end a few millimetres from each other, in a box: sealed, and filled with cells.

namespace geomend::test {
namespace {

struct Faults {
    const char* what;
    std::vector<std::string> names;
};

void PrintTo(const Faults& faults, std::ostream* out) { *out << faults.what; }

class RealFaults : public ::testing::TestWithParam<Faults> {};

TEST_P(RealFaults, InABoxBecomeASealedModel) {
    const auto folder = real_data("gocad/scec_cfm7_2000m");
    if (!folder) GTEST_SKIP() << "no real data";
    const TemporaryFolder out;
    std::vector<std::string> words{"repair"};
    for (const std::string& name : GetParam().names) words.push_back((*folder / (name + "_2000m.ts")).string());
    const std::string sealed = (out / "sealed.ml").string();
    words.insert(words.end(), {"--box", "auto", "--max-gap", "200", "-o", sealed});
    const ProgramRun repaired = run_geomend(words);
    ASSERT_EQ(repaired.status, 0) << repaired.out << repaired.err;
    const ProgramRun valid = run_geomend({"validate", sealed, "--json"});
    EXPECT_EQ(valid.status, 0) << valid.out;
    const ProgramRun meshed = run_geomend({"mesh", sealed, "-o", (out / "cells.vtu").string()});
    EXPECT_EQ(meshed.status, 0) << meshed.out << meshed.err;
}

INSTANTIATE_TEST_SUITE_P(
    OfCalifornia, RealFaults,
    ::testing::Values(Faults{"IndioHills",
                             {"SAFS-MHFZ-LSBM-Indio_Hills_fault-CFM4", "SAFS-MHFZ-LSBM-Berdoo_Canyon_fault-CFM4",
                              "SAFS-SAFZ-COAV-Mission_Creek_fault_strand-CFM4", "SAFS-MHFZ-MULT-Mecca_Hills_Hidden_Springs_fault-CFM4",
                              "ETRA-LSBM-1992-Joshua_Tree_sequence-CFM6", "SAFS-SAFZ-MULT-Southern_San_Andreas_fault_and_Banning-CFM6"}},
                      Faults{"CoyoteCreek",
                             {"PNRA-SJFZ-BRMT-Coyote_Creek_fault-CFM4", "PNRA-SJFZ-BRMT-Coyote_Creek_blind_fault_north_east-CFM4",
                              "PNRA-SJFZ-ANZA-Clark_fault_south_west-CFM4", "SALT-CRSF-SLTS-Extra_fault-CFM3",
                              "PNRA-SJFZ-ANZA-Clark_fault_south_west_link-CFM4", "PNRA-ELSZ-CYMT-Elsinore_fault-CFM4",
                              "PNRA-SJFZ-SSMT-Superstition_Mountain_fault-CFM4", "SALT-CRSF-IMPV-Elmore_Ranch_fault-CFM1",
                              "PNRA-SJFZ-SSMT-West_Mesa_fault-CFM5", "PNRA-CRSF-ALCM-Sawtooth_Range_fault-CFM4",
                              "PNRA-CRSF-PGWS-Painted_Gorge_Wash_fault-CFM4", "PNRA-SJFZ-ANZA-Clark_fault_south_east-CFM4"}}),
    [](const auto& info) { return std::string(info.param.what); });

}  // namespace
}  // namespace geomend::test
