// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "eclipse_testing.h"
#include "formats/eclipse/array_writer.h"
#include "support/corner_point_samples.h"

namespace geomend::test {
namespace {

std::size_t count(const std::vector<Loss>& losses, LossClass c) {
    std::size_t n = 0;
    for (const Loss& l : losses) n += l.loss_class == c;
    return n;
}

void expect_same_grid(const CornerPointGrid& a, const CornerPointGrid& b) {
    EXPECT_EQ(a.dims, b.dims);
    EXPECT_EQ(a.pillars, b.pillars);
    EXPECT_EQ(a.depths, b.depths);
    EXPECT_EQ(a.activity, b.activity);
    EXPECT_EQ(a.map_axes, b.map_axes);
    EXPECT_EQ(a.map_unit, b.map_unit);
    EXPECT_EQ(a.map_relative, b.map_relative);
    EXPECT_EQ(a.orientation, b.orientation);
    EXPECT_EQ(a.info.crs.axis_units, b.info.crs.axis_units);
    EXPECT_EQ(a.info.crs.z_positive, b.info.crs.z_positive);
    EXPECT_EQ(a.cylindrical, b.cylindrical);
    EXPECT_EQ(a.porosity, b.porosity);
}

void expect_same_connections(const std::vector<CornerPointGrid::Connection>& a, const std::vector<CornerPointGrid::Connection>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].first, b[i].first);
        EXPECT_EQ(a[i].second, b[i].second);
    }
}

CornerPointGrid with_frame(CornerPointGrid grid) {
    grid.map_axes = std::array<double, 6>{100, 500, 100, 300, 400, 300};
    grid.map_unit = "METRES";
    grid.info.crs.axis_units.fill("FEET");
    grid.map_relative = true;
    grid.orientation = {"INC", "INC", "INC", "DOWN", "RIGHT"};
    return grid;
}

Attribute& add_attribute(CornerPointGrid& grid, std::string name, AttributeValues values) {
    Attribute a;
    a.name = std::move(name);
    a.location = AttributeLocation::cell;
    a.values = std::move(values);
    grid.info.attributes.push_back(std::move(a));
    return grid.info.attributes.back();
}

class EgridThereAndBack : public testing::TestWithParam<const char*> {
protected:
    std::filesystem::path path() const { return folder_ / (std::string("faulted.") + GetParam()); }
    TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Forms, EgridThereAndBack, testing::Values("egrid", "fegrid"));

TEST_P(EgridThereAndBack, FaultedGridWithItsFrameAndConnections) {
    CornerPointGrid grid = with_frame(faulted_grid(7, 5, 9));
    grid.connections = {{0, 8, std::nullopt}, {20, 3, std::nullopt}};
    const auto losses = write_eclipse(dataset_of(grid), GetParam(), path());
    EXPECT_EQ(count(losses, LossClass::substance) + count(losses, LossClass::identity), 0u);
    const auto back = read_eclipse(path());
    expect_same_grid(grid, grid_of(back));
    expect_same_connections(grid.connections, grid_of(back).connections);
}

TEST_P(EgridThereAndBack, NumbersWithAllTheirDigits) {
    CornerPointGrid grid = faulted_grid(3, 3, 3);
    for (std::size_t i = 0; i < grid.depths.size(); ++i)
        grid.depths[i] = static_cast<double>(static_cast<float>(1234.5 + std::sin(double(i))));
    grid.pillars[0] = static_cast<double>(-1.17549435e-38F);
    grid.pillars[1] = static_cast<double>(3.4e38F);
    const auto losses = write_eclipse(dataset_of(grid), GetParam(), path());
    EXPECT_EQ(count(losses, LossClass::identity), 0u);
    const auto back = read_eclipse(path());
    expect_same_grid(grid, grid_of(back));
}

