// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/lattice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

#include "base/vectors.h"
#include "geometry/closest_points.h"
#include "geometry/site_grid.h"
#include "geometry/triangle_tree.h"
#include "hexes/main_axes.h"

namespace geomend::hexes {

namespace {

/// A number from -1 to 1 that seems to be random.
double scattered(std::uint64_t seed) {
    seed += 0x9e3779b97f4a7c15;
    seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9;
    seed = (seed ^ (seed >> 27)) * 0x94d049bb133111eb;
    seed ^= seed >> 31;
    return static_cast<double>(seed >> 11) / 4503599627370496.0 - 1;
}

/// Where the columns of a lattice along its third axis cross the boundary of a region, seen a little beside them: surfaces may have
/// vertices and walls on the columns themselves.
struct Crossing {
    std::int64_t i, j;
    double w;
    bool across;  ///< the surface is more across the column than along it
};

constexpr double beside_u = 1.37e-5, beside_v = 2.11e-5;  // of a step

/// On which side of an edge a column is; the same for both triangles at it.
bool is_left(const Vec3& a, const Vec3& b, std::uint32_t na, std::uint32_t nb, double u, double v) {
    const bool turn = na > nb;
    const Vec3 &p = turn ? b : a, &q = turn ? a : b;
    return ((q[0] - p[0]) * (v - p[1]) - (q[1] - p[1]) * (u - p[0]) > 0) != turn;
}

std::vector<Crossing> crossings_of(const volumes::RegionFacets& facets, const Lattice& lattice) {
    std::vector<Crossing> all;
    std::vector<Vec3> at;
    at.reserve(facets.positions.size());
    for (const Vec3& p : facets.positions) at.push_back(lattice.coordinates(p));
    for (std::size_t f = 0; f < facets.triangles.size(); ++f) {
        if (facets.sides[f] == volumes::on_both) continue;
        const Triangle& t = facets.triangles[f];
        const std::array<Vec3, 3> p{at[t[0]], at[t[1]], at[t[2]]};
        const auto [low_u, high_u] = std::minmax({p[0][0], p[1][0], p[2][0]});
        const auto [low_v, high_v] = std::minmax({p[0][1], p[1][1], p[2][1]});
        const auto [low_w, high_w] = std::minmax({p[0][2], p[1][2], p[2][2]});
        const Vec3 n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
        if (n[2] == 0) continue;
        const Vec3 normal{n[0] / lattice.steps[0], n[1] / lattice.steps[1], n[2] / lattice.steps[2]};
        const bool across = 4 * normal[2] * normal[2] >= dot(normal, normal);
        for (auto i = static_cast<std::int64_t>(std::ceil(low_u - beside_u)); static_cast<double>(i) + beside_u <= high_u; ++i) {
            for (auto j = static_cast<std::int64_t>(std::ceil(low_v - beside_v)); static_cast<double>(j) + beside_v <= high_v; ++j) {
                const double u = static_cast<double>(i) + beside_u, v = static_cast<double>(j) + beside_v;
                unsigned left = 0;
                for (std::size_t k = 0; k < 3; ++k) left += is_left(p[k], p[(k + 1) % 3], t[k], t[(k + 1) % 3], u, v) ? 1 : 0;
                if (left != 0 && left != 3) continue;
                // The height is that of the column itself, which may be an edge or a corner of the triangle.
                const double du = static_cast<double>(i) - p[0][0], dv = static_cast<double>(j) - p[0][1];
                all.push_back({i, j, std::clamp(p[0][2] - (n[0] * du + n[1] * dv) / n[2], low_w, high_w), across});
            }
        }
    }
    std::ranges::sort(all, {}, [](const Crossing& c) { return std::tuple(c.i, c.j, c.w); });
    return all;
}

/// Points along the edges that cells are to have, so close that all of an edge is near one of them.
std::vector<Vec3> points_along_edges(const volumes::RegionFacets& facets, double step) {
    std::vector<Vec3> points;
    for (const auto& [from, to] : facets.edges) {
        const Vec3 a = facets.positions[from], d = minus(facets.positions[to], a);
        const double parts = std::clamp(std::ceil(std::sqrt(dot(d, d)) / step), 1.0, 1e4);
        for (double i = 0; i <= parts; ++i) points.push_back(plus(a, times(i / parts, d)));
    }
    return points;
}

/// Whether points are far enough from facets, and from further edges.
class Clearance {
public:
    Clearance(const volumes::RegionFacets& facets, double distance)
        : facets_(facets),
          tree_(facets.positions, facets.triangles),
          distance_(distance),
          on_edges_(points_along_edges(facets, distance / 4)) {
        if (!on_edges_.empty()) edges_.emplace(on_edges_);
    }

