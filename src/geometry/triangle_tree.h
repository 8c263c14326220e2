// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "base/vec3.h"
#include "geometry/squeezed_space.h"
#include "geometry/triangle_pair.h"

namespace geomend {

/// A box along the axes. Coordinates are relative to the tree's origin, in its squeezed space, and rounded to float: both keep the
/// order of numbers, so that things which have a point in common still have boxes that do.
struct Box {
    std::array<float, 3> low, high;
};

/// Four boxes side by side, so that one is compared with all four at a time. Places not used are empty: they overlap nothing.
struct FourBoxes {
    std::array<std::array<float, 4>, 3> low, high;

    /// A box that overlaps nothing.
    static Box empty_box();
    Box box(std::size_t k) const { return {{low[0][k], low[1][k], low[2][k]}, {high[0][k], high[1][k], high[2][k]}}; }
    void set(std::size_t k, const Box& box);
    /// The smallest box around them.
    Box around() const;
    /// Bit k is set where box k and the given one have a point in common, be it on their borders.
    unsigned overlapping(const Box& box) const {
#ifdef __SSE2__
        const auto all = [](float x) { return _mm_set1_ps(x); };
        const auto four = [](const std::array<float, 4>& x) { return _mm_loadu_ps(x.data()); };
        __m128 hit = _mm_and_ps(_mm_cmple_ps(four(low[0]), all(box.high[0])), _mm_cmpge_ps(four(high[0]), all(box.low[0])));
        hit = _mm_and_ps(hit, _mm_and_ps(_mm_cmple_ps(four(low[1]), all(box.high[1])), _mm_cmpge_ps(four(high[1]), all(box.low[1]))));
        hit = _mm_and_ps(hit, _mm_and_ps(_mm_cmple_ps(four(low[2]), all(box.high[2])), _mm_cmpge_ps(four(high[2]), all(box.low[2]))));
        return static_cast<unsigned>(_mm_movemask_ps(hit));
#else
        unsigned hit = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const bool one = low[0][k] <= box.high[0] && high[0][k] >= box.low[0] && low[1][k] <= box.high[1] && high[1][k] >= box.low[1] &&
                             low[2][k] <= box.high[2] && high[2][k] >= box.low[2];
            hit |= static_cast<unsigned>(one) << k;
        }
        return hit;
#endif
    }
};

