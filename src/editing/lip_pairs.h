// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace geomend::editing {

/// Which of the half-planes around an edge go on into each other: pairs that differ from a straight angle by at most a share of
/// a right angle, the straightest first, each half-plane in one pair at most.
/// \param angles of the half-planes around the edge, in radians, from any of them
/// \param most largest difference from a straight angle for two half-planes, in radians; for n of them 2 most / n. Euler's clause
/// (thesis, 2.3.2) is a quarter of pi.
/// Pairs hold positions in `angles`, the lower one first, and ascend. Cost: n^2 log n.
std::vector<std::pair<std::uint32_t, std::uint32_t>> lip_pairs(std::span<const double> angles, double most);

}  // namespace geomend::editing
