// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/intersections.h"

#include <algorithm>
#include <iterator>
#include <optional>
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
    BlockSearch(const TriangleTree& tree, std::vector<TriangleMeetingPair>& found) : tree_(tree), found_(found) {}

    void run(std::size_t block) {
        const auto& fours = tree_.levels().front();
        const std::size_t first = block * fours_per_block, last = std::min(fours.size(), first + fours_per_block);
        collect(first, last);
        for (std::size_t four = first; four != last; ++four) {
            for (std::size_t k = 0; k < 4 && 4 * four + k < tree_.size(); ++k) search(4 * four + k, fours[four].box(k));
        }
    }

private:
    const TriangleTree& tree_;
    std::vector<TriangleMeetingPair>& found_;
    std::vector<std::size_t> near_;      ///< fours whose outer box overlaps that of the block, none before it
    std::vector<FourBoxes> near_boxes_;  ///< their outer boxes, four by four

    void collect(std::size_t first, std::size_t last) {
        const auto& fours = tree_.levels().front();
        FourBoxes own;
        for (std::size_t k = 0; k < 4; ++k) own.set(k, fours[std::min(first + k, last - 1)].around());
        near_.clear();
        near_boxes_.clear();
        tree_.visit_fours(own.around(), [&](std::size_t four) {
            if (four < first) return;
            if (near_.size() % 4 == 0) near_boxes_.push_back(empty_boxes());
            near_boxes_.back().set(near_.size() % 4, fours[four].around());
            near_.push_back(four);
        });
    }

    void search(std::size_t i, const Box& box) {
        const auto& fours = tree_.levels().front();
        std::optional<Separator> own;
        for (std::size_t group = 0; group < near_boxes_.size(); ++group) {
            const unsigned hit = near_boxes_[group].overlapping(box);
            for (std::size_t k = 0; hit >> k != 0; ++k) {
                if ((hit >> k & 1u) == 0) continue;
                const std::size_t four = near_[4 * group + k];
                if (4 * four + 3 <= i) continue;
                const unsigned pairs = fours[four].overlapping(box);
                for (std::size_t m = 0; pairs >> m != 0; ++m) {
                    if ((pairs >> m & 1u) == 0 || 4 * four + m <= i) continue;
                    if (!own) own.emplace(corners(tree_.triangle(i)));
                    test(i, 4 * four + m, *own);
                }
            }
        }
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

    static FourBoxes empty_boxes() {
        FourBoxes boxes;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            boxes.low[axis].fill(HUGE_VALF);
            boxes.high[axis].fill(-HUGE_VALF);
        }
        return boxes;
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
