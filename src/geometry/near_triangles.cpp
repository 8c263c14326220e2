// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/near_triangles.h"

#include <algorithm>

namespace geomend {

bool NearTriangles::collect(std::size_t level, std::size_t node, std::size_t most) {
    pairs_.clear();
    most_ = most;
    widen(level, node);
    const auto with = [&](std::size_t other) {
        if (other >= node && !groups_.are_one(level, node, other) && pairs_.size() <= most_) descend(level, 0, node, other);
    };
    const TriangleTree& tree = soup_.tree();
    if (level + 1 == tree.levels().size()) with(node);
    else tree.visit_nodes(level, wide_[level][0].around(), with);
    const bool are_all = pairs_.size() <= most_;
    list_by_triangle();
    return are_all;
}

/// The boxes of the triangles under the node, wider by the lengths of their groups; those of groups without one are empty.
void NearTriangles::widen(std::size_t level, std::size_t node) {
    const TriangleTree& tree = soup_.tree();
    const std::size_t triangles = std::size_t{4} << (2 * level), first = triangles * node;
    first_ = static_cast<std::uint32_t>(first);
    const std::size_t count = std::min(triangles, tree.size() - first);
    start_.assign(count + 1, 0);
    wide_.resize(level + 1);
    for (std::size_t l = 0; l <= level; ++l) {
        std::vector<FourBoxes>& wide = wide_[l];
        const std::size_t below = l == 0 ? count : wide_[l - 1].size();
        wide.resize((below + 3) / 4);
        for (std::size_t i = 0; i < 4 * wide.size(); ++i) {
            Box box = FourBoxes::empty_box();
            if (l > 0 && i < below) box = wide_[l - 1][i].around();
            if (l == 0 && i < below) {
                const double near = near_[soup_.group(static_cast<std::uint32_t>(first + i))];
                if (near > 0) box = tree.widened(tree.levels()[0][(first + i) / 4].box(i % 4), near);
            }
            wide[i / 4].set(i % 4, box);
        }
    }
}

/// \param local the node's place among those under the one that is looked about
void NearTriangles::descend(std::size_t level, std::size_t local, std::size_t node, std::size_t other) {
    const TriangleTree& tree = soup_.tree();
    const FourBoxes &own = wide_[level][local], &boxes = tree.levels()[level][other];
    const unsigned within = node != other && level + 1 < tree.levels().size() ? own.overlapping(tree.outer_box(level, other)) : 15u;
    visit_bits(within, [&](std::size_t i) {
        unsigned hits = boxes.overlapping(own.box(i));
        if (node == other) hits &= ~0u << (level == 0 ? i + 1 : i);
        visit_bits(hits, [&](std::size_t k) {
            if (level == 0) take(static_cast<std::uint32_t>(4 * node + i), static_cast<std::uint32_t>(4 * other + k));
            else if (!groups_.are_one(level - 1, 4 * node + i, 4 * other + k) && pairs_.size() <= most_)
                descend(level - 1, 4 * local + i, 4 * node + i, 4 * other + k);
        });
    });
}

void NearTriangles::take(std::uint32_t t, std::uint32_t other) {
    const std::uint32_t own = soup_.group(t), group = soup_.group(other);
    if (group == own || near_[group] != near_[own]) return;
    const Triangle& v = soup_.triangle(t);
    if (soup_.has(other, v[0]) || soup_.has(other, v[1]) || soup_.has(other, v[2])) return;
    pairs_.push_back({t - first_, other});
}

void NearTriangles::list_by_triangle() {
    for (const auto& [t, other] : pairs_) ++start_[t + 1];
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    others_.resize(pairs_.size());
    std::vector<std::size_t> at(start_.begin(), start_.end() - 1);
    for (const auto& [t, other] : pairs_) others_[at[t]++] = other;
}

}  // namespace geomend
