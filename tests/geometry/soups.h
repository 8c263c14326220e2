// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/triangle_pair.h"

namespace geomend::test {

/// Triangles over a list of vertices, and which surface each belongs to.
struct Soup {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> groups;

    /// A lattice of nu x nv cells, two triangles each, at place(i, j). Returns its first vertex; vertex (i, j) is that + j (nu + 1) + i.
    template <class Place>
    std::uint32_t add_sheet(std::uint32_t nu, std::uint32_t nv, const Place& place) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        const std::uint32_t group = groups.empty() ? 0 : groups.back() + 1;
        for (std::uint32_t j = 0; j <= nv; ++j) {
            for (std::uint32_t i = 0; i <= nu; ++i) vertices.push_back(place(i, j));
        }
        for (std::uint32_t j = 0; j < nv; ++j) {
            for (std::uint32_t i = 0; i < nu; ++i) {
                const std::uint32_t a = first + j * (nu + 1) + i, b = a + 1, c = a + nu + 1, d = c + 1;
                triangles.insert(triangles.end(), {{a, b, d}, {a, d, c}});
                groups.insert(groups.end(), {group, group});
            }
        }
        return first;
    }
};

}  // namespace geomend::test
