// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLStructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "geometry/cell_volume.h"
#include "hexes/hexahedron_cuts.h"
#include "hexes/recombine.h"
#include "pipeline/load.h"
#include "pipeline/mesh_output.h"
#include "support/real_data.h"

// Meshes of hexahedra that are cut into tetrahedra at random come back whole.

namespace geomend::hexes {
namespace {

using Corners = std::array<std::uint32_t, 8>;
using QuadCorners = std::array<std::uint32_t, 4>;

struct HexMesh {
    std::vector<Vec3> points;
    std::vector<Corners> cells;
};

/// Cuts each hexahedron in one of all ways that leave no tetrahedron flat or inside out. Where none of them goes with what is beside it, or
/// now and then where a face is even, the two sides of a face get different diagonals, and a flat tetrahedron between them.
class Cutter {
public:
    Cutter(const HexMesh& mesh, std::uint32_t seed) : m_(mesh), random_(seed) {
        for (const test::HexahedronCut& cut : all_cuts()) by_diagonals_[cut.diagonals].push_back(&cut);
    }

    test::Tets run() {
        for (const Corners& cell : m_.cells) {
            EXPECT_TRUE(cut(cell)) << "no cut of a cell was found";
        }
        return tets_;
    }
    std::size_t flat = 0;  ///< between two hexahedra

private:
    static const std::vector<test::HexahedronCut>& all_cuts() {
        static const test::HexahedronCuts all;
        return all.cuts;
    }
    double volume(const std::array<std::uint32_t, 4>& t) const {
        return tetrahedron_volume(m_.points[t[0]], m_.points[t[1]], m_.points[t[2]], m_.points[t[3]]);
    }
    static QuadCorners key(QuadCorners q) {
        std::ranges::sort(q);
        return q;
    }
    static std::array<std::uint32_t, 3> sorted(std::array<std::uint32_t, 3> t) {
        std::ranges::sort(t);
        return t;
    }
    bool chance(double part) { return std::uniform_real_distribution<>(0, 1)(random_) < part; }

    /// The faces of a cell, wound outwards.
    static std::array<QuadCorners, 6> faces(const Corners& cell) {
        std::array<QuadCorners, 6> all{};
        std::size_t f = 0;
        for (const LocalFace& face : faces_of(CellType::hexahedron)) {
            for (std::size_t k = 0; k < 4; ++k) all[f][k] = cell[face.corners()[k]];
            ++f;
        }
        return all;
    }

    /// What stands on a face that is cut already, where a cell cuts it its own way: nothing, or a tetrahedron. Two faces that share three
    /// corners, as at the end of a crack, are not cut so that they share a triangle.
    struct Between {
        bool fits = true, has_tet = false;
        std::array<std::uint32_t, 4> tet{};
    };
    Between between(const QuadCorners& q, unsigned start, double size) {
        for (const std::size_t k : {0u, 1u}) {
            const auto half = halves_.find(sorted({q[start], q[(start + k + 1) % 4], q[(start + k + 2) % 4]}));
            if (half != halves_.end() && half->second != key(q)) return {false, false, {}};
        }
        const auto found = cut_faces_.find(key(q));
        if (found == cut_faces_.end()) return {};
        const QuadCorners& far = found->second;  // from one end of its diagonal on, wound outwards of the cell there
        if (q[start] == far[0] || q[start] == far[2]) return {};
        const double v = volume(far);
        // One that bulges is no flat one, but has room where it bulges outwards of the first.
        return {v > -1e-13 * size, true, far};
    }

