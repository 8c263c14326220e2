// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/search.h"

#include <algorithm>
#include <atomic>

#include "base/parallel.h"
#include "geometry/triangle_tree.h"

namespace geomend::arrangement {

namespace {

constexpr std::size_t chunk_level = 3;  // what one thread does at a time: a node of this level, 256 triangles

bool has_same_corners(const Triangle& a, const Triangle& b) {
    const auto is_in = [&](std::uint32_t v) { return v == b[0] || v == b[1] || v == b[2]; };
    return is_in(a[0]) && is_in(a[1]) && is_in(a[2]);
}

/// Some triangles of a soup, by their numbers there.
struct Subset {
    std::vector<std::uint32_t> numbers;
    std::vector<Triangle> triangles;

    void add(std::uint32_t number, const Triangle& t) {
        numbers.push_back(number);
        triangles.push_back(t);
    }
};

/// The new triangles and those whose boxes are within the distance of theirs: all others were looked at before.
Subset near_new(std::span<const Vec3> points, std::span<const Triangle> triangles, std::span<const std::uint8_t> is_new, double distance) {
    Subset fresh;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (is_new[t] != 0) fresh.add(t, triangles[t]);
    }
    std::vector<std::uint8_t> is_near(triangles.size(), 1);
    if (4 * fresh.numbers.size() < triangles.size()) {
        const TriangleTree tree(points, fresh.triangles, distance);
        parallel_blocks(triangles.size(), 4096, [&](std::size_t from, std::size_t to) {
            for (std::size_t t = from; t < to; ++t) {
                if (is_new[t] != 0) continue;
                Vec3 low = points[triangles[t][0]], high = low;
                for (const std::uint32_t v : triangles[t]) {
                    for (std::size_t k = 0; k < 3; ++k) {
                        low[k] = std::min(low[k], points[v][k]);
                        high[k] = std::max(high[k], points[v][k]);
                    }
                }
                is_near[t] = 0;
                if (tree.size() > 0) tree.visit_triangles(tree.box(low, high, distance), [&](std::size_t) { is_near[t] = 1; });
            }
        });
    }
    Subset near;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (is_near[t] != 0) near.add(t, triangles[t]);
    }
    return near;
}

class ChunkSearch {
public:
    ChunkSearch(const TriangleTree& tree, std::span<const std::uint32_t> numbers, std::span<const std::uint8_t> is_new, double distance,
                std::size_t most_points, NearFeatures& to)
        : tree_(tree), numbers_(numbers), is_new_(is_new), distance_(distance), most_points_(most_points), to_(to) {}

    void run(std::size_t level, std::size_t node) {
        const std::size_t size = std::size_t{4} << (2 * level), end = std::min(tree_.size(), (node + 1) * size);
        first_ = node * size;
        for (std::size_t i = first_; i < end; ++i) {
            own_.emplace_back(tree_.vertices(), tree_.triangle(i));
            if (is_new_[number(i)] != 0) add_flat_corner(own_.back(), distance_, to_);
        }
        const auto with = [&](std::size_t other) {
            if (other < node) return;
            tree_.visit_pairs(level, node, other, [&](std::size_t i, std::size_t first, unsigned hits) {
                visit_bits(hits, [&](std::size_t k) { test(i, first + k); });
            });
        };
        if (level + 1 == tree_.levels().size()) with(node);
        else tree_.visit_nodes(level, tree_.outer_box(level, node), with);
    }

private:
    const TriangleTree& tree_;
    std::span<const std::uint32_t> numbers_;
    std::span<const std::uint8_t> is_new_;
    double distance_;
    std::size_t most_points_;
    NearFeatures& to_;
    std::size_t first_ = 0;
    std::vector<FlatTriangle> own_;

    std::uint32_t number(std::size_t i) const { return numbers_[tree_.number(i)]; }

    void test(std::size_t i, std::size_t j) {
        const std::uint32_t a = number(i), b = number(j);
        if ((is_new_[a] | is_new_[b]) == 0 || to_.points.size() > most_points_) return;
        const FlatTriangle& own = own_[i - first_];
        const FlatTriangle other(tree_.vertices(), tree_.triangle(j));
        if (has_same_corners(own.vertex, other.vertex)) to_.same.push_back({std::min(a, b), std::max(a, b)});
        else if (keep_clear(own, other, distance_)) return;
        else if (a < b) add_near_features(own, a, other, b, distance_, to_);
        else add_near_features(other, b, own, a, distance_, to_);
    }
};

/// Triangles without area are not in the tree: a corner of theirs stands on the edge opposite.
void add_flat_triangles(const TriangleTree& tree, std::span<const Triangle> triangles, double distance, NearFeatures& to) {
    if (tree.size() == triangles.size()) return;
    std::vector<std::uint8_t> is_in(triangles.size(), 0);
    for (std::size_t i = 0; i < tree.size(); ++i) is_in[tree.number(i)] = 1;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (is_in[t] == 0) add_flat_corner(FlatTriangle(tree.vertices(), triangles[t]), distance, to);
    }
}

/// Puts one chunk's findings behind the others; numbers of new points and places in `common` move along.
void append(NearFeatures& all, const NearFeatures& chunk) {
    const auto points = static_cast<std::uint32_t>(all.points.size()), common = static_cast<std::uint32_t>(all.common.size());
    all.on_edges.insert(all.on_edges.end(), chunk.on_edges.begin(), chunk.on_edges.end());
    all.on_faces.insert(all.on_faces.end(), chunk.on_faces.begin(), chunk.on_faces.end());
    all.points.insert(all.points.end(), chunk.points.begin(), chunk.points.end());
    all.same.insert(all.same.end(), chunk.same.begin(), chunk.same.end());
    for (auto pair : chunk.pairs) {
        pair.begin += common;
        pair.end += common;
        all.pairs.push_back(pair);
    }
    for (const std::uint32_t c : chunk.common) all.common.push_back(c >= NearFeatures::first_new ? c + points : c);
}

}  // namespace

NearFeatures search(std::span<const Vec3> points, std::span<const Triangle> triangles, std::span<const std::uint8_t> is_new,
                    double distance, const Monitor* monitor, std::size_t most_points) {
    NearFeatures all;
    const Subset near = near_new(points, triangles, is_new, distance);
    const TriangleTree tree(points, near.triangles, distance);
    add_flat_triangles(tree, near.triangles, distance, all);
    if (tree.size() == 0) return all;
    const std::size_t level = std::min(chunk_level, tree.levels().size() - 1), chunks = tree.levels()[level].size();
    constexpr std::size_t round_size = 512;
    std::atomic<std::size_t> count = 0;
    for (std::size_t round = 0; round < chunks && (monitor == nullptr || !monitor->stopped()); round += round_size) {
        std::vector<NearFeatures> found(std::min(round_size, chunks - round));
        parallel_for_each_index(found.size(), [&](std::size_t i) {
            if (count > most_points) return;
            ChunkSearch(tree, near.numbers, is_new, distance, most_points, found[i]).run(level, round + i);
            count += found[i].points.size();
        });
        for (const NearFeatures& chunk : found) append(all, chunk);
        if (monitor != nullptr) monitor->progress("cut", static_cast<double>(round) / static_cast<double>(chunks));
    }
    return all;
}

}  // namespace geomend::arrangement
