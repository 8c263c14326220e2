// SPDX-License-Identifier: AGPL-3.0-or-later
// Real and sample files, cut and damaged: an error with its place or a finding, never silence or a crash.
#include <gtest/gtest.h>

#include <random>

#include "support/program.h"
#include "support/real_data.h"

namespace geomend::test {
namespace {

const char* const files[] = {"gocad/modelA1.ml",
                             "gocad/cube_model_equi.so",
                             "gocad/test.lso",
                             "gocad/ts-2props.ts",
                             "gocad/points.vs",
                             "gocad/surf2d_multi.ts",
                             "gocad/test.wl",
                             "gocad/split_cube.ml",
                             "gmsh/cube_v22.msh",
                             "gmsh/cube_v41.msh",
                             "vtk/dfn1_ascii.vtp",
                             "vtk/cube_0.vtu",
                             "vtk/supportedElements.vtk",
                             "vtk/cone_append_encoded.vtu",
                             "vtk/hybridHexPrismMesh.vtk",
                             "vtk/cells/PentaHexa.vtk",
                             "vtk/Domain_Mesh_FaultModel.vtu"};

// Exit 3 with a message, or exit 0 with a finding on standard error that says the end is missing.
void expect_told(const ProgramRun& run, const std::string& what) {
    if (run.status == 0) {
        EXPECT_NE(run.err.find("F101"), std::string::npos) << what << ": silent success";
    } else {
        EXPECT_EQ(run.status, 3) << what << '\n' << run.err;
    }
    EXPECT_FALSE(run.err.empty()) << what;
}

class Hostile : public testing::TestWithParam<const char*> {};

TEST_P(Hostile, IsNeverSilentlyReadWhenCut) {
    const auto path = real_data(GetParam());
    if (!path) GTEST_SKIP() << GetParam() << " is not here";
    const std::string bytes = read_file(*path);
    const TemporaryFolder folder;
    const auto cut = folder / path->filename().string();
    for (const std::size_t percent : {10, 50, 90}) {
        const std::string kept = bytes.substr(0, bytes.size() * percent / 100);
        if (kept.ends_with("\nEND\n")) continue;  // just between two objects: what is left is a whole file
        write_file(cut, kept);
        expect_told(run_geomend({"info", cut.string()}), std::to_string(percent) + " %");
    }
    write_file(cut, "");
    EXPECT_EQ(run_geomend({"info", cut.string()}).status, 3);
}

TEST_P(Hostile, SurvivesRandomBytes) {
    const auto path = real_data(GetParam());
    if (!path) GTEST_SKIP() << GetParam() << " is not here";
    const std::string bytes = read_file(*path);
    const TemporaryFolder folder;
    const auto changed = folder / path->filename().string();
    std::mt19937 random(7);
    for (int round = 0; round < 6; ++round) {
        std::string damaged = bytes;
        for (int i = 0; i < 1 + 4 * round; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
        write_file(changed, damaged);
        const ProgramRun run = run_geomend({"info", changed.string()});
        EXPECT_TRUE(run.status == 0 || run.status == 3 || run.status == 5) << "round " << round << ": status " << run.status << '\n'
                                                                           << run.err;
    }
}

TEST_P(Hostile, ReadsTheSameWithCarriageReturns) {
    const auto path = real_data(GetParam());
    if (!path) GTEST_SKIP() << GetParam() << " is not here";
    const std::string bytes = read_file(*path);
    if (bytes.find('\0') != std::string::npos || bytes.find("appended") != std::string::npos) GTEST_SKIP() << "not a text file";
    std::string with_cr;
    for (const char c : bytes) {
        if (c == '\n' && (with_cr.empty() || with_cr.back() != '\r')) with_cr += '\r';
        with_cr += c;
    }
    const TemporaryFolder folder;
    const auto copy = folder / path->filename().string();
    write_file(copy, with_cr);
    auto a = info(*path), b = info(copy);
    ASSERT_TRUE(a.is_object() && b.is_object());
    EXPECT_EQ(a["objects"], b["objects"]);
    EXPECT_EQ(a["brep"], b["brep"]);
}

INSTANTIATE_TEST_SUITE_P(Real, Hostile, testing::ValuesIn(files));

TEST(FilesThatHoldNothing, AreTold) {
    const TemporaryFolder folder;
    const std::pair<const char*, const char*> empty[] = {
        {"e.stl", "solid x\nendsolid x\n"},
        {"e.off", "OFF\n0 0 0\n"},
        {"e.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n"},
        {"e.ts", "GOCAD TSurf 1\nHEADER {\nname:x\n}\nTFACE\nEND\n"},
        {"e.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 0 double\n"}};
    for (const auto& [name, text] : empty) {
        write_file(folder / name, text);
        for (const char* command : {"validate", "info"}) {
            const auto run = run_geomend({command, (folder / name).string()});
            EXPECT_TRUE(run.status == 3 || (run.out + run.err).find("F119") != std::string::npos) << name << run.out << run.err;
        }
    }
}

}  // namespace
}  // namespace geomend::test
