// SPDX-License-Identifier: AGPL-3.0-or-later
#include "roff_testing.h"
#include "support/corner_point_samples.h"

namespace geomend::test {
namespace {

bool has_class(const std::vector<Loss>& losses, LossClass c) {
    for (const Loss& l : losses) {
        if (l.loss_class == c) return true;
    }
    return false;
}

void expect_same_grid(const CornerPointGrid& a, const CornerPointGrid& b) {
    EXPECT_EQ(a.dims, b.dims);
    EXPECT_EQ(a.pillars, b.pillars);
    EXPECT_EQ(a.depths, b.depths);
    EXPECT_EQ(a.activity, b.activity);
}

class RoffThereAndBack : public testing::TestWithParam<bool> {
protected:
    const Format& row() const { return GetParam() ? text_row() : binary_row(); }
    TemporaryFolder folder_;
    std::filesystem::path path() const { return folder_ / "faulted.roff"; }
};
INSTANTIATE_TEST_SUITE_P(Forms, RoffThereAndBack, testing::Bool());

TEST_P(RoffThereAndBack, FaultedGridComesBackBitByBit) {
    const CornerPointGrid grid = faulted_grid(6, 4, 5);
    const auto losses = write_roff(grid, row(), path());
    EXPECT_FALSE(has_class(losses, LossClass::substance));
    EXPECT_FALSE(has_class(losses, LossClass::identity));
    auto back = read_roff(path());
    expect_same_grid(grid, grid_of(back));
}

TEST_P(RoffThereAndBack, GapsBetweenLayersNeedNodesOfTwoAndEight) {
    const CornerPointGrid grid = faulted_grid(5, 3, 7, true);
    write_roff(grid, row(), path());
    auto back = read_roff(path());
    expect_same_grid(grid, grid_of(back));
}

TEST_P(RoffThereAndBack, LargeCoordinatesKeepTheirDigitsAroundAnOffset) {
    CornerPointGrid grid = faulted_grid(6, 4, 5);
    for (std::size_t v = 0; v < grid.pillars.size(); v += 3) {
        grid.pillars[v] += 461860.5;
        grid.pillars[v + 1] += 5932880.25;
    }
    const auto losses = write_roff(grid, row(), path());
    EXPECT_FALSE(has_class(losses, LossClass::substance));
    EXPECT_FALSE(has_class(losses, LossClass::identity));
    auto back = read_roff(path());
    expect_same_grid(grid, grid_of(back));
}

TEST_P(RoffThereAndBack, RoundingIsTold) {
    CornerPointGrid grid = faulted_grid(3, 3, 3);
    grid.depths[5] += 1e-5;
    const auto losses = write_roff(grid, row(), path());
    EXPECT_FALSE(has_class(losses, LossClass::substance));
    ASSERT_TRUE(has_class(losses, LossClass::identity));
    grid.depths[5] = 1e10 + 3000;
    EXPECT_TRUE(has_class(write_roff(grid, row(), folder_ / "far.roff"), LossClass::substance));
}

TEST_P(RoffThereAndBack, CoordinatesBeyondSinglePrecisionCannotBeHeld) {
    for (const bool depth : {false, true}) {
        CornerPointGrid grid = faulted_grid(3, 3, 3);
        (depth ? grid.depths[5] : grid.pillars[0]) = 1e300;
        Dataset data;
        data.objects.emplace_back(std::move(grid));
        OutputSet out(path());
        const auto written = row().write(data, out, {});
        ASSERT_FALSE(written.ok());
        EXPECT_EQ(written.why().kind, FailureKind::cannot_hold);
    }
}

TEST_P(RoffThereAndBack, ElevationsStayElevationsInTheFile) {
    CornerPointGrid grid = faulted_grid(3, 3, 3);
    grid.info.crs.z_positive = ZPositive::elevation;
    write_roff(grid, row(), path());
    auto back = read_roff(path());
    expect_same_grid(grid, grid_of(back));
    EXPECT_EQ(grid_of(back).info.crs.z_positive, ZPositive::elevation);
    ASSERT_EQ(back->findings.size(), 1u);
    EXPECT_EQ(back->findings[0].code, "F132");
}

TEST_P(RoffThereAndBack, ParametersOfAllTypesComeBack) {
    CornerPointGrid grid = faulted_grid(3, 2, 2);
    const std::size_t n = grid.cell_count();
    const auto add = [&](std::string name, AttributeValues values) -> Attribute& {
        Attribute a;
        a.name = std::move(name);
        a.location = AttributeLocation::cell;
        a.values = std::move(values);
        grid.info.attributes.push_back(std::move(a));
        return grid.info.attributes.back();
    };
    std::vector<float> f(n);
    std::vector<double> d(n);
    std::vector<std::int32_t> i(n);
    std::vector<std::uint8_t> b(n), flag(n);
    std::vector<std::string> s(n);
    for (std::size_t c = 0; c < n; ++c) {
        f[c] = 0.1F * static_cast<float>(c);
        d[c] = 1.0 / (3.0 + static_cast<double>(c));
        i[c] = static_cast<std::int32_t>(1000000 * c);
        b[c] = static_cast<std::uint8_t>(20 * c);
        flag[c] = c % 2;
        s[c] = "cell " + std::to_string(c);
    }
    add("a real", f).no_data = -999.0;
    add("double", d).no_data = -999.0;
    add("codes", i).no_data = -999;
    grid.info.attributes.back().code_names = {{1, "sand"}, {2, "shale and clay"}};
    add("bytes", b).no_data = 255;
    add("flags", flag).annotations.emplace_back("roff.type", "bool");
    add("text", s);
    const auto losses = write_roff(grid, row(), path());
    EXPECT_FALSE(has_class(losses, LossClass::substance));
    auto back = read_roff(path());
    const auto& attributes = grid_of(back).info.attributes;
    ASSERT_EQ(attributes.size(), grid.info.attributes.size());
    for (std::size_t a = 0; a < attributes.size(); ++a) {
        EXPECT_EQ(attributes[a].name, grid.info.attributes[a].name);
        EXPECT_EQ(attributes[a].values, grid.info.attributes[a].values) << attributes[a].name;
        EXPECT_EQ(attributes[a].no_data, grid.info.attributes[a].no_data) << attributes[a].name;
        EXPECT_EQ(attributes[a].code_names, grid.info.attributes[a].code_names);
    }
}

TEST_P(RoffThereAndBack, OtherNoDataValuesBecomeThoseOfRoff) {
    CornerPointGrid grid = faulted_grid(2, 1, 1);
    Attribute a;
    a.name = "PORO";
    a.location = AttributeLocation::cell;
    a.no_data = static_cast<double>(-9.99e20F);
    a.values = std::vector<float>{0.25F, -9.99e20F};
    grid.info.attributes.push_back(a);
    a.name = "busy";
    a.values = std::vector<float>{-999.0F, -9.99e20F};
    grid.info.attributes.push_back(a);
    const auto losses = write_roff(grid, row(), path());
    auto back = read_roff(path());
    EXPECT_EQ(std::get<std::vector<float>>(grid_of(back).info.attributes[0].values), (std::vector<float>{0.25F, -999.0F}));
    EXPECT_EQ(std::get<std::vector<float>>(grid_of(back).info.attributes[1].values), (std::vector<float>{-999.0F, -9.99e20F}));
    EXPECT_TRUE(has_class(losses, LossClass::identity));
}

TEST_P(RoffThereAndBack, ParametersAloneNeedNoGeometry) {
    CornerPointGrid grid;
    grid.dims = {2, 2, 1};
    Attribute a;
    a.name = "NTG";
    a.location = AttributeLocation::cell;
    a.values = std::vector<float>{1, 2, 3, 4};
    grid.info.attributes.push_back(a);
    write_roff(grid, row(), path());
    auto back = read_roff(path());
    EXPECT_TRUE(grid_of(back).depths.empty());
    EXPECT_EQ(grid_of(back).info.attributes[0].values, a.values);
}

TEST(RoffLosses, WhatRoffHasNoPlaceForIsListed) {
    TemporaryFolder folder;
    CornerPointGrid grid = faulted_grid(2, 2, 2);
    grid.connections.push_back({0, 7, std::nullopt});
    grid.faults.push_back({"F1", {}, std::nullopt});
    grid.map_axes = std::array<double, 6>{0, 1, 0, 0, 1, 0};
    const auto losses = write_roff(grid, binary_row(), folder / "faulted.roff");
    std::size_t substance = 0, identity = 0;
    for (const Loss& l : losses) {
        substance += l.loss_class == LossClass::substance;
        identity += l.loss_class == LossClass::identity;
    }
    EXPECT_EQ(substance, 2u);
    EXPECT_EQ(identity, 1u);
}

TEST(RealRoffThereAndBack, EveryValueOfARealFileComesBack) {
    for (const char* name : {"reek/reek_sim_grid.roff", "reek/reek_grd_w_props.roffasc", "small/gridqc1.roff", "reek/reek_sim_zone.roff"}) {
        const auto path = real_data(std::string("cornerpoint/") + name);
        if (!path) GTEST_SKIP() << "no real data";
        TemporaryFolder folder;
        auto data = read_roff(*path);
        const CornerPointGrid& grid = grid_of(data);
        for (const Format* row : {&binary_row(), &text_row()}) {
            const auto losses = write_roff(grid, *row, folder / (grid.info.name + std::string(row->extensions[0])));
            for (const Loss& l : losses) EXPECT_EQ(l.loss_class, LossClass::style) << l.what;
            auto back = read_roff(folder / (grid.info.name + std::string(row->extensions[0])));
            expect_same_grid(grid, grid_of(back));
            ASSERT_EQ(grid_of(back).info.attributes.size(), grid.info.attributes.size());
            for (std::size_t a = 0; a < grid.info.attributes.size(); ++a)
                EXPECT_EQ(grid_of(back).info.attributes[a].values, grid.info.attributes[a].values);
        }
    }
}

}  // namespace
}  // namespace geomend::test
