// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "topology/used_points.h"

namespace geomend::topology {

/// Why a vertex counts as outlying.
enum class Outlying : std::uint8_t {
    no,
    far,   ///< it lies alone, far off from all that it hangs together with
    usual  ///< and its height is a number that programs write for "no value"
};

/// Vertices that are likely no part of the shape, per vertex.
///
/// A vertex is `usual` where its height, of either sign, is a number such as -999.25, -9999 or 1e10 and lies at least as far from
/// all other heights of its object as these lie from each other; all edges from it to others are steeper than 45 degrees; and
/// these are less than a tenth of the vertices of the object (of 9999 and larger numbers: less than half). Where all edges from such
/// vertices to others are at least four times as steep as those among the others, and none is upright, less than half is enough for
/// 999 and 9999, at which some models end, too; and of numbers that are no depth of anything, such as -999.25, -32768 or -99999, there
/// may be any number beside others. The whole base or top of a body, on which others stand upright, is at such a height rightly.
///
/// Vertices are `far` where edges that are at least ten times as long as all the rest is wide are all that links them to the
/// rest, and they are at most a twentieth of it (from a hundred times on: a quarter). So what tapers off through several
/// vertices, as a salt dome does, and what makes a good part of a surface is not outlying, nor is a part that no edge links, nor the apex
/// of a cone: vertices that close a body which they see as a whole from inside (seen_inside.h). Cost: linear; some times that where
/// something is found.
std::vector<Outlying> find_outlying(const UsedPoints& used, const HangingParts& parts);

}  // namespace geomend::topology