TEST_P(EgridThereAndBack, CoordinatesBeyondSinglePrecisionCannotBeHeld) {
    for (const bool depth : {false, true}) {
        CornerPointGrid grid = faulted_grid(3, 3, 3);
        (depth ? grid.depths[5] : grid.pillars[0]) = 1e300;
        for (const char* form : {GetParam(), "bgrdecl"}) {
            OutputSet out(path());
            const auto written = eclipse_row(form).write(dataset_of(grid), out, {});
            ASSERT_FALSE(written.ok()) << form;
            EXPECT_EQ(written.why().kind, FailureKind::cannot_hold) << form;
        }
    }
}

TEST_P(EgridThereAndBack, DualPorosityAndRefinementsWithTheirLinks) {
    CornerPointGrid grid = faulted_grid(4, 3, 2);
    grid.porosity = CornerPointGrid::Porosity::dual_porosity;
    for (std::size_t c = 0; c < grid.cell_count(); ++c) grid.activity[c] = c % 4;
    grid.connections = {{3, 3 + grid.cell_count(), std::nullopt}};
    CornerPointGrid inner = faulted_grid(2, 2, 2), deep = faulted_grid(2, 1, 1);
    inner.info.name = "INNER";
    inner.porosity = deep.porosity = grid.porosity;
    inner.host = {.grid = "", .first = {1, 1, 0}, .last = {2, 2, 1}, .cells = {5, 6, 9, 10, 17, 18, 21, 22}};
    deep.info.name = "DEEP";
    deep.host = {.grid = "INNER", .first = {0, 0, 0}, .last = {1, 0, 0}, .cells = {0, 1}};
    inner.links = {{"", {{0, 4, std::nullopt}, {1, 2, std::nullopt}}}, {"DEEP", {{7, 1, std::nullopt}}}};
    deep.links = {{"", {{1, 0, std::nullopt}}}};
    Dataset data = dataset_of(grid);
    data.objects.emplace_back(deep);  // before its host
    data.objects.emplace_back(inner);
    const auto losses = write_eclipse(data, GetParam(), path());
    EXPECT_EQ(count(losses, LossClass::substance), 0u);
    const auto back = read_eclipse(path());
    ASSERT_TRUE(back.ok()) << back.why().error.message;
    ASSERT_EQ(back->objects.size(), 3u);
    expect_same_grid(grid, grid_of(back, 0));
    expect_same_connections(grid.connections, grid_of(back, 0).connections);
    const CornerPointGrid &in = grid_of(back, 1), &de = grid_of(back, 2);
    expect_same_grid(inner, in);
    expect_same_grid(deep, de);
    EXPECT_EQ(in.info.name, "INNER");
    EXPECT_EQ(in.host->first, inner.host->first);
    EXPECT_EQ(in.host->last, inner.host->last);
    EXPECT_EQ(in.host->cells, inner.host->cells);
    EXPECT_EQ(de.host->grid, "INNER");
    ASSERT_EQ(in.links.size(), 2u);
    EXPECT_EQ(in.links[0].grid, "");
    expect_same_connections(in.links[0].connections, inner.links[0].connections);
    EXPECT_EQ(in.links[1].grid, "DEEP");
    expect_same_connections(in.links[1].connections, inner.links[1].connections);
    ASSERT_EQ(de.links.size(), 1u);
    expect_same_connections(de.links[0].connections, deep.links[0].connections);
}

TEST_P(EgridThereAndBack, SetsOfCoordinateLines) {
    CornerPointGrid grid = faulted_grid(2, 2, 4);
    auto second = grid.pillars;
    for (double& v : second) v += 1;
    grid.pillars.insert(grid.pillars.end(), second.begin(), second.end());
    grid.reservoirs = {{0, 1, false, false}, {2, 3, true, true}};
    write_eclipse(dataset_of(grid), GetParam(), path());
    const auto back = read_eclipse(path());
    expect_same_grid(grid, grid_of(back));
    ASSERT_EQ(grid_of(back).reservoirs.size(), 2u);
    EXPECT_EQ(grid_of(back).reservoirs[1].first_layer, 2u);
    EXPECT_TRUE(grid_of(back).reservoirs[1].complete_circle);
}

