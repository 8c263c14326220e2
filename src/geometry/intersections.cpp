// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/intersections.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/parallel.h"
#include "geometry/separation.h"

namespace geomend {

namespace {

constexpr std::size_t fours_per_block = 4;     // the triangles that walk through the tree together: 16
constexpr std::size_t blocks_per_chunk = 256;  // what one thread does at a time
constexpr std::size_t chunks_per_round = 64;   // between looks at the limit and at the monitor

/// Pairs of the triangles in one block with those that come after them in the tree's order.
class BlockSearch {
public:
    BlockSearch(const TriangleTree& tree, std::vector<TriangleMeetingPair>& found) : tree_(tree), near_(tree), found_(found) {}

    void run(std::size_t block) {
        const auto& fours = tree_.levels().front();
        const std::size_t first = block * fours_per_block, last = std::min(fours.size(), first + fours_per_block);
        near_.collect(outer_box(fours, first, last), [&](std::size_t four) { return four >= first; });
        for (std::size_t i = 4 * first; i < std::min(4 * last, tree_.size()); ++i) search(i, fours[i / 4].box(i % 4));
    }

private:
    const TriangleTree& tree_;
    Neighbourhood near_;
    std::vector<TriangleMeetingPair>& found_;

    void search(std::size_t i, const Box& box) {
        const Separator own(corners(tree_.triangle(i)));
        near_.visit_triangles(box, i + 1, [&](std::size_t j) { test(i, j, own); });
    }

    std::array<Vec3, 3> corners(const Triangle& t) const {
        const auto vertices = tree_.vertices();
        return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    }

    void test(std::size_t i, std::size_t j, const Separator& own) {
        const Triangle &a = tree_.triangle(i), &b = tree_.triangle(j);
        Corners a_shared = 0, b_shared = 0;
        for (unsigned m = 0; m < 3; ++m) {
            for (unsigned n = 0; n < 3; ++n) {
                const auto same = static_cast<unsigned>(a[m] == b[n]);
                a_shared |= same << m;
                b_shared |= same << n;
            }
        }
        const std::array<Vec3, 3> other = corners(b);
        if (own.clear_of(other, a_shared, b_shared)) return;
        if (Separator(other).clear_of(own.corners(), b_shared, a_shared)) return;
        TriangleMeetingPair pair{tree_.number(i), tree_.number(j), {}};
        // The first of the two is the one with the lower number, whatever their order in the tree.
        const bool ascending = pair.a < pair.b;
        pair.how = ascending ? meeting(tree_.vertices(), a, b) : meeting(tree_.vertices(), b, a);
        if (pair.how.kind == Meeting::none) return;
        if (!ascending) std::swap(pair.a, pair.b);
        found_.push_back(pair);
    }
};

}  // namespace

std::vector<TriangleMeetingPair> intersections(std::span<const Vec3> vertices, std::span<const Triangle> triangles, const Monitor* monitor,
                                               std::size_t most) {
    return intersections(TriangleTree(vertices, triangles), monitor, most);
}

std::vector<TriangleMeetingPair> intersections(const TriangleTree& tree, const Monitor* monitor, std::size_t most) {
    std::vector<TriangleMeetingPair> found;
    if (tree.size() == 0) return found;
    const std::size_t fours = tree.levels().front().size();
    const std::size_t blocks = (fours + fours_per_block - 1) / fours_per_block;
    const std::size_t chunks = (blocks + blocks_per_chunk - 1) / blocks_per_chunk;
    for (std::size_t round = 0; round < chunks && found.size() < most; round += chunks_per_round) {
        if (monitor != nullptr && monitor->stopped()) break;
        const std::size_t size = std::min(chunks_per_round, chunks - round);
        std::vector<std::vector<TriangleMeetingPair>> parts(size);
        parallel_for_each_index(size, [&](std::size_t part) {
            BlockSearch search(tree, parts[part]);
            const std::size_t first = (round + part) * blocks_per_chunk, last = std::min(blocks, first + blocks_per_chunk);
            for (std::size_t block = first; block != last && parts[part].size() < most; ++block) search.run(block);
        });
        for (const auto& part : parts) found.insert(found.end(), part.begin(), part.end());
        if (monitor != nullptr) monitor->progress("intersections", static_cast<double>(round + size) / static_cast<double>(chunks));
    }
    std::sort(found.begin(), found.end(), [](const auto& p, const auto& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
    if (found.size() > most) found.resize(most);
    return found;
}

}  // namespace geomend
