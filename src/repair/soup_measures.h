// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/length.h"
#include "base/vectors.h"
#include "geometry/box_tree.h"
#include "model/triangle_soup.h"

namespace geomend::repair {

/// The normal of a triangle, as it is wound; its length is twice the area.
inline Vec3 triangle_normal(const TriangleSoup& soup, std::uint32_t t) {
    const auto& [a, b, c] = soup.triangles[t];
    return cross(minus(soup.vertices[b], soup.vertices[a]), minus(soup.vertices[c], soup.vertices[a]));
}

inline double triangle_area(const TriangleSoup& soup, std::uint32_t t) { return 0.5 * length(triangle_normal(soup, t)); }

/// The box along the axes around each triangle.
inline std::vector<BoxTree::Corners> triangle_boxes(const TriangleSoup& soup) {
    std::vector<BoxTree::Corners> boxes;
    boxes.reserve(soup.triangles.size());
    for (const Triangle& t : soup.triangles) {
        BoxTree::Corners box{soup.vertices[t[0]], soup.vertices[t[0]]};
        for (const std::uint32_t v : t) {
            for (std::size_t k = 0; k < 3; ++k) {
                box[0][k] = std::min(box[0][k], soup.vertices[v][k]);
                box[1][k] = std::max(box[1][k], soup.vertices[v][k]);
            }
        }
        boxes.push_back(box);
    }
    return boxes;
}

}  // namespace geomend::repair
