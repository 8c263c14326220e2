// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "complexity/parts.h"

// Angles between surfaces around lines, and between lines at the corners of surfaces.

namespace geomend::complexity {

namespace {

constexpr double degrees_of(double radians) { return radians * 180 / std::numbers::pi; }

// A triangle's edge on a line: the triangle lies at `third`; `along` where it runs from low to high.
struct Flap {
    std::uint32_t low, high, surface, third;
    bool along;
};

std::vector<Flap> flaps(const MeasuredModel& model) {
    std::vector<Flap> all;
    for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
        const SurfaceTriangles& surface = model.surfaces[s];
        for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
            const auto& c = surface.triangles[t];
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = c[i], b = c[(i + 1) % 3];
                if (surface.across[t][i] == no_index && a != b) all.push_back({std::min(a, b), std::max(a, b), s, c[(i + 2) % 3], a < b});
            }
        }
    }
    std::ranges::sort(all, {}, [](const Flap& f) { return std::tuple(f.low, f.high, f.surface, f.third); });
    return all;
}

// Two directions across an edge, so that turning from the first to the second goes round it anticlockwise.
std::array<Vec3, 2> across_frame(const Vec3& edge) {
    const std::size_t small =
        static_cast<std::size_t>(std::ranges::min_element(edge, {}, [](double x) { return std::abs(x); }) - edge.begin());
    Vec3 other{};
    other[small] = 1;
    const Vec3 u = cross(edge, other), unit{u[0] / length(u), u[1] / length(u), u[2] / length(u)};
    return {unit, cross(edge, unit)};
}

struct Turn {
    double angle;
    const Flap* flap;
};

std::vector<Turn> radial_order(const MeasuredModel& model, std::span<const Flap> around) {
    const Vec3 &from = model.points[around[0].low], edge = minus(model.points[around[0].high], from);
    const double l = length(edge);
    std::vector<Turn> order;
    if (!(l > 0)) return order;
    const auto [u, w] = across_frame({edge[0] / l, edge[1] / l, edge[2] / l});
    for (const Flap& f : around) {
        const Vec3 to = minus(model.points[f.third], from);
        order.push_back({std::atan2(dot(to, w), dot(to, u)), &f});
    }
    std::ranges::stable_sort(order, {}, &Turn::angle);
    return order;
}

// The region on the side of a flap that is met by turning on, anticlockwise, or back.
RegionId region_beside(const BrepData& brep, const Flap& f, bool onwards) {
    return brep.surfaces[f.surface].regions[f.along == onwards ? 1 : 0];
}

}  // namespace

std::vector<double> sharp_parts_of_regions(const MeasuredModel& model, double degrees) {
    const BrepData& brep = model.brep;
    std::vector<double> sharp(brep.regions.size()), whole(brep.regions.size());
    const std::vector<Flap> all = flaps(model);
    for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
        while (last < all.size() && all[last].low == all[first].low && all[last].high == all[first].high) ++last;
        const double l = length(minus(model.points[all[first].high], model.points[all[first].low]));
        const auto order = radial_order(model, std::span(all).subspan(first, last - first));
        for (std::size_t i = 0; i < order.size() && order.size() > 1; ++i) {
            const Turn &here = order[i], &next = order[(i + 1) % order.size()];
            const RegionId region = region_beside(brep, *here.flap, true);
            if (!region.valid() || region != region_beside(brep, *next.flap, false)) continue;
            double gap = next.angle - here.angle;
            if (i + 1 == order.size()) gap += 2 * std::numbers::pi;
            whole[region.value] += l;
            if (degrees_of(gap) < degrees) sharp[region.value] += l;
        }
    }
    for (std::size_t r = 0; r < sharp.size(); ++r) sharp[r] = whole[r] > 0 ? sharp[r] / whole[r] : 0;
    return sharp;
}

namespace {

double corner_angle(const MeasuredModel& model, const std::array<std::uint32_t, 3>& t, std::size_t i) {
    const Vec3 a = minus(model.points[t[(i + 1) % 3]], model.points[t[i]]), b = minus(model.points[t[(i + 2) % 3]], model.points[t[i]]);
    return std::atan2(length(cross(a, b)), dot(a, b));
}

}  // namespace

std::vector<double> sharp_parts_of_surfaces(const MeasuredModel& model, double degrees) {
    std::vector<std::uint8_t> is_corner(model.points.size());
    for (const auto& corner : model.brep.corners) is_corner[corner.vertex.value] = 1;
    std::vector<double> parts(model.surfaces.size());
    for (std::size_t s = 0; s < parts.size(); ++s) {
        const SurfaceTriangles& surface = model.surfaces[s];
        std::uint64_t sharp = 0, whole = 0;
        for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
            for (std::size_t i = 0; i < 3; ++i) {
                // A fan of triangles around a corner begins at the edge to it that is on a line, and ends at another one.
                const std::uint32_t v = surface.triangles[t][i];
                if (is_corner[v] == 0 || surface.across[t][i] != no_index) continue;
                double angle = 0;
                std::size_t at = t, in = i;
                for (std::size_t steps = 0; steps <= surface.triangles.size(); ++steps) {
                    angle += corner_angle(model, surface.triangles[at], in);
                    const std::uint32_t next = surface.across[at][(in + 2) % 3];
                    if (next == no_index) break;
                    at = next;
                    const auto found = std::ranges::find(surface.triangles[at], v);
                    if (found == surface.triangles[at].end()) break;
                    in = static_cast<std::size_t>(found - surface.triangles[at].begin());
                }
                ++whole;
                sharp += degrees_of(angle) < degrees;
            }
        }
        parts[s] = whole > 0 ? static_cast<double>(sharp) / static_cast<double>(whole) : 0;
    }
    return parts;
}

}  // namespace geomend::complexity
