// SPDX-License-Identifier: AGPL-3.0-or-later
// Known counts of real files, what is left of them when they are cut or damaged, and VTK's own readers on what we write.
#include <sys/wait.h>

#include <cstdlib>
#include <map>
#include <random>

#include "support/real_data.h"
#include "vtk/xml_support.h"

namespace geomend::test {
namespace {

struct Known {
    const char* file;
    std::size_t points;
    std::map<CellType, std::size_t> cells;
};

const std::vector<Known>& known_files() {
    static const std::vector<Known> all{
        {"vtk/Domain_Mesh_FaultModel.vtu", 7421, {{CellType::hexahedron, 6000}}},
        {"vtk/Fault_Mesh_FaultModel.vtu", 88, {{CellType::polygon, 63}}},
        {"vtk/box_hybrid_mesh.vtu", 3655, {{CellType::tetrahedron, 7949}, {CellType::pyramid, 515}, {CellType::hexahedron, 943}}},
        {"vtk/faultMesh.vtu", 27612, {{CellType::hexahedron, 17980}, {CellType::quad, 19142}}},
        {"vtk/staircase3d_tet_with_properties.vtu", 961, {{CellType::tetrahedron, 3157}}},
        {"vtk/cone_append_encoded.vtu",
         580,
         {{CellType::tetrahedron, 2197}, {CellType::triangle, 1182}, {CellType::line, 131}, {CellType::vertex, 6}}},
        {"vtk/cells/QuadraticTetra.vtu", 189, {{CellType::quadratic_tetrahedron, 96}}},
        {"vtk/cells/TriangleStrip.vtu", 10, {{CellType::triangle, 8}}},
        {"vtk/cells/Voxel.vtu", 8, {{CellType::hexahedron, 1}}},
        {"vtk/cube.pvtu", 100, {{CellType::hexahedron, 27}}},
    };
    return all;
}

TEST(XmlReal, CountsAreThoseOfTheOracles) {
    if (!real_data("vtk")) GTEST_SKIP() << "the real files are not there";
    for (const Known& known : known_files()) {
        SCOPED_TRACE(known.file);
        const auto data = read_xml_file(*real_data(known.file));
        ASSERT_TRUE(data.ok()) << data.why().error.message;
        const auto mesh = only_object<CellMesh>(*data);
        EXPECT_EQ(mesh.points.size(), known.points);
        std::map<CellType, std::size_t> cells;
        for (const CellType t : mesh.types) ++cells[t];
        EXPECT_EQ(cells, known.cells);
    }
    const auto grid = read_xml_file(*real_data("vtk/egg_withBurdens_small.vts"));
    ASSERT_TRUE(grid.ok());
    EXPECT_EQ(lattice_cell_count(only_object<StructuredGrid>(*grid).dims), 79200u);
    const auto polygons = read_xml_file(*real_data("vtk/dfn1_ascii.vtp"));
    ASSERT_TRUE(polygons.ok());
    EXPECT_EQ(only_object<Surface>(*polygons).points.size(), 187u);
    EXPECT_EQ(only_object<Surface>(*polygons).polygons.size(), 10u);
    const auto blocks = read_xml_file(*real_data("vtk/tShapedFracturedCube.vtm"));
    ASSERT_FALSE(blocks.ok());
    EXPECT_EQ(blocks.why().error.code, "F010");
}

TEST(XmlReal, CutFilesAreNeverReadInSilence) {
    if (!real_data("vtk")) GTEST_SKIP() << "the real files are not there";
    for (const Known& known : known_files()) {
        SCOPED_TRACE(known.file);
        const std::string bytes = read_file(*real_data(known.file));
        for (const std::size_t percent : {0, 10, 50, 90}) {
            const auto code = failure_code(bytes.substr(0, bytes.size() * percent / 100));
            EXPECT_EQ(code, percent == 0 ? "F002" : "F004") << percent;
        }
    }
}

TEST(XmlReal, ChangedBytesGiveADatasetOrADiagnosis) {
    if (!real_data("vtk")) GTEST_SKIP() << "the real files are not there";
    std::mt19937 random(20);
    for (const char* file : {"vtk/cells/QuadraticTetra.vtu", "vtk/Fault_Mesh_FaultModel.vtu", "vtk/cube_0.vtu", "vtk/dfn1_ascii.vtp"}) {
        const std::string bytes = read_file(*real_data(file));
        for (int round = 0; round < 200; ++round) {
            std::string changed = bytes;
            for (int i = 0; i < 4; ++i) changed[random() % changed.size()] = static_cast<char>(random());
            const auto data = read_xml(changed);
            if (!data) {
                EXPECT_FALSE(data.why().error.code.empty());
                EXPECT_EQ(data.why().error.where.file, "model.vtu");
            }
        }
    }
}

int client(const std::string& arguments) {
    const std::string command = "/usr/bin/python3 " GEOMEND_SOURCE_DIR "/tests/vtk/xml_client.py " + arguments + " >/dev/null 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string counts(const std::filesystem::path& file, const TemporaryFolder& folder) {
    const auto text = folder / "counts.txt";
    EXPECT_EQ(client(file.string() + ' ' + text.string()), 0) << file;
    return read_file(text);
}

TEST(XmlClient, ReadsBackWhatWeWriteWithTheSameCounts) {
    if (client("--probe") != 0) GTEST_SKIP() << "python3 with VTK (package python3-vtk9) is not there";
    if (!real_data("vtk")) GTEST_SKIP() << "the real files are not there";
    const TemporaryFolder folder;
    const std::vector<FormatOptions> ways{{}, {{"compress", "yes"}}, {{"encoding", "ascii"}}};
    std::size_t way = 0;
    for (const char* file : {"vtk/box_hybrid_mesh.vtu", "vtk/staircase3d_tet_with_properties.vtu", "vtk/egg_withBurdens_small.vts",
                             "vtk/dfn1_ascii.vtp", "vtk/cells/HexagonalPrism.vtu", "vtk/faultMesh.vtu"}) {
        SCOPED_TRACE(file);
        const auto path = *real_data(file);
        const auto data = read_xml_file(path);
        ASSERT_TRUE(data.ok());
        const auto ours = write_xml(*data, folder, path.extension().string().substr(1), ways[way++ % ways.size()]);
        EXPECT_EQ(counts(ours, folder), counts(path, folder));
    }
}

TEST(XmlClient, ReadsPolyhedraImagesAndBlocks) {
    if (client("--probe") != 0) GTEST_SKIP() << "python3 with VTK (package python3-vtk9) is not there";
    const TemporaryFolder folder;
    Dataset data =
        must_read_xml(unstructured(four_points, "0 1 2 3", "4", "42", 4, 1,
                                   "<DataArray type=\"Int64\" Name=\"faces\" format=\"ascii\">4 3 0 2 1 3 0 1 3 3 1 2 3 3 0 3 2</DataArray>"
                                   "<DataArray type=\"Int64\" Name=\"faceoffsets\" format=\"ascii\">17</DataArray>"));
    EXPECT_EQ(counts(write_xml(data, folder, "vtu"), folder), "4 points 1 cells\ntype 42: 1\n");
    EXPECT_EQ(counts(write_xml(data, folder, "vtm"), folder), "4 points 1 cells\n");
    Raster raster;
    raster.dims = {3, 2, 2};
    raster.origin = {400000.33333333331, 0, 0};
    data.objects = {raster};
    EXPECT_EQ(counts(write_xml(data, folder, "vti"), folder), "12 points 2 cells\norigin 400000.3333333333\ntype 11: 2\n");
}

}  // namespace
}  // namespace geomend::test
