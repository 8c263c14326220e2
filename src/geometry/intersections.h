// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/monitor.h"
#include "geometry/triangle_pair.h"
#include "geometry/triangle_tree.h"

namespace geomend {

/// Two triangles of a soup that meet in more than shared vertices and edges; numbers count from 0, a < b.
struct TriangleMeetingPair {
    std::uint32_t a, b;
    TriangleMeeting how;
};

/// All pairs of triangles that meet in more than shared vertices and edges (see meeting()), ascending by a, then b.
/// Exact, whatever the distances and sizes. Degenerate triangles (equal vertex numbers, or positions in line) are skipped.
/// \param triangles vertex numbers below vertices.size(); sharing is by number: weld equal positions before
/// \param monitor may stop the search: what was found by then is returned
/// \param most stop searching soon after so many pairs, and return no more than so many: the same ones whatever the number of threads
/// Cost: about n log n, some tenths of a second per million triangles; memory: the tree's 48 bytes per triangle.
std::vector<TriangleMeetingPair> intersections(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                               const Monitor* monitor = nullptr, std::size_t most = SIZE_MAX);

/// The same for a tree that is there already; its vertices must still be.
std::vector<TriangleMeetingPair> intersections(const TriangleTree& tree, const Monitor* monitor = nullptr, std::size_t most = SIZE_MAX);

/// What becomes of the pairs that are found in one part of a soup, 1024 triangles with those behind them.
struct PairTaker {
    std::function<void(const TriangleMeetingPair&)> take;
    /// Asked while `is_choosy`: false for a pair of triangles to be passed over, before it is known whether they meet.
    std::function<bool(std::uint32_t a, std::uint32_t b)> wants;
    bool is_choosy = false;
    bool is_full = false;  ///< no more are wanted
};

/// How many parts visit_intersections() goes through.
std::size_t intersection_parts(const TriangleTree& tree);

/// All pairs, where there may be too many to keep: ten thousand triangles on each other have fifty million. The parts follow each
/// other in the order of the tree, and what they are handed does not depend on the number of threads.
/// \param taker_of makes the taker of a part; called by the thread that works on it, which then calls the taker
/// \param after_round called between rounds, on one thread, with the first part that was done since and the one behind the last
/// \param groups of the triangles, in the tree's order, of which it is known that they do not meet themselves (is_single_valued()):
/// pairs in one are passed over; NodeGroups::mixed for triangles in none. May be empty
void visit_intersections(const TriangleTree& tree, const std::function<PairTaker&(std::size_t part)>& taker_of,
                         const std::function<void(std::size_t first, std::size_t last)>& after_round, const Monitor* monitor = nullptr,
                         std::span<const std::uint32_t> groups = {});

}  // namespace geomend
