// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "model/triangle_soup.h"
#include "topology/assemble.h"

namespace geomend::volumes {

/// On which sides of a facet the region lies: behind its normal, in front of it, or both for surfaces that end inside.
enum FacetSides : std::uint8_t { behind = 1, in_front = 2, on_both = 3 };

/// The triangles that bound one region or lie inside it, over vertices of their own.
struct RegionFacets {
    std::uint32_t region = no_index;                  ///< in the boundary representation
    std::vector<std::uint32_t> vertices;              ///< of the model, ascending
    std::vector<Vec3> positions;                      ///< of them
    std::vector<Triangle> triangles;                  ///< over them, wound as their surfaces
    std::vector<FacetSides> sides;                    ///< of each triangle
    std::vector<std::uint32_t> surfaces;              ///< of each triangle
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< that cells are to have besides those of triangles, over the vertices
    double volume = 0;                                ///< enclosed by them; relative error some 1e-15 times the number of triangles
    double median_edge = 0;                           ///< half of their area has triangles with a shorter edge, on average
};

/// An edge inside of a region, on no surface.
struct InnerEdge {
    std::uint32_t region;               ///< of those that were found
    std::array<std::uint32_t, 2> ends;  ///< vertices of the model, the lower one first
    auto operator<=>(const InnerEdge&) const = default;
};

/// The facets of all regions of a model, ascending by region. Regions are those found along the surfaces; each has the number of the
/// stated region that has one of its sides.
/// Failure (cannot_hold, F026) where a polygon is no triangle, where there is no region, or none that is stated where one was found.
/// Cost: linear in triangles.
Result<std::vector<RegionFacets>> facets_of_regions(const BrepData& brep, const topology::FoundRegions& found,
                                                    std::span<const InnerEdge> inner = {});

inline Result<std::vector<RegionFacets>> facets_of_regions(const topology::JudgedModel& model) {
    return facets_of_regions(*model.brep, model.found);
}

}  // namespace geomend::volumes
