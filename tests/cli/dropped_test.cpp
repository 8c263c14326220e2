// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/program.h"

// What a reader leaves out of a file is in the list of losses of info and convert: one file for each family that leaves anything out.

namespace geomend::test {

namespace {

struct Case {
    std::string file, text, target;
    std::string what;        ///< stands in the entry of the list
    std::string loss_class;  ///< of that entry
    std::string code;        ///< of the finding
    std::vector<std::string> options = {};
};

const std::string deck_head =
    "SPECGRID\n 3 1 1 1 F /\nCOORD\n 0 0 0 0 0 9 1 0 0 1 0 9 2 0 0 2 0 9 3 0 0 3 0 9 0 1 0 0 1 9 1 1 0 1 1 9 2 1 0 2 1 9 3 1 0 3 1 9 /\n"
    "ZCORN\n 12*1 12*2 /\n";
const std::string gocad_head = "HEADER {\nname:s\n}\n";
const std::string legacy_head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n";
const std::string triangle_msh =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n";

/// An array of a formatted file of Eclipse; values as they stand.
std::string eclipse_array(std::string name, int count, const char* type, const std::string& values) {
    name.resize(8, ' ');
    std::string number = std::to_string(count);
    number.insert(0, 12 - number.size(), ' ');
    return " '" + name + "'" + number + " '" + type + "'\n" + values + (values.empty() ? "" : "\n");
}
const std::string coarsened_grid =
    eclipse_array("DIMENS", 3, "INTE", " 1 1 1") + eclipse_array("COORDS", 7, "INTE", " 1 1 1 1 1 0 1") +
    eclipse_array("CORNERS", 24, "REAL", " 0 0 10 10 0 10 0 20 10 10 20 10\n 0 0 15 10 0 15 0 20 15 10 20 15");

std::vector<Case> cases() {
    return {
        {"a.FGRID", coarsened_grid, "vtu", "the grouping of coarsened cells", "identity", "F150"},
        {"a.ts", "GOCAD TSurf 1\n" + gocad_head + "TFACE\nPVRTX 1 0 0 0 7\nPVRTX 2 1 0 0 8\nPVRTX 3 0 1 0 9\nTRGL 1 2 3\nEND\n", "vtp",
         "values", "substance", "F107"},
        {"b.ts", "GOCAD TSurf 1\n" + gocad_head + "TFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nSEG 1 2\nEND\n", "vtp",
         "record 'SEG'", "identity", "F150"},
        {"c.ts",
         "GOCAD TSurf 1\n" + gocad_head + "TFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\nGOCAD Whatever 1\n" +
             gocad_head + "END\n",
         "vtp", "object of type 'Whatever'", "substance", "F150"},
        {"a.vs", "GOCAD VSet 1\n" + gocad_head + "PVRTX 1 0 0 0 7\nPVRTX 2 1 0 0 8\nEND\n", "vtp", "values", "substance", "F107"},
        {"a.msh", triangle_msh + "$NodeData\n1\n\"v\"\n0\n3\n0\n1\n2\n1 5\n1 6\n$EndNodeData\n", "vtu", "values", "substance", "F107"},
        {"a.vtk", legacy_head + "HYPERFACES 1 2\n1 0\nVERTICES 3 6\n1 0 1 1 1 2\n", "vtp", "record 'HYPERFACES'", "substance", "F150"},
        {"a.vtu",
         "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" NumberOfCells=\"2\"><Points><DataArray "
         "type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points><Cells><DataArray "
         "type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
         "format=\"ascii\">3 3</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 "
         "0</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>",
         "msh", "empty cells", "identity", "F119"},
        {"a.grdecl", deck_head + "NNC\n 1 1 1 3 1 1 5 2 2 /\n/\n", "vtu", "further items of stated connections", "substance", "F150"},
        {"b.grdecl", deck_head + "INCLUDE\n 'missing.inc' /\n", "vtu", "missing.inc", "substance", "F150", {"--option", "includes=skip"}},
    };
}

const nlohmann::json* entry_of(const nlohmann::json& losses, const Case& c) {
    for (const auto& loss : losses) {
        if (loss.at("what").get<std::string>().find(c.what) != std::string::npos && loss.at("class") == c.loss_class) return &loss;
    }
    return nullptr;
}

TEST(Losses, WhatManyRegionsLoseAlikeIsOneLine) {
    const TemporaryFolder folder;
    constexpr int count = 12;
    std::string names, nodes, cells;
    for (int r = 0; r < count; ++r) {
        const std::string number = std::to_string(r + 1), x = std::to_string(10 * r), next = std::to_string(10 * r + 1);
        const auto node = [&](int k) { return std::to_string(4 * r + k) + ' '; };
        names += "3 " + number + " \"R" + std::to_string(r) + "\"\n";
        nodes += node(1) + x + " 0 0\n" + node(2) + next + " 0 0\n" + node(3) + x + " 1 0\n" + node(4) + x + " 0 1\n";
        cells += number + " 4 2 " + number + ' ' + number + ' ' + node(1) + node(2) + node(3) + node(4) + '\n';
    }
    write_file(folder / "cells.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" + std::to_string(count) + '\n' + names +
                                         "$EndPhysicalNames\n$Nodes\n" + std::to_string(4 * count) + '\n' + nodes +
                                         "$EndNodes\n$Elements\n" + std::to_string(count) + '\n' + cells + "$EndElements\n");
    const auto run = run_geomend({"convert", folder / "cells.msh", "-o", folder / "model.ml", "--lossy"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.err.find("R0, R1, R2 and 9 more: cells (12 times)"), std::string::npos) << run.err;
    EXPECT_EQ(run.err.find("R7"), std::string::npos) << run.err;
    const auto all = run_geomend({"convert", folder / "cells.msh", "-o", folder / "model.ml", "--lossy", "--verbose"});
    EXPECT_NE(all.err.find("R7: cells"), std::string::npos) << all.err;
}

}  // namespace

TEST(WhatIsDropped, IsInTheLossesOfInfoAndConvert) {
    for (const Case& c : cases()) {
        const TemporaryFolder folder;
        write_file(folder / c.file, c.text);
        const auto told = info(folder / c.file, c.options);
        ASSERT_TRUE(told.contains("loss")) << c.file << told.dump();
        EXPECT_NE(entry_of(told["loss"], c), nullptr) << c.file << told["loss"].dump();

        std::vector<std::string> arguments{"convert", "--json", (folder / c.file).string(), "-o", (folder / ("o." + c.target)).string()};
        arguments.insert(arguments.end(), c.options.begin(), c.options.end());
        const ProgramRun strict = run_geomend(arguments);
        EXPECT_EQ(strict.status, c.loss_class == "substance" ? 4 : 0) << c.file << strict.out << strict.err;
        arguments.push_back("--lossy");
        const ProgramRun lossy = run_geomend(arguments);
        ASSERT_EQ(lossy.status, 0) << c.file << lossy.err;
        const auto result = nlohmann::json::parse(lossy.out);
        EXPECT_NE(entry_of(result.at("loss"), c), nullptr) << c.file << lossy.out;

        const ProgramRun validated = run_geomend({"validate", "--json", (folder / c.file).string(), "--checks", "F*"});
        if (c.options.empty()) {
            EXPECT_NE(validated.out.find('"' + c.code + '"'), std::string::npos) << c.file << validated.out;
        }
    }
}

TEST(WhatIsDropped, NothingOfSoundFiles) {
    const std::vector<std::pair<std::string, std::string>> files = {
        {"b.ts", "GOCAD TSurf 1\n" + gocad_head + "TFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n"},
        {"b.msh", triangle_msh},
        {"b.vtk", legacy_head + "VERTICES 3 6\n1 0 1 1 1 2\n"},
        {"b.grdecl", deck_head + "NNC\n 1 1 1 3 1 1 5 /\n/\nMARVEL\n 1 2 3 /\n"},
        {"b.xyz", "1 2 3 4\n5 6 7 8\n9 10 11 12\n"},
    };
    for (const auto& [name, text] : files) {
        const TemporaryFolder folder;
        write_file(folder / name, text);
        EXPECT_EQ(info(folder / name).at("loss"), nlohmann::json::array()) << name;
    }
}

TEST(WhatIsDropped, OfRestartFilesIsWhatIsNotOfCells) {
    const TemporaryFolder folder;
    write_file(folder / "a.grdecl", deck_head);
    ASSERT_EQ(run_geomend({"convert", (folder / "a.grdecl").string(), "-o", (folder / "a.EGRID").string(), "--lossy"}).status, 0);
    std::string head;
    for (int i = 0; i < 100; ++i)
        head += i == 8 || i == 11 ? " 3" : i == 2 || i == 9 || i == 10 || i == 64 || i == 65 ? " 1" : i == 66 ? " 2020" : " 0";
    write_file(folder / "a.FUNRST", eclipse_array("SEQNUM", 1, "INTE", " 1") + eclipse_array("INTEHEAD", 100, "INTE", head) +
                                        eclipse_array("IWEL", 3, "INTE", " 1 2 3") + eclipse_array("STARTSOL", 0, "INTE", "") +
                                        eclipse_array("PRESSURE", 3, "REAL", " 100 200 300") + eclipse_array("ENDSOL", 0, "INTE", ""));
    const auto told = info(folder / "a.FUNRST");
    ASSERT_TRUE(told.contains("loss")) << told.dump();
    EXPECT_NE(told["loss"].dump().find("IWEL"), std::string::npos) << told.dump();
    const ProgramRun run = run_geomend({"convert", "--json", (folder / "a.FUNRST").string(), "-o", (folder / "o.vtu").string()});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("IWEL"), std::string::npos) << run.out;
}

// Tags of ROFF that nothing is known of are kept, and go back.
TEST(WhatIsDropped, NothingOfRoffFiles) {
    const TemporaryFolder folder;
    write_file(folder / "a.grdecl", deck_head);
    const auto file = [&](const char* name) { return (folder / name).string(); };
    ASSERT_EQ(run_geomend({"convert", file("a.grdecl"), "-o", file("a.roffasc"), "--lossy"}).status, 0);
    std::string text = read_file(folder / "a.roffasc");
    const std::size_t end = text.find("tag eof");
    ASSERT_NE(end, std::string::npos);
    text.insert(end, "tag marvel\nint a 3\narray float data 2\n 1 2\nendtag\n");
    write_file(folder / "b.roffasc", text);
    EXPECT_EQ(info(folder / "b.roffasc").at("loss"), nlohmann::json::array());
    ASSERT_EQ(run_geomend({"convert", file("b.roffasc"), "-o", file("c.roffasc")}).status, 0);
    EXPECT_NE(read_file(folder / "c.roffasc").find("marvel"), std::string::npos);
    // A target that cannot hold it says so.
    const ProgramRun run = run_geomend({"convert", "--json", file("b.roffasc"), "-o", file("d.EGRID"), "--lossy"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("\"loss\""), std::string::npos);
    EXPECT_NE(run.out.find("source format"), std::string::npos) << run.out;
}

// Readers of horizons refuse what they cannot take: nothing of such a file is left out.
TEST(WhatIsDropped, HorizonsWithSurplusTextAreRefused) {
    for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
             {"a.zmap", "@H HEADER, GRID, 3\n10, -999.0, , 3, 1\n2, 2, 0.0, 1.0, 0.0, 1.0\n0.0, 0.0, 0.0\n@\n 1.0 2.0\n 3.0 4.0\n 5.0\n"},
             {"a.xyz", "1 2 3\n4 5 6 word\n"}}) {
        const TemporaryFolder folder;
        write_file(folder / name, text);
        EXPECT_EQ(run_geomend({"info", (folder / name).string()}).status, 3) << name;
    }
}

TEST(VolumesLeftOut, OfPinchedCellsWithWarpedFacesAreListed) {
    const TemporaryFolder folder;
    const std::string head =
        "SPECGRID\n 1 1 1 1 F /\nCOORD\n 0 0 0 0 0 100 100 0 0 100 0 100 0 100 0 0 100 100 100 100 0 100 100 100 /\nZCORN\n 4*10 ";
    const auto told = [&](const std::string& bottom) {
        write_file(folder / "grid.grdecl", head + bottom + " /\n");
        const ProgramRun run = run_geomend({"convert", (folder / "grid.grdecl").string(), "-o", (folder / "o.vtu").string()});
        EXPECT_EQ(run.status, 0) << run.err;
        return run.err;
    };
    EXPECT_NE(told("20 10 10 10").find("volume of pinched cells with warped faces: 25000 becomes 33333"), std::string::npos);
    EXPECT_EQ(told("20 20 10 10").find("volume of"), std::string::npos);  // a wedge, exactly
    EXPECT_EQ(told("20 20 20 20").find("volume of"), std::string::npos);
}

}  // namespace geomend::test
