// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.h"
#include "geometry/surface_distance.h"
#include "geometry/triangle_tree.h"

namespace geomend {

// What nearly touches, but does not. Surfaces that meet along a line are close to each other beside it, and that is no miss: so
// a miss is a place where the distance of two surfaces is smallest, less than `near` and not 0: whichever way one goes from
// there, along either of them, it does not shrink. What is not told, because the surfaces are joined, is said at each function.

/// A border that nearly meets a surface.
struct NearMiss {
    std::uint32_t border_edge;  ///< place in the list of border edges
    std::uint32_t triangle;     ///< number in the soup
    double distance;            ///< more than 0, less than `near`
    Vec3 on_edge, on_triangle;  ///< the two closest points
};

/// Border edges that nearly meet the triangles of another group, or others of their own (not the two rings of triangles
/// around them). A miss is one of
/// - an edge that has a place where the distance is smallest, as above, unless both groups have a vertex in common within
///   twice the distance; with the border edges next to it, up to where the distance stops growing (edges with one end beyond `near`
///   only where there are no others);
/// - a hole in a contact: a run of edges, all of whose vertices are closer than `near`, from a vertex of the other group to
///   another such vertex or to the end of the border;
/// - a slow wedge: a run of edges from a vertex of the other group to the last place that is closer than `near` and than `slow` of
///   the way along the border up to there, where the surface leaves the other one more steeply across its border than along it.
/// Edges of holes and wedges are told with the distance at the end that is farther off. So a border that leaves a surface at
/// more than 3 degrees (`slow` being 1/20) is no miss, nor is that of a bed that wedges out as a whole.
/// At most one for each border edge and group of triangles: ascending by edge, then by group.
/// \param groups the surface of each triangle; patches of one geological surface may share a group
/// \param border_edges two vertex numbers each; \param border_groups the group of each, that of the triangle beside it
/// \param near length; what is 0 apart (touches or crosses) is no near miss
/// \param monitor may stop the search: nothing is returned then
/// \param touching what is no farther off touches: it is told alone, as what touches by exact predicates is not told
/// \param slow a border that is no farther off than this part of the way along it since both met leaves too slowly
/// \pre arrays agree in length, indices are in range, coordinates finite, fewer than 1.4e9 triangles
/// Cost: as the number of border edges, times the triangles within `near` of one.
std::vector<NearMiss> near_misses(const SurfaceDistance& soup, std::span<const std::array<std::uint32_t, 2>> border_edges,
                                  std::span<const std::uint32_t> border_groups, double near, const Monitor* monitor = nullptr,
                                  double touching = 0, double slow = 0.05);
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

/// What was found, and where the search was cut short.
struct ClosePairs {
    std::vector<ClosePair> pairs;          ///< ascending by group_a, then group_b
    std::vector<std::uint32_t> cut_short;  ///< groups near which not everything was looked at, ascending
};

/// For each two groups the closest place where the distance is smallest, as above. Left out
/// are places that are joined: from where a way leads over both surfaces to where they meet or where a third group joins them
/// (two contact lines on a fault), with never more than `near` between the two and no farther than 10 `near` from the place;
/// and places within `near` of one that is left out. See leads_to_meeting().
/// Cost: as the number of vertices, times the triangles within `near` of one, and some
/// milliseconds for each place that is looked at: 20 microseconds for each vertex where `near` is three edges long, 1 where it is
/// shorter than an edge. Where `near` is so much longer than the edges that everything is near everything, the search is cut short:
/// it looks at some hundred triangles for each, and at a thousand places for each two groups.
/// \param near of each group; only groups with the same length, more than 0, are compared
/// \param monitor as for near_misses()
ClosePairs closest_pairs(const SurfaceDistance& soup, std::span<const double> near, const Monitor* monitor = nullptr);
/// The same with one length for all, and a tree of its own.
ClosePairs closest_pairs(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::span<const std::uint32_t> groups,
                         double near, const Monitor* monitor = nullptr);

}  // namespace geomend
