// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "hexes/lattice.h"
#include "remesh/pattern.h"

namespace geomend::hexes {

/// The lattices of a model's regions, and those which its surfaces and lines take: of the regions beside them the first with layers, else
/// the common one.
struct RegionLattices {
    Lattice common;
    std::vector<Lattice> of_region;
    std::vector<std::uint32_t> of_surface, of_line;  ///< regions; no_index: the common lattice

    const Lattice& at(std::uint32_t region) const { return region < of_region.size() ? of_region[region] : common; }
};
RegionLattices region_lattices(const BrepData& brep, std::span<const volumes::RegionFacets> regions, const Lattice& common);

/// Right-angled sampling: new vertices of lines and surfaces lie where the planes and lines of a lattice cross them, so that triangles
/// are halves of quadrangles that agree with the lattice's cells on both sides.
/// Source: A. Botella (2016), 2.5.3, and its boundary test.
/// \pre the lattices outlive the pattern
remeshing::Pattern lattice_pattern(const RegionLattices& lattices);

/// Where a polyline crosses the planes of a lattice that it runs across the most, no nearer to each other and to points that stay than
/// half a step; longer gaps are parted evenly, and points of the polyline are added where the new one would be too far from it.
std::vector<remeshing::LineSample> lattice_line(const Lattice& lattice, std::span<const Vec3> points, const remeshing::LineRules& rules);

/// Where the lines of a lattice along the axis to which a surface faces the most cross it, no nearer to its borders than half a step,
/// and no nearer to each other and to places that are taken than about that. Triangles that are steep against that axis count by their
/// own. Cost: linear in triangles and points, with a few border edges for each point.
std::vector<remeshing::SurfacePoint> lattice_surface(const Lattice& lattice, const remeshing::EdgeMesh& surface,
                                                     std::span<const Vec3> taken);

}  // namespace geomend::hexes