    bool cut(const Corners& cell) {
        const auto q = faces(cell);
        double size = 0;
        for (const auto& t : {std::array{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}})
            size += volume({cell[t[0]], cell[t[1]], cell[t[2]], cell[t[3]]});
        std::array<std::uint8_t, 64> order{};
        for (std::uint8_t k = 0; k < 64; ++k) order[k] = k;
        std::ranges::shuffle(order, random_);
        for (const bool may_be_flat : {chance(0.1), true}) {
            for (const std::uint8_t diagonals : order) {
                std::array<Between, 6> beside{};
                bool fits = true;
                for (std::size_t f = 0; f < 6; ++f) {
                    beside[f] = between(q[f], diagonals >> f & 1u, size);
                    fits = fits && beside[f].fits && (may_be_flat || !beside[f].has_tet);
                }
                if (fits && cut_so(cell, diagonals, size)) {
                    for (std::size_t f = 0; f < 6; ++f) note(q[f], diagonals >> f & 1u, beside[f]);
                    return true;
                }
            }
        }
        return false;
    }

    bool cut_so(const Corners& cell, std::uint8_t diagonals, double size) {
        auto cuts = by_diagonals_[diagonals];
        std::ranges::shuffle(cuts, random_);
        for (const test::HexahedronCut* cut : cuts) {
            test::Tets own;
            for (const auto& t : cut->tets) own.push_back({cell[t[0]], cell[t[1]], cell[t[2]], cell[t[3]]});
            if (std::ranges::any_of(own, [&](const auto& t) { return volume(t) < 1e-4 * size; })) continue;
            tets_.insert(tets_.end(), own.begin(), own.end());
            return true;
        }
        return false;
    }

    void note(const QuadCorners& q, unsigned start, const Between& beside) {
        for (const std::size_t k : {0u, 1u}) halves_[sorted({q[start], q[(start + k + 1) % 4], q[(start + k + 2) % 4]})] = key(q);
        cut_faces_[key(q)] = {q[start], q[(start + 1) % 4], q[(start + 2) % 4], q[(start + 3) % 4]};
        if (!beside.has_tet) return;
        tets_.push_back(beside.tet);
        ++flat;
    }

