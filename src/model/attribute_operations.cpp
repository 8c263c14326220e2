// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/attribute_operations.h"

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace geomend {

namespace {

/// The value that stands for "none" in a new place.
template <class Value>
Value missing_value_of(const Attribute& a) {
    if constexpr (std::is_same_v<Value, std::string>) {
        return {};
    } else if constexpr (std::is_floating_point_v<Value>) {
        return a.no_data ? static_cast<Value>(*a.no_data) : std::numeric_limits<Value>::quiet_NaN();
    } else {
        const bool fits = a.no_data && *a.no_data >= static_cast<double>(std::numeric_limits<Value>::min()) &&
                          *a.no_data <= static_cast<double>(std::numeric_limits<Value>::max() / 2);
        return fits ? static_cast<Value>(*a.no_data) : Value{0};
    }
}

std::size_t heaviest(const Weights& w) { return static_cast<std::size_t>(std::max_element(w.begin(), w.end()) - w.begin()); }

/// One component of one sample. \pre the first row is there
template <class Value>
Value value_between(const Attribute& a, const std::vector<Value>& values, const Sample& sample, std::uint32_t component) {
    const auto at = [&](std::size_t i) { return values[std::size_t{sample.rows[i]} * a.components + component]; };
    const std::size_t first = heaviest(sample.weights);
    if constexpr (!std::is_floating_point_v<Value>) {
        return at(first);
    } else {
        if (sample.weights[first] == 1 || is_no_data(a, static_cast<double>(at(first)))) return at(first);
        double sum = 0, shares = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (sample.weights[i] == 0 || is_no_data(a, static_cast<double>(at(i)))) continue;
            sum += sample.weights[i] * static_cast<double>(at(i));
            shares += sample.weights[i];
        }
        return static_cast<Value>(sum / shares);
    }
}

Attribute of_vertices(const Attribute& attribute, const Origin& origin, const TriangleSoup& source) {
    std::vector<Sample> samples;
    samples.reserve(origin.vertices.size());
    for (const Origin::Vertex& v : origin.vertices) {
        if (v.triangle != no_index) samples.push_back({source.triangles[v.triangle], v.weights});
        else samples.push_back({{v.vertex, v.vertex, v.vertex}, {1, 0, 0}});
    }
    return interpolated(attribute, samples);
}

}  // namespace

AttributeValues taken(const AttributeValues& values, std::span<const std::uint32_t> rows, std::uint32_t components) {
    return std::visit(
        [&](const auto& all) -> AttributeValues {
            std::decay_t<decltype(all)> some;
            some.reserve(rows.size() * components);
            for (const std::uint32_t row : rows) {
                const auto at = all.begin() + static_cast<std::ptrdiff_t>(std::size_t{row} * components);
                some.insert(some.end(), at, at + components);
            }
            return some;
        },
        values);
}

Attribute taken(const Attribute& attribute, std::span<const std::uint32_t> rows) {
    Attribute result = without_values(attribute);
    if (std::find(rows.begin(), rows.end(), no_index) == rows.end()) {
        result.values = taken(attribute.values, rows, attribute.components);
        return result;
    }
    std::vector<Sample> samples;
    samples.reserve(rows.size());
    for (const std::uint32_t row : rows) samples.push_back({{row, row, row}, {1, 0, 0}});
    return interpolated(attribute, samples);
}

void resize_with_missing(Attribute& attribute, std::size_t things) {
    std::visit(
        [&](auto& values) {
            using Value = typename std::decay_t<decltype(values)>::value_type;
            values.resize(things * attribute.components, missing_value_of<Value>(attribute));
        },
        attribute.values);
}

Attribute interpolated(const Attribute& attribute, std::span<const Sample> samples) {
    Attribute result = without_values(attribute);
    std::visit(
        [&](const auto& values) {
            using Values = std::decay_t<decltype(values)>;
            Values between;
            between.reserve(samples.size() * attribute.components);
            const auto missing = missing_value_of<typename Values::value_type>(attribute);
            for (const Sample& sample : samples) {
                for (std::uint32_t k = 0; k < attribute.components; ++k) {
                    between.push_back(sample.rows[0] == no_index ? missing : value_between(attribute, values, sample, k));
                }
            }
            result.values = std::move(between);
        },
        attribute.values);
    return result;
}

Attribute carried(const Attribute& attribute, const Origin& origin, const TriangleSoup& source) {
    if (attribute.location == AttributeLocation::polygon) return taken(attribute, origin.triangles);
    return of_vertices(attribute, origin, source);
}

}  // namespace geomend
