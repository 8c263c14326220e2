// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellValidator.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/vec3.h"
#include "hexes/layered_sheets.h"
#include "support/program.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

// mesh --cells hybrid on models with thin parts: valid by geomend's own checks and by VTK's, with the volumes that are enclosed.

namespace geomend {
namespace {

using nlohmann::json;
using test::layers;
using test::parts;
using test::run_geomend;
using test::Sheets;
using test::TemporaryFolder;

struct VtkCounts {
    std::map<int, int> cells;  ///< by VTK's type
    int wrong = 0;             ///< of them, those that its check finds something wrong with
};

/// \param near_origin each cell with its first corner at the origin: far from there VTK calls tetrahedra wrong, too
VtkCounts vtk_counts(const std::string& file, bool near_origin) {
    const vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkUnstructuredGrid* grid = reader->GetOutput();
    VtkCounts counts;
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
        vtkCell* cell = grid->GetCell(c);
        if (cell->GetCellDimension() != 3) continue;
        ++counts.cells[cell->GetCellType()];
        if (near_origin) {
            std::array<double, 3> first{}, p{};
            cell->GetPoints()->GetPoint(0, first.data());
            for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k) {
                cell->GetPoints()->GetPoint(k, p.data());
                for (std::size_t a = 0; a < 3; ++a) p[a] -= first[a];
                cell->GetPoints()->SetPoint(k, p.data());
            }
        }
        if (vtkCellValidator::Check(cell, FLT_EPSILON) != vtkCellValidator::State::Valid) ++counts.wrong;
    }
    return counts;
}

struct Judged {
    json report;
    VtkCounts vtk;
    double prism_sides = 0;  ///< share of the sides of triangles in thin parts
};

Judged judged(const std::string& model, const std::vector<std::string>& options, bool near_origin = false) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"mesh", model, "-o", folder / "cells.vtu", "--cells", "hybrid", "--lossy", "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto run = run_geomend(arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    if (run.status != 0) return {};
    EXPECT_EQ(run_geomend({"validate", folder / "cells.vtu"}).status, 0);
    Judged found{json::parse(run.out), vtk_counts((folder / "cells.vtu").string(), near_origin), 0};
    EXPECT_EQ(found.vtk.wrong, 0);
    EXPECT_EQ(found.report["recombine"]["folded"], 0);
    EXPECT_EQ(found.report["recombine"]["not_taken"], 0);
    for (const json& region : found.report["regions"])
        EXPECT_NEAR(region["volume"].get<double>(), region["surface_volume"].get<double>(), 1e-9 * region["surface_volume"].get<double>());
    const json& thin = found.report["recombine"]["thin"];
    found.prism_sides = thin["prisms"].get<double>() / std::max(1.0, thin["triangles"].get<double>());
    // Two ends each; where they stand on sides of a model, these have triangles as well.
    EXPECT_GE(thin["prisms"].get<int>(), 2 * found.vtk.cells[VTK_WEDGE]);
    return found;
}

Judged judged_text(const std::string& text, const std::vector<std::string>& options, bool near_origin = false) {
    const TemporaryFolder folder;
    test::write_file(folder / "model.ts", text);
    return judged(folder / "model.ts", options, near_origin);
}

double volume(const json& report) {
    double sum = 0;
    for (const json& region : report["regions"]) sum += region["volume"].get<double>();
    return sum;
}

using Corners = std::array<std::size_t, 3>;

/// An icosahedron's triangles cut into four several times, the vertices on the unit sphere.
struct UnitSphere {
    std::vector<Vec3> points;
    std::vector<Corners> triangles;

