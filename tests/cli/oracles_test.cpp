// SPDX-License-Identifier: AGPL-3.0-or-later
// Known answers of real files, asked of the program as a user would.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <ostream>

#include "support/program.h"
#include "support/real_data.h"

namespace geomend::test {
namespace {

using Json = nlohmann::json;

// Half a unit of the last digit of a figure that is given with so many significant digits.
void expect_to_digits(const Json& actual, double expected, int digits, const std::string& what) {
    ASSERT_TRUE(actual.is_number()) << what;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(expected))) - digits + 1);
    EXPECT_NEAR(actual.get<double>(), expected, 0.5 * unit * (1 + 1e-9)) << what;
}

struct BrepOracle {
    const char* file;
    int corners, lines, surfaces, regions;
    int vertices, triangles;  ///< -1: not known
};
void PrintTo(const BrepOracle& o, std::ostream* out) { *out << o.file; }

class Breps : public testing::TestWithParam<BrepOracle> {};

TEST_P(Breps, HaveTheKnownCounts) {
    const BrepOracle& o = GetParam();
    const auto path = real_data(o.file);
    if (!path) GTEST_SKIP() << o.file << " is not here";
    const Json brep = info(*path)["brep"];
    ASSERT_TRUE(brep.is_object());
    EXPECT_EQ(brep["corners"], o.corners);
    EXPECT_EQ(brep["lines"], o.lines);
    EXPECT_EQ(brep["surfaces"], o.surfaces);
    EXPECT_EQ(brep["regions"], o.regions);
    if (o.vertices >= 0) {
        EXPECT_EQ(brep["vertices"], o.vertices);
    }
    if (o.triangles >= 0) {
        EXPECT_EQ(brep["triangles"], o.triangles);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Real, Breps,
    testing::Values(BrepOracle{"gocad/modelA1.ml", 20, 36, 21, 4, 3602, 7932}, BrepOracle{"gocad/modelA4.ml", 52, 98, 55, 8, 23438, 48903},
                    BrepOracle{"gocad/modelA4.so", 52, 98, 55, 8, 6691, 10049},
                    BrepOracle{"gocad/modelA4_lts.so", 52, 98, 55, 8, 6691, 10049},
                    BrepOracle{"gocad/CloudSpin.ml", 138, 239, 115, 7, 14524, 30751},
                    BrepOracle{"gocad/CloudSpin_fixed.ml", 148, 249, 115, 7, 14524, 30751},
                    BrepOracle{"gocad/not_sealed_cube.ml", 6, 6, 6, 0, 24, 12}, BrepOracle{"gocad/split_cube.ml", 1, 1, 3, 2, 12, 22},
                    BrepOracle{"gocad/cube_model_equi.so", 12, 20, 11, 2, 54, 116}, BrepOracle{"gocad/test.lso", 22, 39, 23, 4, -1, -1},
                    BrepOracle{"gmsh/cube_v22.msh", 8, 12, 6, 1, 131, 240}, BrepOracle{"gmsh/cube_v41.msh", 8, 12, 6, 1, 131, 240}));

struct VolumeOracle {
    const char* file;
    std::vector<std::pair<double, int>> volumes;  ///< in any order, with their significant digits
    double sum;
    int sum_digits;  ///< 0: not known
};
void PrintTo(const VolumeOracle& o, std::ostream* out) { *out << o.file; }

class RegionVolumes : public testing::TestWithParam<VolumeOracle> {};

TEST_P(RegionVolumes, AreTheKnownOnes) {
    const VolumeOracle& o = GetParam();
    const auto path = real_data(o.file);
    if (!path) GTEST_SKIP() << o.file << " is not here";
    const Json brep = info(*path)["brep"];
    ASSERT_TRUE(brep.is_object());
    std::vector<double> volumes;
    double sum = 0;
    for (const Json& region : brep["region_volumes"]) {
        ASSERT_TRUE(region.contains("volume")) << region;
        volumes.push_back(region["volume"]);
        sum += volumes.back();
    }
    auto expected = o.volumes;
    if (!expected.empty()) {
        ASSERT_EQ(volumes.size(), expected.size());
        std::sort(volumes.begin(), volumes.end());
        std::sort(expected.begin(), expected.end());
        for (std::size_t i = 0; i < volumes.size(); ++i) expect_to_digits(volumes[i], expected[i].first, expected[i].second, "region");
    }
    if (o.sum_digits > 0) {
        expect_to_digits(sum, o.sum, o.sum_digits, "sum");
        expect_to_digits(brep["universe_volume"], o.sum, o.sum_digits, "universe");
    }
}

INSTANTIATE_TEST_SUITE_P(
    Real, RegionVolumes,
    testing::Values(VolumeOracle{"gocad/modelA1.ml", {{3.05172e10, 6}, {2.77686e11, 6}, {1.22128e11, 6}, {3.45897e11, 6}}, 7.76229e11, 6},
                    VolumeOracle{"gocad/modelA4.ml",
                                 {{1.91029e10, 6},
                                  {1.553e11, 4},
                                  {7.69032e10, 6},
                                  {2.48268e11, 6},
                                  {1.51024e11, 6},
                                  {7.03506e10, 6},
                                  {1.15336e10, 6},
                                  {4.37473e10, 6}},
                                 7.76229e11,
                                 6},
                    VolumeOracle{"gocad/modelA4.so",
                                 {{2.48205e11, 6},
                                  {1.55362e11, 6},
                                  {1.51059e11, 6},
                                  {7.69077e10, 6},
                                  {7.03478e10, 6},
                                  {4.37376e10, 6},
                                  {1.90939e10, 6},
                                  {1.15159e10, 6}},
                                 0,
                                 0},
                    VolumeOracle{"gocad/modelA4_lts.so",
                                 {{2.48205e11, 6},
                                  {1.55362e11, 6},
                                  {1.51059e11, 6},
                                  {7.69077e10, 6},
                                  {7.03478e10, 6},
                                  {4.37376e10, 6},
                                  {1.90939e10, 6},
                                  {1.15159e10, 6}},
                                 0,
                                 0},
                    VolumeOracle{"gocad/CloudSpin_fixed.ml", {}, 2.12636e12, 6},
                    VolumeOracle{"gocad/split_cube.ml", {{0.3, 6}, {0.7, 6}}, 1, 6},
                    VolumeOracle{"gocad/cube_model_equi.so", {{13361.3, 6}, {6680.63, 6}}, 0, 0},
                    VolumeOracle{"gocad/test.lso", {{1760, 4}, {960, 3}, {240, 3}, {1040, 4}}, 4000, 4}));

struct CountOracle {
    const char* file;
    std::map<std::string, int> counts;  ///< summed over the objects; also cell types
    double volume = 0;
    int volume_digits = 0;
    double area = 0;
    int area_digits = 0;
};
void PrintTo(const CountOracle& o, std::ostream* out) { *out << o.file; }

class Objects : public testing::TestWithParam<CountOracle> {};

TEST_P(Objects, HaveTheKnownCounts) {
    const CountOracle& o = GetParam();
    const auto path = real_data(o.file);
    if (!path) GTEST_SKIP() << o.file << " is not here";
    const Json file = info(*path);
    ASSERT_TRUE(file.is_object());
    std::map<std::string, int> sums;
    double volume = 0, area = 0;
    for (const Json& object : file["objects"]) {
        for (const auto& [what, n] : object["counts"].items()) {
            if (n.is_number()) sums[what] += n.get<int>();
        }
        if (object["counts"].contains("cell_types")) {
            for (const auto& [type, n] : object["counts"]["cell_types"].items()) sums[type] += n.get<int>();
        }
        volume += object.value("volume", 0.0);
        area += object.value("area", 0.0);
    }
    for (const auto& [what, n] : o.counts) EXPECT_EQ(sums[what], n) << what;
    if (o.volume_digits > 0) expect_to_digits(volume, o.volume, o.volume_digits, "volume");
    if (o.area_digits > 0) expect_to_digits(area, o.area, o.area_digits, "area");
}

INSTANTIATE_TEST_SUITE_P(
    Gocad, Objects,
    testing::Values(
        CountOracle{"gocad/2triangles.ts", {{"points", 4}, {"triangles", 2}}},
        CountOracle{"gocad/surf2d_multi.ts", {{"points", 92}, {"triangles", 92}}},
        CountOracle{"gocad/ts-2props.ts", {{"points", 4}, {"triangles", 2}}},
        CountOracle{"gocad/geom_with_properties.ts", {{"points", 5215}, {"triangles", 10066}}},
        CountOracle{"gocad/tsurf_eks.ts", {{"points", 159}, {"triangles", 253}}},
        CountOracle{"gocad/normal_lines.pl", {{"points", 11391}, {"edges", 11374}}}, CountOracle{"gocad/points.vs", {{"points", 6}}},
        CountOracle{"gocad/test.wl", {{"points", 55}, {"edges", 54}}}, CountOracle{"gocad/test.vo", {{"points", 1000}}},
        CountOracle{"gocad/auscope/tsTest.ts", {{"points", 582}, {"triangles", 989}}},
        CountOracle{"gocad/auscope/vsTest.vs", {{"points", 2764}}},
        CountOracle{"gocad/scec_cfm/GVFA-WWFZ-EAST-Scodie_Lineament-CFM1.ts", {{"points", 6}, {"triangles", 4}}},
        CountOracle{"gocad/scec_cfm/CASC-BMMR-BLDM-Bald_Mountain_Big_Lagoon-CFM7_500m.ts", {{"points", 27155}, {"triangles", 53375}}},
        CountOracle{"gocad/modelA4.so", {{"tetrahedron", 34540}}}, CountOracle{"gocad/cube_model_equi.so", {{"tetrahedron", 112}}},
        CountOracle{"gocad/test.lso", {{"tetrahedron", 1247}}, 4000, 4}));

INSTANTIATE_TEST_SUITE_P(Gmsh, Objects,
                         testing::Values(CountOracle{"gmsh/toy_model.msh",
                                                     {{"points", 6691}, {"elements", 44573}, {"tetrahedron", 34540}, {"triangles", 10033}}},
                                         CountOracle{"gmsh/cube_v22.msh", {{"points", 131}, {"triangles", 240}, {"tetrahedron", 364}}},
                                         CountOracle{"gmsh/cube_v41.msh", {{"points", 131}, {"triangles", 240}, {"tetrahedron", 364}}}));

INSTANTIATE_TEST_SUITE_P(
    Vtk, Objects,
    testing::Values(CountOracle{"vtk/Domain_Mesh_FaultModel.vtu", {{"hexahedron", 6000}}, 5.76e11, 3},
                    CountOracle{"vtk/Fault_Mesh_FaultModel.vtu", {{"polygons", 63}}, 0, 0, 846000, 6},
                    CountOracle{"vtk/box_hybrid_mesh.vtu", {{"tetrahedron", 7949}, {"pyramid", 515}, {"hexahedron", 943}}, 69.290811, 8},
                    CountOracle{"vtk/faultMesh.vtu", {{"hexahedron", 17980}, {"quads", 19142}}, 8e9, 10, 3.03095e7, 6},
                    CountOracle{"vtk/staircase3d_tet_with_properties.vtu", {{"tetrahedron", 3157}}, 500, 10},
                    CountOracle{
                        "vtk/hybridHexPrismMesh.vtk", {{"hexahedron", 70}, {"pentagonal_prism", 100}, {"hexagonal_prism", 130}}, 1, 6},
                    CountOracle{"vtk/egg_withBurdens_small.vts", {{"hexahedron", 79200}}, 20275200, 8},
                    CountOracle{"vtk/cone_append_encoded.vtu", {{"points", 580}, {"tetrahedron", 2197}, {"triangles", 1182}}},
                    CountOracle{"vtk/dfn1_ascii.vtp", {{"points", 187}, {"polygons", 10}}},
                    CountOracle{"vtk/supportedElements.vtk", {{"cells", 12}}}));

TEST(Models, NameTheirRegionsAndCountTheirFeatures) {
    const auto path = real_data("gocad/modelA4.ml");
    if (!path) GTEST_SKIP() << "modelA4.ml is not here";
    const Json brep = info(*path)["brep"];
    EXPECT_EQ(brep["features"]["fault"], 2);
    EXPECT_EQ(brep["features"]["horizon"], 3);
    EXPECT_EQ(brep["features"]["boundary"], 6);
    EXPECT_EQ(brep["layers"], 4);
    EXPECT_EQ(brep["contacts"], 38);
    EXPECT_EQ(brep["internal_lines"]["region"], 4);
    EXPECT_EQ(brep["internal_lines"]["surface"], 2);
    std::map<std::string, double> volumes;
    for (const Json& r : brep["region_volumes"]) volumes[r["name"]] = r.value("volume", 0.0);
    expect_to_digits(volumes["H1b_2"], 1.91029e10, 6, "H1b_2");
    expect_to_digits(volumes["H3b_1"], 7.03506e10, 6, "H3b_1");
}

TEST(Models, CountInterfacesAndContacts) {
    const auto path = real_data("gocad/modelA1.ml");
    if (!path) GTEST_SKIP() << "modelA1.ml is not here";
    const Json brep = info(*path)["brep"];
    EXPECT_EQ(brep["interfaces"], 9);
    EXPECT_EQ(brep["contacts"], 24);
}

TEST(Models, TellTheCellsOfEachRegion) {
    const auto path = real_data("gmsh/toy_model.msh");
    if (!path) GTEST_SKIP() << "toy_model.msh is not here";
    const Json brep = info(*path)["brep"];
    std::map<std::string, int> cells;
    for (const Json& r : brep["region_volumes"]) cells[r["name"]] += r.value("cells", 0);
    EXPECT_EQ(cells,
              (std::map<std::string, int>{{"Overburden1", 12255}, {"Overburden2", 5177}, {"Reservoir", 5687}, {"Underburden", 11421}}));
}

TEST(Voxet, KnowsItsDims) {
    const auto path = real_data("gocad/test.vo");
    if (!path) GTEST_SKIP() << "test.vo is not here";
    EXPECT_EQ(info(*path)["objects"][0]["dims"], (Json{10, 10, 10}));
}

}  // namespace
}  // namespace geomend::test
