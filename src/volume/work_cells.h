// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "base/vec3.h"
#include "model/triangle_soup.h"
#include "volume/region_cells.h"
#include "volume/region_facets.h"

// The cells of a region while they are changed.

namespace geomend::volumes {

using Cell = std::array<std::uint32_t, 4>;

inline constexpr double least_gain = 1e-6;  ///< of a sine: less is none

inline std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

/// Edges and faces of facets, and further edges, which stay.
class FixedParts {
public:
    FixedParts(const RegionFacets& facets, std::span<const std::array<std::uint32_t, 2>> edges);
    bool has_edge(std::uint32_t a, std::uint32_t b) const { return edges_.contains(edge_key(a, b)); }
    bool has_face(Triangle t) const;

private:
    struct Hash {
        std::size_t operator()(const Triangle& t) const {
            return (std::size_t{t[0]} * 0x9e3779b97f4a7c15u ^ t[1]) * 0xbf58476d1ce4e5b9u ^ std::size_t{t[2]} * 0x94d049bb133111ebu;
        }
    };
    std::unordered_set<std::uint64_t> edges_;
    std::unordered_set<Triangle, Hash> faces_;
};

inline bool has(const Cell& c, std::uint32_t v) { return c[0] == v || c[1] == v || c[2] == v || c[3] == v; }

/// Cells that change, with the cells around each vertex.
class WorkCells {
public:
    /// Takes the cells out of the region.
    WorkCells(const RegionFacets& facets, RegionCells& region);

    std::size_t size() const { return cells_.size(); }
    bool is_there(std::uint32_t c) const { return sine_[c] >= 0; }
    const Cell& at(std::uint32_t c) const { return cells_[c]; }
    double sine_of(std::uint32_t c) const { return sine_[c]; }
    const std::vector<std::uint32_t>& around(std::uint32_t v) const { return around_[v]; }
    const Vec3& position(std::uint32_t v) const { return positions_[v]; }

    std::array<Vec3, 4> corners(const Cell& c) const { return {positions_[c[0]], positions_[c[1]], positions_[c[2]], positions_[c[3]]}; }
    double sine(const Cell& c) const;
    /// Of a cell that would be new: below 0 where it is flat or inside out.
    double sine_of_new(const Cell& c) const;
    /// The other cell at a face of a cell, or no_index.
    std::uint32_t across(std::uint32_t c, const Triangle& face) const;

    /// Puts cells in the place of others.
    void replace(std::span<const std::uint32_t> old, std::span<const Cell> made);
    /// Moves a vertex, if no cell around it turns over and the worst of them gets better by a hundredth.
    bool move(std::uint32_t v, const Vec3& to);
    /// Moves a vertex, if then no cell around it is flat or turned over, whether they were or not.
    bool move_and_turn(std::uint32_t v, const Vec3& to);
    /// A new vertex, which no cell has yet.
    std::uint32_t add_vertex(const Vec3& place);
    /// Puts a vertex elsewhere. \pre no cell has it yet
    void place(std::uint32_t v, const Vec3& place) { positions_[v] = place; }
    /// The worst cell at a vertex. \pre it has one
    std::uint32_t worst_around(std::uint32_t v) const;

    /// What was tried at a cell in vain is not tried again before something changes at one of its vertices.
    enum Tried : std::uint8_t { flips_and_moves = 1, new_vertex = 2, new_vertex_with_effort = 4 };
    bool is_tried(std::uint32_t c, Tried what) const { return (tried_[c] & what) != 0; }
    void set_tried(std::uint32_t c, Tried what) { tried_[c] |= what; }

    /// What is left, in the order in which it stands; new vertices that cells have, as they are now.
    void put_back(const RegionFacets& facets, RegionCells& region);

private:
    std::vector<Cell> cells_;
    std::vector<Vec3> positions_;
    std::vector<std::vector<std::uint32_t>> around_;
    std::vector<double> sine_;  ///< of each cell; -1: it is gone
    std::vector<std::uint8_t> tried_;

    void wake(std::uint32_t v);
};

}  // namespace geomend::volumes