TEST_P(EgridThereAndBack, ElevationsAreWrittenAsElevations) {
    CornerPointGrid grid = faulted_grid(3, 3, 3);
    grid.info.crs.z_positive = ZPositive::elevation;
    write_eclipse(dataset_of(grid), GetParam(), path());
    const auto back = read_eclipse(path());
    expect_same_grid(grid, grid_of(back));
    ASSERT_EQ(back->findings.size(), 1u);
    EXPECT_EQ(back->findings[0].code, "F132");
}

TEST(EgridLosses, WhatItHasNoPlaceForIsListed) {
    TemporaryFolder folder;
    CornerPointGrid grid = faulted_grid(3, 3, 3);
    add_attribute(grid, "PORO", std::vector<float>(27, 0.2F));
    add_attribute(grid, "CORSNUM", std::vector<std::int32_t>(27, 0));
    grid.faults.push_back({"F1", {}, std::nullopt});
    grid.least_pore_volume = 1;
    grid.connections = {{0, 5, 2.5}};
    grid.unit_system = "FIELD";
    grid.depths[7] += 1e-6;
    Dataset data = dataset_of(grid);
    data.objects.emplace_back(PointSet{});
    const auto losses = write_eclipse(data, "egrid", folder / "other.EGRID");
    EXPECT_EQ(count(losses, LossClass::substance), 5u);  // PORO, fault, MINPV, transmissibility, points
    EXPECT_EQ(count(losses, LossClass::identity), 3u);   // name, unit system, rounding
    const auto back = read_eclipse(folder / "other.EGRID");
    EXPECT_NE(find_attribute(grid_of(back).info.attributes, "CORSNUM", AttributeLocation::cell), nullptr);
}

TEST(EgridLosses, NothingIsWrittenWithoutAGrid) {
    TemporaryFolder folder;
    OutputSet out(folder / "a.EGRID");
    const auto losses = eclipse_row("egrid").write(Dataset{}, out, {});
    ASSERT_FALSE(losses.ok());
    EXPECT_EQ(losses.why().error.code, "F021");
}

class InitThereAndBack : public testing::TestWithParam<const char*> {
protected:
    std::filesystem::path path() const { return folder_ / (std::string("faulted.") + GetParam()); }
    TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Forms, InitThereAndBack, testing::Values("init", "finit"));

TEST_P(InitThereAndBack, PropertiesOfActiveCells) {
    CornerPointGrid grid = faulted_grid(3, 2, 2);
    grid.pillars.clear();
    grid.depths.clear();
    grid.unit_system = "FIELD";
    std::vector<float> poro(12);
    std::vector<double> exact(12);
    std::vector<std::int32_t> region(12);
    std::vector<std::uint8_t> flag(12);
    std::vector<std::string> names(12);
    for (std::size_t c = 0; c < 12; ++c) {
        poro[c] = 0.1F + 0.01F * static_cast<float>(c);
        exact[c] = -1.0 / (7.0 + static_cast<double>(c));
        region[c] = static_cast<std::int32_t>(c) - 5;
        flag[c] = c % 2;
        names[c] = "c" + std::to_string(c);
    }
    poro[1] = static_cast<float>(-9.99e20);
    add_attribute(grid, "PORO", poro).no_data = static_cast<double>(poro[1]);
    exact[1] = static_cast<double>(poro[1]);
    add_attribute(grid, "EXACT", exact).no_data = exact[1];
    region[1] = -2147483647;
    add_attribute(grid, "FIPNUM", region).no_data = -2147483647;
    flag[1] = 255;
    add_attribute(grid, "FLAG", flag).no_data = 255;
    grid.info.attributes.back().annotations.emplace_back("eclipse.type", "LOGI");
    names[1] = "";
    add_attribute(grid, "NAMES", names);
    const auto losses = write_eclipse(dataset_of(grid), GetParam(), path());
    EXPECT_EQ(count(losses, LossClass::substance), 0u);
    const auto back = read_eclipse(path());
    const CornerPointGrid& b = grid_of(back);
    EXPECT_EQ(b.activity, grid.activity);
    EXPECT_EQ(b.unit_system, "FIELD");
    ASSERT_EQ(b.info.attributes.size(), 5u);
    for (std::size_t a = 0; a < 5; ++a) {
        EXPECT_EQ(b.info.attributes[a].values, grid.info.attributes[a].values) << b.info.attributes[a].name;
        EXPECT_EQ(b.info.attributes[a].no_data, grid.info.attributes[a].no_data);
    }
}

