// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "model/triangle_soup.h"

namespace geomend::test {

/// A soup as its lists; without patches each triangle is one of its own.
inline TriangleSoup soup_of(std::vector<Vec3> vertices, std::vector<Triangle> triangles, std::vector<std::uint32_t> patches = {}) {
    TriangleSoup soup;
    soup.vertices = std::move(vertices);
    soup.triangles = std::move(triangles);
    soup.patches = std::move(patches);
    for (auto p = static_cast<std::uint32_t>(soup.patches.size()); p < soup.triangles.size(); ++p) soup.patches.push_back(p);
    return soup;
}

}  // namespace geomend::test
