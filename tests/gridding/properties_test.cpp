// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gridding/place_finder.h"
#include "gridding/sampled_properties.h"
#include "made_models.h"

// Properties of other objects brought to the cells of a grid.

namespace geomend::gridding::test {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// nx by ny by nz cells of 10 x 10 x 2 between depths 100 and 100 + 2 nz.
CornerPointGrid flat_grid(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz) {
    Structure structure;
    for (int h = 0; h < 2; ++h)
        structure.horizons.push_back(map("h" + std::to_string(h), nx + 1, ny + 1, 10, [&](double, double) { return 100 + 2.0 * nz * h; }));
    return grid(structure, net(nx, ny, 10, 10), {proportional(nz)}).grid;
}

Attribute attribute(const std::string& name, AttributeLocation location, AttributeValues values) {
    Attribute a;
    a.name = name;
    a.location = location;
    a.values = std::move(values);
    return a;
}

/// A voxet of samples in the middle of the grid's cells and as many layers as is said, with values by place.
template <class Value>
Raster voxet(std::uint32_t nx, std::uint32_t ny, std::uint32_t layers, double height, const Value& value) {
    Raster raster;
    raster.info.name = "voxet";
    raster.dims = {nx, ny, layers};
    raster.origin = {5, 5, -100 - height / layers / 2};
    raster.step = {Vec3{10, 0, 0}, Vec3{0, 10, 0}, Vec3{0, 0, -height / layers}};
    std::vector<double> values;
    for (std::uint32_t k = 0; k < layers; ++k) {
        for (std::uint32_t j = 0; j < ny; ++j) {
            for (std::uint32_t i = 0; i < nx; ++i) values.push_back(value(i, j, k));
        }
    }
    raster.info.attributes.push_back(attribute("PERM", AttributeLocation::point, std::move(values)));
    return raster;
}

const std::vector<double>& reals(const SampledProperties& s, std::size_t a = 0) {
    return std::get<std::vector<double>>(s.attributes.at(a).values);
}

std::vector<Object> objects(Object object) {
    std::vector<Object> all;
    all.push_back(std::move(object));
    return all;
}

std::vector<PropertyRule> rule(const std::string& name, Averaging how) { return {{name, how}}; }

TEST(Means, OfValuesWithWeights) {
    const std::vector<double> values{1, 4, none, 4}, weights{3, 1, 7, 1};
    EXPECT_DOUBLE_EQ(mean_of(values, weights), 11.0 / 5);
    EXPECT_EQ(majority_of(values, weights), 1);
    EXPECT_EQ(majority_of(std::vector<double>{7, 2}, std::vector<double>{1, 1}), 2);  // of equal ones the lowest
    EXPECT_DOUBLE_EQ(harmonic_of(values, weights), 5 / (3 + 0.25 + 0.25));
    EXPECT_EQ(harmonic_of(std::vector<double>{0, 5}, std::vector<double>{1, 1}), 0);
    EXPECT_TRUE(std::isnan(mean_of(std::vector<double>{none}, std::vector<double>{1})));
    EXPECT_TRUE(std::isnan(harmonic_of(std::vector<double>{none}, std::vector<double>{1})));
    // Two columns: 2 and 6 on top of each other, then 3 and nothing.
    const std::vector<double> columns{2, 6, 3, none}, one{1, 1, 1, 1};
    EXPECT_DOUBLE_EQ(harmonic_down(columns, one, 2), (3 * 2 + 3 * 1) / 3.0);
}

TEST(Means, RulesAreReadAndWrongOnesNamed) {
    const std::vector<std::string> good{"PORO", "KZ=harmonic", "a=b=nearest"};
    const auto rules = parse_properties(good);
    ASSERT_TRUE(rules.ok());
    EXPECT_FALSE((*rules)[0].how.has_value());
    EXPECT_EQ((*rules)[1].how, Averaging::harmonic);
    EXPECT_EQ((*rules)[2].name, "a=b");
    for (const char* word : {"KZ=geometric", "=mean", ""}) EXPECT_FALSE(parse_properties(std::vector<std::string>{word}).ok()) << word;
    EXPECT_FALSE(parse_properties(std::vector<std::string>{"A", "A=mean"}).ok());
}

TEST(Properties, AVoxetOfTheSameCellsIsTakenToTheDigit) {
    const auto grid = flat_grid(3, 2, 4);
    const auto sources = objects(voxet(3, 2, 4, 8, [](auto i, auto j, auto k) { return 100.0 * k + 10 * j + i; }));
    for (const Averaging how : {Averaging::nearest, Averaging::mean, Averaging::majority}) {
        const auto sampled = sample_properties(grid, sources, rule("PERM", how));
        ASSERT_TRUE(sampled.ok());
        for (std::size_t c = 0; c < grid.cell_count(); ++c) {
            const auto [i, j, k] = grid.ijk(c);
            EXPECT_NEAR(reals(*sampled)[c], 100.0 * k + 10 * j + i, 1e-12) << to_string(how);
        }
    }
}

TEST(Properties, LayersWithinACellAreAveragedAsAsked) {
    const auto grid = flat_grid(2, 2, 1);  // one layer of 2 m over four of the voxet
    const auto sources = objects(voxet(2, 2, 4, 2, [](auto, auto, auto k) { return k == 0 ? 1.0 : 4.0; }));
    const auto value = [&](Averaging how) { return reals(*sample_properties(grid, sources, rule("PERM", how)))[0]; };
    EXPECT_NEAR(value(Averaging::mean), 3.25, 1e-12);
    EXPECT_NEAR(value(Averaging::harmonic), 4 / (1 + 0.75), 1e-12);
    EXPECT_EQ(value(Averaging::majority), 4);
}

TEST(Properties, WhatReachesNotAllCellsLeavesTheOthersWithoutAValue) {
    const auto grid = flat_grid(4, 2, 1);
    const auto sources = objects(voxet(2, 2, 1, 2, [](auto, auto, auto) { return 7.0; }));  // one sample high: it holds at all heights
    const auto sampled = sample_properties(grid, sources, {});
    ASSERT_TRUE(sampled.ok());
    EXPECT_EQ(sampled->report[0].with, 4u);
    EXPECT_EQ(sampled->report[0].without, 4u);
    EXPECT_EQ(reals(*sampled)[0], 7);
    EXPECT_EQ(reals(*sampled)[3], no_sample);
    EXPECT_EQ(sampled->attributes[0].no_data, no_sample);
    EXPECT_FALSE(sample_properties(grid, sources, rule("PORO", Averaging::mean)).ok());
}

TEST(Properties, TheNearestWithinACellIsTakenWhereNothingLiesAtItsMiddle) {
    const auto grid = flat_grid(3, 1, 1);
    // One layer of samples in the upper third of the cells of 2, and none over the third column.
    Raster above = voxet(2, 1, 2, 0.6, [](auto i, auto, auto k) { return 10.0 * (i + 1) + k; });
    const auto sampled = sample_properties(grid, objects(std::move(above)), rule("PERM", Averaging::nearest));
    ASSERT_TRUE(sampled.ok());
    EXPECT_EQ(reals(*sampled), (std::vector<double>{11, 21, no_sample})) << "the lower layer is nearer to the middle";
    EXPECT_EQ(sampled->report[0].with, 2u);
    EXPECT_EQ(sampled->report[0].without, 1u);
}

TEST(Properties, CellsOfAnotherGridKeepTheirCodes) {
    CornerPointGrid fine = flat_grid(8, 8, 4);
    const auto coarse = flat_grid(4, 4, 4);  // twice as wide: the same layers over four times the area
    std::vector<std::int32_t> facies;
    for (std::size_t c = 0; c < fine.cell_count(); ++c) {
        const auto [i, j, k] = fine.ijk(c);
        facies.push_back(static_cast<std::int32_t>(10 * k + (i % 2 == 0 || j % 2 == 0 ? 1 : 2)));
    }
    fine.info.attributes = {attribute("FACIES", AttributeLocation::cell, std::move(facies))};
    fine.info.attributes[0].code_names = {{1, "sand"}};
    const auto sampled = sample_properties(coarse, objects(fine), {});
    ASSERT_TRUE(sampled.ok());
    EXPECT_EQ(sampled->report[0].how, Averaging::majority);
    EXPECT_EQ(sampled->attributes[0].code_names.size(), 1u);
    const auto& codes = std::get<std::vector<std::int32_t>>(sampled->attributes[0].values);
    for (std::size_t c = 0; c < coarse.cell_count(); ++c) {
        const auto [i, j, k] = coarse.ijk(c);
        // Cells 10 m wide, as the fine ones: those of I and J even and odd alternate.
        EXPECT_EQ(codes[c], static_cast<std::int32_t>(10 * k + (i % 2 == 0 || j % 2 == 0 ? 1 : 2)));
    }
}

TEST(Properties, TetrahedraGiveValuesAndRegions) {
    const auto grid = flat_grid(2, 1, 1);
    CellMesh mesh;  // two tetrahedra that hold the middles of the two cells
    mesh.points = {{-50, -50, -90}, {10, 50, -100}, {10, -50, -150}, {10, 0, -50}, {70, -50, -90}};
    mesh.add_cell(CellType::tetrahedron, std::vector<std::uint32_t>{0, 1, 2, 3});
    mesh.add_cell(CellType::tetrahedron, std::vector<std::uint32_t>{1, 2, 3, 4});
    mesh.entities.resize(3);
    mesh.entities[0].name = "west";
    mesh.entities[1].dimension = 2;
    mesh.entities[2].name = "east";
    mesh.cell_entity = {0, 2};
    mesh.info.attributes = {attribute("phi", AttributeLocation::cell, std::vector<double>{0.1, 0.3})};
    const auto sampled = sample_properties(grid, objects(std::move(mesh)), {});
    ASSERT_TRUE(sampled.ok());
    ASSERT_EQ(sampled->attributes.size(), 2u);
    EXPECT_NEAR(reals(*sampled)[0], 0.1, 1e-12);
    EXPECT_NEAR(reals(*sampled)[1], 0.3, 1e-12);
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(sampled->attributes[1].values), (std::vector<std::int32_t>{1, 2}));
    EXPECT_EQ(sampled->attributes[1].code_names[1].second, "east");
}

