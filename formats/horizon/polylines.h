// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "formats/format.h"
#include "model/objects.h"

namespace geomend::horizon {

/// A line of a polyline set: point indices in order; a closed line repeats its first point at the end.
struct Chain {
    std::size_t part = 0;  ///< index into the parts of the set
    std::vector<std::uint32_t> points;
};

/// The lines that the edges make, in the order of the edges: an edge goes on with the line when it begins where the
/// one before has ended. Points without edges become lines of one point.
std::vector<Chain> chains_of(const PolylineSet& set);

/// Adds a line. When its last point equals its first and there are at least two others, the line is closed by an edge
/// instead of a second point there.
void add_line(PolylineSet& set, std::string name, std::span<const Vec3> points);

/// The first polyline set of a dataset, or the failure cannot_hold.
Result<std::size_t> polylines_for_writing(const Dataset& dataset, std::string_view title);

}  // namespace geomend::horizon
