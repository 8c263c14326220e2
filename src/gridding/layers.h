// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace geomend::gridding {

/// How the interval between two horizons is divided.
struct ZoneLayers {
    enum class Rule : std::uint8_t { proportional, from_top, from_base };
    std::string zone;  ///< name; empty: made from the horizons
    Rule rule = Rule::proportional;
    std::uint32_t count = 1;  ///< of layers; 0: as many as the thickest place needs
    double thickness = 0;     ///< of the layers, counted from the top or the base
};

/// The rules in a text "ZONE=proportional:10,ZONE=from-top:2.5:4,..."; the names may be left out. proportional:N makes N layers;
/// from-top:T and from-base:T layers of thickness T, the last of which is cut off by the other horizon: as many as are needed, or N with
/// :N behind, the last one taking what is left. Failure (usage) with the word that is wrong.
Result<std::vector<ZoneLayers>> parse_layers(const std::string& text);

/// Most layers of one zone.
inline constexpr std::uint32_t most_layers = 1000000;

/// The layers of a zone, for a largest thickness. At least 1. Failure (usage) where the rule needs more than most_layers: the message has
/// their number. \param zone how the zone is called in messages
Result<std::uint32_t> layer_count(const ZoneLayers& rule, double thickest, const std::string& zone);

/// Depth of boundary k of n layers between top and base: exactly top for 0 and base for n, ascending between. \pre top <= base
double layer_depth(const ZoneLayers& rule, std::uint32_t k, std::uint32_t n, double top, double base);

/// Depths of horizons at one place, top to base, brought into order: what erodes cuts off all below it, what is lapped onto all above it,
/// and the rest gives way to the horizons above. How far the farthest was moved comes back.
double put_in_order(std::span<double> depths, std::span<const std::uint8_t> erodes, std::span<const std::uint8_t> is_lapped);

}  // namespace geomend::gridding