    const HexMesh& m_;
    std::mt19937 random_;
    std::array<std::vector<const test::HexahedronCut*>, 64> by_diagonals_;
    std::map<QuadCorners, QuadCorners> cut_faces_;
    std::map<std::array<std::uint32_t, 3>, QuadCorners> halves_;  ///< the face that a triangle is half of
    test::Tets tets_;
};

/// Cuts each hexahedron into six from that of its corners which comes first in an order at random, and so its faces.
test::Tets cut_from_first_corners(const HexMesh& mesh, std::uint32_t seed) {
    std::vector<std::uint32_t> rank(mesh.points.size());
    for (std::uint32_t v = 0; v < rank.size(); ++v) rank[v] = v;
    std::mt19937 random(seed);
    std::ranges::shuffle(rank, random);
    const auto by_rank = [&](std::uint32_t v) { return rank[v]; };
    test::Tets tets;
    for (const Corners& cell : mesh.cells) {
        const std::uint32_t first = *std::ranges::min_element(cell, {}, by_rank);
        for (const LocalFace& face : faces_of(CellType::hexahedron)) {
            QuadCorners q{};
            for (std::size_t k = 0; k < 4; ++k) q[k] = cell[face.corners()[k]];
            if (std::ranges::find(q, first) != q.end()) continue;
            std::ranges::rotate(q, std::ranges::min_element(q, {}, by_rank));
            tets.push_back({q[0], q[2], q[1], first});
            tets.push_back({q[0], q[3], q[2], first});
        }
    }
    return tets;
}

void expect_whole(const HexMesh& mesh, const test::Tets& tets, std::size_t flat) {
    const auto cut = VolumeMesh::make(test::mesh_data(mesh.points, tets));
    ASSERT_TRUE(cut) << cut.why().error.message;
    RecombineReport report;
    const auto made = recombine(*cut, {}, report);
    ASSERT_TRUE(made) << made.why().error.message;
    EXPECT_EQ(report.count_of(CellType::hexahedron), mesh.cells.size())
        << tets.size() << " tetrahedra, " << flat << " flat ones; first " << report.first_share << " of the volume, "
        << report.closing.quads << " quadrangles, " << report.closing.absorbed << " absorbed, " << report.closing.opened << " opened, "
        << report.leftovers.flat << " left flat";
    EXPECT_EQ(report.cell_count(), mesh.cells.size());
}

void expect_whole(const HexMesh& mesh, std::uint32_t seed) {
    Cutter cutter(mesh, seed);
    const test::Tets tets = cutter.run();
    expect_whole(mesh, tets, cutter.flat);
}

TEST(RoundTrip, ALatticeThatIsBentComesBackWhole) {
    for (const double part : {0.0, 0.05, 0.15}) {
        test::Lattice l = test::lattice({8, 8, 8});
        test::jitter(l, part);
        HexMesh mesh{l.points, {}};
        for (std::uint32_t k = 0; k < 8; ++k) {
            for (std::uint32_t j = 0; j < 8; ++j) {
                for (std::uint32_t i = 0; i < 8; ++i) mesh.cells.push_back(l.cube(i, j, k));
            }
        }
        for (const std::uint32_t seed : {1u, 2u, 3u}) expect_whole(mesh, seed);
    }
}

HexMesh hexahedra_in(const std::string& file) {
    HexMesh mesh;
    auto dataset = load(file, {});
    if (!dataset) return mesh;
    std::vector<Loss> losses;
    const auto real = volume_mesh_in(*dataset, losses);
    if (!real) return mesh;
    mesh.points = (*real)->vertices;
    for (std::uint32_t c = 0; c < (*real)->cell_count(); ++c) {
        const auto nodes = (*real)->nodes_of(c);
        if (nodes.size() == 8) mesh.cells.push_back({nodes[0], nodes[1], nodes[2], nodes[3], nodes[4], nodes[5], nodes[6], nodes[7]});
    }
    return mesh;
}

// It has a crack: at its ends faces of the two sides share three corners.
TEST(RoundTrip, ARealMeshOfHexahedraComesBackWhole) {
    const auto file = test::real_data("vtk/Domain_Mesh_FaultModel.vtu");
    if (!file) GTEST_SKIP() << "no real data";
    const HexMesh mesh = hexahedra_in(file->string());
    ASSERT_EQ(mesh.cells.size(), 6000u);
    for (const std::uint32_t seed : {1u, 2u}) expect_whole(mesh, seed);
}

// Its cells are slices that lean: four others may stand in the place of six. With flat cells between as well.
TEST(RoundTrip, ARealMeshOfLeaningHexahedraComesBackWhole) {
    const auto file = test::real_data("vtk/faultMesh.vtu");
    if (!file) GTEST_SKIP() << "no real data";
    const HexMesh mesh = hexahedra_in(file->string());
    ASSERT_EQ(mesh.cells.size(), 17980u);
    for (const std::uint32_t seed : {1u, 2u, 3u}) expect_whole(mesh, cut_from_first_corners(mesh, seed), 0);
    for (const std::uint32_t seed : {1u, 2u, 3u}) expect_whole(mesh, seed);
}

/// Cells between the points of a grid of n[0] by n[1] by n[2] cells, where they are taken.
HexMesh grid_cells(
    const std::array<std::uint32_t, 3>& n, const std::function<Vec3(const std::array<std::uint32_t, 3>&)>& place,
    const std::function<bool(std::uint32_t, std::uint32_t, std::uint32_t)>& is_taken = [](auto, auto, auto) { return true; }) {
    HexMesh mesh;
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> number;
    const auto vertex = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const auto [at, is_new] = number.emplace(std::array{i, j, k}, static_cast<std::uint32_t>(mesh.points.size()));
        if (is_new) mesh.points.push_back(place({i, j, k}));
        return at->second;
    };
    for (std::uint32_t k = 0; k < n[2]; ++k) {
        for (std::uint32_t j = 0; j < n[1]; ++j) {
            for (std::uint32_t i = 0; i < n[0]; ++i) {
                if (!is_taken(i, j, k)) continue;
                mesh.cells.push_back({vertex(i, j, k), vertex(i + 1, j, k), vertex(i + 1, j + 1, k), vertex(i, j + 1, k),
                                      vertex(i, j, k + 1), vertex(i + 1, j, k + 1), vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1)});
            }
        }
    }
    return mesh;
}

