// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/dataset.h"
#include "topology/face_edges.h"
#include "topology/frontiers.h"
#include "topology/line_graph.h"
#include "topology/stated_claims.h"
#include "topology/surface_complex.h"

namespace geomend::topology {

/// A boundary representation on its way: what later steps need of earlier ones.
struct Assembly {
    BrepData brep;
    std::vector<FaceEdges> faces;
    LineGraph graph;
    std::vector<double> cones;       ///< see cone_volumes
    FoundRegions found;              ///< where the surfaces were walked along
    std::vector<double> tolerances;  ///< per surface, within which polygons at a line coincide
    StatedClaims claims;
    std::vector<std::uint8_t> joined_lines;  ///< per line, see JudgedModel
    std::vector<Finding> findings;
};

/// Appends the regions that the file lists. Their sides are brought into agreement with the geometry (see
/// solve_sides); what had to be turned is in the claims; what does not close, has no side or claims a side that another region
/// has, is a finding F113 or F121, one per region. Gives for each stated region its id (the Universe: none).
std::vector<RegionId> add_stated_regions(Assembly& assembly, const std::vector<StatedRegion>& stated);

/// Appends regions found by walking along the surfaces, and sets the Universe.
void add_found_regions(Assembly& assembly);

/// Tells surfaces which regions lie on their two sides; fills the Universe (all sides that no region has) where
/// it is not known, and its volume.
void settle_universe(Assembly& assembly);

/// F113 for each region that is stated on the wrong side of a surface, where no judge reports it.
void report_wrong_sides(Assembly& assembly);

/// Finding about one region of a model.
Finding region_finding(const BrepData& brep, std::string code, std::string region, std::string message);

}  // namespace geomend::topology
