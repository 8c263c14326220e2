// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "model/dataset.h"

namespace geomend::testing {

/// A face between two cells of a grid of blocks; outside of the grid the region is 0, as it is for blocks left out.
struct BlockWall {
    int axis;                      ///< 0 to 2: along which the two cells follow one another
    std::array<int, 3> low, high;  ///< the cells; where one is outside of the grid its number along the axis is -1 or the size
    int low_region, high_region;

    bool between(int a, int b) const { return (low_region == a && high_region == b) || (low_region == b && high_region == a); }
    /// The plane of nodes along the axis that it lies in, seen from below.
    int plane() const { return low[static_cast<std::size_t>(axis)] + 1; }
};

/// A model as a bent grid of blocks: all meshes conform, whatever the form. Nodes may be at one position: cells without height
/// are skipped, triangles without area are left out.
struct Blocks {
    std::array<int, 3> size{};                                    ///< cells along x, y, z
    std::function<Vec3(int, int, int)> node;                      ///< position of each node; z upwards
    std::function<int(int, int, int)> region;                     ///< of each cell, from 1 without gaps; 0: outside
    std::function<std::string(const BlockWall&)> surface;         ///< that a wall between two regions belongs to; empty: none is there
    std::function<std::string(const BlockWall&)> sheet;           ///< the same for walls inside a region; may be empty
    std::map<std::string, FeatureRole> roles;                     ///< of the surfaces; those not listed are boundaries
    std::function<bool(int, std::array<int, 3>)> other_diagonal;  ///< of the wall across an axis with this lowest node; may be empty
};

/// What was made of it.
struct BlockModel {
    Dataset data;                 ///< one StatedModel: a part for each piece between contacts, regions with their sides, Universe
    std::vector<double> volumes;  ///< per region, from the cells

    StatedModel& stated() { return data.models.front(); }
    const StatedModel& stated() const { return data.models.front(); }
    Surface& surface(const std::string& name);
};

/// The name of the side of the box that a wall lies on: bottom, top, west, east, south, north.
std::string box_side(const BlockWall& wall);
/// The same for walls to the outside; else the name given.
std::string box_side_or(const BlockWall& wall, const std::string& name);

/// Puts the walls together. The front of a surface is the side of the outside, else of the region of the higher number. A part
/// is cut open along contacts that run inside of it, with points of its own for both lips.
BlockModel make_block_model(const Blocks& blocks);

/// The model without its region lists.
Dataset without_lists(Dataset data);
/// The surfaces alone, each interface one surface with one point for each position.
Dataset loose_surfaces(const Dataset& data);

}  // namespace geomend::testing
