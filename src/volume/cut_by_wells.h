// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "topology/frontiers.h"
#include "volume/region_facets.h"
#include "volume/well_network.h"

namespace geomend::volumes {

/// A path that is a chain of edges between vertices of a model, as far as it lies in the model.
struct WellChain {
    std::string name;
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< in the order in which it runs, each once
    double length = 0;                                ///< of the path
    double inside = 0;                                ///< of the edges: what lies in the model or on its surfaces
    double repeated = 0;                              ///< where the path runs along edges that it has already
    std::uint64_t on_surfaces = 0;                    ///< edges that lie on surfaces
    std::uint64_t crossings = 0;                      ///< vertices on surfaces
};

/// A model whose surfaces have vertices where paths cross them or begin on them, and edges where paths run along them.
struct CutByWells {
    BrepData brep;
    std::vector<WellChain> chains;  ///< one for each path
    std::vector<InnerEdge> inner;   ///< ascending, each once
};

/// Cuts surfaces by paths, and paths by surfaces: no shape changes by more than the tolerance, and paths end where the model does. Doing it
/// once more changes nothing. Surfaces that lie in no region are left alone.
/// Failure (limit, F026) where a path does not come to rest on a surface.
/// \pre surfaces are of triangles; tolerance > 0
/// Cost: that of a search tree over the triangles, some times; and as the triangles near paths.
Result<CutByWells> cut_by_wells(const BrepData& brep, const topology::FoundRegions& found, std::span<const WellPath> paths,
                                double tolerance);

}  // namespace geomend::volumes
