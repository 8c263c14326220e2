// SPDX-License-Identifier: AGPL-3.0-or-later
// What is written: there and back without a bit changed, lines of 128 characters, and what does not go in is listed.
#include <gtest/gtest.h>
//
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "grdecl/grdecl_support.h"

namespace geomend::test {
namespace {

template <class T>
Attribute cell_attribute(std::string name, std::vector<T> values) {
    Attribute a;
    a.name = std::move(name);
    a.location = AttributeLocation::cell;
    a.values = std::move(values);
    return a;
}

CornerPointGrid made(std::array<std::uint32_t, 3> dims = {2, 1, 2}) {
    CornerPointGrid g;
    g.info.name = "back";
    g.info.crs.z_positive = ZPositive::depth;
    g.info.crs.z_positive_stated = true;
    g.dims = dims;
    for (std::uint32_t j = 0; j <= dims[1]; ++j) {
        for (std::uint32_t i = 0; i <= dims[0]; ++i) {
            for (const double v : {i + 0.1, j / 3.0, 0.0, i + 0.2, j / 7.0, 100.0}) g.pillars.push_back(v);
        }
    }
    for (std::size_t n = 0; n < 8 * g.cell_count(); ++n)
        g.depths.push_back(1000 + std::sin(static_cast<double>(n)) + static_cast<double>(n));
    return g;
}

Dataset dataset_of(CornerPointGrid g) {
    Dataset d;
    d.objects.emplace_back(std::move(g));
    return d;
}

CornerPointGrid full() {
    CornerPointGrid g = made();
    g.activity = {1, 0, 1, 1};
    g.map_axes = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    g.map_unit = "FEET";
    g.map_relative = true;
    g.info.crs.axis_units = {"METRES", "METRES", "METRES"};
    g.info.crs.stated = true;
    g.orientation = {"INC", "INC", "INC", "DOWN", "LEFT"};
    g.unit_system = "METRIC";
    g.faults = {{"F1", {{{0, 0, 0}, {0, 0, 1}, CellFace::i_plus}, {{0, 0, 0}, {1, 0, 0}, CellFace::k_minus}}, 0.25}, {"F2", {}, 0.5}};
    g.connections = {{0, 3, 1.5}, {1, 2, {}}};
    g.pinch = CornerPointGrid::Pinch{0.02, false, 3, true, true};
    g.least_pore_volume = 17.5;
    g.region_multipliers = {{1, {}, 0.5, "XY", "NNC", 'F'}};
    g.info.attributes = {cell_attribute<double>("PORO", {0.1, 0.2, 1.0 / 3, -0.0}),
                         cell_attribute<std::int32_t>("FLUXNUM", {1, 1, 2, 2}),
                         cell_attribute<std::int32_t>("SATNUM", {1, 1, 2, 3}),
                         cell_attribute<std::int32_t>("FACIES", {4, 4, -4, 4}),
                         cell_attribute<double>("RHO", {1, 2, 3, 4}),
                         cell_attribute<double>("my own name", {1.5, 2, 3, 4}),
                         cell_attribute<std::string>("ZONE", {"it's", "a/b", "", "-- no comment"})};
    return g;
}

TEST(Writing, EverythingComesBack) {
    const TemporaryFolder folder;
    const Dataset d = dataset_of(full());
    for (const char* name : {"back.grdecl", "back.grdecl.gz", "back.DATA"}) {
        const auto written = write(d, folder / name);
        EXPECT_TRUE(written.losses.empty()) << written.losses.front().what;
        const auto again = read_path(written.path);
        ASSERT_TRUE(again) << why(again);
        expect_same(grid_of(d), grid_of(*again));
        EXPECT_TRUE(again->findings.empty()) << again->findings.front().message;
    }
}

TEST(Writing, WhatSimulatorsWouldStopOnStandsBeside) {
    const TemporaryFolder folder;
    const auto written = write(dataset_of(full()), folder / "back.grdecl");
    const std::string text = read_file(written.path);
    const std::string beside = read_file(folder / "back.properties.grdecl");
    for (const char* word : {"FACIES", "RHO\n", "my own name", "ZONE"}) {
        EXPECT_EQ(text.find(word), std::string::npos) << word;
        EXPECT_NE(beside.find(word), std::string::npos) << word;
    }
    EXPECT_EQ(text.find("INCLUDE"), std::string::npos);
    EXPECT_NE(text.find("-- Further properties, which simulators do not take: back.properties.grdecl"), std::string::npos);
    const auto inside = write(dataset_of(full()), folder / "in.grdecl", {{"properties", "inside"}});
    EXPECT_FALSE(std::filesystem::exists(folder / "in.properties.grdecl"));
    EXPECT_NE(read_file(inside.path).find("FACIES"), std::string::npos);
}

TEST(Writing, LinesAreShortAndRepeatsAreCounted) {
    const TemporaryFolder folder;
    CornerPointGrid g = made({30, 20, 3});
    g.info.attributes = {cell_attribute<double>("PORO", std::vector<double>(1800, 0.25))};
    const auto written = write(dataset_of(g), folder / "back.grdecl");
    const std::string text = read_file(written.path);
    std::size_t longest = 0, line = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\n') continue;
        longest = std::max(longest, i - line);
        line = i + 1;
    }
    EXPECT_LE(longest, 128U);
    EXPECT_GT(longest, 100U);
    EXPECT_NE(text.find("PORO\n 1800*0.25\n/"), std::string::npos);
}

TEST(Writing, MissingValuesBecomeDefaults) {
    const TemporaryFolder folder;
    CornerPointGrid g = made();
    Attribute a = cell_attribute<double>("PORO", {-999.25, 0.2, std::numeric_limits<double>::quiet_NaN(), 0.4});
    a.no_data = -999.25;
    g.info.attributes = {a};
    const auto written = write(dataset_of(g), folder / "back.grdecl");
    EXPECT_NE(read_file(written.path).find("PORO\n 1* 0.2 1* 0.4\n/"), std::string::npos);
    ASSERT_EQ(written.losses.size(), 1U);
    EXPECT_EQ(written.losses[0].loss_class, LossClass::identity);
    const auto again = read_path(written.path);
    ASSERT_TRUE(again) << why(again);
    EXPECT_TRUE(is_no_data(attribute(grid_of(*again), "PORO"), values(grid_of(*again), "PORO")[0]));
}

TEST(Writing, TwoPorositiesComeBack) {
    const TemporaryFolder folder;
    CornerPointGrid g = made();
    g.porosity = CornerPointGrid::Porosity::dual_permeability;
    g.activity = {3, 1, 2, 0};
    g.connections = {{0, 4, 2.0}};
    g.info.attributes = {cell_attribute<double>("PORO", {0.1, 0.2, 0.3, 0.4}),
                         cell_attribute<double>("PORO:fracture", {0.5, 0.6, 0.7, 0.8}), cell_attribute<double>("PERMX", {1, 2, 3, 4}),
                         cell_attribute<std::int32_t>("SATNUM", {1, 2, 1, 2}),
                         cell_attribute<double>("NTG:fracture", {0.5, 0.5, 0.5, 0.25})};
    const Dataset d = dataset_of(g);
    for (const char* name : {"back.grdecl", "back.DATA"}) {
        const auto written = write(d, folder / name);
        EXPECT_FALSE(loses_substance(written.losses));
        const auto again = read_path(written.path);
        ASSERT_TRUE(again) << why(again);
        const CornerPointGrid& back = grid_of(*again);
        EXPECT_EQ(back.porosity, g.porosity);
        EXPECT_EQ(back.dims, g.dims);
        EXPECT_EQ(back.activity, g.activity);
        EXPECT_TRUE(same(back.depths, g.depths));
        EXPECT_EQ(back.connections[0].second, 4U);
        for (const char* property : {"PORO", "PORO:fracture", "PERMX", "SATNUM", "NTG:fracture"})
            EXPECT_EQ(values(back, property), values(g, property)) << property;
    }
}

TEST(Writing, LocalGridsAndSetsOfLinesComeBack) {
    const TemporaryFolder folder;
    CornerPointGrid g = made();
    g.pillars.insert(g.pillars.end(), g.pillars.begin(), g.pillars.end());
    g.reservoirs = {{0, 0, false, false}, {1, 1, true, true}};
    CornerPointGrid fine = made({3, 1, 2});
    fine.info.name = "LGR 1";
    fine.host = CornerPointGrid::Host{"", {0, 0, 0}, {1, 0, 0}, {0, 0, 1, 0, 0, 1}};
    fine.info.attributes = {cell_attribute<double>("PORO", {1, 2, 3, 4, 5, 6}), cell_attribute<std::int32_t>("SATNUM", {1, 2, 3, 4, 5, 6}),
                            cell_attribute<std::int32_t>("FACIES", {6, 5, 4, 3, 2, 1})};
    g.info.attributes = {cell_attribute<std::int32_t>("FACIES", {4, 3, 2, 1})};
    Dataset d = dataset_of(g);
    d.objects.emplace_back(fine);
    for (const char* name : {"back.grdecl", "back.DATA"}) {
        const auto written = write(d, folder / name);
        EXPECT_FALSE(loses_substance(written.losses));
        const auto again = read_path(written.path);
        ASSERT_TRUE(again) << why(again);
        ASSERT_EQ(again->objects.size(), 2U);
        expect_same(g, grid_of(*again));
        expect_same(fine, grid_of(*again, 1));
        EXPECT_EQ(grid_of(*again, 1).host->cells, fine.host->cells);
        EXPECT_EQ(grid_of(*again).reservoirs[1].joined, true);
    }
}

// As EGRID files of two porosities have them: numbers beyond the matrix mean the fracture.
TEST(Writing, ConnectionsOfTheFractureOfALocalGridAreLeftOutAndListed) {
    const TemporaryFolder folder;
    CornerPointGrid g = made();
    g.porosity = CornerPointGrid::Porosity::dual_porosity;
    g.activity = {3, 1, 2, 0};
    CornerPointGrid fine = made({3, 1, 2});
    fine.info.name = "LGR 1";
    fine.host = CornerPointGrid::Host{"", {0, 0, 0}, {1, 0, 0}, {0, 0, 1, 0, 0, 1}};
    fine.porosity = g.porosity;
    fine.activity = {3, 1, 2, 0, 3, 1};
    fine.connections = {{0, 2, 1.5}, {0, 6, 2.5}, {7, 11, {}}};
    Dataset d = dataset_of(g);
    d.objects.emplace_back(fine);
    for (const char* name : {"back.grdecl", "back.DATA"}) {
        const auto written = write(d, folder / name);
        const auto lost = std::ranges::find_if(
            written.losses, [](const Loss& l) { return l.loss_class == LossClass::substance && l.what.starts_with("connections"); });
        ASSERT_NE(lost, written.losses.end());
        EXPECT_EQ(lost->entity, "LGR 1");
        EXPECT_EQ(lost->count, 2U);
        const auto again = read_path(written.path);
        ASSERT_TRUE(again) << why(again);
        EXPECT_EQ(grid_of(*again).activity, g.activity);
        const CornerPointGrid& back = grid_of(*again, 1);
        EXPECT_EQ(back.activity, fine.activity);
        ASSERT_EQ(back.connections.size(), 1U);
        EXPECT_EQ(back.connections[0].second, 2U);
        EXPECT_EQ(back.connections[0].transmissibility, 1.5);
    }
}

TEST(Writing, CoordinatesThatAreNoneAreReadableAndListed) {
    const TemporaryFolder folder;
    CornerPointGrid g = made();
    g.depths[3] = std::numeric_limits<double>::quiet_NaN();
    const auto written = write(dataset_of(g), folder / "back.grdecl");
    EXPECT_TRUE(loses_substance(written.losses));
    const auto again = read_path(written.path);
    ASSERT_TRUE(again) << why(again);
    EXPECT_EQ(grid_of(*again).depths[3], 1e20);
}

TEST(Writing, RecordsOfEditStayUnderTheirSection) {
    const auto d = read_text(
        "GRID\nSPECGRID\n 1 1 1 /\nCOORD\n 24*0 /\nZCORN\n 4*0 4*1 /\nFAULTS\n A 1 1 1 1 1 1 X /\n/\nEDIT\nMULTFLT\n A 0.5 /\n/\n");
    ASSERT_TRUE(d) << why(d);
    EXPECT_FALSE(grid_of(*d).faults[0].multiplier);
    const TemporaryFolder folder;
    for (const char* name : {"back.grdecl", "back.DATA"}) {
        const auto again = read_path(write(*d, folder / name).path);
        ASSERT_TRUE(again) << why(again);
        EXPECT_FALSE(grid_of(*again).faults[0].multiplier);
        ASSERT_EQ(grid_of(*again).info.annotations.size(), 1U) << name;
        EXPECT_EQ(grid_of(*again).info.annotations[0].key, "grdecl.record.edit");
    }
}

TEST(Writing, NamesOfFaultsWithQuotesOfBothKindsAreReadableAndListed) {
    CornerPointGrid g = made();
    const auto fault = [](std::string name) {
        return CornerPointGrid::Fault{std::move(name), {{{0, 0, 0}, {0, 0, 1}, CellFace::i_plus}}, 0.5};
    };
    g.faults = {fault("plain"), fault("it's"), fault("12\" pipe"), fault("it's 12\""), fault("it's 12'")};
    const TemporaryFolder folder;
    const auto written = write(dataset_of(g), folder / "back.grdecl");
    const auto again = read_path(written.path);
    ASSERT_TRUE(again) << why(again);
    const CornerPointGrid& back = grid_of(*again);
    ASSERT_EQ(back.faults.size(), 5u);
    EXPECT_EQ(back.faults[0].name, "plain");
    EXPECT_EQ(back.faults[1].name, "it's");
    EXPECT_EQ(back.faults[2].name, "12\" pipe");
    EXPECT_EQ(back.faults[3].name, "it's 12'_2") << "not the name of another fault";
    EXPECT_EQ(back.faults[4].name, "it's 12'");
    EXPECT_EQ(back.faults[3].multiplier, 0.5);
    EXPECT_EQ(std::ranges::count_if(written.losses, [](const Loss& l) { return l.what == "name of fault 'it's 12\"'"; }), 1);
}

TEST(Writing, WhatDoesNotGoInIsListed) {
    const TemporaryFolder folder;
    CornerPointGrid g = made();
    Attribute on_points = cell_attribute<double>("P", {1, 2});
    on_points.location = AttributeLocation::point;
    g.info.attributes = {on_points, cell_attribute<double>("SATNUM", {1, 2, 3, 4.5}), cell_attribute<double>("COORD", {1, 2, 3, 4})};
    g.links = {{"LGR", {{1, 2, 3.0}}}};
    g.info.crs.name = "UTM 31";
    Dataset d = dataset_of(g);
    d.objects.emplace_back(made());
    d.objects.emplace_back(PointSet{});
    const auto written = write(d, folder / "back.grdecl");
    EXPECT_EQ(std::ranges::count_if(written.losses, [](const Loss& l) { return l.loss_class == LossClass::substance; }), 6);
    EXPECT_EQ(std::ranges::count_if(written.losses, [](const Loss& l) { return l.loss_class == LossClass::identity; }), 1);
    OutputSet out(folder / "none.grdecl");
    Dataset none;
    none.objects.emplace_back(PointSet{});
    const auto refused = row("grdecl").write(none, out, {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.why().kind, FailureKind::cannot_hold);
}

TEST(Writing, RealsThatAreWholeBecomeRegions) {
    const TemporaryFolder folder;
    CornerPointGrid g = made();
    g.info.attributes = {cell_attribute<float>("SATNUM", {1, 2, 3, 4}), cell_attribute<float>("PERMX", {0.1F, 2, 3, 4})};
    const auto written = write(dataset_of(g), folder / "back.grdecl");
    EXPECT_TRUE(written.losses.empty());
    const auto again = read_path(written.path);
    ASSERT_TRUE(again) << why(again);
    EXPECT_EQ(values(grid_of(*again), "SATNUM"), (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(values(grid_of(*again), "PERMX")[0], 0.1);
}

TEST(Writing, RegionsMayMissCells) {
    const TemporaryFolder folder;
    CornerPointGrid g = made();
    g.info.attributes = {cell_attribute<std::int32_t>("SATNUM", {1, -2147483647, 3, 4})};
    g.info.attributes[0].no_data = -2147483647.0;
    const auto written = write(dataset_of(g), folder / "back.grdecl");
    for (const Loss& loss : written.losses) EXPECT_NE(loss.loss_class, LossClass::substance) << loss.what;
    const auto again = read_path(written.path);
    ASSERT_TRUE(again) << why(again);
    EXPECT_EQ(values(grid_of(*again), "SATNUM")[2], 3);
}

TEST(Writing, RadialDecksStayBlocksAroundTheirAxis) {
    const std::string head = "RUNSPEC\nDIMENS\n 3 4 2 /\nMETRIC\nRADIAL\nGRID\n";
    for (const char* steps :
         {"INRAD\n 0.25 /\nDRV\n 1.0 5.0 20.0 /\nDTHETAV\n 4*90 /\nDZ\n 24*10 /\nTOPS\n 12*2000 /\n",
          "INRAD\n 0.1 /\nDRV\n 0.3 0.7 1.1 /\nDTHETAV\n 10.1 20.2 30.3 40.4 /\nDZ\n 12*3.3 12*0 /\nTOPS\n 2000.1 11*2001.7 /\n",
          "INRAD\n 0.5 /\nOUTRAD\n 300 /\nDTHETAV\n 4*30 /\nDZV\n 7 9 /\nTOPS\n 12*1500.5 /\n"}) {
        const auto grid = good(head + steps);
        const TemporaryFolder folder;
        const std::string written = read_file(write(dataset_of(grid), folder / "back.DATA").path);
        EXPECT_NE(written.find("DTHETAV"), std::string::npos) << written;
        EXPECT_EQ(written.find("COORD"), std::string::npos) << written;
        EXPECT_EQ(written.find("SPECGRID"), std::string::npos) << written;
        const auto back = good(written);
        EXPECT_TRUE(same(grid.pillars, back.pillars)) << steps;
        EXPECT_TRUE(same(grid.depths, back.depths)) << steps;
        EXPECT_TRUE(back.cylindrical);
    }
}

TEST(Writing, RadialGridsThatAreNoBlocksKeepTheirPillars) {
    auto grid = good("RUNSPEC\nDIMENS\n 2 1 1 /\nRADIAL\nGRID\nINRAD\n 1 /\nDRV\n 1 2 /\nDTHETAV\n 90 /\nDZ\n 2*3 /\nTOPS\n 2*10 /\n");
    grid.depths.back() += 0.5;  // no longer flat
    const TemporaryFolder folder;
    const std::string written = read_file(write(dataset_of(grid), folder / "back.DATA").path);
    EXPECT_NE(written.find("COORD"), std::string::npos);
    EXPECT_TRUE(same(grid.depths, good(written).depths));
}

TEST(Writing, OnlyPropertiesWhereThatIsAsked) {
    const TemporaryFolder folder;
    const auto written = write(dataset_of(full()), folder / "back.grdecl", {{"content", "properties"}});
    const auto again = read_path(written.path, {{"dims", "2,1,2"}});
    ASSERT_TRUE(again) << why(again);
    EXPECT_TRUE(grid_of(*again).depths.empty());
    EXPECT_TRUE(grid_of(*again).faults.empty());
    EXPECT_EQ(values(grid_of(*again), "PORO"), values(full(), "PORO"));
}

RC_GTEST_PROP(WritingProperty, AnyFiniteDoublesComeBackBitByBit, ()) {
    CornerPointGrid g = made({1, 1, 2});
    const auto any = *rc::gen::container<std::vector<std::uint64_t>>(16, rc::gen::arbitrary<std::uint64_t>());
    for (std::size_t i = 0; i < any.size(); ++i) {
        const double v = std::bit_cast<double>(any[i]);
        g.depths[i] = std::isfinite(v) ? std::abs(v) : 0.0;
    }
    const TemporaryFolder folder;
    const auto written = write(dataset_of(g), folder / "back.grdecl");
    const auto again = read_path(written.path);
    RC_ASSERT(static_cast<bool>(again));
    RC_ASSERT(same(grid_of(*again).depths, g.depths));
}

}  // namespace
}  // namespace geomend::test
