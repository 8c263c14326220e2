// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace geomend::gridding {

/// How the value of a cell comes of what lies in it.
enum class Averaging : std::uint8_t {
    nearest,   ///< what lies at its middle
    mean,      ///< weighted by volume
    majority,  ///< the value of most of its volume
    harmonic   ///< harmonic along each way down through it, mean of these: flow across layers
};
/// "nearest", "mean", "majority", "harmonic".
const char* to_string(Averaging how);

/// What is said of a property; without `how` codes have their majority, other values their mean.
struct PropertyRule {
    std::string name;
    std::optional<Averaging> how;
};

/// The rules in words "NAME" or "NAME=METHOD". Failure (usage) with the word that is wrong.
Result<std::vector<PropertyRule>> parse_properties(std::span<const std::string> words);

/// Values with weights above 0; those that are not finite count for nothing. NaN where none is left.
double mean_of(std::span<const double> values, std::span<const double> weights);
/// Of values of equal weight the lowest.
double majority_of(std::span<const double> values, std::span<const double> weights);
/// 0 where a value is not above 0.
double harmonic_of(std::span<const double> values, std::span<const double> weights);
/// Columns of `height` values one after the other: harmonic in each, mean of all. \pre height divides the number of values
double harmonic_down(std::span<const double> values, std::span<const double> weights, std::size_t height);

}  // namespace geomend::gridding
