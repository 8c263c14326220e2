// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/attribute_operations.h"

#include <gtest/gtest.h>

#include <cmath>

namespace geomend {
namespace {

template <class Value>
Attribute attribute_of(std::vector<Value> values, std::uint32_t components = 1) {
    Attribute a;
    a.name = "a";
    a.unit = "m";
    a.components = components;
    a.values = std::move(values);
    return a;
}

template <class Value>
const std::vector<Value>& values_of(const Attribute& a) {
    return std::get<std::vector<Value>>(a.values);
}

TEST(AttributeOperations, TakeRows) {
    const Attribute a = attribute_of<float>({1, 2, 3, 4, 5, 6}, 2);
    const std::vector<std::uint32_t> rows{2, 0, 2};
    const Attribute t = taken(a, rows);
    EXPECT_EQ(values_of<float>(t), (std::vector<float>{5, 6, 1, 2, 5, 6}));
    EXPECT_EQ(t.unit, "m");
    EXPECT_EQ(t.components, 2u);
    EXPECT_EQ(values_of<std::string>(taken(attribute_of<std::string>({"x", "y", "z"}), rows)), (std::vector<std::string>{"z", "x", "z"}));
    const std::vector<std::uint32_t> with_none{1, no_index};
    Attribute numbers = attribute_of<std::int32_t>({7, 8});
    numbers.no_data = -999;
    EXPECT_EQ(values_of<std::int32_t>(taken(numbers, with_none)), (std::vector<std::int32_t>{8, -999}));
    EXPECT_TRUE(std::isnan(values_of<double>(taken(attribute_of<double>({1, 2}), with_none))[1]));
}

TEST(AttributeOperations, ResizeWithMissingValues) {
    Attribute a = attribute_of<std::uint8_t>({1});
    a.no_data = -99999;  // no byte
    resize_with_missing(a, 2);
    EXPECT_EQ(values_of<std::uint8_t>(a), (std::vector<std::uint8_t>{1, 0}));
    resize_with_missing(a, 0);
    EXPECT_EQ(value_count(a), 0u);
}

TEST(AttributeOperations, InterpolateNumbersAndTakeTheNearestOfCodes) {
    const std::vector<Sample> samples{{{0, 1, 2}, {0.5, 0.25, 0.25}}, {{0, 1, 2}, {0, 1, 0}}, {{0, 1, 2}, {0.2, 0.4, 0.4}}};
    const Attribute numbers = interpolated(attribute_of<double>({8, 0.1, 4}), samples);
    EXPECT_NEAR(values_of<double>(numbers)[0], 5.025, 1e-15);
    EXPECT_EQ(values_of<double>(numbers)[1], 0.1) << "to the bit";
    EXPECT_EQ(values_of<std::int16_t>(interpolated(attribute_of<std::int16_t>({8, 3, 4}), samples)), (std::vector<std::int16_t>{8, 3, 3}));
    EXPECT_EQ(values_of<std::string>(interpolated(attribute_of<std::string>({"a", "b", "c"}), samples)),
              (std::vector<std::string>{"a", "b", "b"}));
}

TEST(AttributeOperations, MissingValuesCountForNothing) {
    Attribute a = attribute_of<double>({10, -99999, 20, 1, 2, 3}, 2);
    a.no_data = -99999;
    const std::vector<Sample> samples{{{0, 1, 2}, {0.5, 0.25, 0.25}}, {{0, 1, 2}, {0.2, 0.6, 0.2}}};
    const Attribute between = interpolated(a, samples);
    const std::vector<double>& v = values_of<double>(between);
    EXPECT_DOUBLE_EQ(v[0], 0.5 * 10 + 0.25 * 20 + 0.25 * 2);
    EXPECT_EQ(v[1], -99999) << "the nearest is missing";
    EXPECT_DOUBLE_EQ(v[3], (0.6 * 1 + 0.2 * 3) / 0.8) << "the others share";
}

TEST(AttributeOperations, ValuesAreCarriedByAnOrigin) {
    TriangleSoup source;
    source.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    source.triangles = {{0, 1, 2}};
    source.patches = {0};
    Origin o = identity_origin(source);
    o.vertices.push_back(Origin::from_triangle(0, {0.5, 0.5, 0}));
    o.vertices.emplace_back();
    o.triangles = {0, 0, no_index};
    const Attribute points = carried(attribute_of<double>({0.1, 0.3, 7}), o, source);
    EXPECT_EQ(values_of<double>(points)[0], 0.1);
    EXPECT_DOUBLE_EQ(values_of<double>(points)[3], 0.2);
    EXPECT_TRUE(std::isnan(values_of<double>(points)[4]));
    Attribute of_triangles = attribute_of<std::int32_t>({42});
    of_triangles.location = AttributeLocation::polygon;
    EXPECT_EQ(values_of<std::int32_t>(carried(of_triangles, o, source)), (std::vector<std::int32_t>{42, 42, 0}));
}

}  // namespace
}  // namespace geomend
