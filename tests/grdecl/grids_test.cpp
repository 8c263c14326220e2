// SPDX-License-Identifier: AGPL-3.0-or-later
// Kinds of grids: heads, blocks, radial, local refinements, two porosities, faults and connections.
#include <cmath>
#include <numbers>

#include "grdecl/grdecl_support.h"
#include "grid/cell_geometry.h"

namespace geomend::test {
namespace {

using Dims = std::array<std::uint32_t, 3>;

const std::string small =
    "SPECGRID\n 2 1 2 1 F /\nCOORD\n 0 0 0 0 0 10  1 0 0 1 0 10  2 0 0 2 0 10\n 0 1 0 0 1 10  1 1 0 1 1 10  2 1 0 2 1 10 /\n"
    "ZCORN\n 8*0 16*1 8*2 /\n";

TEST(Heads, EverythingIsKept) {
    const auto g =
        good("MAPUNITS\n'METRES ' /\nMAPAXES\n 0 100 0 0 100 0 /\nGRIDUNIT\n FEET MAP /\nGDORIENT\n INC INC INC\n DOWN LEFT /\n" + small +
             "PINCH\n 0.01 NOGAP 5 ALL ALL /\nMINPV\n 12.5 /\n");
    EXPECT_EQ(g.map_unit, "METRES");
    EXPECT_EQ(g.map_axes, (std::array<double, 6>{0, 100, 0, 0, 100, 0}));
    EXPECT_EQ(g.info.crs.axis_units[0], "FEET");
    EXPECT_TRUE(g.info.crs.stated);
    EXPECT_TRUE(g.map_relative);
    EXPECT_EQ(g.orientation, (std::vector<std::string>{"INC", "INC", "INC", "DOWN", "LEFT"}));
    ASSERT_TRUE(g.pinch);
    EXPECT_EQ(g.pinch->threshold, 0.01);
    EXPECT_FALSE(g.pinch->gap);
    EXPECT_EQ(g.pinch->largest_gap, 5);
    EXPECT_TRUE(g.pinch->all_layers);
    EXPECT_TRUE(g.pinch->multiplier_of_all);
    EXPECT_EQ(g.least_pore_volume, 12.5);
    EXPECT_EQ(g.info.crs.z_positive, ZPositive::depth);
}

TEST(Faults, FacesInEverySpelling) {
    const auto g =
        good(small +
             "FAULTS\n 'A' 1 1 1 1 1 2 X /\n A 1 1 1 1 1 2 'I+' /\n 'B' 2 2 1 1 1 2 X- /\n 'B' 1 2 1 1 1 2 J- /\n B 1 2 1 1 1 1 K /\n/\n"
             "MULTFLT\n 'A' 0.5 /\n 'C' 2 /\n 'B*' 0 /\n/\n");
    ASSERT_EQ(g.faults.size(), 3U);
    EXPECT_EQ(g.faults[0].boxes[0].face, CellFace::i_plus);
    EXPECT_EQ(g.faults[0].boxes[1].face, CellFace::i_plus);
    EXPECT_EQ(g.faults[1].boxes[0].face, CellFace::i_minus);
    EXPECT_EQ(g.faults[1].boxes[1].face, CellFace::j_minus);
    EXPECT_EQ(g.faults[1].boxes[2].face, CellFace::k_plus);
    EXPECT_EQ(g.faults[1].boxes[0].last, (Dims{1, 0, 1}));
    EXPECT_EQ(g.faults[0].multiplier, 0.5);
    EXPECT_EQ(g.faults[1].multiplier, 0.0);
    EXPECT_TRUE(g.faults[2].boxes.empty());
}

TEST(Connections, CellsCountFromZero) {
    const auto d = read_text(
        small + "NNC\n 1 1 1 2 1 2 0.5 /\n 2 1 1 1 1 2 /\n 1 1 1 2 1 1 1.5 3 /\n/\nMULTREGT\n 1 2 0.1 XY NNC F /\n 1* 3 0.2 /\n/\n");
    ASSERT_TRUE(d) << why(d);
    const auto& g = grid_of(*d);
    ASSERT_EQ(g.connections.size(), 3U);
    EXPECT_EQ(g.connections[0].first, 0U);
    EXPECT_EQ(g.connections[0].second, 3U);
    EXPECT_EQ(g.connections[0].transmissibility, 0.5);
    EXPECT_FALSE(g.connections[1].transmissibility);
    EXPECT_TRUE(loses_substance(d->losses));  // the third says more than is kept
    ASSERT_EQ(g.region_multipliers.size(), 2U);
    EXPECT_EQ(g.region_multipliers[0].directions, "XY");
    EXPECT_EQ(g.region_multipliers[0].regions, 'F');
    EXPECT_FALSE(g.region_multipliers[1].from);
    EXPECT_EQ(g.region_multipliers[1].to, 3);
}

TEST(Blocks, BecomeCorners) {
    const auto g = good("SPECGRID\n 2 2 2 /\nDX\n 4*10 4*10 /\nDY\n 8*5 /\nDZ\n 4*1 4*2 /\nTOPS\n 100 101 102 103 /\n");
    EXPECT_EQ(misfit(g), "");
    EXPECT_TRUE(g.info.attributes.empty());
    EXPECT_DOUBLE_EQ(grid::volume(g), 4 * 50 * 1 + 4 * 50 * 2);
    const auto c = cell_corners(g, 1, 1, 1);
    EXPECT_EQ(c[0], (Vec3{10, 5, 104}));
    EXPECT_EQ(c[7], (Vec3{20, 10, 106}));
}

TEST(Blocks, FromVectorsAndFromEquals) {
    const auto g = good("SPECGRID\n 3 1 2 /\nDXV\n 1 2 3 /\nDYV\n 4 /\nDZV\n 2*5 /\nEQUALS\n TOPS 1000 1 3 1 1 1 1 /\n/\n");
    EXPECT_DOUBLE_EQ(grid::volume(g), 6 * 4 * 10);
    const auto z = good("SPECGRID\n 1 1 2 /\nDXV\n 2 /\nDYV\n 2 /\nDZV\n 1 3 /\nDEPTHZ\n 10 11 12 13 /\n");
    EXPECT_DOUBLE_EQ(grid::volume(z), 16);
    EXPECT_EQ(cell_corners(z, 0, 0, 1)[7][2], 17);
}

TEST(Blocks, ThatDoNotFitColumnsAreTold) {
    const auto d = read_text("SPECGRID\n 2 2 1 /\nDX\n 1 1 2 2 /\nDY\n 4*1 /\nDZ\n 4*1 /\nTOPS\n 4*0 /\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "F113"));
    EXPECT_EQ(values(grid_of(*d), "DX"), (std::vector<double>{1, 1, 2, 2}));
}

TEST(Blocks, WithoutTopsAreRefused) { EXPECT_EQ(bad("SPECGRID\n 1 1 1 /\nDX\n 1 /\nDY\n 1 /\nDZ\n 1 /\n").substr(0, 4), "F012"); }

TEST(Radial, RingsHaveTheirVolume) {
    const auto g =
        good("RUNSPEC\nDIMENS\n 3 4 2 /\nRADIAL\nGRID\nINRAD\n 1 /\nDRV\n 1 2 3 /\nDTHETAV\n 4*90 /\nDZV\n 2*5 /\nTOPS\n 12*1000 /\n");
    EXPECT_TRUE(g.cylindrical);
    EXPECT_NEAR(grid::volume(g), std::numbers::pi * (49 - 1) * 10, 1e-6);
}

TEST(Radial, OuterRadiusMakesRingsThatGrowEvenly) {
    const auto g = good("RUNSPEC\nDIMENS\n 3 1 1 /\nRADIAL\nGRID\nINRAD\n 1 /\nOUTRAD\n 8 /\nDTHETAV\n 360 /\nDZV\n 1 /\nTOPS\n 3*0 /\n");
    EXPECT_NEAR(g.pillars[6], 2, 1e-12);
    EXPECT_NEAR(g.pillars[12], 4, 1e-12);
    EXPECT_NEAR(grid::volume(g), std::numbers::pi * 63, 1e-6);
}

TEST(LocalGrids, CutTheirHostsEvenly) {
    const auto d = read_text(
        small + "ACTNUM\n 1 0 1 1 /\nPORO\n 4*0.1 /\nCARFIN\n 'LGR1' 2 2 1 1 1 2 4 3 2 /\nPORO\n 24*0.2 /\nENDFIN\nNTG\n 4*1 /\n");
    ASSERT_TRUE(d) << why(d);
    ASSERT_EQ(d->objects.size(), 2U);
    const auto& fine = grid_of(*d, 1);
    EXPECT_EQ(fine.info.name, "LGR1");
    EXPECT_EQ(fine.dims, (Dims{4, 3, 2}));
    ASSERT_TRUE(fine.host);
    EXPECT_EQ(fine.host->first, (Dims{1, 0, 0}));
    EXPECT_EQ(fine.host->last, (Dims{1, 0, 1}));
    EXPECT_EQ(active_count(fine), 12U);
    EXPECT_NEAR(grid::volume(fine), 1, 1e-12);
    EXPECT_EQ(fine.host->cells[0], 1U);
    EXPECT_EQ(fine.host->cells[23], 3U);
    EXPECT_EQ(values(fine, "PORO"), std::vector<double>(24, 0.2));
    EXPECT_EQ(values(grid_of(*d), "NTG").size(), 4U);
}

TEST(LocalGrids, NumbersOfFineCellsMayDiffer) {
    const auto d = read_text(small + "CARFIN\n 'L' 1 2 1 1 1 1 5 1 1 /\nNXFIN\n 2 3 /\nHXFIN\n 1 3 3*1 /\nENDFIN\n");
    ASSERT_TRUE(d) << why(d);
    const auto& fine = grid_of(*d, 1);
    EXPECT_EQ(fine.host->cells, (std::vector<std::uint64_t>{0, 0, 1, 1, 1}));
    EXPECT_DOUBLE_EQ(grid::cell_volume(fine, 0, 0, 0), 0.25);
    EXPECT_NEAR(grid::volume(fine), 2, 1e-12);
    EXPECT_EQ(bad(small + "CARFIN\n 'L' 1 2 1 1 1 1 5 1 1 /\nENDFIN\n").substr(0, 4), "F008");
}

TEST(TwoPorosities, LayersOfTheDeckAreHalved) {
    const std::string head = "RUNSPEC\nDIMENS\n 2 1 4 /\nDUALPORO\nGRID\n";
    const std::string geometry = small.substr(small.find("COORD"));
    const auto g = good(head + geometry + "ACTNUM\n 1 1 0 0 1 0 1 0 /\nPORO\n 4*0.1 4*0.2 /\nNNC\n 1 1 1 1 1 3 2 /\n/\n");
    EXPECT_EQ(g.porosity, CornerPointGrid::Porosity::dual_porosity);
    EXPECT_EQ(g.dims, (Dims{2, 1, 2}));
    EXPECT_EQ(g.activity, (std::vector<std::uint8_t>{3, 1, 2, 0}));
    EXPECT_EQ(values(g, "PORO"), std::vector<double>(4, 0.1));
    EXPECT_EQ(values(g, "PORO:fracture"), std::vector<double>(4, 0.2));
    EXPECT_EQ(g.connections[0].second, 4U);
    const auto full = good(head +
                           "COORD\n 0 0 0 0 0 10  1 0 0 1 0 10  2 0 0 2 0 10\n 0 1 0 0 1 10  1 1 0 1 1 10  2 1 0 2 1 10 /\nZCORN\n 8*0 "
                           "16*1 8*2 8*0 16*1 8*2 /\n");
    EXPECT_TRUE(same(full.depths, g.depths));
}

TEST(TwoPorosities, ArraysOfTheMatrixAloneSuffice) {
    const auto g =
        good("RUNSPEC\nDIMENS\n 2 1 4 /\nDUALPERM\nGRID\n" + small.substr(small.find("COORD")) + "ACTNUM\n 1 1 0 1 /\nPORO\n 4*0.1 /\n");
    EXPECT_EQ(g.porosity, CornerPointGrid::Porosity::dual_permeability);
    EXPECT_EQ(g.activity, (std::vector<std::uint8_t>{3, 3, 0, 3}));
    EXPECT_EQ(values(g, "PORO"), std::vector<double>(4, 0.1));
}

TEST(LocalGrids, OfRingsAreKeptAsText) {
    const auto d = read_text(small + "RADFIN\n 'W' 1 1 1 1 1 2 3 4 2 /\nINRAD\n 0.1 /\nPORO\n 24*0.1 /\nENDFIN\nPORO\n 4*0.2 /\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "F148"));
    EXPECT_FALSE(loses_substance(d->losses)) << "a deck keeps it; other formats list it as lost";
    EXPECT_EQ(values(grid_of(*d), "PORO"), std::vector<double>(4, 0.2));
    ASSERT_EQ(grid_of(*d).info.annotations.size(), 1U);
    EXPECT_TRUE(grid_of(*d).info.annotations[0].value.ends_with("ENDFIN"));
}

TEST(Reservoirs, HaveTheirOwnLines) {
    const auto g =
        good("SPECGRID\n 1 1 2 2 F /\nCOORDSYS\n 1 1 INCOMP SEPARATE /\n 2 2 COMP JOIN /\nCOORD\n 24*0 24*1 /\nZCORN\n 4*0 8*1 4*2 /\n");
    EXPECT_EQ(misfit(g), "");
    ASSERT_EQ(g.reservoirs.size(), 2U);
    EXPECT_EQ(g.reservoirs[1].first_layer, 1U);
    EXPECT_TRUE(g.reservoirs[1].complete_circle);
    EXPECT_TRUE(g.reservoirs[1].joined);
}

TEST(Elevations, AreTurnedAndTold) {
    std::string up = small;
    up.replace(up.find(" 8*0 16*1 8*2"), 13, " 8*-5 16*-6 8*-7");
    const auto d = read_text(up);
    ASSERT_TRUE(d) << why(d);
    // Depths -5 to -7 grow less with k: elevations of a grid that is 5 to 7 deep.
    EXPECT_TRUE(has_finding(*d, "F132"));
    EXPECT_EQ(grid_of(*d).depths.front(), 5);
    EXPECT_EQ(grid_of(*d).depths.back(), 7);
    EXPECT_EQ(grid_of(*d).info.crs.z_positive, ZPositive::elevation);
}

TEST(AddedDepths, AreNotAppliedAndTold) {
    const auto d = read_text(small + "ADDZCORN\n 5 1 2 1 1 1 1 /\n/\nPORO\n 4*0.1 /\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(has_finding(*d, "F148"));
    EXPECT_NE(find_attribute(grid_of(*d).info.attributes, "PORO", AttributeLocation::cell), nullptr);
}

TEST(GeometryElsewhere, IsTold) {
    const auto d = read_text("SPECGRID\n 2 1 2 /\nGDFILE\n 'X.EGRID' /\nPORO\n 4*0.1 /\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_TRUE(grid_of(*d).depths.empty());
    EXPECT_TRUE(loses_substance(d->losses));
}

}  // namespace
}  // namespace geomend::test
