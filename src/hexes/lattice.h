// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hexes/layers.h"
#include "model/brep.h"
#include "volume/region_facets.h"

namespace geomend::hexes {

/// Points at even steps along three directions at right angles; in regions between a base and a top as many along the third one in each
/// column, whatever its height.
struct Lattice {
    Vec3 origin{};
    std::array<Vec3, 3> axes{};            ///< of length 1
    Vec3 steps{};                          ///< above 0; with layers their height for the third
    std::shared_ptr<const Layers> layers;  ///< none: even steps
    double base_step = 0;                  ///< with layers the step in which they are given

    /// In steps along the axes from the origin, and layers.
    Vec3 coordinates(const Vec3& p) const;
    Vec3 place(const Vec3& coordinates) const;
    double least_step() const;
};

/// The lattice along the main axes that parts the model's extent along each of them into equal steps near `size`.
/// \param size 0: the median edge of the triangles, by area
Lattice lattice_of(const BrepData& brep, double size);

/// The lattice of a region: with layer coordinates where it has a base and a top all over, else the one given. Cost: as of points_inside().
Lattice lattice_of_region(const volumes::RegionFacets& facets, const Lattice& lattice);

/// Places as they would be if all layers of a lattice were level and even, to a small part of a step, so that those on its planes share
/// them, and with a little of their own heights, so that cells which would be flat by it turn the way in which they do; nothing for one
/// without layers in all of its columns. \pre steps and layers are those of a region that holds the places
std::vector<Vec3> along_layers(const Lattice& lattice, std::span<const Vec3> places);

/// Those points of a lattice that lie in a region and no nearer to its facets and edges than `clear` of the least step, in the order of
/// their coordinates. They are moved by a ten-millionth of a step, so that no eight of them lie on a sphere. Cost: n log n in facets and
/// points.
std::vector<Vec3> points_inside(const volumes::RegionFacets& facets, const Lattice& lattice, double clear = 0.4999);

}  // namespace geomend::hexes
