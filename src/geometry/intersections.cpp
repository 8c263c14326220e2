// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/intersections.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "geometry/node_groups.h"
#include "geometry/separation.h"

namespace geomend {

namespace {

constexpr std::size_t chunk_level = 4;        // what one thread does at a time: a node of this level, 1024 triangles
constexpr std::size_t chunks_per_round = 64;  // between looks at the limit and at the monitor

/// Pairs of the triangles in one node with these and those that come after them in the tree's order.
class NodeSearch {
public:
    /// \param groups of the triangles that need no look at pairs of their own, and of the nodes; may be empty
    NodeSearch(const TriangleTree& tree, PairTaker& taker, std::span<const std::uint32_t> groups, const NodeGroups& nodes)
        : tree_(tree), taker_(taker), groups_(groups), nodes_(nodes) {}

    void run(std::size_t level, std::size_t node) {
        const std::size_t size = std::size_t{4} << (2 * level), end = std::min(tree_.size(), (node + 1) * size);
        first_ = node * size;
        own_.resize(end - first_);
        const auto with = [&](std::size_t other) {
            if (other < node || taker_.is_full) return;
            const auto is_clear = [&](std::size_t l, std::size_t a, std::size_t b) { return !groups_.empty() && nodes_.are_one(l, a, b); };
            tree_.visit_pairs(level, node, other, is_clear, [&](std::size_t i, std::size_t first, unsigned hits) {
                if (taker_.is_full) return;
                visit_bits(hits, [&](std::size_t k) {
                    if (groups_.empty() || groups_[i] == NodeGroups::mixed || groups_[i] != groups_[first + k]) test(i, first + k);
                });
            });
        };
        if (level + 1 == tree_.levels().size()) with(node);
        else tree_.visit_nodes(level, tree_.outer_box(level, node), with);
    }

private:
    const TriangleTree& tree_;
    PairTaker& taker_;
    std::span<const std::uint32_t> groups_;
    const NodeGroups& nodes_;
    std::size_t first_ = 0;
    std::vector<std::optional<Separator>> own_;  ///< of the triangles of the node, from first_ on; made when first needed

    std::array<Vec3, 3> corners(std::size_t i) const {
        const Triangle& t = tree_.triangle(i);
        const auto vertices = tree_.vertices();
        return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    }

    void test(std::size_t i, std::size_t j) {
        if (taker_.is_choosy && !taker_.wants(tree_.number(i), tree_.number(j))) return;
        const Triangle &a = tree_.triangle(i), &b = tree_.triangle(j);
        Corners a_shared = 0, b_shared = 0;
        for (unsigned m = 0; m < 3; ++m) {
            for (unsigned n = 0; n < 3; ++n) {
                const auto same = static_cast<unsigned>(a[m] == b[n]);
                a_shared |= same << m;
                b_shared |= same << n;
            }
        }
        if (!own_[i - first_]) own_[i - first_].emplace(corners(i));
        const Separator& own = *own_[i - first_];
        const std::array<Vec3, 3> other = corners(j);
        const bool is_the_same = a_shared == 7;  // a triangle that is there twice: no corner is left to be on one side
        if (!is_the_same && (own.clear_of(other, a_shared, b_shared) || Separator(other).clear_of(own.corners(), b_shared, a_shared)))
            return;
        TriangleMeetingPair pair{tree_.number(i), tree_.number(j), {}};
        // The first of the two is the one with the lower number, whatever their order in the tree.
        const bool ascending = pair.a < pair.b;
        pair.how = ascending ? meeting(tree_.vertices(), a, b) : meeting(tree_.vertices(), b, a);
        if (pair.how.kind == Meeting::none) return;
        if (!ascending) std::swap(pair.a, pair.b);
        taker_.take(pair);
    }
};

}  // namespace

std::vector<TriangleMeetingPair> intersections(std::span<const Vec3> vertices, std::span<const Triangle> triangles, const Monitor* monitor,
                                               std::size_t most) {
    return intersections(TriangleTree(vertices, triangles), monitor, most);
}

std::vector<TriangleMeetingPair> intersections(const TriangleTree& tree, const Monitor* monitor, std::size_t most) {
    std::vector<TriangleMeetingPair> found;
    struct Part {
        PairTaker taker;
        std::vector<TriangleMeetingPair> pairs;
    };
    std::vector<Part> parts(intersection_parts(tree));
    const auto taker_of = [&](std::size_t i) -> PairTaker& {
        Part& part = parts[i];
        part.taker.is_full = found.size() >= most;
        part.taker.take = [&part, most](const TriangleMeetingPair& pair) {
            part.pairs.push_back(pair);
            part.taker.is_full = part.pairs.size() >= most;
        };
        return part.taker;
    };
    const auto after_round = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            found.insert(found.end(), parts[i].pairs.begin(), parts[i].pairs.end());
            parts[i].pairs = {};
        }
    };
    visit_intersections(tree, taker_of, after_round, monitor);
    std::sort(found.begin(), found.end(), [](const auto& p, const auto& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
    if (found.size() > most) found.resize(most);
    return found;
}

std::size_t intersection_parts(const TriangleTree& tree) {
    return tree.size() == 0 ? 0 : tree.levels()[std::min(chunk_level, tree.levels().size() - 1)].size();
}

void visit_intersections(const TriangleTree& tree, const std::function<PairTaker&(std::size_t part)>& taker_of,
                         const std::function<void(std::size_t first, std::size_t last)>& after_round, const Monitor* monitor,
                         std::span<const std::uint32_t> groups) {
    const std::size_t chunks = intersection_parts(tree);
    if (chunks == 0) return;
    const std::size_t level = std::min(chunk_level, tree.levels().size() - 1);
    const NodeGroups nodes(groups, groups.empty() ? 0 : level + 1);
    for (std::size_t round = 0; round < chunks; round += chunks_per_round) {
        if (monitor != nullptr && monitor->stopped()) break;
        const std::size_t size = std::min(chunks_per_round, chunks - round);
        parallel_for_each_index(size, [&](std::size_t part) {
            PairTaker& taker = taker_of(round + part);
            const bool is_stopped = monitor != nullptr && monitor->stopped();
            if (!taker.is_full && !is_stopped) NodeSearch(tree, taker, groups, nodes).run(level, round + part);
        });
        after_round(round, round + size);
        if (monitor != nullptr) monitor->progress("intersections", static_cast<double>(round + size) / static_cast<double>(chunks));
    }
}

}  // namespace geomend
