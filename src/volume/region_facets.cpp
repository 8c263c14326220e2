// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/region_facets.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/vectors.h"
#include "base/wording.h"

namespace geomend::volumes {

namespace {

/// Per found region the stated one that has the most of its sides; no_index where none has any.
std::vector<std::uint32_t> stated_regions(const BrepData& brep, const topology::FoundRegions& by_walking) {
    const auto& side_region = by_walking.region_of_side;
    std::vector<std::uint32_t> stated(by_walking.regions.size(), no_index);
    std::vector<std::size_t> most(stated.size(), 0);
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        std::vector<std::size_t> sides(stated.size(), 0);
        for (const auto& side : brep.regions[r].sides) {
            const std::uint32_t found = side_region[2 * std::size_t{side.surface.value} + (side.front ? 1 : 0)];
            if (found != no_index && ++sides[found] > most[found]) {
                most[found] = sides[found];
                stated[found] = r;
            }
        }
    }
    return stated;
}

/// Twice the area, and the mean edge, of a triangle.
std::pair<double, double> area_and_edge(const std::array<Vec3, 3>& t) {
    const Vec3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    double edges = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 d = minus(t[(i + 1) % 3], t[i]);
        edges += std::sqrt(dot(d, d));
    }
    return {std::sqrt(dot(n, n)), edges / 3};
}

double median_edge(const RegionFacets& facets) {
    std::vector<std::pair<double, double>> edges;  // edge, area
    double all = 0;
    for (const Triangle& t : facets.triangles) {
        const auto [area, edge] = area_and_edge({facets.positions[t[0]], facets.positions[t[1]], facets.positions[t[2]]});
        edges.emplace_back(edge, area);
        all += area;
    }
    std::ranges::sort(edges);
    double sum = 0;
    for (const auto& [edge, area] : edges) {
        sum += area;
        if (2 * sum >= all) return edge;
    }
    return 0;
}

/// What the facets enclose, seen from their first vertex, so that map coordinates cost no digits.
double enclosed_volume(const RegionFacets& facets) {
    double sum = 0;
    for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
        if (facets.sides[t] == on_both) continue;
        const Triangle& corners = facets.triangles[t];
        const Vec3 a = minus(facets.positions[corners[0]], facets.positions[0]),
                   b = minus(facets.positions[corners[1]], facets.positions[0]),
                   c = minus(facets.positions[corners[2]], facets.positions[0]);
        const double six = dot(a, cross(b, c));
        sum += facets.sides[t] == behind ? six : -six;
    }
    return sum / 6;
}

void number_vertices(const BrepData& brep, RegionFacets& facets) {
    for (const Triangle& t : facets.triangles) facets.vertices.insert(facets.vertices.end(), t.begin(), t.end());
    for (const auto& e : facets.edges) facets.vertices.insert(facets.vertices.end(), e.begin(), e.end());
    std::ranges::sort(facets.vertices);
    const auto repeats = std::ranges::unique(facets.vertices);
    facets.vertices.erase(repeats.begin(), repeats.end());
    for (const std::uint32_t v : facets.vertices) facets.positions.push_back(brep.vertices[v]);
    const auto number = [&](std::uint32_t& v) {
        v = static_cast<std::uint32_t>(std::ranges::lower_bound(facets.vertices, v) - facets.vertices.begin());
    };
    for (Triangle& t : facets.triangles) std::ranges::for_each(t, number);
    for (auto& e : facets.edges) std::ranges::for_each(e, number);
    facets.volume = enclosed_volume(facets);
    facets.median_edge = median_edge(facets);
}

Failure cannot_fill(const std::string& why) { return failure(FailureKind::cannot_hold, "F026", {}, why); }

}  // namespace

Result<std::vector<RegionFacets>> facets_of_regions(const BrepData& brep, const topology::FoundRegions& found,
                                                    std::span<const InnerEdge> inner) {
    const auto stated = stated_regions(brep, found);
    if (stated.empty()) return cannot_fill("no region is closed by surfaces: there is nothing to fill");
    std::vector<RegionFacets> all(stated.size());
    for (std::size_t f = 0; f < stated.size(); ++f) {
        if (stated[f] == no_index) return cannot_fill("a closed region is not among those that are stated; repair states all");
        all[f].region = stated[f];
    }
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        if (!surface.polygons.all_triangles()) return cannot_fill(quoted(surface.name) + " has polygons that are no triangles");
        const std::uint32_t back = found.region_of_side[2 * std::size_t{s}], front = found.region_of_side[2 * std::size_t{s} + 1];
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            const Triangle t{surface.nodes[polygon[0]].value, surface.nodes[polygon[1]].value, surface.nodes[polygon[2]].value};
            const auto add = [&](std::uint32_t region, FacetSides sides) {
                if (region == no_index) return;
                all[region].triangles.push_back(t);
                all[region].sides.push_back(sides);
                all[region].surfaces.push_back(s);
            };
            if (back == front) add(back, on_both);
            else {
                add(back, behind);
                add(front, in_front);
            }
        }
    }
    for (const InnerEdge& edge : inner) all[edge.region].edges.push_back(edge.ends);
    for (RegionFacets& facets : all) number_vertices(brep, facets);
    std::ranges::stable_sort(all, {}, &RegionFacets::region);
    const auto repeat = std::ranges::adjacent_find(all, {}, &RegionFacets::region);
    if (repeat != all.end()) return cannot_fill("region " + quoted(brep.regions[repeat->region].name) + " is two volumes");
    return all;
}

}  // namespace geomend::volumes
