// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "base/bounds.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "geometry/closest_points.h"
#include "geometry/predicates.h"
#include "geometry/triangle_tree.h"

namespace geomend::topology {

namespace {

constexpr double closeness = 0.01;  // of the larger diameter

bool counts(const UsedPoints& used, std::uint32_t t, std::span<const std::uint8_t> left_out) {
    return std::ranges::none_of(used.triangles[t], [&](std::uint32_t v) { return left_out[v] != 0; });
}

/// Adds what one object has of a part. The largest coordinates, as they are stored, are at the bounds, since rounding keeps order.
void widen(PartExtent& part, const ObjectInfo& info, const Bounds& bounds) {
    Vec3& largest = info.precision == CoordinatePrecision::single_precision ? part.largest_single : part.largest_double;
    for (std::size_t k = 0; k < 3; ++k) {
        if (bounds.low[k] > bounds.high[k]) continue;
        part.low[k] = std::min(part.low[k], bounds.low[k]);
        part.high[k] = std::max(part.high[k], bounds.high[k]);
        for (const double x : {bounds.low[k], bounds.high[k]}) largest[k] = std::max(largest[k], std::abs(x - info.stored_around[k]));
    }
}

/// Sums over the triangles of a part.
struct PartSums {
    double weight = 0;
    Vec3 origin{}, weighted{}, plain{};
    std::uint64_t triangles = 0;

    void add(const std::array<Vec3, 3>& corners, double share) {
        if (triangles++ == 0) origin = corners[0];
        const Vec3 sum = plus(minus(corners[0], origin), plus(minus(corners[1], origin), minus(corners[2], origin)));
        plain = plus(plain, sum);
        weighted = plus(weighted, times(share / 3, sum));
        weight += share;
    }
    Vec3 centroid() const {
        return plus(origin, weight > 0 ? times(1 / weight, weighted) : times(1 / (3 * static_cast<double>(triangles)), plain));
    }
};

PartExtent extent_of(const Dataset& dataset, const UsedPoints& used, std::span<const std::uint32_t> triangles,
                     std::span<const std::uint8_t> left_out) {
    PartExtent part;
    part.low = Bounds().low;
    part.high = Bounds().high;
    PartSums sums;
    // Triangles come object by object.
    for (std::size_t i = 0; i < triangles.size();) {
        const std::uint32_t object = used.object[triangles[i]];
        Bounds bounds;
        for (; i < triangles.size() && used.object[triangles[i]] == object; ++i) {
            const std::uint32_t t = triangles[i];
            if (!counts(used, t, left_out)) continue;
            const auto corners = used.corners(t);
            sums.add(corners, used.weights[t]);
            for (const Vec3& p : corners) bounds.add(p);
        }
        widen(part, info_of(dataset.objects[object]), bounds);
    }
    part.empty = sums.triangles == 0;
    if (part.empty) return part;
    part.weight = sums.weight;
    part.centroid = sums.centroid();
    double square = 0;
    for (const std::uint32_t t : triangles) {
        if (!counts(used, t, left_out)) continue;
        for (const std::uint32_t v : used.triangles[t]) {
            const Vec3 d = minus(used.positions[v], part.centroid);
            square = std::max(square, dot(d, d));
        }
    }
    part.radius = std::sqrt(square);
    return part;
}

/// On which side along an axis a triangle lies of a point that it covers seen along that axis: +1 ahead, -1 behind, 0 through it or
/// not covering it.
int covers(const std::array<Vec3, 3>& t, const Vec3& point, unsigned axis) {
    int sense = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const int sign = orientation_2d(t[k], t[(k + 1) % 3], point, axis);
        if (sign * sense < 0) return 0;
        if (sign != 0) sense = sign;
    }
    return -sense * orientation(t[0], t[1], t[2], point);
}

/// Tells whether two parts belong together: one comes close to the other, or lies inside of it.
class Closeness {
public:
    Closeness(const UsedPoints& used, const HangingParts& parts, std::span<const PartExtent> extents,
              std::span<const std::uint8_t> left_out)
        : used_(used), parts_(parts), extents_(extents), left_out_(left_out) {}

    bool belong_together(std::uint32_t a, std::uint32_t b) { return are_close(a, b) || surrounds(a, b) || surrounds(b, a); }

private:
    const UsedPoints& used_;
    const HangingParts& parts_;
    std::span<const PartExtent> extents_;
    std::span<const std::uint8_t> left_out_;

    bool are_close(std::uint32_t a, std::uint32_t b) {
        const double reach = closeness * 2 * std::max(extents_[a].radius, extents_[b].radius);
        const Vec3 d = minus(extents_[a].centroid, extents_[b].centroid);
        if (std::sqrt(dot(d, d)) > extents_[a].radius + extents_[b].radius + reach) return false;
        if (parts_[a].size() < parts_[b].size()) std::swap(a, b);
        return std::ranges::any_of(parts_[b], [&](std::uint32_t t) { return comes_close(t, a, reach); });
    }

    /// Whether a lies around b: all ways along the axes from a vertex of b meet a. \pre they are not close
    bool surrounds(std::uint32_t a, std::uint32_t b) {
        const Vec3 d = minus(extents_[a].centroid, extents_[b].centroid);
        if (std::sqrt(dot(d, d)) + extents_[b].radius > extents_[a].radius) return false;
        const auto inner = std::ranges::find_if(parts_[b], [&](std::uint32_t t) { return counts(used_, t, left_out_); });
        if (inner == parts_[b].end()) return false;
        const Vec3 point = used_.corners(*inner)[0];
        for (unsigned axis = 0; axis < 3; ++axis) {
            if (!is_covered(a, point, axis)) return false;
        }
        return true;
    }