TEST_P(InitThereAndBack, DualPorosityAndPoreVolumes) {
    CornerPointGrid grid = faulted_grid(2, 2, 1);
    grid.pillars.clear();
    grid.depths.clear();
    grid.porosity = CornerPointGrid::Porosity::dual_porosity;
    grid.activity = {3, 1, 2, 0};
    const auto none = static_cast<float>(-9.99e20);
    add_attribute(grid, "PORV", std::vector<float>{10, 20, 0, 0});
    add_attribute(grid, "PORV:fracture", std::vector<float>{1, 0, 2, 0});
    add_attribute(grid, "PERMX", std::vector<float>{5, 6, none, none}).no_data = static_cast<double>(none);
    add_attribute(grid, "PERMX:fracture", std::vector<float>{7, none, 8, none}).no_data = static_cast<double>(none);
    const auto losses = write_eclipse(dataset_of(grid), GetParam(), path());
    EXPECT_EQ(count(losses, LossClass::substance), 0u);
    const auto back = read_eclipse(path());
    const CornerPointGrid& b = grid_of(back);
    EXPECT_EQ(b.dims, grid.dims);
    EXPECT_EQ(b.activity, grid.activity);
    ASSERT_EQ(b.info.attributes.size(), 4u);
    for (std::size_t a = 0; a < 4; ++a) {
        EXPECT_EQ(b.info.attributes[a].name, grid.info.attributes[a].name);
        EXPECT_EQ(b.info.attributes[a].values, grid.info.attributes[a].values);
    }
}

TEST_P(InitThereAndBack, StandsOnTheGridBesideIt) {
    CornerPointGrid grid = with_frame(faulted_grid(4, 3, 2));
    grid.connections = {{0, 4, 1.5}, {2, 9, 0.25}};
    add_attribute(grid, "PORO", std::vector<float>(grid.cell_count(), 0.25F));
    write_eclipse(dataset_of(grid), "egrid", folder_ / "faulted.EGRID");
    const auto losses = write_eclipse(dataset_of(grid), GetParam(), path());
    EXPECT_EQ(count(losses, LossClass::substance), 2u);  // corners, cells of the connections
    const auto back = read_eclipse(path());
    expect_same_grid(grid, grid_of(back));
    expect_same_connections(grid.connections, grid_of(back).connections);
    EXPECT_EQ(grid_of(back).connections[1].transmissibility, 0.25);
    EXPECT_TRUE(back->findings.empty());
}

TEST_P(InitThereAndBack, AGridOfOtherSizeBesideItIsNotUsed) {
    CornerPointGrid grid = faulted_grid(4, 3, 2);
    write_eclipse(dataset_of(faulted_grid(4, 3, 3)), "egrid", folder_ / "faulted.EGRID");
    add_attribute(grid, "PORO", std::vector<float>(grid.cell_count(), 0.25F));
    write_eclipse(dataset_of(grid), GetParam(), path());
    const auto back = read_eclipse(path());
    EXPECT_TRUE(grid_of(back).depths.empty());
    ASSERT_EQ(back->findings.size(), 1u);
    EXPECT_EQ(back->findings[0].code, "F133");
}

