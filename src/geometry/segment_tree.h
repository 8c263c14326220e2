// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend {

using Segment = std::array<Vec3, 2>;

/// The closest points of two segments: how far apart they are, and where they lie (0 at the first end, 1 at the second).
struct SegmentDistance {
    double distance = 0;
    double along_first = 0, along_second = 0;
    Vec3 on_first{}, on_second{};
};

/// In plain arithmetic relative to the first end: errors of some 1e-16 of the lengths and distances at hand. Of parallel
/// segments that lie side by side any place of theirs. Segments may be points. \pre finite
SegmentDistance closest_points(const Segment& first, const Segment& second);

/// The length along which two segments lie side by side, nowhere farther apart than `distance`, and where; 0 where there is
/// none. \pre neither is a point
struct SideBySide {
    double length = 0;
    Segment where{};
};
SideBySide side_by_side(const Segment& first, const Segment& second, double distance);

/// A tree of boxes around segments, for all pairs that may come near each other. It halves the segments at the median of
/// their middles, along the axis on which these differ most. Cost: n log n; memory 60 bytes per segment.
class SegmentTree {
public:
    /// \param distance boxes that are this near overlap; the segments outlive the tree and are finite
    SegmentTree(std::span<const Segment> segments, double distance);

    /// Calls visit(a, b), a and b numbers of segments, for each pair whose boxes overlap, once; until it returns false.
    template <class Visit>
    void visit_pairs(const Visit& visit) const {
        if (!nodes_.empty()) visit_within(0, visit);
    }

private:
    struct Node {
        Vec3 low, high;
        std::uint32_t first, last;   // into order_
        std::uint32_t second_child;  // 0: a leaf; the first child follows its parent
    };
    static constexpr std::size_t leaf_size = 4;

    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;

    std::uint32_t build(std::span<const Segment> segments, std::uint32_t first, std::uint32_t last, double distance);
    static bool overlap(const Node& a, const Node& b) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
        }
        return true;
    }

    template <class Visit>
    bool visit_within(std::uint32_t n, const Visit& visit) const {
        const Node& node = nodes_[n];
        if (node.second_child != 0)
            return visit_within(n + 1, visit) && visit_within(node.second_child, visit) && visit_between(n + 1, node.second_child, visit);
        for (std::uint32_t i = node.first; i < node.last; ++i) {
            for (std::uint32_t j = i + 1; j < node.last; ++j) {
                if (!visit(order_[i], order_[j])) return false;
            }
        }
        return true;
    }
    template <class Visit>
    bool visit_between(std::uint32_t m, std::uint32_t n, const Visit& visit) const {
        const Node &a = nodes_[m], &b = nodes_[n];
        if (!overlap(a, b)) return true;
        if (a.second_child != 0 && (b.second_child == 0 || a.last - a.first >= b.last - b.first))
            return visit_between(m + 1, n, visit) && visit_between(a.second_child, n, visit);
        if (b.second_child != 0) return visit_between(m, n + 1, visit) && visit_between(m, b.second_child, visit);
        for (std::uint32_t i = a.first; i < a.last; ++i) {
            for (std::uint32_t j = b.first; j < b.last; ++j) {
                if (!visit(order_[i], order_[j])) return false;
            }
        }
        return true;
    }
};

}  // namespace geomend
