// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
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

/// The command that repairs some faults.
std::vector<std::string> repair_of(const Faults& faults, const std::filesystem::path& folder) {
    std::vector<std::string> words{"repair"};
    for (const std::string& name : faults.names) words.push_back((folder / (name + "_2000m.ts")).string());
    return words;
}

TEST_P(RealFaults, InABoxBecomeASealedModel) {
    const auto folder = real_data("gocad/scec_cfm7_2000m");
    if (!folder) GTEST_SKIP() << "no real data";
    const TemporaryFolder out;
    auto words = repair_of(GetParam(), *folder);
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

// Steps are judged by the tolerance by rule, the result also by one that was asked for: what is found by that alone is mended, too.
class RealFaultsAndATolerance : public ::testing::TestWithParam<Faults> {};

TEST_P(RealFaultsAndATolerance, AreSoundByThatOne) {
    const auto folder = real_data("gocad/scec_cfm7_2000m");
    if (!folder) GTEST_SKIP() << "no real data";
    const TemporaryFolder out;
    auto words = repair_of(GetParam(), *folder);
    const std::string sealed = (out / "sealed.ml").string(), tolerance = "0.5";
    words.insert(words.end(), {"--box", "auto", "--max-gap", "100", "--tolerance", tolerance, "-o", sealed});
    const ProgramRun repaired = run_geomend(words);
    ASSERT_EQ(repaired.status, 0) << repaired.out << repaired.err;
    EXPECT_EQ(run_geomend({"validate", sealed}).status, 0);
    const ProgramRun valid = run_geomend({"validate", sealed, "--tolerance", tolerance});
    EXPECT_EQ(valid.status, 0) << valid.out;
}

INSTANTIATE_TEST_SUITE_P(OfCalifornia, RealFaultsAndATolerance,
                         ::testing::Values(Faults{"EarthquakeValley",
                                                  {"PNRA-ATEV-MULT-Agua_Tibia_Earthquake_Valley_fault_east-CFM4",
                                                   "PNRA-ATEV-MULT-Agua_Tibia_Earthquake_Valley_fault_main-CFM4",
                                                   "PNRA-ATEV-MULT-Agua_Tibia_Earthquake_Valley_fault_west-CFM4"}},
                                           Faults{"GreatValley", {"GVFA-CGVT-DlS5-Great_Valley-CFM7", "GVFA-CGVT-ENGH-Great_Valley-CFM7"}}),
                         [](const auto& info) { return std::string(info.param.what); });

// Faults that lie so near each other that a weld of all does not settle: borders are laid and cut twice, both times in sheets where a cut
// does not settle; without these in the second round one error more is left.
TEST(RealFaultsSoNear, AreWeldedByTheirBordersTwice) {
    const auto folder = real_data("gocad/scec_cfm7_2000m");
    if (!folder) GTEST_SKIP() << "no real data";
    std::vector<std::string> words{"repair"};
    for (const auto& file : std::filesystem::directory_iterator(*folder)) {
        if (file.path().filename().string().starts_with("OCBA-")) words.push_back(file.path().string());
    }
    std::ranges::sort(words.begin() + 1, words.end());
    const TemporaryFolder out;
    words.insert(words.end(), {"--box", "auto", "--max-gap", "100", "--tolerance", "0.16", "-o", (out / "sealed.ml").string(), "--json"});
    const auto result = nlohmann::json::parse(run_geomend(words).out, nullptr, false);
    EXPECT_LE(result["report"]["files"][0]["counts"]["error"], 2);
}

}  // namespace
}  // namespace geomend::test
