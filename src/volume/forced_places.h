// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/vec3.h"
#include "geometry/closest_points.h"
#include "geometry/triangle_tree.h"
#include "volume/region_facets.h"

namespace geomend::volumes {

/// Where surfaces force narrow cells: within one size of edges at which facets meet below 10 degrees, and of places at which facets face
/// each other nearer than half the size. What was asked of a vertex of facets is known from then on. Not for several threads at once.
class ForcedPlaces {
public:
    /// \param size of edges. Cost: linear, with logarithms.
    ForcedPlaces(const RegionFacets& facets, double size);

    /// \param vertex of facets, or a higher number for another place. Cost: some 0.03 ms where it was not asked before.
    bool is_near(std::uint32_t vertex, const Vec3& place);

private:
    using Edge = std::array<std::uint32_t, 2>;
    enum class Known : std::uint8_t { unasked, near, far };
    const RegionFacets& facets_;
    const double size_;
    TriangleTree tree_;
    std::vector<std::vector<Edge>> sharp_;                           ///< per facet its sharp edges
    std::vector<std::optional<std::vector<std::uint32_t>>> facing_;  ///< per facet those that face it closely, once that was asked
    std::vector<Known> known_;                                       ///< per vertex of facets

    std::array<Vec3, 3> corners(std::uint32_t f) const;
    /// The facets nearer than half the size that a facet faces.
    const std::vector<std::uint32_t>& facing(std::uint32_t f);
    bool are_opposite(const Closest& gap, std::uint32_t a, std::uint32_t b) const;
    bool is_near(const Vec3& p);
    bool is_beside(const Vec3& p, const Edge& edge) const;
};

}  // namespace geomend::volumes
