// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "geometry/triangle_pair.h"

namespace geomend {

/// A box along the axes. Coordinates are relative to the tree's origin and rounded to float: rounding keeps the order of
/// numbers, so that things which have a point in common still have boxes that do.
struct Box {
    std::array<float, 3> low, high;
};

/// Four boxes side by side, so that one is compared with all four at a time. Places not used are empty: they overlap nothing.
struct FourBoxes {
    std::array<std::array<float, 4>, 3> low, high;

    Box box(std::size_t k) const { return {{low[0][k], low[1][k], low[2][k]}, {high[0][k], high[1][k], high[2][k]}}; }
    void set(std::size_t k, const Box& box);
    /// The smallest box around them.
    Box around() const;
    /// Bit k is set where box k and the given one have a point in common, be it on their borders.
    unsigned overlapping(const Box& box) const {
        std::array<std::int32_t, 4> hit;
        for (std::size_t k = 0; k < 4; ++k) {
            hit[k] = (low[0][k] <= box.high[0]) & (high[0][k] >= box.low[0]) & (low[1][k] <= box.high[1]) & (high[1][k] >= box.low[1]) &
                     (low[2][k] <= box.high[2]) & (high[2][k] >= box.low[2]);
        }
        return static_cast<unsigned>(hit[0] | hit[1] << 1 | hit[2] << 2 | hit[3] << 3);
    }
};

/// A search tree over the triangles of a soup: they are put in the order of a Hilbert curve through their centres, and boxes
/// are put around each four, each four fours, and so on (a packed R-tree). Degenerate triangles (equal vertex numbers, or
/// positions in line) are left out. Memory: 48 bytes per triangle, 64 while it is made. Cost: n; about 0.1 s per million.
class TriangleTree {
public:
    TriangleTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

    std::size_t size() const { return order_.size(); }
    /// Number, in the given soup, of the i-th triangle in the tree's order.
    std::uint32_t number(std::size_t i) const { return order_[i]; }
    const Triangle& triangle(std::size_t i) const { return triangles_[i]; }
    std::span<const Vec3> vertices() const { return vertices_; }

    /// Boxes of triangles 4 i to 4 i + 3 for level 0; of the fours 4 i to 4 i + 3 of the level below for others. The last level is one.
    const std::vector<std::vector<FourBoxes>>& levels() const { return levels_; }

    /// The box around points that lie within `distance` of the box from `low` to `high`.
    Box box(const Vec3& low, const Vec3& high, double distance = 0) const;

    /// Calls visit(i) for each i, ascending, such that the four triangles from 4 i on have an outer box that overlaps the given one.
    template <class Visit>
    void visit_fours(const Box& box, const Visit& visit) const {
        if (levels_.empty()) return;
        if (levels_.size() == 1) return visit(std::size_t{0});
        visit_below(levels_.size() - 1, 0, box, visit);
    }

    /// Calls visit(i) for each triangle in the tree's order, ascending, whose box overlaps the given one.
    template <class Visit>
    void visit_triangles(const Box& box, const Visit& visit) const {
        visit_fours(box, [&](std::size_t four) {
            const unsigned hit = levels_[0][four].overlapping(box);
            for (std::size_t k = 0; k < 4; ++k) {
                if ((hit >> k & 1u) != 0) visit(4 * four + k);
            }
        });
    }

private:
    std::span<const Vec3> vertices_;
    Vec3 origin_{};
    std::vector<std::uint32_t> order_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<FourBoxes>> levels_;

    void sort_triangles(std::span<const Triangle> triangles);
    void make_boxes();

    template <class Visit>
    void visit_below(std::size_t level, std::size_t i, const Box& box, const Visit& visit) const {
        const unsigned hit = levels_[level][i].overlapping(box);
        for (std::size_t k = 0; k < 4; ++k) {
            if ((hit >> k & 1u) == 0) continue;
            if (level == 1) visit(4 * i + k);
            else visit_below(level - 1, 4 * i + k, box, visit);
        }
    }
};

}  // namespace geomend
