// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/triangle_pair.h"

namespace geomend::bench {

/// Triangles with shared vertices, and the surface that each belongs to.
struct Soup {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> groups;
};

/// Edges of one triangle only, with the group of that.
struct Borders {
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint32_t> groups;
};
Borders free_borders(const Soup& soup);

/// A thousandth of twice the largest distance from the centre.
double near_length(const Soup& soup);

/// Eight folded horizons, and four faults that go through them, of about so many triangles.
Soup crossed_folds(std::size_t triangles);

/// Copies side by side along x of all triangles of a file, welded where positions are equal, one group per part. Empty
/// where the file cannot be read. \param spacing in lengths of the model: below 1 the copies cross each other
Soup copies_of(const std::string& path, std::size_t copies, double spacing = 1.25);

}  // namespace geomend::bench
