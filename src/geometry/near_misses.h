// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.h"
#include "geometry/triangle_tree.h"

namespace geomend {

// What nearly touches, but does not. Surfaces that meet along a line are close to each other beside it, and that is no
// miss: so a miss is a place where the distance between two surfaces is smallest, is not 0, and grows whichever way one
// goes from there along either of them. A sound model has none unless it has a feature as small as `near`.

/// A border that nearly meets a surface.
struct NearMiss {
    std::uint32_t border_edge;  ///< place in the list of border edges
    std::uint32_t triangle;     ///< number in the soup
    double distance;            ///< more than 0, less than `near`
    Vec3 on_edge, on_triangle;  ///< the two closest points
};

/// Border edges that nearly meet the triangles of another group, or others of their own (not the two rings of triangles
/// around them). A miss is one of
/// - a place where the distance is smallest, as above, with the border edges next to it, up to where the distance stops growing
///   (edges with one end beyond `near` only where there are no others);
/// - a run of edges, all of whose vertices are closer than `near`, from a vertex of the other group to another such vertex, to
///   the end of the border, or for more than 10 `near`: a hole in a contact, or a strip narrower than `near`. Its edges are told
///   with the distance at the end that is farther off.
/// At most one for each border edge and group of triangles: ascending by edge, then by group.
/// \param groups the surface of each triangle; patches of one geological surface may share a group
/// \param border_edges two vertex numbers each; \param border_groups the group of each, that of the triangle beside it
/// \param near length; what is 0 apart (touches or crosses) is no near miss
/// \param monitor may stop the search: nothing is returned then
/// \param touching what is no farther off touches: it is told alone, as what touches by exact predicates is not told
/// \pre arrays agree in length, indices are in range, coordinates finite, fewer than 1.4e9 triangles
/// Cost: as the number of border edges, times the triangles within `near` of one; 18 bytes per triangle besides the tree.
std::vector<NearMiss> near_misses(const TriangleTree& tree, std::span<const std::uint32_t> groups,
                                  std::span<const std::array<std::uint32_t, 2>> border_edges, std::span<const std::uint32_t> border_groups,
                                  double near, const Monitor* monitor = nullptr, double touching = 0);
/// The same, with a tree of its own.
std::vector<NearMiss> near_misses(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                  std::span<const std::uint32_t> groups, std::span<const std::array<std::uint32_t, 2>> border_edges,
                                  std::span<const std::uint32_t> border_groups, double near, const Monitor* monitor = nullptr);

/// Where two surfaces come close to each other without touching.
struct ClosePair {
    std::uint32_t group_a, group_b;        ///< group_a < group_b
    std::uint32_t triangle_a, triangle_b;  ///< numbers in the soup
    double distance;                       ///< more than 0, less than `near`
    Vec3 on_a, on_b;                       ///< the two closest points
};

/// For each two groups the closest pair of triangles that share no vertex and do not meet, at a place where the distance is
/// smallest, as above; ascending by group_a, then group_b. Left out are places within 2 `near` of a vertex that both groups
/// have, and places where both lie on one third group: two contact lines on a fault are joined by the fault.
/// The search starts from vertices that are closer to the other group than their neighbours are: where no vertex of either
/// surface comes within `near` of the other although two edges do, that is not found.
/// Parameters as for near_misses(). Cost: as the number of vertices, times the triangles within `near` of one: some microseconds
/// each where `near` is three edges long.
std::vector<ClosePair> closest_pairs(const TriangleTree& tree, std::span<const std::uint32_t> groups, double near,
                                     const Monitor* monitor = nullptr);
/// The same, with a tree of its own.
std::vector<ClosePair> closest_pairs(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                     std::span<const std::uint32_t> groups, double near, const Monitor* monitor = nullptr);

}  // namespace geomend
