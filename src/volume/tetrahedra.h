// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"
#include "volume/region_facets.h"

namespace geomend::volumes {

/// Tetrahedra over the vertices of facets, and over more.
struct Tetrahedra {
    std::vector<Vec3> new_vertices;                   ///< their numbers follow those of the facets' vertices
    std::vector<std::array<std::uint32_t, 4>> cells;  ///< in no particular orientation
};

class TetrahedraWorkers;

/// What a child process may take.
struct ChildLimits {
    double seconds = 120;
    std::uint64_t memory_bytes = 0;        ///< 0: no limit
    std::vector<std::string> program;      ///< the command to which tetrahedra_worker_arguments() are added; empty: this program
    TetrahedraWorkers* workers = nullptr;  ///< that are asked in its place
};

/// In which order TetGen gets the vertices: what it cannot fill from one it often can from another.
struct VertexOrder {
    std::uint32_t shuffle = 0;  ///< 0: as they are; else a seed
};

/// How long edges are to be near a point.
struct SizedPoint {
    Vec3 place{};
    double size = 0;
};

/// What is wanted inside of a region.
struct Inside {
    /// Vertices besides those of the facets, inside of the region or outside, on no facet; their numbers, where cells use them, follow
    /// those of the facets' vertices. With the switch i they are inserted when the facets are in.
    std::span<const Vec3> points{};
    std::span<const SizedPoint> sizes{};  ///< with the switch m: between these sizes are interpolated, and outside of them the nearest hold
};

/// All tetrahedra that TetGen makes of the facets, outside of the region too where facets close there. `switches` as of tetgen(1);
/// with Y facets stay as they are.
/// Failure (limit) where the child ran out of time or of the memory it may take (F023), crashed or gave up (F026); the message says which.
/// Cost: that of a process that is started, or of a fork where there are workers.
Result<Tetrahedra> tetrahedra_of(const RegionFacets& facets, const Inside& inside, const std::string& switches, VertexOrder order,
                                 const ChildLimits& limits, const Monitor* monitor);

/// The first argument of a child process, by which main() knows it.
inline constexpr const char* worker_word = "--tetrahedra-worker";
/// What the child does with the rest of its arguments: switches, the parent's number, bytes of memory, and the file of the facets; or the
/// parent's number alone, where it takes one request after the other.
/// \return its exit status: 0, or 1 with the reason on standard error
int tetrahedra_worker(const std::vector<std::string>& arguments);

}  // namespace geomend::volumes