    /// Whether ways from a point along an axis, ahead and back, both meet a part.
    bool is_covered(std::uint32_t part, const Vec3& point, unsigned axis) {
        const Tree& tree = tree_of(part);
        if (tree.triangles->size() == 0) return false;
        Vec3 low = point, high = point;
        low[axis] = extents_[part].low[axis];
        high[axis] = extents_[part].high[axis];
        bool ahead = false, behind = false;
        tree.triangles->visit_triangles(tree.triangles->box(low, high), [&](std::size_t i) {
            const auto& [p, q, r] = tree.triangles->triangle(i);
            const int side = covers({tree.points[p], tree.points[q], tree.points[r]}, point, axis);
            ahead = ahead || side > 0;
            behind = behind || side < 0;
        });
        return ahead && behind;
    }

    /// A part by itself: what lies between two parts need not be looked at, however much it is.
    struct Tree {
        std::vector<Vec3> points;  ///< the corners of one triangle after the other
        std::unique_ptr<TriangleTree> triangles;
    };
    std::vector<Tree> trees_;  ///< of parts that were looked through

    const Tree& tree_of(std::uint32_t part) {
        trees_.resize(parts_.size());
        Tree& tree = trees_[part];
        if (tree.triangles) return tree;
        std::vector<Triangle> triangles;
        for (const std::uint32_t t : parts_[part]) {
            if (!counts(used_, t, left_out_)) continue;
            const auto first = static_cast<std::uint32_t>(tree.points.size());
            const auto corners = used_.corners(t);
            tree.points.insert(tree.points.end(), corners.begin(), corners.end());
            triangles.push_back({first, first + 1, first + 2});
        }
        tree.triangles = std::make_unique<TriangleTree>(tree.points, triangles);
        return tree;
    }

    bool comes_close(std::uint32_t t, std::uint32_t part, double reach) {
        if (!counts(used_, t, left_out_)) return false;
        const auto corners = used_.corners(t);
        const auto [low, high] = bounds_around(corners);
        for (std::size_t k = 0; k < 3; ++k) {
            if (low[k] > extents_[part].high[k] + reach || high[k] < extents_[part].low[k] - reach) return false;
        }
        bool close = false;
        const Tree& tree = tree_of(part);
        if (tree.triangles->size() == 0) return false;
        tree.triangles->visit_triangles(tree.triangles->box(low, high, reach), [&](std::size_t i) {
            const auto& [a, b, c] = tree.triangles->triangle(i);
            close = close || closest_points(corners, std::array{tree.points[a], tree.points[b], tree.points[c]}).distance <= reach;
        });
        return close;
    }
};

/// Calls visit(a, b) for each two parts whose bounding spheres come close to each other.
template <class Visit>
void each_candidate(std::span<const PartExtent> extents, const Visit& visit) {
    std::vector<std::uint32_t> part;
    std::vector<Vec3> points;
    std::vector<Triangle> boxes;  // each spans the box around a sphere
    for (std::uint32_t p = 0; p < extents.size(); ++p) {
        const double r = (1 + 2 * closeness) * extents[p].radius;
        if (extents[p].empty || !(r > 0)) continue;
        const Vec3& c = extents[p].centroid;
        const auto first = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), {{c[0] - r, c[1] - r, c[2] - r}, {c[0] + r, c[1] + r, c[2] + r}, {c[0] - r, c[1] + r, c[2] - r}});
        boxes.push_back({first, first + 1, first + 2});
        part.push_back(p);
    }
    if (part.size() < 2) return;
    const TriangleTree tree(points, boxes);
    if (tree.levels().empty()) return;
    tree.visit_pairs(tree.levels().size() - 1, 0, 0, [&](std::size_t i, std::size_t first, unsigned hits) {
        visit_bits(hits, [&](std::size_t k) { visit(part[tree.number(i)], part[tree.number(first + k)]); });
    });
}

}  // namespace

std::vector<PartExtent> part_extents(const Dataset& dataset, const UsedPoints& used, const HangingParts& parts,
                                     std::span<const std::uint8_t> left_out) {
    std::vector<PartExtent> extents(parts.size());
    parallel_for_each_index(parts.size(), [&](std::size_t p) { extents[p] = extent_of(dataset, used, parts[p], left_out); });
    return extents;
}

Vec3 stored_steps(const PartExtent& part) {
    Vec3 steps{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double large = part.largest_double[k];
        double step = large >= 0 ? std::nextafter(large, HUGE_VAL) - large : 0;
        if (part.largest_single[k] >= 0) {
            const auto v = static_cast<float>(part.largest_single[k]);
            step = std::max(step, static_cast<double>(std::nextafter(v, HUGE_VALF)) - static_cast<double>(v));
        }
        steps[k] = 4 * step;
    }
    return steps;
}

std::vector<std::uint32_t> cluster_parts(const UsedPoints& used, const HangingParts& parts, std::span<const PartExtent> extents,
                                         std::span<const std::uint8_t> left_out) {
    DisjointSets sets(parts.size());
    Closeness closeness_of(used, parts, extents, left_out);
    each_candidate(extents, [&](std::uint32_t a, std::uint32_t b) {
        if (sets.root(a) != sets.root(b) && closeness_of.belong_together(a, b)) sets.join(a, b);
    });
    auto cluster = std::move(sets).roots();
    std::uint32_t count = 0;
    for (std::uint32_t p = 0; p < cluster.size(); ++p) cluster[p] = cluster[p] == p ? count++ : cluster[cluster[p]];
    return cluster;
}

}  // namespace geomend::topology
