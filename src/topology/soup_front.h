// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "model/triangle_soup.h"
#include "topology/surface_complex.h"

namespace geomend::topology {

/// Triangles in patches, and what is known of the model that they make: what cutting, repair and remeshing give back.
struct SoupModel {
    std::string name;
    CoordinateSystem crs;
    std::vector<Annotation> annotations;

    /// Each patch becomes one surface, with the vertices that it uses as its nodes: where two vertices of a patch are at one
    /// position it is cut. Embedded edges state lines; edges of one id are one line, unless corners part it.
    TriangleSoup soup;
    struct Patch {
        std::string name;
        std::string interface_name;
        FeatureRole role = FeatureRole::unknown;
        std::string role_text;
        /// Over patch_vertices() (point), over the triangles of the patch in their order (polygon), or for the whole (object).
        std::vector<Attribute> attributes;
        std::vector<Annotation> annotations;
        std::uint32_t source_object = no_index, source_part = no_index;
    };
    std::vector<Patch> patches;  ///< TriangleSoup::patches are numbers of these

    std::vector<std::string> line_names;  ///< by id of embedded edges; may be shorter
    std::vector<SurfaceComplex::CornerName> corners;
    std::vector<SurfaceComplex::Interface> interfaces;
    std::vector<SurfaceComplex::Feature> features;  ///< over patches
    std::vector<StatedRegion> regions;              ///< over patches; empty: regions are found
    std::vector<SurfaceComplex::RegionList> layers, fault_blocks;
};

/// The vertices that the triangles of each patch use, ascending: the nodes of its surface. Cost: n log n.
std::vector<std::vector<std::uint32_t>> patch_vertices(const TriangleSoup& soup, std::size_t patches);

/// The soup as surfaces over welded vertices; equal positions are one vertex.
/// Failure (internal) where the soup is not what it promises or a patch, a face or an attribute does not fit. Cost: n log n.
Result<SurfaceComplex> complex_of_soup(SoupModel model);

}  // namespace geomend::topology
