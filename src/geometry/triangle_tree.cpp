// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/triangle_tree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "base/bounds.h"
#include "base/parallel.h"
#include "geometry/hilbert_curve.h"
#include "geometry/predicates.h"

namespace geomend {

namespace {

constexpr std::size_t grain = 4096;
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr Box empty_box{{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};

// The ends of a box are finite, so that none overlaps an empty one; where they are no numbers it reaches as far as numbers do.
constexpr float largest = std::numeric_limits<float>::max();
float low_end(double x) { return x > -double{largest} ? static_cast<float>(std::min(x, double{largest})) : -largest; }
float high_end(double x) { return x < double{largest} ? static_cast<float>(std::max(x, -double{largest})) : largest; }

Bounds extent_of(std::span<const Vec3> points) {
    std::vector<Bounds> parts((points.size() + grain - 1) / grain);
    parallel_for_each_index(parts.size(), [&](std::size_t part) {
        const std::size_t last = std::min(points.size(), (part + 1) * grain);
        for (std::size_t i = part * grain; i < last; ++i) parts[part].add(points[i]);
    });
    Bounds all;
    for (const Bounds& part : parts) all.add(part);
    return all;
}

/// Sorts by the bits from `first_bit` on, keeping the order of equals: digit by digit, the lowest first.
void radix_sort(std::vector<std::uint64_t>& keys, unsigned first_bit) {
    constexpr unsigned digit_bits = 11;
    std::vector<std::uint64_t> sorted(keys.size());
    for (unsigned shift = first_bit; shift < 64; shift += digit_bits) {
        std::array<std::size_t, (std::size_t{1} << digit_bits) + 1> start{};
        const auto digit = [&](std::uint64_t key) { return key >> shift & ((1u << digit_bits) - 1); };
        for (const std::uint64_t key : keys) ++start[digit(key) + 1];
        if (!keys.empty() && start[digit(keys.front()) + 1] == keys.size()) continue;  // all have the same
        for (std::size_t d = 1; d < start.size(); ++d) start[d] += start[d - 1];
        for (const std::uint64_t key : keys) sorted[start[digit(key)]++] = key;
        keys.swap(sorted);
    }
}

/// Puts the members of large groups side by side, in the order in which the groups begin; those of small groups follow as they are,
/// since groups of a triangle or two say nothing of where things lie.
template <class Group>
void part_run(std::span<std::uint64_t> keys, const Group& group) {
    constexpr std::size_t large = 64;
    // A member of a group: the group, then its place in the run.
    std::vector<std::uint64_t> members(keys.size());
    for (std::size_t i = 0; i < members.size(); ++i) members[i] = std::uint64_t{group(keys[i])} << 32 | i;
    radix_sort(members, 32);
    const auto group_of = [](std::uint64_t member) { return member >> 32; };
    const auto place_of = [](std::uint64_t member) { return static_cast<std::uint32_t>(member); };
    std::vector<std::span<const std::uint64_t>> blocks;
    std::vector<std::uint8_t> is_in_block(keys.size(), 0);
    for (std::size_t first = 0, end = 0; first < members.size(); first = end) {
        while (end < members.size() && group_of(members[end]) == group_of(members[first])) ++end;
        if (end - first < large) continue;
        blocks.push_back(std::span(members).subspan(first, end - first));
        for (const std::uint64_t member : blocks.back()) is_in_block[place_of(member)] = 1;
    }
    std::ranges::sort(blocks, {}, [&](std::span<const std::uint64_t> block) { return place_of(block.front()); });
    std::vector<std::uint64_t> parted;
    parted.reserve(keys.size());
    for (const auto& block : blocks) {
        for (const std::uint64_t member : block) parted.push_back(keys[place_of(member)]);
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (is_in_block[i] == 0) parted.push_back(keys[i]);
    }
    std::ranges::copy(parted, keys.begin());
}

/// The same within each run of a node of the tree, so that what lies far apart stays so.
template <class Group>
void part_by_groups(std::span<std::uint64_t> keys, const Group& group) {
    constexpr std::size_t run = 65536;
    parallel_for_each_index((keys.size() + run - 1) / run,
                            [&](std::size_t i) { part_run(keys.subspan(run * i, std::min(run, keys.size() - run * i)), group); });
}

bool degenerate(std::span<const Vec3> vertices, const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || in_line(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
}

void enclose(Box& box, const Box& other) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], other.low[k]);
        box.high[k] = std::max(box.high[k], other.high[k]);
    }
}

}  // namespace

void FourBoxes::set(std::size_t k, const Box& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis][k] = box.low[axis];
        high[axis][k] = box.high[axis];
    }
}

Box FourBoxes::empty_box() { return geomend::empty_box; }

Box FourBoxes::around() const {
    Box all = geomend::empty_box;
    for (std::size_t k = 0; k < 4; ++k) enclose(all, box(k));
    return all;
}

