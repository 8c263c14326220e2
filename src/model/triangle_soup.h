// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "base/vec3.h"

namespace geomend {

/// Three vertex numbers, in the order in which the triangle turns.
using Triangle = std::array<std::uint32_t, 3>;

/// Triangles over one list of vertices, without any adjacency: what is cut, edited and assembled. Triangles share a vertex
/// where they use the same number. It may be broken (degenerate, double, crossing triangles): that is what it is mended from.
struct TriangleSoup {
    std::vector<Vec3> vertices;  ///< elevation-up; finite
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> patches;  ///< per triangle the surface, side or part that it belongs to

    /// Edges that must stay edges whatever is done (lines, wells, borders of a stated region); they need not be edges of
    /// triangles. In pieces where they are cut, each with the id of the whole.
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint32_t> edge_ids;  ///< per edge
};

/// Whether a soup is what it promises: positions finite, one patch a triangle and one id an edge, all vertex numbers in
/// range, two different ends for each edge. A triangle may name a vertex twice.
/// Fails with FailureKind::internal and the first thing that is wrong. Linear.
Result<void> check(const TriangleSoup& soup);

}  // namespace geomend
