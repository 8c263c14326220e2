// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/surviving_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "base/vectors.h"
#include "base/wording.h"
#include "topology/upward_ray.h"

namespace geomend::repair {

namespace {

/// The regions around a point, by counting what lies above it; nothing where it lies on a surface.
std::optional<std::vector<std::uint32_t>> regions_at(const topology::UpwardRay& ray, const BrepData& brep, const Vec3& point) {
    const auto hits = ray.above(point, [&](std::uint32_t s) { return brep.surfaces[s].regions[0] != brep.surfaces[s].regions[1]; });
    if (!hits) return std::nullopt;
    std::map<std::uint32_t, unsigned> times;
    for (const auto& hit : *hits) {
        for (const RegionId r : brep.surfaces[hit.surface].regions) {
            if (r.valid()) ++times[r.value];
        }
    }
    std::vector<std::uint32_t> inside;
    for (const auto& [region, count] : times) {
        if (count % 2 == 1) inside.push_back(region);
    }
    return inside;
}

struct Facet {
    Vec3 middle, inward;  ///< inward: of length twice the area
    double area;
};

/// The largest triangle of each side of a region, the largest first.
std::vector<Facet> largest_facets(const BrepData& brep, const BrepData::Region& region, double& area) {
    std::vector<Facet> facets;
    for (const auto& side : region.sides) {
        const auto& surface = brep.surfaces[side.surface.value];
        Facet largest{{}, {}, 0};
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            for (std::size_t k = 2; k < polygon.size(); ++k) {
                const auto at = [&](std::size_t i) { return brep.vertices[surface.nodes[polygon[i]].value]; };
                const Vec3 a = at(0), b = at(k - 1), c = at(k);
                const Vec3 normal = cross(minus(b, a), minus(c, a));
                const double size = 0.5 * std::sqrt(dot(normal, normal));
                area += size;
                if (size > largest.area) largest = {times(1.0 / 3, plus(a, plus(b, c))), times(side.front ? 1 : -1, normal), size};
            }
        }
        if (largest.area > 0) facets.push_back(largest);
    }
    std::ranges::stable_sort(facets, [](const Facet& a, const Facet& b) { return a.area > b.area; });
    return facets;
}

/// Some points inside of a region, at most three: behind its largest triangles, a quarter of its thickness away or nearer.
std::vector<Vec3> points_inside(const BrepData& brep, const topology::UpwardRay& ray, std::uint32_t region, double thin) {
    double area = 0;
    const auto facets = largest_facets(brep, brep.regions[region], area);
    const double thickness = 2 * brep.regions[region].volume / area;
    std::vector<Vec3> points;
    if (!(thickness > thin)) return points;
    for (const Facet& facet : facets) {
        const Vec3 inward = times(0.5 / facet.area, facet.inward);
        for (double away = thickness / 4; away > thickness / 500; away /= 2) {
            const Vec3 point = plus(facet.middle, times(away, inward));
            const auto inside = regions_at(ray, brep, point);
            if (!inside || *inside != std::vector<std::uint32_t>{region}) continue;
            points.push_back(point);
            break;
        }
        if (points.size() == 3) break;
    }
    return points;
}

}  // namespace

std::string lost_region(const BrepData& before, const BrepData& after, double thin, const std::function<bool(const Vec3&)>& may_go) {
    if (before.regions.empty()) return {};
    const topology::UpwardRay old_ray(before), new_ray(after);
    std::map<std::set<std::uint32_t>, std::uint32_t> taken;  // what the points of a region are in -> that region
    for (std::uint32_t r = 0; r < before.regions.size(); ++r) {
        if (!before.regions[r].volume_known || !(before.regions[r].volume > 0)) continue;
        const auto points = points_inside(before, old_ray, r, thin);
        if (points.empty()) continue;
        std::set<std::uint32_t> now;
        bool outside = false;
        for (const Vec3& point : points) {
            const auto inside = regions_at(new_ray, after, point);
            if (inside) now.insert(inside->begin(), inside->end());
            outside |= inside && inside->empty() && may_go(point);
        }
        const std::string name = "region " + quoted(before.regions[r].name);
        if (now.empty()) {
            if (outside) continue;
            return name + " is not closed after it";
        }
        if (now.size() > 1) continue;
        const auto [other, is_first] = taken.emplace(now, r);
        if (!is_first) return name + " and " + quoted(before.regions[other->second].name) + " are one after it";
    }
    return {};
}

std::uint64_t thin_regions(const BrepData& brep, double thin) {
    std::uint64_t count = 0;
    for (const auto& region : brep.regions) {
        if (!region.volume_known || !(region.volume > 0)) continue;
        double area = 0;
        largest_facets(brep, region, area);
        count += 2 * region.volume <= thin * area ? 1 : 0;
    }
    return count;
}

}  // namespace geomend::repair
