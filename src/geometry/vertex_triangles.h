// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_pair.h"

namespace geomend {

/// The triangles around each vertex, ascending. Memory: 12 bytes per triangle and 4 per vertex. Cost: linear.
class VertexTriangles {
public:
    /// \param triangles fewer than 2^32 / 3, their vertex numbers below `vertices`
    VertexTriangles(std::size_t vertices, std::span<const Triangle> triangles) : start_(vertices + 1), triangles_(3 * triangles.size()) {
        for (const Triangle& t : triangles) {
            for (const std::uint32_t v : t) ++start_[v];
        }
        std::uint32_t end = 0;
        for (std::uint32_t& s : start_) s = end += s;
        for (std::size_t i = triangles.size(); i-- > 0;) {
            for (const std::uint32_t v : triangles[i]) triangles_[--start_[v]] = static_cast<std::uint32_t>(i);
        }
    }

    /// A triangle that names the vertex twice comes twice.
    std::span<const std::uint32_t> at(std::uint32_t vertex) const {
        return std::span(triangles_).subspan(start_[vertex], start_[vertex + 1] - start_[vertex]);
    }

private:
    std::vector<std::uint32_t> start_, triangles_;
};

}  // namespace geomend
