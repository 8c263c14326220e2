// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/brep.h"
#include "volume/region_facets.h"
#include "volume/tetrahedra.h"

namespace geomend::volumes {

/// Points that surfaces need as vertices, since tetrahedra could not be made without them.
struct SurfacePoints {
    struct OnEdge {
        std::array<std::uint32_t, 2> ends;  ///< vertices of the model, the lower one first
        Vec3 place;
    };
    struct Inside {
        std::uint32_t surface;
        Triangle corners;  ///< vertices of the model, as the surface has them
        Vec3 place;
    };
    std::vector<OnEdge> on_edges;
    std::vector<Inside> inside;

    std::size_t size() const { return on_edges.size() + inside.size(); }
};

/// The new vertices of tetrahedra that lie on facets which are no faces of them: there the facets were divided.
/// Cost: n log n in cells.
SurfacePoints points_on_facets(const RegionFacets& facets, const Tetrahedra& all);

/// A model whose surfaces and lines have these points as vertices, whatever surfaces meet there: no shape changes. Values at new nodes
/// lie between those of the triangle that they are in; triangles keep theirs.
/// \pre surfaces are of triangles; the points are on edges and triangles of the model
/// Cost: linear, once for each point that the edge with the most of them has
BrepData with_points(const BrepData& brep, const SurfacePoints& points);

}  // namespace geomend::volumes
