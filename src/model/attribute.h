// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/vector_variant.h"

namespace geomend {

/// What the values of an attribute stand on. `pillar` is for corner-point grids.
enum class AttributeLocation : std::uint8_t { point, edge, polygon, cell, pillar, object };

/// The values, in the type that the file stores. Text formats without a type give double.
using AttributeValues =
    VectorVariant<std::vector<double>, std::vector<float>, std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
                  std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>, std::vector<std::int64_t>,
                  std::vector<std::uint64_t>, std::vector<std::string>>;

/// How the values of a cell attribute stand on the corners of each cell, corner after corner: surfaces that differ at
/// points which they share, and data of elements' nodes in MSH.
struct CornerValues {
    std::uint32_t components = 1;                       ///< per corner; Attribute::components is that times the corners of the largest cell
    std::optional<std::vector<std::int64_t>> surfaces;  ///< tags of the surface entities that have it; else all cells with values
    bool made_no_data = false;                          ///< no_data stands for cells of other surfaces: the property itself has none
    bool operator==(const CornerValues&) const = default;
};

/// The report step of a simulation that the values belong to.
struct TimeStep {
    std::string date;            ///< "YYYY-MM-DD"; empty: not stated
    std::optional<double> days;  ///< since the start
    std::optional<std::int64_t> number;
    bool operator==(const TimeStep&) const = default;
};

/// A named property. values.size() == components * number of things at the location; the components of
/// one thing are adjacent.
struct Attribute {
    std::string name;
    AttributeLocation location = AttributeLocation::point;
    std::uint32_t components = 1;
    AttributeValues values;

    std::string unit;               ///< empty: not stated
    std::string kind;               ///< e.g. "Length", "Porosity"; empty: not stated
    std::string property_class;     ///< Gocad property class; empty: not stated
    std::optional<double> no_data;  ///< the value that stands for missing
    std::optional<double> legal_min, legal_max;
    std::vector<std::string> component_names;             ///< empty, or one per component
    std::vector<std::pair<int, std::string>> code_names;  ///< meaning of integer codes (rock tables); may be empty
    std::optional<CornerValues> corner_values;            ///< only of cell attributes
    std::optional<TimeStep> time;                         ///< nothing: the values hold always, or it is not stated
    /// Further things that a format says of the property, kept for the way back ("gocad.subclass", ...).
    std::vector<std::pair<std::string, std::string>> annotations;
};

/// Number of values (components counted one by one).
std::size_t value_count(const Attribute& a);
/// Value `i` (0 <= i < value_count) as a double; NaN for text.
double value_as_double(const Attribute& a, std::size_t i);
/// "float64", "int32", "string", ...
const char* type_name(const AttributeValues& values);
/// "point", "cell", ...
const char* to_string(AttributeLocation location);

/// Whether a value stands for missing: compared as it is and after rounding both to float32, because
/// programs print no-data through single precision.
bool is_no_data(const Attribute& a, double value);

/// All that describes an attribute, without its values.
Attribute without_values(const Attribute& a);

/// The attribute of a name at a location, or nullptr.
const Attribute* find_attribute(const std::vector<Attribute>& all, const std::string& name, AttributeLocation location);

}  // namespace geomend