TriangleTree::TriangleTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles, double margin,
                           std::span<const std::uint32_t> groups)
    : vertices_(vertices) {
    sort_triangles(triangles, groups);
    make_boxes(margin);
}

Box TriangleTree::box(const Vec3& low, const Vec3& high, double distance) const {
    Box box{};
    const double reach = distance > 0 ? distance + box_error_ : 0;
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = low_end(space_.at(k, low[k]) - origin_[k] - reach);
        box.high[k] = high_end(space_.at(k, high[k]) - origin_[k] + reach);
    }
    return box;
}

Box TriangleTree::widened(const Box& box, double distance) const {
    const auto by = static_cast<float>((distance + 2 * box_error_) * (1 + 1e-6));
    Box wide = box;
    for (std::size_t k = 0; k < 3; ++k) {
        wide.low[k] = low_end(box.low[k] - by);
        wide.high[k] = high_end(box.high[k] + by);
    }
    return wide;
}

void TriangleTree::sort_triangles(std::span<const Triangle> triangles, std::span<const std::uint32_t> groups) {
    const std::size_t count = triangles.size();
    if (count == 0) return;
    Bounds extent = extent_of(vertices_);
    space_ = SqueezedSpace(vertices_, triangles, extent.low, extent.high);
    double side = 0, stretch = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        stretch = std::max(stretch, extent.high[k] - extent.low[k]);
        extent.low[k] = space_.at(k, extent.low[k]);
        extent.high[k] = space_.at(k, extent.high[k]);
        origin_[k] = extent.low[k] + 0.5 * (extent.high[k] - extent.low[k]);
        side = std::max(side, extent.high[k] - extent.low[k]);
    }
    // A float within side / 2 of 0 is rounded by 2^-25 of the side at most; squeezing rounds as double precision does.
    box_error_ = side * 0x1p-23 + stretch * 0x1p-50;
    // A key is the place of the centre on the curve, followed by the number of the triangle; those left out come last.
    const auto number_bits = static_cast<unsigned>(std::bit_width(count));
    const unsigned bits = std::min(16u, (63 - number_bits) / 3);
    const std::uint32_t cells = 1u << bits;
    const double scale = side > 0 ? cells / side / 3 : 0;
    std::vector<std::uint64_t> keys(count);
    parallel_blocks(count, grain, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i != to; ++i) {
            const Triangle& t = triangles[i];
            if (degenerate(vertices_, t)) {
                keys[i] = std::uint64_t{1} << 63 | i;
                continue;
            }
            std::array<std::uint32_t, 3> cell{};
            for (std::size_t k = 0; k < 3; ++k) {
                double sum = 0;
                for (const std::uint32_t v : t) sum += space_.at(k, vertices_[v][k]) - extent.low[k];
                cell[k] = sum * scale > 0 ? static_cast<std::uint32_t>(std::min(sum * scale, cells - 1.0)) : 0;
            }
            keys[i] = hilbert_place(cell, bits) << number_bits | i;
        }
    });
    radix_sort(keys, number_bits);
    const std::uint64_t number_mask = (std::uint64_t{1} << number_bits) - 1;
    while (!keys.empty() && keys.back() >> 63 != 0) keys.pop_back();
    if (!groups.empty()) part_by_groups(keys, [&](std::uint64_t key) { return groups[key & number_mask]; });
    order_.resize(keys.size());
    triangles_.resize(keys.size());
    parallel_blocks(keys.size(), grain, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i != to; ++i) {
            order_[i] = static_cast<std::uint32_t>(keys[i] & number_mask);
            triangles_[i] = triangles[order_[i]];
        }
    });
}

void TriangleTree::make_boxes(double margin) {
    const auto fours = [](std::size_t count) { return (count + 3) / 4; };
    const auto make_level = [&](std::size_t count, const auto& box_of) {
        std::vector<FourBoxes>& level = levels_.emplace_back(fours(count));
        parallel_blocks(level.size(), grain / 4, [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i != to; ++i) {
                for (std::size_t k = 0; k < 4; ++k) level[i].set(k, 4 * i + k < count ? box_of(4 * i + k) : empty_box);
            }
        });
    };
    if (triangles_.empty()) return;
    levels_.reserve(18);  // 4^17 triangles and more than 32 bits can number: references stay valid
    make_level(triangles_.size(), [&](std::size_t i) {
        const auto& [a, b, c] = triangles_[i];
        const Vec3 &p = vertices_[a], &q = vertices_[b], &r = vertices_[c];
        Vec3 low, high;  // squeezing keeps the order along each axis
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min({p[k], q[k], r[k]});
            high[k] = std::max({p[k], q[k], r[k]});
        }
        return box(low, high, margin / 2);
    });
    while (levels_.back().size() > 1) {
        const std::vector<FourBoxes>& below = levels_.back();
        make_level(below.size(), [&](std::size_t i) { return below[i].around(); });
    }
}

}  // namespace geomend