    explicit UnitSphere(int cuts) {
        const double g = (1 + std::sqrt(5.0)) / 2;
        for (const double s : {1.0, -1.0}) {
            for (const double t : {g, -g}) {
                add({0, s, t});
                add({s, t, 0});
                add({t, 0, s});
            }
        }
        // Triples at the least distance, wound outwards.
        for (std::size_t a = 0; a < 12; ++a) {
            for (std::size_t b = a + 1; b < 12; ++b) {
                for (std::size_t c = b + 1; c < 12; ++c) {
                    if (are_near(a, b) && are_near(b, c) && are_near(a, c)) triangles.push_back(outwards({a, b, c}));
                }
            }
        }
        for (int cut = 0; cut < cuts; ++cut) cut_in_four();
    }

private:
    std::size_t add(Vec3 p) {
        const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        points.push_back({p[0] / r, p[1] / r, p[2] / r});
        return points.size() - 1;
    }
    bool are_near(std::size_t a, std::size_t b) const {
        double d = 0;
        for (std::size_t k = 0; k < 3; ++k) d += std::pow(points[a][k] - points[b][k], 2);
        return d < 1.2;
    }
    Corners outwards(Corners t) const {
        const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
        const double det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
        if (det < 0) std::swap(t[1], t[2]);
        return t;
    }
    void cut_in_four() {
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
        const auto middle = [&](std::size_t a, std::size_t b) {
            const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), 0);
            if (is_new) at->second = add({points[a][0] + points[b][0], points[a][1] + points[b][1], points[a][2] + points[b][2]});
            return at->second;
        };
        std::vector<Corners> smaller;
        for (const auto& [a, b, c] : triangles) {
            const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const Corners& t : {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}}) smaller.push_back(t);
        }
        triangles = std::move(smaller);
    }
};

std::string nested_spheres(const std::vector<std::pair<int, double>>& cuts_and_radii) {
    std::ostringstream text;
    text.precision(17);
    for (const auto& [cuts, radius] : cuts_and_radii) {
        const UnitSphere sphere(cuts);
        text << "GOCAD TSurf 1\nHEADER {\nname:sphere" << radius << "\n}\nTFACE\n";
        for (std::size_t v = 0; v < sphere.points.size(); ++v) {
            const Vec3& p = sphere.points[v];
            text << "VRTX " << v + 1 << ' ' << radius * p[0] << ' ' << radius * p[1] << ' ' << radius * p[2] << '\n';
        }
        for (const auto& [a, b, c] : sphere.triangles) text << "TRGL " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
        text << "END\n";
    }
    return text.str();
}

TEST(Hybrid, ThinShellsBetweenThreeNestedSpheresHavePrisms) {
    for (const auto& spheres : {std::vector<std::pair<int, double>>{{3, 100}, {3, 95}, {3, 90}}, {{3, 100}, {3, 90}, {3, 80}}}) {
        const Judged found = judged_text(nested_spheres(spheres), {});
        ASSERT_TRUE(found.report.is_object());
        EXPECT_EQ(found.report["regions"].size(), 3u);
        EXPECT_GE(found.prism_sides, 0.35);
    }
}

TEST(Hybrid, SpheresWithDifferentTrianglesAndThickShellsAreValid) {
    for (const auto& spheres : {std::vector<std::pair<int, double>>{{3, 100}, {2, 95}, {3, 90}}, {{3, 100}, {2, 60}, {1, 30}}})
        judged_text(nested_spheres(spheres), {});
}

