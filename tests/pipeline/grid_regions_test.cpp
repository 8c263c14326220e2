// SPDX-License-Identifier: AGPL-3.0-or-later
// A region of the boundary representation of a grid holds what the polyhedra of its cells hold: both follow the same
// triangles. Figures are compared with the polyhedra's own volumes.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "geometry/measures.h"
#include "grid/boundary_model.h"
#include "grid/cell_mesh.h"
#include "pipeline/load.h"
#include "support/corner_point_grids.h"
#include "support/program.h"
#include "support/real_data.h"
#include "topology/brep_from_dataset.h"

namespace geomend {
namespace {

// Five regions of several pieces each, so that they meet along faults, steps and layers.
void add_blocks(CornerPointGrid& grid) {
    std::vector<std::int32_t> values(grid.cell_count());
    for (std::size_t c = 0; c < values.size(); ++c) {
        const auto [i, j, k] = grid.ijk(c);
        values[c] = static_cast<std::int32_t>((i / 3 + 7 * (j / 4) + 3 * (k / 2)) % 5 + 1);
    }
    Attribute a;
    a.name = "BLOCK";
    a.location = AttributeLocation::cell;
    a.values = std::move(values);
    grid.info.attributes.push_back(std::move(a));
}

std::map<std::string, double> volumes_of_polyhedra(const CornerPointGrid& grid, bool blocks) {
    const grid::Cells cells = grid::conforming_cells(grid);
    const Attribute* block = find_attribute(cells.mesh.info.attributes, "BLOCK", AttributeLocation::cell);
    std::map<std::string, double> sums;
    for (std::size_t c = 0; c < cells.mesh.cell_count(); ++c) {
        const std::string name = blocks ? "BLOCK_" + std::to_string(int(value_as_double(*block, c))) : "grid";
        sums[name] += cell_volume(cells.mesh, c);
    }
    return sums;
}

void expect_regions_as_polyhedra(CornerPointGrid grid) {
    add_blocks(grid);
    for (const bool blocks : {false, true}) {
        auto model = grid::boundary_model(grid, {blocks ? "BLOCK" : "", {}});
        ASSERT_TRUE(model.ok());
        topology::build_breps(*model);
        ASSERT_EQ(model->breps.size(), 1u);
        const BrepData& brep = *model->breps[0];
        const auto expected = volumes_of_polyhedra(grid, blocks);
        ASSERT_EQ(brep.regions.size(), expected.size());
        for (const auto& region : brep.regions) {
            EXPECT_TRUE(region.volume_known) << region.name;
            ASSERT_TRUE(expected.contains(region.name)) << region.name;
            const double sum = expected.at(region.name);
            EXPECT_NEAR(region.volume, sum, 1e-12 * std::abs(sum)) << region.name;
        }
        for (const auto& surface : brep.surfaces) EXPECT_TRUE(surface.polygons.all_triangles());
    }
}

// Layers dip, bend and twist, differently on both sides of two faults, between pillars that lean apart.
CornerPointGrid bent(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz, double lean) {
    CornerPointGrid grid = testing::brick_grid(nx, ny, nz);
    for (std::size_t p = 0; p < grid.pillars.size(); p += 6) {
        grid.pillars[p + 3] += lean * std::sin(0.3 * double(p));
        grid.pillars[p + 4] -= lean * std::cos(0.7 * double(p));
    }
    testing::reshape(grid, [](std::uint32_t i, std::uint32_t j, auto, unsigned c, double depth) {
        const double x = i + (c & 1u), y = j + ((c >> 1) & 1u);
        const double side = i >= 4 ? -9 * y + 13 : 4 * y;
        return depth + side + 1.7 * std::sin(1.1 * x * y) + (j >= 5 ? 7.25 : 0);
    });
    return grid;
}

TEST(RegionsOfGrids, with_bent_faces_and_crossing_faults_hold_what_their_polyhedra_hold) {
    for (const double lean : {0.0, 1.0, 25.0}) {
        SCOPED_TRACE(lean);
        expect_regions_as_polyhedra(bent(9, 9, 6, lean));
    }
}

// Gaps that close on three pillars, layers that are as thin as the rounding of their depths (or turned over by it) with a
// gap below, inactive cells.
CornerPointGrid with_gaps(bool gaps, bool pinches, bool holes) {
    CornerPointGrid grid = bent(8, 8, 6, 3.0);
    testing::reshape(grid, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, unsigned c, double depth) {
        if (gaps && k == 3 && c == 1 && i % 3 == 0) return depth + 2;
        if (pinches && k == 2 && c >= 4 && j % 3 == 1) return depth - 10;
        return depth;
    });
    grid.activity.assign(grid.cell_count(), 1);
    for (std::size_t c = 0; holes && c < grid.cell_count(); c += 17) grid.activity[c] = 0;
    return grid;
}

TEST(RegionsOfGrids, with_gaps_pinches_and_holes_hold_what_their_polyhedra_hold) {
    for (int kind = 1; kind < 8; ++kind) {
        SCOPED_TRACE(kind);
        expect_regions_as_polyhedra(with_gaps((kind & 1) != 0, (kind & 2) != 0, (kind & 4) != 0));
    }
}

// Depths from a few whole numbers: faces of neighbours, and tops and bottoms with a gap between, often have triangles in
// common.
TEST(RegionsOfGrids, with_many_coincidences_hold_what_their_polyhedra_hold) {
    std::uint64_t state = 7;
    const auto below = [&](std::uint32_t n) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::uint32_t>((state >> 33) % n);
    };
    for (int round = 0; round < 100; ++round) {
        SCOPED_TRACE(round);
        CornerPointGrid grid = testing::brick_grid(5, 5, 4);
        for (std::uint32_t j = 0; j < 5; ++j) {
            for (std::uint32_t i = 0; i < 5; ++i) {
                for (unsigned c = 0; c < 4; ++c) {
                    double depth = 1000 + below(4);
                    for (std::uint32_t k = 0; k < 4; ++k) {
                        depth += below(6) == 0 ? 1 : 0;
                        grid.depths[corner_index(grid.dims, i, j, k, c)] = depth;
                        depth += below(3);
                        grid.depths[corner_index(grid.dims, i, j, k, c + 4)] = depth;
                    }
                }
            }
        }
        grid.activity.assign(grid.cell_count(), 1);
        for (int n = 0; n < 10; ++n) grid.activity[below(100)] = 0;
        expect_regions_as_polyhedra(grid);
        if (::testing::Test::HasFailure()) return;
    }
}

