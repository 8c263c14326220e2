// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "model/attribute.h"
#include "model/origin.h"

namespace geomend {

/// Whether two values of one type are the same: equal, or both NaN.
template <class Value>
bool same_value(const Value& a, const Value& b) {
    if constexpr (std::is_floating_point_v<Value>) return a == b || (a != a && b != b);
    else return a == b;
}

/// The values of some things: row i of the result is row rows[i], all components. \pre each row is there. Linear.
AttributeValues taken(const AttributeValues& values, std::span<const std::uint32_t> rows, std::uint32_t components);
/// An attribute of some things, with all that describes it; where rows[i] is no_index, thing i has no value (see
/// resize_with_missing()). Linear.
Attribute taken(const Attribute& attribute, std::span<const std::uint32_t> rows);

/// Makes an attribute long enough for, or cuts it to, a number of things; new ones have the no-data value, or without one
/// NaN, zero (integers, or a no-data value that the type cannot hold) or an empty text.
void resize_with_missing(Attribute& attribute, std::size_t things);

/// Where a new value comes from: three things with their shares. Rows with share 0 are not looked at; no_index in the
/// first row: there is no value.
struct Sample {
    std::array<std::uint32_t, 3> rows;
    Weights weights;
};

/// Values between others. Floating-point values are weighted sums; integers and texts are those of the largest share (of equal
/// ones the first). No-data values count for nothing: where the row of the largest share is missing so is the result, else
/// the others share their weights out. A share of 1 gives the value to the bit. Component by component. Linear.
Attribute interpolated(const Attribute& attribute, std::span<const Sample> samples);

/// An attribute of a soup's vertices (point) or triangles (polygon) brought to the result of a cut or an edit. Vertices that
/// are source vertices and triangles keep their values to the bit; what was made from nothing has none.
/// \pre the origin passes check(), the attribute stands on vertices or triangles of the source
Attribute carried(const Attribute& attribute, const Origin& origin, const TriangleSoup& source);

}  // namespace geomend