/// Calls visit(k) for each bit k that is set, the lowest first.
template <class Visit>
void visit_bits(unsigned bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

/// A search tree over the triangles of a soup: they are put in the order of a Hilbert curve through their centres, and boxes
/// are put around each four, each four fours, and so on (a packed R-tree). Degenerate triangles (equal vertex numbers, or
/// positions in line) are left out. Long empty stretches cost nothing: parts may lie
/// any distance apart. Memory: 48 bytes per triangle. Cost: linear, about 0.1 s per million.
class TriangleTree {
public:
    /// \param margin boxes are so much wider that triangles within this distance of each other have boxes that overlap
    /// \param groups of the triangles (their surfaces), or none: of triangles near each other those of one group are side by side
    TriangleTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles, double margin = 0,
                 std::span<const std::uint32_t> groups = {});

    std::size_t size() const { return order_.size(); }
    /// Number, in the given soup, of the i-th triangle in the tree's order.
    std::uint32_t number(std::size_t i) const { return order_[i]; }
    const Triangle& triangle(std::size_t i) const { return triangles_[i]; }
    /// All of them, in the tree's order.
    std::span<const Triangle> triangles() const { return triangles_; }
    std::span<const Vec3> vertices() const { return vertices_; }

    /// Boxes of triangles 4 i to 4 i + 3 for level 0; of the fours 4 i to 4 i + 3 of the level below for others. The last level is one.
    const std::vector<std::vector<FourBoxes>>& levels() const { return levels_; }

    /// The box around points that lie within `distance` of the box from `low` to `high`.
    Box box(const Vec3& low, const Vec3& high, double distance = 0) const;

    /// A box of the tree with everything that lies within `distance` of what it holds.
    Box widened(const Box& box, double distance) const;
    /// True only where the i-th triangle, by its box, is farther from the point than `distance`.
    bool is_farther(const Vec3& point, std::size_t i, double distance) const {
        const FourBoxes& boxes = levels_.front()[i / 4];
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = space_.at(k, point[k]) - origin_[k], slack = box_error_;
            const double beyond = std::max({0.0, boxes.low[k][i % 4] - x - slack, x - boxes.high[k][i % 4] - slack});
            square += beyond * beyond;
        }
        return square > distance * distance;
    }

    /// The box around node i of a level (see levels()), which is not the last one.
    Box outer_box(std::size_t level, std::size_t i) const { return levels_[level + 1][i / 4].box(i % 4); }

    /// Calls visit(i) for each node i of a level, ascending, whose outer box overlaps the given one; for the last level with 0.
    template <class Visit>
    void visit_nodes(std::size_t level, const Box& box, const Visit& visit) const {
        if (levels_.empty()) return;
        visit_below(levels_.size() - 1, 0, level, box, visit);
    }
    /// Level 0: the four triangles from 4 i on.
    template <class Visit>
    void visit_fours(const Box& box, const Visit& visit) const {
        visit_nodes(0, box, visit);
    }

    /// For nodes a <= b of one level: calls visit(i, first, hits) where the box of triangle i under a overlaps those of
    /// triangles first + k under b for each bit k of hits. Each pair of triangles comes once, i before the other.
    /// \param is_clear asked with (level, a, b) of two nodes: true where no pair of theirs is wanted
    template <class IsClear, class Visit>
    void visit_pairs(std::size_t level, std::size_t a, std::size_t b, const IsClear& is_clear, const Visit& visit) const {
        if (is_clear(level, a, b)) return;
        const FourBoxes &first = levels_[level][a], &second = levels_[level][b];
        const unsigned near = a != b && level + 1 < levels_.size() ? first.overlapping(outer_box(level, b)) : 15u;
        visit_bits(near, [&](std::size_t i) {
            unsigned hits = second.overlapping(first.box(i));
            if (level == 0) {
                if (a == b) hits &= ~0u << (i + 1);
                if (hits != 0) visit(4 * a + i, 4 * b, hits);
            } else {
                if (a == b) hits &= ~0u << i;
                visit_bits(hits, [&](std::size_t j) { visit_pairs(level - 1, 4 * a + i, 4 * b + j, is_clear, visit); });
            }
        });
    }

    template <class Visit>
    void visit_pairs(std::size_t level, std::size_t a, std::size_t b, const Visit& visit) const {
        visit_pairs(
            level, a, b, [](std::size_t, std::size_t, std::size_t) { return false; }, visit);
    }

    /// Calls visit(i) for each triangle in the tree's order, ascending, whose box overlaps the given one.
    template <class Visit>
    void visit_triangles(const Box& box, const Visit& visit) const {
        visit_fours(box,
                    [&](std::size_t four) { visit_bits(levels_[0][four].overlapping(box), [&](std::size_t k) { visit(4 * four + k); }); });
    }

private:
    std::span<const Vec3> vertices_;
    SqueezedSpace space_;
    Vec3 origin_{};
    double box_error_ = 0;  ///< no box coordinate is rounded by more
    std::vector<std::uint32_t> order_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<FourBoxes>> levels_;

    void sort_triangles(std::span<const Triangle> triangles, std::span<const std::uint32_t> groups);
    void make_boxes(double margin);

    template <class Visit>
    void visit_below(std::size_t level, std::size_t i, std::size_t target, const Box& box, const Visit& visit) const {
        if (level == target) return visit(i);
        visit_bits(levels_[level][i].overlapping(box), [&](std::size_t k) { visit_below(level - 1, 4 * i + k, target, box, visit); });
    }
};

}  // namespace geomend
