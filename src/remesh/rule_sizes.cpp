// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/rule_sizes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/length.h"
#include "base/parallel.h"
#include "base/vectors.h"
#include "geometry/surface_distance.h"
#include "remesh/edge_mesh.h"

namespace geomend::remeshing {

/// The triangles that a distance is from.
struct RuleSizes::Zone {
    SizeRule rule;
    double reach = 0;  ///< farther away the rule has no say
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> groups;
    std::unique_ptr<TriangleTree> tree;
    std::unique_ptr<SurfaceDistance> distance;
};

namespace {

bool is_called(const BrepData& brep, const BrepData::Surface& surface, const std::string& name) {
    return surface.name == name || (surface.interface_id.valid() && brep.interfaces[surface.interface_id.value].name == name);
}

/// Twice the area of a triangle as a vector along its normal.
Vec3 area_normal(const BrepData& brep, const BrepData::Surface& surface, std::uint32_t t) {
    const auto place = [&](std::uint32_t k) {
        return brep.vertices[surface.nodes[surface.polygons.corners[3 * std::size_t{t} + k]].value];
    };
    return cross(minus(place(1), place(0)), minus(place(2), place(0)));
}

}  // namespace

RuleSizes::RuleSizes(const BrepData& brep, std::span<const SizeRule> rules, double elsewhere)
    : brep_(brep), rules_(rules.begin(), rules.end()), elsewhere_(elsewhere) {
    for (const SizeRule& rule : rules) {
        if (rule.kind != SizeRule::Kind::distance) continue;
        Zone& zone = zones_.emplace_back();
        zone.rule = rule;
        zone.reach = rule.thickness + influence_zone(rule.size, elsewhere, rule.ratio);
        for (const auto& surface : brep.surfaces) {
            if (!is_called(brep, surface, rule.name)) continue;
            for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
                const auto polygon = surface.polygons[p];
                for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
                    zone.triangles.push_back(
                        {surface.nodes[polygon[0]].value, surface.nodes[polygon[k]].value, surface.nodes[polygon[k + 1]].value});
            }
        }
        zone.groups.assign(zone.triangles.size(), 0);
        zone.tree = std::make_unique<TriangleTree>(brep.vertices, zone.triangles);
        zone.distance = std::make_unique<SurfaceDistance>(*zone.tree, zone.groups);
    }
}

RuleSizes::~RuleSizes() = default;

bool RuleSizes::has_places() const {
    return !zones_.empty() || std::ranges::any_of(rules_, [](const SizeRule& rule) { return rule.kind == SizeRule::Kind::field; });
}

double RuleSizes::at(const Vec3& point) const {
    double least = HUGE_VAL;
    for (const SizeRule& rule : rules_) {
        if (rule.kind == SizeRule::Kind::field) least = std::min(least, rule.field(point));
    }
    for (const Zone& zone : zones_) {
        if (zone.tree->size() == 0) continue;
        std::uint32_t triangle = 0;
        const double distance = zone.distance->from_group(point, 0, zone.reach, triangle).distance;
        if (distance < zone.reach) least = std::min(least, size_at_distance(zone.rule, distance, elsewhere_));
    }
    return least;
}

void RuleSizes::apply_curvature(const SizeRule& rule, std::vector<double>& least) const {
    const double turn = rule.degrees * std::numbers::pi / 180, smallest = elsewhere_ / 16;
    for (const auto& surface : brep_.surfaces) {
        if (!surface.polygons.all_triangles()) continue;
        std::vector<double> bend(surface.nodes.size(), 0), area(surface.nodes.size(), 0);
        for (std::uint32_t h = 0; h < surface.polygons.corners.size(); ++h) {
            const std::uint32_t a = surface.polygons.corners[h], b = surface.polygons.corners[next_of(h)], t = h / 3,
                                u = surface.neighbours[h];
            const Vec3 normal = area_normal(brep_, surface, t);
            area[a] += length(normal) / 6;
            if (u == no_index || u < t) continue;
            const Vec3 other = area_normal(brep_, surface, u);
            const double angle = std::atan2(length(cross(normal, other)), dot(normal, other));
            const double edge = length(minus(brep_.vertices[surface.nodes[b].value], brep_.vertices[surface.nodes[a].value]));
            for (const std::uint32_t node : {a, b}) bend[node] += angle * edge / 2;
        }
        for (std::size_t n = 0; n < surface.nodes.size(); ++n) {
            if (!(bend[n] > 0) || !(area[n] > 0)) continue;
            double& size = least[surface.nodes[n].value];
            size = std::min(size, std::max(smallest, turn * area[n] / bend[n]));
        }
    }
}

void RuleSizes::apply_property(const SizeRule& rule, std::vector<double>& least) const {
    double low = HUGE_VAL, high = -HUGE_VAL;
    const auto visit = [&](const auto& use) {
        for (const auto& surface : brep_.surfaces) {
            const Attribute* values = find_attribute(surface.attributes, rule.name, AttributeLocation::point);
            if (values == nullptr) continue;
            for (std::size_t n = 0; n < surface.nodes.size(); ++n) {
                const double value = value_as_double(*values, n * values->components);
                if (std::isfinite(value) && !is_no_data(*values, value)) use(surface.nodes[n].value, value);
            }
        }
    };
    visit([&](std::uint32_t, double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    });
    visit([&](std::uint32_t v, double value) {
        const double share = high > low ? (value - low) / (high - low) : 0;
        least[v] = std::min(least[v], rule.size + share * (rule.largest - rule.size));
    });
}

void RuleSizes::apply(std::vector<double>& sizes) const {
    std::vector<double> least(sizes.size(), HUGE_VAL);
    for (const SizeRule& rule : rules_) {
        if (rule.kind == SizeRule::Kind::curvature) apply_curvature(rule, least);
        if (rule.kind == SizeRule::Kind::property) apply_property(rule, least);
    }
    if (has_places()) parallel_for_each_index(sizes.size(), [&](std::size_t v) { least[v] = std::min(least[v], at(brep_.vertices[v])); });
    const bool makes_larger = std::ranges::any_of(rules_, [&](const SizeRule& rule) {
        return rule.kind != SizeRule::Kind::curvature && std::max(rule.size, rule.largest) > elsewhere_;
    });
    for (std::size_t v = 0; v < sizes.size(); ++v) {
        if (least[v] != HUGE_VAL) sizes[v] = makes_larger && sizes[v] == elsewhere_ ? least[v] : std::min(sizes[v], least[v]);
    }
}

}  // namespace geomend::remeshing
