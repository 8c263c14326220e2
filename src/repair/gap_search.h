// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box_tree.h"
#include "model/objects.h"
#include "model/triangle_soup.h"

namespace geomend::repair {

/// Where a surface would meet another one if it went on straight.
struct GapHit {
    std::uint32_t patch = no_index;  ///< that is met; no_index: none
    double along = 0;                ///< from the border, along the direction of search
    bool within = false;             ///< the triangle itself is met; else its plane, no farther from it than the limit
    bool found() const { return patch != no_index; }
};

/// What lies nearest to an edge of a border, wherever it lies.
struct NearestHit {
    std::uint32_t patch = no_index;  ///< no_index: nothing within the limit
    double distance = 0;
    double ahead = 0;      ///< cosine between the way there and the direction of search; 0 where they touch
    bool grazing = false;  ///< the direction meets that triangle at less than 10 degrees
    Vec3 normal{};         ///< of that triangle, unit; null where it has no area
    bool found() const { return patch != no_index; }
};

/// Looks for what lies ahead of free borders.
class GapSearch {
public:
    /// \param limits per patch the largest gap at its borders, measured square to the surface that is met
    /// Cost: n log n. \pre the soup outlives this
    GapSearch(const TriangleSoup& soup, std::vector<double> limits);

    double limit(std::uint32_t patch) const { return limits_[patch]; }

    /// The nearest triangle of another patch ahead of a point that is met at more than 10 degrees; triangles that are met within
    /// themselves go before those whose planes are.
    /// \param direction unit
    /// \param only the patch that is looked for; no_index: any but the own one
    GapHit ahead(const Vec3& from, const Vec3& direction, std::uint32_t own_patch, std::uint32_t only = no_index) const;

    /// The triangle of another patch that is nearest to an edge, within the limit. \param direction unit
    NearestHit nearest(const std::array<Vec3, 2>& edge, const Vec3& direction, std::uint32_t own_patch) const;

private:
    const TriangleSoup& soup_;
    std::vector<double> limits_;
    BoxTree tree_;
};

}  // namespace geomend::repair
