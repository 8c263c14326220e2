// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace geomend {

enum class ZPositive : std::uint8_t { elevation, depth };

/// What a file says about its axes. In memory surfaces and cells are always elevation-up; `z_positive` is
/// the file's own sign, to which bounds and written files return. Units are reported, never converted.
struct CoordinateSystem {
    bool stated = false;  ///< the file has a coordinate system block or its like
    std::string name;
    std::string projection;
    std::string datum;
    std::array<std::string, 3> axis_names;
    std::array<std::string, 3> axis_units;  ///< empty: not stated
    ZPositive z_positive = ZPositive::elevation;
    bool z_positive_stated = false;
    /// Further lines, kept for the way back.
    std::vector<std::pair<std::string, std::string>> annotations;

    bool operator==(const CoordinateSystem&) const = default;
};

/// True when the three axis units are the same (or none is stated), so that volumes mean something.
bool axis_units_agree(const CoordinateSystem& crs);

/// Empty when objects in the two systems may stand in one output; else what disagrees (names, units, sign of Z).
/// What one of them does not state agrees with anything; signs always agree, because memory is elevation-up,
/// unless `compare_sign`.
std::string disagreement(const CoordinateSystem& a, const CoordinateSystem& b, bool compare_sign);

}  // namespace geomend
