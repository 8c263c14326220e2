// SPDX-License-Identifier: AGPL-3.0-or-later
// The programs themselves read what was written; where one is not installed its test is skipped.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <sstream>

#include "meshes/cell_samples.h"
#include "meshes/written_mesh.h"
#include "support/temporary_folder.h"

namespace geomend::test {
namespace {

bool is_installed(const std::string& program) { return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0; }

/// Runs a shell line in a folder and gives what it printed.
std::string run(const TemporaryFolder& folder, const std::string& line) {
    const int status = std::system(("cd '" + folder.path().string() + "' && (" + line + ") > log 2>&1").c_str());
    const std::string log = read_file(folder / "log");
    EXPECT_EQ(status, 0) << log;
    return log;
}

void write(CellMesh mesh, const char* format, const std::filesystem::path& file) {
    OutputSet out(file);
    ASSERT_TRUE(write_cells(std::move(mesh), format, out));
}

std::size_t count_of(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

/// The volume that CalculiX integrates over an element set.
double volume_by_ccx(const TemporaryFolder& folder, const std::string& set) {
    write_file(folder / "job.inp", "*INCLUDE, INPUT=m.inp\n*MATERIAL, NAME=stuff\n*ELASTIC\n1000, 0.25\n*SOLID SECTION, ELSET=" + set +
                                       ", MATERIAL=stuff\n*BOUNDARY\n1, 1, 3\n2, 1, 3\n3, 1, 3\n*STEP\n*STATIC\n*EL PRINT, ELSET=" + set +
                                       ", TOTALS=ONLY\nEVOL\n*END STEP\n");
    const std::string log = run(folder, "timeout 60 ccx job");
    EXPECT_EQ(count_of(log, "*ERROR"), 0u) << log;
    const std::string data = read_file(folder / "job.dat");
    const std::size_t at = data.find("total volume");
    if (at == std::string::npos) return -1;
    std::istringstream in(data.substr(data.find('\n', at)));
    double volume = -1;
    in >> volume;
    return volume;
}

TEST(Clients, CalculixMeasuresTheSameVolumes) {
    if (!is_installed("ccx")) GTEST_SKIP() << "ccx (calculix-ccx) is not installed";
    for (const SampleCell& cell : sample_cells()) {
        const TemporaryFolder folder;
        write(mesh_of(cell), "abaqus", folder / "m.inp");
        EXPECT_NEAR(volume_by_ccx(folder, "rock"), cell.volume, 1e-5 * cell.volume) << to_string(cell.type);
    }
}

/// The volumes of the cells of an MSH 2.2 text.
std::vector<double> volumes_in_msh(const std::string& text) {
    std::map<std::size_t, Vec3> nodes;
    std::vector<double> volumes;
    std::istringstream in(text);
    std::size_t count = 0;
    for (std::string word; in >> word;) {
        if (word == "$Nodes") {
            in >> count;
            for (std::size_t i = 0, id = 0; i < count && in >> id; ++i) {
                Vec3& p = nodes[id];
                in >> p[0] >> p[1] >> p[2];
            }
        } else if (word == "$Elements") {
            in >> count;
            for (std::string line; std::getline(in, line) && !line.starts_with("$End");) {
                std::istringstream words(line);
                std::size_t id = 0, type = 0, tags = 0, skipped = 0, node = 0;
                words >> id >> type >> tags;
                for (; tags > 0; --tags) words >> skipped;
                if (type < 4 || type > 6) continue;  // tetrahedron, hexahedron, prism
                std::vector<Vec3> corners;
                while (words >> node) corners.push_back(nodes.at(node));
                volumes.push_back(flat_volume(corners));
            }
        }
    }
    return volumes;
}

TEST(Clients, GmshReadsMeditWithCellsTheRightWayOut) {
    if (!is_installed("gmsh")) GTEST_SKIP() << "gmsh is not installed";
    for (const SampleCell& cell : sample_cells()) {
        if (cell.type != CellType::tetrahedron && cell.type != CellType::hexahedron) continue;  // Gmsh 4.8 reads no prisms of Medit
        const TemporaryFolder folder;
        write(mesh_of(cell), "medit", folder / "m.mesh");
        run(folder, "timeout 60 gmsh m.mesh -save -format msh22 -save_all -o again.msh");
        EXPECT_EQ(volumes_in_msh(read_file(folder / "again.msh")), std::vector<double>{cell.volume}) << to_string(cell.type);
    }
}

TEST(Clients, TetGenReadsItsFilesAgain) {
    if (!is_installed("tetgen")) GTEST_SKIP() << "tetgen is not installed";
    for (const std::size_t sample : {0u, 3u}) {
        const TemporaryFolder folder;
        write(mesh_of(sample_cells()[sample]), "tetgen", folder / "m.node");
        const std::string log = run(folder, "timeout 60 tetgen -rCC m.ele");
        EXPECT_NE(log.find("Mesh tetrahedra: 1"), std::string::npos) << log;
        EXPECT_EQ(count_of(log, "!!"), 0u) << log;
    }
}

TEST(Clients, OpenFoamChecksTheTopologyOfItsMesh) {
    if (!is_installed("checkMesh")) GTEST_SKIP() << "checkMesh (openfoam) is not installed";
    const TemporaryFolder folder;
    write(two_boxes(false), "openfoam", folder / "case.foam");
    std::filesystem::create_directory(folder / "system");
    for (const std::string name : {"controlDict", "fvSchemes", "fvSolution"}) {
        write_file(folder / "system" / name,
                   "FoamFile { version 2.0; format ascii; class dictionary; object " + name +
                       "; }\napplication x; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; "
                       "writeControl timeStep; writeInterval 1; gradSchemes{} divSchemes{} laplacianSchemes{} "
                       "interpolationSchemes{} snGradSchemes{} ddtSchemes{} solvers{}\n");
    }
    const std::string log = run(folder, "WM_PROJECT_DIR=/usr/share/openfoam timeout 60 checkMesh -allTopology");
    EXPECT_EQ(count_of(log, "***"), 0u) << log;
    EXPECT_EQ(count_of(log, "Upper triangular ordering OK."), 1u) << log;
    EXPECT_EQ(count_of(log, "hexahedra:     2"), 1u) << log;
}

}  // namespace
}  // namespace geomend::test