TEST(RealInitThereAndBack, EveryArrayComesBack) {
    const auto path = real_data("cornerpoint/small/TEST_DP.INIT");
    if (!path) GTEST_SKIP() << "no real data";
    TemporaryFolder folder;
    const auto input = Input::from_memory(read_file(*path), "alone.INIT");
    const auto data = sniffed(input).read(input, {});
    ASSERT_TRUE(data.ok());
    write_eclipse(*data, "init", folder / "alone.INIT");
    const auto back = read_eclipse(folder / "alone.INIT");
    const CornerPointGrid &a = grid_of(data), &b = grid_of(back);
    EXPECT_EQ(a.activity, b.activity);
    ASSERT_EQ(a.info.attributes.size(), b.info.attributes.size());
    for (const Attribute& attribute : a.info.attributes) {
        const Attribute* same = find_attribute(b.info.attributes, attribute.name, AttributeLocation::cell);
        ASSERT_NE(same, nullptr) << attribute.name;
        EXPECT_EQ(same->values, attribute.values) << attribute.name;
    }
    ASSERT_EQ(a.info.annotations.size(), b.info.annotations.size());
    for (const Annotation& annotation : a.info.annotations) {
        EXPECT_TRUE(std::ranges::any_of(b.info.annotations, [&](const Annotation& o) { return o.value == annotation.value; }))
            << annotation.value.substr(0, 40);
    }
}

TEST(BgrdeclThereAndBack, GridAndProperties) {
    TemporaryFolder folder;
    CornerPointGrid grid = with_frame(faulted_grid(4, 3, 2));
    add_attribute(grid, "PORO", std::vector<float>(24, 0.25F));
    add_attribute(grid, "Zone", std::vector<std::int32_t>(24, 7));
    add_attribute(grid, "a long name", std::vector<double>(24, 0.1));
    add_attribute(grid, "a long namesake", std::vector<double>(24, 0.2));
    const auto losses = write_eclipse(dataset_of(grid), "bgrdecl", folder / "faulted.bgrdecl");
    EXPECT_EQ(count(losses, LossClass::substance), 0u);
    EXPECT_EQ(count(losses, LossClass::identity), 2u);
    const auto back = read_eclipse(folder / "faulted.bgrdecl");
    expect_same_grid(grid, grid_of(back));
    const auto& attributes = grid_of(back).info.attributes;
    ASSERT_EQ(attributes.size(), 4u);
    EXPECT_EQ(attributes[1].name, "Zone");
    EXPECT_EQ(attributes[3].name, "a long 2");
    for (std::size_t a = 0; a < 4; ++a) EXPECT_EQ(attributes[a].values, grid.info.attributes[a].values);
}

TEST(FortranReals, AreReadBackToTheSameValue) {
    EXPECT_EQ(eclipse::fortran_real(0.0F), "0.00000000E+00");
    EXPECT_EQ(eclipse::fortran_real(1999.5F), "0.19995000E+04");
    EXPECT_EQ(eclipse::fortran_real(-25.0F), "-0.25000000E+02");
    EXPECT_EQ(eclipse::fortran_real(1.0), "0.10000000000000D+01");
    std::uint64_t random = 42;
    for (int i = 0; i < 20000; ++i) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        const auto f = std::bit_cast<float>(static_cast<std::uint32_t>(random >> 32));
        if (std::isfinite(f)) {
            const std::string text = eclipse::fortran_real(f);
            EXPECT_LE(text.size(), 16u);
            EXPECT_EQ(std::strtof(text.c_str(), nullptr), f) << text;
        }
        const double d = std::ldexp(static_cast<double>(random >> 11), static_cast<int>(random % 100) - 90) * (i % 2 == 0 ? 1 : -1);
        std::string text = eclipse::fortran_real(d);
        EXPECT_LE(text.size(), 22u);
        if (const std::size_t at = text.find('D'); at != std::string::npos) text[at] = 'E';
        EXPECT_EQ(std::strtod(text.c_str(), nullptr), d) << text;
    }
}

TEST(BgrdeclThereAndBack, PoreVolumesKeepTheirName) {
    const TemporaryFolder folder;
    CornerPointGrid grid = faulted_grid(2, 2, 1);
    add_attribute(grid, "PORV", std::vector<float>(4, 12.5F));
    write_eclipse(dataset_of(grid), "bgrdecl", folder / "a.bgrdecl");
    EXPECT_NE(find_attribute(grid_of(read_eclipse(folder / "a.bgrdecl")).info.attributes, "PORV", AttributeLocation::cell), nullptr);
}

}  // namespace
}  // namespace geomend::test