TEST(Hybrid, AThinLayerThatPinchesOutBecomesPrisms) {
    const TemporaryFolder folder;
    const auto height = [](std::size_t k, double x) {
        const std::vector<double> z{0, 200, 200, 600};
        return z[k] + (k == 2 ? 0.05 * std::max(0.0, 700 - x) : 0);
    };
    // The layer between 1 and 2 ends at x = 700, and so does its top: the one above lies on 1 from there on.
    Sheets sheets;
    const auto xs = parts(1000, 20), ys = parts(800, 16), thin = parts(700, 14);
    const std::vector<double> sides{0, 1};
    for (const std::size_t k : {0, 1, 3})
        sheets.add("h" + std::to_string(k), xs, ys, [&](double x, double y) { return Vec3{x, y, height(k, x)}; });
    sheets.add("h2", thin, ys, [&](double x, double y) { return Vec3{x, y, height(2, x)}; });
    for (std::size_t k = 0; k < 3; ++k) {
        const auto z = [&](double x, double side) { return height(side == 0 ? k : k + 1, x); };
        for (const double y : {0.0, 800.0})
            sheets.add("s" + std::to_string(k) + (y > 0 ? "n" : "s"), k == 1 ? thin : xs, sides, [&](double x, double s) {
                return Vec3{x, y, z(x, s)};
            });
        for (const double x : {0.0, 1000.0}) {
            if (k != 1 || x == 0)
                sheets.add("s" + std::to_string(k) + (x > 0 ? "e" : "w"), ys, sides, [&](double y, double s) {
                    return Vec3{x, y, z(x, s)};
                });
        }
    }
    const Judged found = judged_text(sheets.text(), {"--size", "50"});
    ASSERT_TRUE(found.report.is_object());
    EXPECT_NEAR(volume(found.report), 4.8e8, 1e-9 * 4.8e8);
    // 14 by 16 squares: those at the tip are pyramids and tetrahedra.
    EXPECT_GE(found.report["recombine"]["thin"]["prisms"].get<int>(), 2 * 2 * 13 * 16 * 9 / 10);
}

struct ThinCase {
    const char* what;
    std::vector<double> z;  ///< of the borders
    double grows;           ///< how much the one below the last is higher at x = 1000
    double tilt, turn;
    Vec3 shift;
    double least_share;  ///< of prisms
};

TEST(Hybrid, ThinLayersHavePrismsWhereverTheyLie) {
    const std::vector<double> one{0, 200, 210, 600}, two{0, 200, 210, 222, 600};
    const Vec3 here{0, 0, 0}, map{500000, 6000000, -3000};
    const std::vector<ThinCase> cases{{"tilted", one, 0, 0.4, 0, here, 0.65},
                                      {"on a map", one, 0, 0, 0.4, map, 0.55},
                                      {"two of them", two, 0, 0, 0, here, 0.8},
                                      {"two of them, tilted, on a map", two, 0, 0.4, 0.4, map, 0.6},
                                      {"six times as thick on one side", {0, 200, 205, 600}, 25, 0, 0, here, 0.6}};
    for (const ThinCase& c : cases) {
        SCOPED_TRACE(c.what);
        const auto height = [&](std::size_t k, double x) { return c.z[k] + (k + 2 == c.z.size() ? c.grows * x / 1000 : 0); };
        const auto moved = [&](const Vec3& p) {
            const double x = std::cos(c.tilt) * p[0] - std::sin(c.tilt) * p[2], z = std::sin(c.tilt) * p[0] + std::cos(c.tilt) * p[2];
            return Vec3{c.shift[0] + std::cos(c.turn) * x - std::sin(c.turn) * p[1],
                        c.shift[1] + std::sin(c.turn) * x + std::cos(c.turn) * p[1], c.shift[2] + z};
        };
        const std::vector<double> ends(c.z.size() - 1, 1000);
        const Judged found = judged_text(layers(c.z.size(), height, ends, moved), {"--size", "50"}, c.shift[0] > 0);
        ASSERT_TRUE(found.report.is_object());
        EXPECT_NEAR(volume(found.report), 4.8e8, 1e-9 * 4.8e8);
        EXPECT_GE(found.prism_sides, c.least_share);
    }
}

TEST(Hybrid, ThinLayersOfARealModelHavePrisms) {
    const auto file = test::real_data("gocad/modelA1.ml");
    if (!file) GTEST_SKIP() << "no real data";
    const Judged found = judged(file->string(), {});
    ASSERT_TRUE(found.report.is_object());
    EXPECT_GE(found.prism_sides, 0.6);
}

}  // namespace
}  // namespace geomend
