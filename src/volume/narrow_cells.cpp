// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/narrow_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/vectors.h"
#include "geometry/closest_points.h"
#include "geometry/triangle_tree.h"
#include "volume/cell_quality.h"

namespace geomend::volumes {

namespace {

constexpr double degree = std::numbers::pi / 180;

double length(const Vec3& d) { return std::sqrt(dot(d, d)); }

/// Looks about narrow cells for what forces them.
class Surroundings {
public:
    Surroundings(const RegionFacets& facets, double size) : facets_(facets), size_(size), tree_(facets.positions, facets.triangles) {}

    bool force(const std::array<Vec3, 4>& cell) {
        Vec3 low = cell[0], high = cell[0];
        for (const Vec3& p : cell) {
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        }
        near_.clear();
        tree_.visit_triangles(tree_.box(low, high, size_), [&](std::size_t i) { near_.push_back(tree_.number(i)); });
        std::ranges::sort(near_);
        for (std::size_t i = 0; i < near_.size(); ++i) {
            for (std::size_t j = i + 1; j < near_.size(); ++j) {
                if (force(cell, near_[i], near_[j])) return true;
            }
        }
        return false;
    }

private:
    const RegionFacets& facets_;
    const double size_;
    TriangleTree tree_;
    std::vector<std::uint32_t> near_;

    std::array<Vec3, 3> corners(std::uint32_t f) const {
        const Triangle& t = facets_.triangles[f];
        return {facets_.positions[t[0]], facets_.positions[t[1]], facets_.positions[t[2]]};
    }
    static Vec3 normal(const std::array<Vec3, 3>& t) {
        const Vec3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
        const double size = length(n);
        return size > 0 ? times(1 / size, n) : Vec3{};
    }

    bool force(const std::array<Vec3, 4>& cell, std::uint32_t a, std::uint32_t b) const {
        std::array<std::uint32_t, 3> shared{};
        std::size_t count = 0;
        for (const std::uint32_t v : facets_.triangles[a]) {
            if (std::ranges::find(facets_.triangles[b], v) != facets_.triangles[b].end()) shared[count++] = v;
        }
        if (count == 2)
            return meets_sharply(a, b, shared[0], shared[1]) && is_beside(cell, facets_.positions[shared[0]], facets_.positions[shared[1]]);
        if (count != 0) return false;
        return lie_close(cell, a, b);
    }

    /// Whether two facets meet along an edge at less than 10 degrees, with the region between them.
    bool meets_sharply(std::uint32_t a, std::uint32_t b, std::uint32_t v, std::uint32_t w) const {
        const auto apex = [&](std::uint32_t f) {
            for (const std::uint32_t c : facets_.triangles[f]) {
                if (c != v && c != w) return facets_.positions[c];
            }
            return facets_.positions[v];
        };
        const Vec3 along = minus(facets_.positions[w], facets_.positions[v]);
        const auto across = [&](const Vec3& p) {
            const Vec3 d = minus(p, facets_.positions[v]);
            return minus(d, times(dot(d, along) / dot(along, along), along));
        };
        const Vec3 p = across(apex(a)), q = across(apex(b));
        if (std::atan2(length(cross(p, q)), dot(p, q)) >= 10 * degree) return false;
        const double side = dot(normal(corners(a)), q);
        return side == 0 || (facets_.sides[a] & (side > 0 ? in_front : behind)) != 0;
    }

    bool is_beside(const std::array<Vec3, 4>& cell, const Vec3& from, const Vec3& to) const {
        const Vec3 along = minus(to, from);
        return std::ranges::any_of(cell, [&](const Vec3& p) {
            const Vec3 d = minus(p, from);
            const double share = std::clamp(dot(d, along) / dot(along, along), 0.0, 1.0);
            return length(minus(d, times(share, along))) <= size_;
        });
    }

    /// Whether two facets that share no corner face each other nearer than half the size.
    bool lie_close(const std::array<Vec3, 4>& cell, std::uint32_t a, std::uint32_t b) const {
        const auto s = corners(a), t = corners(b);
        const Closest gap = closest_points(s, t);
        if (!(gap.distance < size_ / 2) || !(gap.distance > 0)) return false;
        const auto faces = [&](const Vec3& n) { return std::abs(dot(n, gap.apart)) > 0.5 * gap.distance; };
        if (!faces(normal(s)) || !faces(normal(t))) return false;
        return std::ranges::any_of(cell, [&](const Vec3& p) { return length(minus(p, gap.on_first)) <= size_; });
    }
};

}  // namespace

NarrowCells narrow_cells(const RegionFacets& facets, const RegionCells& region, double size) {
    const auto known = facets.positions.size();
    const auto position = [&](std::uint32_t v) { return v < known ? facets.positions[v] : region.new_vertices[v - known]; };
    NarrowCells found;
    std::optional<Surroundings> about;  // most regions have no such cell
    for (const auto& c : region.cells) {
        const std::array<Vec3, 4> p{position(c[0]), position(c[1]), position(c[2]), position(c[3])};
        if (dihedral_cosines(p).of_least <= std::cos(5 * degree)) continue;
        ++found.all;
        if (!about) about.emplace(facets, size);
        if (about->force(p)) ++found.forced;
    }
    return found;
}

}  // namespace geomend::volumes
