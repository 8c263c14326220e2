// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "volume/tetrahedra.h"

// What parent and child say to each other, as bytes: counts, then arrays, in the machine's own order.

namespace geomend::volumes {

/// What the child says when it gives up for want of memory.
inline constexpr const char* out_of_memory = "it ran out of memory";

/// What the child is given.
struct WorkerFacets {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<Vec3> points;                         ///< that are to be vertices of cells, too
    std::vector<SizedPoint> sizes;                    ///< how long edges are to be
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< that cells are to have, over the positions
};

std::string worker_question(const WorkerFacets& facets);
/// Nothing where counts or vertex numbers do not fit, or a position or size is not finite.
std::optional<WorkerFacets> worker_facets(std::string_view bytes);

std::string worker_answer(const Tetrahedra& all);
/// The answer to a question with so many vertices. Nothing where sizes or numbers do not fit, or a position is not finite.
std::optional<Tetrahedra> worker_tetrahedra(std::string_view bytes, std::size_t known_vertices);

}  // namespace geomend::volumes
