// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkIdList.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// mesh --cells hex-dominant with default options on whole models, as they are, turned, and on a map.

namespace geomend {
namespace {

using nlohmann::json;
using test::run_geomend;
using test::TemporaryFolder;

/// The text of Gocad surfaces with all vertices moved.
std::string moved(const std::string& text, const std::function<Vec3(const Vec3&)>& map) {
    std::istringstream in(text);
    std::ostringstream out;
    out.precision(17);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string keyword, number;
        Vec3 p{};
        words >> keyword;
        if ((keyword == "VRTX" || keyword == "PVRTX") && words >> number >> p[0] >> p[1] >> p[2]) {
            std::string rest;
            std::getline(words, rest);
            p = map(p);
            out << keyword << ' ' << number << ' ' << p[0] << ' ' << p[1] << ' ' << p[2] << rest << '\n';
        } else {
            out << line << '\n';
        }
    }
    return out.str();
}

/// How often faces of VTK's solid cells are there at most; those of one cell that are no surface's, and surfaces' that are of no cell.
struct Matching {
    int most = 0;
    std::size_t open = 0, loose = 0;
};

Matching match_faces(const std::string& file) {
    const auto reader = vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkUnstructuredGrid& grid = *reader->GetOutput();
    const auto key = [](vtkIdList& ids) {
        std::vector<vtkIdType> all;
        for (vtkIdType k = 0; k < ids.GetNumberOfIds(); ++k) all.push_back(ids.GetId(k));
        std::ranges::sort(all);
        return all;
    };
    std::map<std::vector<vtkIdType>, int> faces;
    std::set<std::vector<vtkIdType>> surfaces;
    for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
        vtkCell& cell = *grid.GetCell(c);
        if (cell.GetCellDimension() == 2) surfaces.insert(key(*cell.GetPointIds()));
        for (int f = 0; cell.GetCellDimension() == 3 && f < cell.GetNumberOfFaces(); ++f) ++faces[key(*cell.GetFace(f)->GetPointIds())];
    }
    Matching found;
    for (const auto& [face, count] : faces) {
        found.most = std::max(found.most, count);
        if (count == 1 && !surfaces.contains(face)) ++found.open;
    }
    for (const auto& face : surfaces) found.loose += faces.contains(face) ? 0 : 1;
    return found;
}

void expect_sound(const std::string& model, double size, double least_share, bool has_even_sides = true) {
    const TemporaryFolder folder;
    test::write_file(folder / "model.ml", model);
    json report;
    for (const char* threads : {"1", "2"}) {
        const auto run = run_geomend({"mesh", folder / "model.ml", "-o", folder / (std::string(threads) + ".vtu"), "--cells",
                                      "hex-dominant", "--size", std::to_string(size), "--lossy", "--json", "--threads", threads});
        ASSERT_EQ(run.status, 0) << run.err;
        report = json::parse(run.out, nullptr, false);
        ASSERT_TRUE(report.is_object());
    }
    EXPECT_EQ(test::read_file(folder / "1.vtu"), test::read_file(folder / "2.vtu"));
    const json& made = report["recombine"];
    EXPECT_EQ(made["folded"], 0);
    EXPECT_EQ(made["leftovers"]["flat"], 0);
    EXPECT_GE(made["made"]["hexahedron"]["volume_share"].get<double>(), least_share);
    EXPECT_GE(report["quality"]["min_scaled_jacobian"].get<double>(), 0.3);
    // Quadrangles between regions bend: one gains what another loses. Those of uneven outer sides do, too, and nothing lies behind them.
    double volume = 0, inside = 0;
    for (const json& region : report["regions"]) {
        volume += region["volume"].get<double>();
        inside += region["surface_volume"].get<double>();
    }
    EXPECT_NEAR(volume, inside, (has_even_sides ? 1e-9 : 2e-4) * inside);
    const Matching faces = match_faces(folder / "1.vtu");
    EXPECT_EQ(faces.most, 2);
    EXPECT_EQ(faces.open, 0u);
    EXPECT_EQ(faces.loose, 0u);
}

Vec3 turned(const Vec3& p) {
    const double x = std::cos(0.4) * p[0] - std::sin(0.4) * p[1], y = std::sin(0.4) * p[0] + std::cos(0.4) * p[1];
    return {x, std::cos(0.3) * y - std::sin(0.3) * p[2], std::sin(0.3) * y + std::cos(0.3) * p[2]};
}

Vec3 on_map(const Vec3& p) {
    return {500000 + std::cos(0.4) * p[0] - std::sin(0.4) * p[1], 6000000 + std::sin(0.4) * p[0] + std::cos(0.4) * p[1], p[2] - 2000};
}

Vec3 as_it_is(const Vec3& p) { return p; }

TEST(SealedModels, TheSampleIsConformalWhereverItLies) {
    const std::string text = test::read_file(std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml");
    for (const auto& map : {as_it_is, on_map}) expect_sound(moved(text, map), 50, 0.98);
}

TEST(SealedModels, RealOnesAreConformalWhereverTheyLie) {
    const auto file = test::real_data("gocad/modelA1.ml");
    if (!file) GTEST_SKIP() << "no real data";
    for (const auto& map : {as_it_is, turned, on_map}) expect_sound(moved(test::read_file(*file), map), 812, 0.95);
}

// One of its cells stayed flat.
TEST(SealedModels, ARealOneOfManySurfacesIsConformal) {
    const auto file = test::real_data("gocad/CloudSpin_fixed.ml");
    if (!file) GTEST_SKIP() << "no real data";
    expect_sound(moved(test::read_file(*file), on_map), 742.5, 0.75, false);
}

}  // namespace
}  // namespace geomend
