// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "base/vec3.h"
#include "model/triangle_soup.h"

namespace geomend::test {

/// A lattice of nu x nv cells, two triangles each, at place(u, v) for u, v from 0 to 1, as a patch of its own.
template <class Place>
void add_sheet(TriangleSoup& soup, std::uint32_t nu, std::uint32_t nv, const Place& place) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    const std::uint32_t patch = soup.patches.empty() ? 0 : soup.patches.back() + 1;
    for (std::uint32_t j = 0; j <= nv; ++j) {
        for (std::uint32_t i = 0; i <= nu; ++i) soup.vertices.push_back(place(i / static_cast<double>(nu), j / static_cast<double>(nv)));
    }
    for (std::uint32_t j = 0; j < nv; ++j) {
        for (std::uint32_t i = 0; i < nu; ++i) {
            const std::uint32_t a = first + j * (nu + 1) + i, b = a + 1, c = a + nu + 1, d = c + 1;
            soup.triangles.insert(soup.triangles.end(), {{a, b, d}, {a, d, c}});
            soup.patches.insert(soup.patches.end(), {patch, patch});
        }
    }
}

}  // namespace geomend::test
