// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "validators/model_scope.h"

// Borders of surfaces where nothing else is: where they run, how long they are, and in words.

namespace geomend::validators {

/// Free border lines that hang together.
struct FreeBorder {
    std::vector<std::uint32_t> lines;
    std::uint64_t edges = 0;
    double length = 0;
    Vec3 middle{};       ///< of the middles of its edges, weighted by their lengths
    bool closed = true;  ///< goes round once: each of its vertices is on two of its edges
    Vec3 facing{};       ///< of a closed one: a vector as long as the area that it goes round, across it; its sign means nothing
};

/// The lines among `lines` that are free borders, as they hang together, rings of one surface that touch in points
/// apart; the shortest first.
/// \pre lines are of the model  Cost: n log n in their vertices.
std::vector<FreeBorder> free_borders(const ModelScope& scope, std::span<const std::uint32_t> lines);

/// "3 edges, 12.5 long, around (100, 200, -1500)", the height in the file's own sense; of several the first, and how many more.
std::string border_text(const ModelScope& scope, std::span<const FreeBorder> borders);

/// Marks their lines in a finding, and adds the number of their edges and their length to its measures.
void mark_borders(const ModelScope& scope, std::span<const FreeBorder> borders, Finding& finding);

/// Per surface the lowest surface of its group: those that hang together along lines. Near-linear.
std::vector<std::uint32_t> surface_groups(const ModelScope& scope);

/// Per surface 1 where one of its group has different regions on its two sides: the group closes around something. Near-linear.
std::vector<std::uint8_t> closing_groups(const ModelScope& scope);

}  // namespace geomend::validators