// A simulation grid with thin layers between thick ones.
TEST(RoundTrip, ARealGridOfThinAndThickLayersComesBackWhole) {
    const auto file = test::real_data("vtk/egg_withBurdens_small.vts");
    if (!file) GTEST_SKIP() << "no real data";
    const auto reader = vtkSmartPointer<vtkXMLStructuredGridReader>::New();
    reader->SetFileName(file->c_str());
    reader->Update();
    vtkStructuredGrid& grid = *reader->GetOutput();
    std::array<int, 3> points{};
    grid.GetDimensions(points.data());
    std::array<std::uint32_t, 3> n{};
    for (std::size_t k = 0; k < 3; ++k) n[k] = static_cast<std::uint32_t>(points[k] - 1);
    const HexMesh mesh = grid_cells(n, [&](const std::array<std::uint32_t, 3>& at) {
        Vec3 p{};
        grid.GetPoint(static_cast<vtkIdType>(at[0] + (n[0] + 1) * (at[1] + (n[1] + 1) * at[2])), p.data());
        return p;
    });
    ASSERT_FALSE(mesh.cells.empty());
    expect_whole(mesh, 1);
}

TEST(RoundTrip, ATwistedColumnComesBackWhole) {
    const HexMesh mesh = grid_cells({8, 8, 16}, [](const std::array<std::uint32_t, 3>& at) {
        const double x = at[0] - 4.0, y = at[1] - 4.0, turn = 0.1 * at[2];
        return Vec3{std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y, 1.0 * at[2]};
    });
    for (const std::uint32_t seed : {1u, 2u, 3u}) expect_whole(mesh, seed);
}

TEST(RoundTrip, CellsThatGrowByAQuarterEachComeBackWhole) {
    const HexMesh mesh = grid_cells({10, 10, 10}, [](const std::array<std::uint32_t, 3>& at) {
        Vec3 p{};
        for (std::size_t k = 0; k < 3; ++k) p[k] = std::pow(1.25, at[k]);
        return p;
    });
    for (const std::uint32_t seed : {1u, 2u, 3u}) expect_whole(mesh, seed);
}

TEST(RoundTrip, ARingAndABlockWithHolesComeBackWhole) {
    // Around an axis: the last cell of a turn stands beside the first.
    HexMesh ring;
    constexpr std::uint32_t around = 24, across = 4, high = 5;
    for (std::uint32_t k = 0; k <= high; ++k) {
        for (std::uint32_t j = 0; j <= across; ++j) {
            for (std::uint32_t i = 0; i < around; ++i) {
                const double angle = 2 * std::numbers::pi * i / around, r = 3 + j;
                ring.points.push_back({r * std::cos(angle), r * std::sin(angle), 1.0 * k});
            }
        }
    }
    const auto at = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return i % around + around * (j + (across + 1) * k); };
    for (std::uint32_t k = 0; k < high; ++k) {
        for (std::uint32_t j = 0; j < across; ++j) {
            for (std::uint32_t i = 0; i < around; ++i) {
                ring.cells.push_back({at(i, j, k), at(i, j + 1, k), at(i + 1, j + 1, k), at(i + 1, j, k), at(i, j, k + 1),
                                      at(i, j + 1, k + 1), at(i + 1, j + 1, k + 1), at(i + 1, j, k + 1)});
            }
        }
    }
    const HexMesh block = grid_cells(
        {9, 9, 5},
        [](const std::array<std::uint32_t, 3>& at) {
            return Vec3{1.0 * at[0], 1.0 * at[1] + 0.3 * std::sin(0.7 * at[0]), 0.5 * at[2] + 0.1 * at[0]};
        },
        [](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return !(i % 3 == 1 && j % 3 == 1) && !(i == 4 && k == 2); });
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        expect_whole(ring, seed);
        expect_whole(block, seed);
    }
}

}  // namespace
}  // namespace geomend::hexes