TEST(Properties, AWellGivesTheCellsItPassesThrough) {
    const auto grid = flat_grid(3, 3, 5);
    Well well;
    well.info.name = "W";
    well.path = {{15, 15, 0}, {15, 15, -120}};
    well.measured_depth = {0, 120};
    Well::Curve curve;
    curve.values = attribute("PHI", AttributeLocation::point, std::vector<double>{});
    auto& values = std::get<std::vector<double>>(curve.values.values);
    for (double depth = 90.25; depth < 112; depth += 0.5) {
        curve.measured_depth.push_back(depth);
        values.push_back(depth < 101 ? 1 : depth < 102 ? 3 : depth < 104 ? -999.25 : 5);
    }
    curve.values.no_data = -999.25;
    well.curves.push_back(std::move(curve));
    const auto sampled = sample_properties(grid, objects(std::move(well)), {});
    ASSERT_TRUE(sampled.ok());
    EXPECT_EQ(sampled->report[0].with, 4u);  // of five layers one has no value in the curve
    EXPECT_DOUBLE_EQ(reals(*sampled)[grid.cell(1, 1, 0)], 2);
    EXPECT_EQ(reals(*sampled)[grid.cell(1, 1, 1)], no_sample);
    EXPECT_DOUBLE_EQ(reals(*sampled)[grid.cell(1, 1, 2)], 5);
    EXPECT_EQ(reals(*sampled)[grid.cell(0, 1, 2)], no_sample);
}

TEST(Properties, ALatticeOfObliqueStepsIsLookedUpByThem) {
    Raster raster;
    raster.dims = {3, 4, 1};
    raster.origin = {100, 200, 0};
    raster.step = {Vec3{3, 4, 0}, Vec3{-2, 7, 0}, Vec3{0, 0, 1}};
    const auto finder = PlaceFinder::of(Object(raster));
    ASSERT_TRUE(finder.has_value());
    for (std::uint32_t j = 0; j < 4; ++j) {
        for (std::uint32_t i = 0; i < 3; ++i) {
            const Vec3 at = sample_position(raster, i, j, 0);
            EXPECT_EQ(finder->at({at[0] + 0.3, at[1] - 0.2, 1234}).point, i + 3 * j);
        }
    }
    EXPECT_EQ(finder->at({90, 190, 0}).point, no_index);
}

}  // namespace
}  // namespace geomend::gridding::test
