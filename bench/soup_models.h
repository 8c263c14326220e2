// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

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

/// Eight folded horizons, and four faults that go through them, of about so many triangles.
Soup crossed_folds(std::size_t triangles);

/// Copies side by side along x of all triangles of a file, welded where positions are equal, one group per part. Empty
/// where the file cannot be read.
Soup copies_of(const std::string& path, std::size_t copies);

}  // namespace geomend::bench
