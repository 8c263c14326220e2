// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/parallel.h"
#include "complexity/parts.h"
#include "geometry/triangle_tree.h"

// Thickness: how far it is from the boundary of a region or surface, straight inwards, to the boundary again.

namespace geomend::complexity {

namespace {

// A triangle is looked at from the middles of the four that halving its edges makes.
std::array<Vec3, 4> looking_points(const MeasuredModel& model, const std::array<std::uint32_t, 3>& t) {
    const Vec3 &a = model.points[t[0]], &b = model.points[t[1]], &c = model.points[t[2]];
    const auto at = [&](double wa, double wb, double wc) {
        return Vec3{wa * a[0] + wb * b[0] + wc * c[0], wa * a[1] + wb * b[1] + wc * c[1], wa * a[2] + wb * b[2] + wc * c[2]};
    };
    return {at(1. / 3, 1. / 3, 1. / 3), at(2. / 3, 1. / 6, 1. / 6), at(1. / 6, 2. / 3, 1. / 6), at(1. / 6, 1. / 6, 2. / 3)};
}

// Whether the segment from + t direction, 0 < t <= 1, passes through a triangle. (Moeller and Trumbore 1997: solves
// from + t direction = a + u (b-a) + v (c-a).)
bool passes(const Vec3& from, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = minus(b, a), ac = minus(c, a), p = cross(direction, ac);
    const double determinant = dot(ab, p);
    if (determinant == 0) return false;
    const Vec3 to = minus(from, a);
    const double u = dot(to, p) / determinant;
    if (!(u >= 0 && u <= 1)) return false;
    const Vec3 q = cross(to, ab);
    const double v = dot(direction, q) / determinant;
    if (!(v >= 0 && u + v <= 1)) return false;
    const double t = dot(ac, q) / determinant;
    return t > 0 && t <= 1;
}

}  // namespace

std::vector<double> thin_parts_of_regions(const MeasuredModel& model, double h) {
    const BrepData& brep = model.brep;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> surface_of;
    for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
        triangles.insert(triangles.end(), model.surfaces[s].triangles.begin(), model.surfaces[s].triangles.end());
        surface_of.resize(triangles.size(), s);
    }
    const TriangleTree tree(model.points, triangles);
    // Quarters of each triangle that are thin: behind it, and in front.
    std::vector<std::array<std::uint8_t, 2>> thin(triangles.size());
    parallel_for_each_index(triangles.size(), [&](std::size_t t) {
        Vec3 normal = model.area_vector(triangles[t]);
        const double area = length(normal);
        if (!(area > 0)) return;
        for (double& x : normal) x /= area;
        for (std::size_t side = 0; side < 2; ++side) {
            const RegionId region = brep.surfaces[surface_of[t]].regions[side];
            if (!region.valid()) continue;
            const Vec3 inwards = times(side == 1 ? h : -h, normal);
            for (const Vec3& from : looking_points(model, triangles[t])) {
                const Vec3 to = moved(from, inwards);
                Vec3 low, high;
                for (std::size_t a = 0; a < 3; ++a) std::tie(low[a], high[a]) = std::minmax(from[a], to[a]);
                bool met = false;
                tree.visit_triangles(tree.box(low, high), [&](std::size_t i) {
                    const std::uint32_t other = tree.number(i);
                    const auto& beside = brep.surfaces[surface_of[other]].regions;
                    if (met || other == t || (beside[0] != region && beside[1] != region)) return;
                    const Triangle& c = triangles[other];
                    met = passes(from, inwards, model.points[c[0]], model.points[c[1]], model.points[c[2]]);
                });
                thin[t][side] += met;
            }
        }
    });
    std::vector<double> parts(brep.regions.size()), whole(brep.regions.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const double area = model.area(triangles[t]);
        for (std::size_t side = 0; side < 2; ++side) {
            const RegionId region = brep.surfaces[surface_of[t]].regions[side];
            if (!region.valid()) continue;
            whole[region.value] += area;
            parts[region.value] += area * thin[t][side] / 4;
        }
    }
    for (std::size_t r = 0; r < parts.size(); ++r) parts[r] = whole[r] > 0 ? parts[r] / whole[r] : 0;
    return parts;
}

namespace {

// A walk straight ahead on a surface: each triangle is unfolded into the plane of the one before.
class Walk {
public:
    Walk(const MeasuredModel& model, const SurfaceTriangles& surface) : model_(model), surface_(surface) {}

