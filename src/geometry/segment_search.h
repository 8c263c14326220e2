// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend {

/// Triangles in a tree of boxes, for segments that look for what they hit first. In double precision: for measures, not
/// for decisions that must be exact.
class SegmentSearch {
public:
    using Triangle = std::array<std::uint32_t, 3>;

    /// Both spans outlive the tree. Cost: n log n.
    SegmentSearch(std::span<const Vec3> points, std::span<const Triangle> triangles);

    /// Calls hit(triangle, t) for each triangle that the segment from + t direction, 0 < t <= most, passes through; the
    /// direction's length is the unit of t. In no special order. Parallel triangles are not hit.
    template <class Hit>
    void along(const Vec3& from, const Vec3& direction, double most, const Hit& hit) const {
        std::array<std::uint32_t, 64> stack;
        std::size_t depth = 0;
        if (!nodes_.empty()) stack[depth++] = 0;
        while (depth > 0) {
            const Node& node = nodes_[stack[--depth]];
            if (!meets(node, from, direction, most)) continue;
            if (node.count == 0) {
                stack[depth++] = node.first;
                stack[depth++] = node.first + 1;
                continue;
            }
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                double t = 0;
                if (passes(order_[i], from, direction, t) && t > 0 && t <= most) hit(order_[i], t);
            }
        }
    }

private:
    struct Node {
        Vec3 low{}, high{};
        std::uint32_t first = 0, count = 0;  ///< triangles in order_; count 0: children first and first + 1
    };

    void build(std::uint32_t node, std::uint32_t first, std::uint32_t last);
    static bool meets(const Node& node, const Vec3& from, const Vec3& direction, double most);
    bool passes(std::uint32_t triangle, const Vec3& from, const Vec3& direction, double& t) const;

    std::span<const Vec3> points_;
    std::span<const Triangle> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace geomend
