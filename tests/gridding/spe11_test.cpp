// SPDX-License-Identifier: AGPL-3.0-or-later
#include "spe11_model.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/output.h"
#include "formats/registry.h"
#include "grid/cell_geometry.h"
#include "gridding/sampled_properties.h"
#include "made_models.h"
#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// Known answer i: the facies of SPE 11A in a box grid.

namespace geomend::gridding::test {
namespace {

using geomend::test::run_geomend;

constexpr double length = 2.8, height = 1.2, width = 0.01;

/// The area of each facies in a box grid of nx columns and nz layers.
std::map<int, double> gridded_areas(const std::vector<Object>& slab, std::uint32_t nx, std::uint32_t nz) {
    Structure structure;
    for (const double depth : {-height, 0.0}) {
        Sheet sheet;
        sheet.vertices = {{0, 0, depth}, {length, 0, depth}, {length, width, depth}, {0, width, depth}};
        sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
        structure.horizons.push_back({depth < 0 ? "top" : "base", std::move(sheet)});
    }
    const auto made = grid(structure, net(nx, 1, length / nx, width), {proportional(nz)});
    const auto sampled = sample_properties(made.grid, slab, {});
    EXPECT_TRUE(sampled.ok() && sampled->report[0].without == 0);
    const auto& codes = std::get<std::vector<std::int32_t>>(sampled->attributes[0].values);
    const auto volumes = grid::cell_volumes(made.grid);
    std::map<int, double> areas;
    for (std::size_t c = 0; c < codes.size(); ++c) areas[codes[c]] += std::abs(volumes[c]) / width;
    return areas;
}

TEST(KnownAnswers, I_TheAreasOfFaciesConverge) {
    const auto path = geomend::test::real_data("spe11/spe11a.geo");
    if (!path) GTEST_SKIP() << "no real data";
    const Spe11Section section = read_spe11(*path);
    ASSERT_EQ(section.polygons.size(), 32u);
    const auto exact = section.areas();
    double all = 0;
    for (const auto& [facies, area] : exact) all += area;
    ASSERT_NEAR(all, length * height, 1e-12);  // the polygons fill the box
    std::vector<Object> slab;
    slab.emplace_back(spe11_slab(section, width));
    std::vector<double> errors;
    for (const std::uint32_t n : {35u, 70u, 140u, 280u}) {
        auto areas = gridded_areas(slab, n, 3 * n / 7);
        double error = 0;
        for (const auto& [facies, area] : exact) error += std::abs(areas[facies] - area);
        errors.push_back(error);
    }
    // First order or better: three halvings of the cells.
    EXPECT_LT(errors[3], errors[0] / 8) << errors[0] << ' ' << errors[1] << ' ' << errors[2] << ' ' << errors[3];
    EXPECT_LT(errors[3], 0.006 * length * height);
}

TEST(Spe11, ABoxGridTakesItsFaciesAndRunsInFlow) {
    const auto path = geomend::test::real_data("spe11/spe11a.geo");
    if (!path) GTEST_SKIP() << "no real data";
    const geomend::test::TemporaryFolder folder;
    Dataset dataset;
    dataset.objects.emplace_back(spe11_slab(read_spe11(*path), width));
    OutputSet slab{std::filesystem::path(folder / "facies.vtu")};
    ASSERT_TRUE(format_by_name("vtu")->write(dataset, slab, {}).ok());
    ASSERT_TRUE(slab.commit().ok());
    std::ofstream sheets(folder / "box.ts");
    for (const double z : {height, 0.0}) {
        sheets << "GOCAD TSurf 1\nHEADER {\nname:" << (z > 0 ? "top" : "base") << "\n}\nTFACE\n";
        int n = 0;
        for (const Corner& c : {Corner{0, 0}, {length, 0}, {length, width}, {0, width}})
            sheets << "VRTX " << ++n << ' ' << c[0] << ' ' << c[1] << ' ' << z << '\n';
        sheets << "TRGL 1 2 3\nTRGL 1 3 4\nEND\n";
    }
    sheets.close();
    const auto ran = run_geomend({"grid", folder / "box.ts", "-o", folder / "spe11.grdecl", "--cells", "70x1", "--layers",
                                  "proportional:30", "--properties-of", folder / "facies.vtu", "--option", "deck=yes", "--json"});
    const auto made = nlohmann::json::parse(ran.out, nullptr, false);
    ASSERT_TRUE(made.is_object()) << ran.err;
    EXPECT_EQ(made["active_cells"], 70 * 30);
    EXPECT_EQ(made["properties"][0]["name"], "FACIES");
    EXPECT_EQ(made["properties"][0]["without_value"], 0);
    EXPECT_EQ(run_geomend({"validate", folder / "spe11.grdecl"}).status, 0);
    if (std::system("command -v flow > /dev/null 2>&1") != 0) GTEST_SKIP() << "flow is not installed";
    const std::string run =
        "cd " + folder.path().string() + " && OMPI_MCA_orte_tmpdir_base=$PWD timeout 300 flow spe11.DATA --output-dir=out > log 2>&1";
    ASSERT_EQ(std::system(run.c_str()), 0);
    const auto in_flow = geomend::test::info(folder / "out/SPE11.EGRID");
    EXPECT_EQ(in_flow["objects"][0]["counts"]["active_cells"], made["active_cells"]);
    EXPECT_EQ(in_flow["objects"][0]["counts"].value("stated_connections", 0u), made["nnc"]);
}

}  // namespace
}  // namespace geomend::gridding::test