    /// Whether the border is met within h, going from a point at part `where` of edge i of triangle t at right angles to
    /// that edge.
    bool meets_border(std::size_t t, std::size_t i, double where, double h) const {
        // In the plane the edge that was entered lies on the x axis, from 0 to its length, the triangle above it; the
        // walk is at (x, 0) and goes into (dx, dy).
        double x = where * edge_length(t, i), dx = 0, dy = 1, gone = 0;
        for (std::size_t steps = 0; steps <= 2 * surface_.triangles.size(); ++steps) {
            const double base = edge_length(t, i);
            const auto [ax, ay] = apex(t, i, base);
            if (!(ay > 0)) return false;  // a triangle without area: the walk cannot be judged
            // To the left of the apex it leaves by the edge from the apex to the start, else by the one from the end.
            const bool left = dx * ay - dy * (ax - x) < 0;
            const double ex = left ? 0 : base, ux = ax - ex, uy = ay;
            // (x, 0) + s d = (ex, 0) + r u
            const double determinant = dx * uy - dy * ux;
            if (determinant == 0) return false;
            const double s = (ex - x) * uy / determinant, r = (ex - x) * dy / determinant;
            gone += s;
            if (gone >= h) return false;
            const std::size_t leaving = left ? (i + 2) % 3 : (i + 1) % 3;
            const std::uint32_t next = surface_.across[t][leaving];
            if (next == no_index) return true;
            const std::uint32_t from = surface_.triangles[t][leaving];
            // The edge as the next triangle has it, seen from within that one.
            const std::size_t entered = edge_of(next, from, surface_.triangles[t][(leaving + 1) % 3]);
            if (entered == 3) return false;
            const double l = std::hypot(ux, uy), cx = ux / l, cy = uy / l;
            // r counts from the base to the apex. Left the edge runs from the apex down, right from the base up.
            const double along_mine = left ? (1 - r) * l : r * l;
            const double forward = left ? -(dx * cx + dy * cy) : dx * cx + dy * cy;
            const double outwards = std::abs(dx * cy - dy * cx);
            const bool same_sense = surface_.triangles[next][entered] == from;
            x = same_sense ? along_mine : l - along_mine;
            dx = same_sense ? forward : -forward;
            dy = outwards;
            t = next;
            i = entered;
        }
        return false;
    }

private:
    double edge_length(std::size_t t, std::size_t i) const {
        const auto& c = surface_.triangles[t];
        return length(minus(model_.points[c[(i + 1) % 3]], model_.points[c[i]]));
    }

    std::pair<double, double> apex(std::size_t t, std::size_t i, double base) const {
        const auto& c = surface_.triangles[t];
        const Vec3 along = minus(model_.points[c[(i + 1) % 3]], model_.points[c[i]]),
                   to = minus(model_.points[c[(i + 2) % 3]], model_.points[c[i]]);
        if (!(base > 0)) return {0, 0};
        return {dot(along, to) / base, length(cross(along, to)) / base};
    }

    std::size_t edge_of(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
        const auto& c = surface_.triangles[t];
        for (std::size_t i = 0; i < 3; ++i) {
            if ((c[i] == a && c[(i + 1) % 3] == b) || (c[i] == b && c[(i + 1) % 3] == a)) return i;
        }
        return 3;
    }

    const MeasuredModel& model_;
    const SurfaceTriangles& surface_;
};

}  // namespace

std::vector<double> thin_parts_of_surfaces(const MeasuredModel& model, double h) {
    constexpr std::array looks = {1. / 8, 3. / 8, 5. / 8, 7. / 8};
    std::vector<double> parts(model.surfaces.size());
    parallel_for_each_index(parts.size(), [&](std::size_t s) {
        const SurfaceTriangles& surface = model.surfaces[s];
        const Walk walk(model, surface);
        double whole = 0, thin = 0;
        for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
            const auto& c = surface.triangles[t];
            for (std::size_t i = 0; i < 3; ++i) {
                if (surface.across[t][i] != no_index || c[i] == c[(i + 1) % 3]) continue;
                const double l = length(minus(model.points[c[(i + 1) % 3]], model.points[c[i]]));
                whole += l;
                for (const double where : looks) thin += walk.meets_border(t, i, where, h) ? l / looks.size() : 0;
            }
        }
        parts[s] = whole > 0 ? thin / whole : 0;
    });
    return parts;
}

}  // namespace geomend::complexity