    bool operator()(const Vec3& p) const {
        bool clear = true;
        if (edges_) {
            const Vec3 away = minus(on_edges_[edges_->nearest(p)], p);
            if (dot(away, away) < distance_ * distance_) return false;
        }
        tree_.visit_triangles(tree_.box(p, p, distance_), [&](std::size_t i) {
            if (!clear || tree_.is_farther(p, i, distance_)) return;
            const Triangle& t = tree_.triangle(i);
            clear = closest_points(p, {facets_.positions[t[0]], facets_.positions[t[1]], facets_.positions[t[2]]}).distance >= distance_;
        });
        return clear;
    }

private:
    const volumes::RegionFacets& facets_;
    TriangleTree tree_;
    double distance_;
    std::vector<Vec3> on_edges_;
    std::optional<SiteGrid> edges_;
};

}  // namespace

Vec3 Lattice::coordinates(const Vec3& p) const {
    const Vec3 d = minus(p, origin);
    const double u = dot(d, axes[0]) / steps[0], v = dot(d, axes[1]) / steps[1], w = dot(d, axes[2]);
    return {u, v, layers ? layers->level(u, v, w / base_step) : w / steps[2]};
}

Vec3 Lattice::place(const Vec3& c) const {
    if (layers) {
        const double w = base_step * layers->height(c[0], c[1], c[2]);
        return plus(origin, plus(times(c[0] * steps[0], axes[0]), plus(times(c[1] * steps[1], axes[1]), times(w, axes[2]))));
    }
    return plus(origin, plus(times(c[0] * steps[0], axes[0]), plus(times(c[1] * steps[1], axes[1]), times(c[2] * steps[2], axes[2]))));
}

double Lattice::least_step() const { return std::min({steps[0], steps[1], layers ? layers->least_height() * base_step : steps[2]}); }

namespace {

/// Half of the area of the surfaces has triangles with a shorter edge on average; 1 where there are none.
double median_edge(const BrepData& brep) {
    std::vector<std::pair<double, double>> edges;  // edge, area
    double all = 0;
    for (const auto& surface : brep.surfaces) {
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            const auto at = [&](std::size_t k) { return brep.vertices[surface.nodes[polygon[k]].value]; };
            for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
                const Vec3 a = minus(at(k), at(0)), b = minus(at(k + 1), at(0)), c = minus(at(k + 1), at(k)), n = cross(a, b);
                const double area = std::sqrt(dot(n, n));
                edges.emplace_back((std::sqrt(dot(a, a)) + std::sqrt(dot(b, b)) + std::sqrt(dot(c, c))) / 3, area);
                all += area;
            }
        }
    }
    std::ranges::sort(edges);
    double sum = 0;
    for (const auto& [edge, area] : edges) {
        sum += area;
        if (2 * sum >= all && edge > 0) return edge;
    }
    return 1;
}

}  // namespace

Lattice lattice_of(const BrepData& brep, double size) {
    if (!(size > 0)) size = median_edge(brep);
    Lattice lattice;
    lattice.axes = main_axes(brep);
    if (brep.vertices.empty()) {
        lattice.steps = {size, size, size};
        return lattice;
    }
    const Vec3 first = brep.vertices.front();
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const Vec3& p : brep.vertices) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double along = dot(minus(p, first), lattice.axes[k]);
            low[k] = std::min(low[k], along);
            high[k] = std::max(high[k], along);
        }
    }
    lattice.origin = first;
    for (std::size_t k = 0; k < 3; ++k) {
        const double extent = high[k] - low[k], count = std::max(1.0, std::round(extent / size));
        lattice.steps[k] = extent > 0 ? extent / count : size;
        lattice.origin = plus(lattice.origin, times(low[k], lattice.axes[k]));
    }
    return lattice;
}

Lattice lattice_of_region(const volumes::RegionFacets& facets, const Lattice& lattice) {
    const auto crossings = crossings_of(facets, lattice);
    std::vector<ColumnSpan> whole;
    std::size_t columns = 0;
    for (std::size_t first = 0, last = 0; first < crossings.size(); first = last) {
        for (last = first; last < crossings.size() && crossings[last].i == crossings[first].i && crossings[last].j == crossings[first].j;)
            ++last;
        ++columns;
        const Crossing &in = crossings[first], &out = crossings[last - 1];
        if (last - first == 2 && in.across && out.across) whole.push_back({in.i, in.j, in.w, out.w});
    }
    Lattice own = lattice;
    own.layers = Layers::of(whole, columns);
    if (!own.layers) return own;
    own.base_step = lattice.steps[2];
    own.steps[2] = lattice.steps[2] * own.layers->median_height();
    return own;
}

std::vector<Vec3> along_layers(const Lattice& lattice, std::span<const Vec3> places) {
    constexpr double grain = 1.0 / (1 << 30);  // of a step: less than what points are moved by, more than rounding on a map
    constexpr double kept = 0.03;              // of the heights that they have
    std::vector<Vec3> level;
    if (!lattice.layers || !lattice.layers->in_all_columns()) return level;
    for (const Vec3& p : places) {
        Vec3 c = lattice.coordinates(p);
        c[2] = (1 - kept) * c[2] + kept * dot(minus(p, lattice.origin), lattice.axes[2]) / lattice.steps[2];
        Vec3& own = level.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) own[k] = lattice.steps[k] * (std::round(c[k] / grain) * grain);
    }
    return level;
}

std::vector<Vec3> points_inside(const volumes::RegionFacets& facets, const Lattice& lattice, double clear) {
    const auto crossings = crossings_of(facets, lattice);
    const Clearance is_clear(facets, clear * lattice.least_step());
    std::vector<Vec3> points;
    for (std::size_t c = 0; c + 1 < crossings.size();) {
        const Crossing &in = crossings[c], &out = crossings[c + 1];
        if (in.i != out.i || in.j != out.j) {  // not met where surfaces are closed
            ++c;
            continue;
        }
        c += 2;
        for (auto k = static_cast<std::int64_t>(std::ceil(in.w)); static_cast<double>(k) < out.w; ++k) {
            const Vec3 whole{static_cast<double>(in.i), static_cast<double>(in.j), static_cast<double>(k)};
            if (!is_clear(lattice.place(whole))) continue;
            Vec3 moved = whole;
            for (std::size_t d = 0; d < 3; ++d) {
                const auto seed = static_cast<std::uint64_t>(in.i * 73856093 ^ in.j * 19349663 ^ k * 83492791) * 3 + d;
                moved[d] += 1e-7 * scattered(seed);
            }
            points.push_back(lattice.place(moved));
        }
    }
    return points;
}

}  // namespace geomend::hexes
