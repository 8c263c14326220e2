// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace geomend
