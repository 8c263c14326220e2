// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace geomend {

/// Polygons over some array of points. Without offsets all are triangles and `corners` holds three per polygon;
/// else polygon i has corners[offsets[i] .. offsets[i+1]). Quadrangles and larger polygons are in cyclic order.
struct Polygons {
    std::vector<std::uint32_t> corners;
    std::vector<std::uint64_t> offsets;  ///< empty, or size()+1 values from 0

    bool all_triangles() const { return offsets.empty(); }
    std::size_t size() const { return offsets.empty() ? corners.size() / 3 : offsets.size() - 1; }
    std::span<const std::uint32_t> operator[](std::size_t i) const {
        if (offsets.empty()) return {corners.data() + 3 * i, 3};
        return {corners.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
    }
    /// Where the corners of polygon i begin in `corners`. \pre i <= size()
    std::size_t first_corner(std::size_t i) const { return offsets.empty() ? 3 * i : static_cast<std::size_t>(offsets[i]); }
    /// Adds a polygon; the first that is not a triangle brings the offsets in.
    void push_back(std::span<const std::uint32_t> polygon) {
        if (offsets.empty() && polygon.size() != 3) {
            offsets.reserve(size() + 2);
            for (std::size_t i = 0; i <= corners.size() / 3; ++i) offsets.push_back(3 * i);
        }
        corners.insert(corners.end(), polygon.begin(), polygon.end());
        if (!offsets.empty()) offsets.push_back(corners.size());
    }
};

}  // namespace geomend
