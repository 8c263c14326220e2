// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/brep.h"

namespace geomend::topology {

/// What the cells of one volume entity say about their region.
struct CellRegion {
    BrepData::Region region;            ///< nodes, cells, attributes, volume, sides; no name
    std::vector<SurfaceId> incomplete;  ///< surfaces that only a part of whose polygons bound the region on a side
};

/// Makes the region of some three-dimensional cells. Its sides are the surfaces whose polygons are facets of the cells;
/// front or back is told by where the cell lies, whatever its own winding. Its volume is the sum of the cells'
/// absolute volumes. Cost: linear in the cells.
class CellRegions {
public:
    /// \param vertex_of per mesh point its model vertex
    CellRegions(const BrepData& brep, const CellMesh& mesh, const std::vector<std::uint32_t>& vertex_of);

    CellRegion make(const std::vector<std::uint32_t>& cells) const;

private:
    struct Facet {
        std::uint32_t second, third, size;  // the lowest vertex files it; then the next two and the number of corners
        std::uint32_t surface, polygon;
    };
    const Facet* find(const std::vector<std::uint32_t>& vertices) const;

    const BrepData& brep_;
    const CellMesh& mesh_;
    const std::vector<std::uint32_t>& vertex_of_;
    std::vector<std::uint32_t> first_;  // per vertex, into facets_
    std::vector<Facet> facets_;
};

}  // namespace geomend::topology