TEST(RegionsOfGrids, far_from_the_origin_and_of_the_other_hand_hold_what_their_polyhedra_hold) {
    CornerPointGrid grid = bent(9, 9, 6, 5.0);
    for (std::size_t p = 0; p < grid.pillars.size(); p += 3) {
        grid.pillars[p] = 461000 - grid.pillars[p];
        grid.pillars[p + 1] += 5932000;
    }
    expect_regions_as_polyhedra(grid);
}

class RegionsOfRealGrids : public ::testing::TestWithParam<const char*> {};

TEST_P(RegionsOfRealGrids, hold_what_their_polyhedra_hold) {
    const auto file = test::real_data(std::string("cornerpoint/") + GetParam());
    if (!file) GTEST_SKIP() << "no real data: " << GetParam();
    auto dataset = load(file->string(), {});
    ASSERT_TRUE(dataset.ok());
    bool any = false;
    for (const Object& object : dataset->objects) {
        const auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == nullptr || grid->depths.empty()) continue;
        expect_regions_as_polyhedra(*grid);
        any = true;
    }
    EXPECT_TRUE(any);
}

INSTANTIATE_TEST_SUITE_P(Grids, RegionsOfRealGrids,
                         ::testing::Values("reek/reek_sim_grid.grdecl", "reek/REEK.EGRID", "reek3/reek_sim.grdecl", "spe9/SPE9.GRDECL",
                                           "pygrdecl/20X20X6.GRDECL", "pygrdecl/40X48x1_3fatults.GRDECL", "pygrdecl/CP.GRDECL",
                                           "pygrdecl/Simple20x20x5_Fault.grdecl", "pygrdecl/Simple10x10x3_Fault.grdecl",
                                           "simpleb8/simpleb8.grdecl", "simpleb8/E100_BO.EGRID", "simpleb8/IX_BO.EGRID",
                                           "small/banal1.grdecl", "small/banal3.grdecl", "small/banal4.grdecl", "small/banal6.grdecl",
                                           "small/concave.grdecl", "small/sixcells2_described_zoverlap.grdecl",
                                           "small/sixcells_described_hdr1.grdecl", "small/sixcells_lefthanded_hdr1.grdecl",
                                           "small/gridqc1.roff", "small/dual_distorted1.grdecl", "small/twocell.grdecl",
                                           "opm/MAPAXES.EGRID", "resinsight/regular27cell.grdecl", "upscaling/27cellsIso.grdecl",
                                           "upscaling/EightCells.grdecl"));

// What a user sees: the volumes of the regions in the file that convert wrote, against the sum of the cells in the other.
TEST(RegionsOfGrids, are_the_same_in_both_files_that_convert_writes) {
    const auto file = test::real_data("cornerpoint/simpleb8/simpleb8.grdecl");
    if (!file) GTEST_SKIP() << "no real data: simpleb8";
    const test::TemporaryFolder folder;
    const auto brep = (folder / "brep.vtm").string(), cells = (folder / "cells.vtu").string();
    ASSERT_EQ(test::run_geomend({"convert", file->string(), "-o", brep, "--lossy", "--option", "as=brep"}).status, 0);
    ASSERT_EQ(test::run_geomend({"convert", file->string(), "-o", cells, "--lossy", "--option", "faces=conformal"}).status, 0);
    const auto model = test::info(brep), mesh = test::info(cells);
    ASSERT_TRUE(model.is_object() && mesh.is_object());
    const double region = model["brep"]["region_volumes"][0]["volume"], sum = mesh["objects"][0]["volume"];
    EXPECT_NEAR(region, sum, 1e-12 * sum);
}

}  // namespace
}  // namespace geomend
