// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/cell_volume.h"
#include "topology/face_edges.h"
#include "topology/winding.h"
#include "validators/cell_findings.h"
#include "validators/each_surface.h"
#include "validators/model_checks.h"

namespace geomend::validators {

namespace {

bool uses_vertex_twice(const BrepData::Surface& surface, std::uint32_t p) {
    const auto polygon = surface.polygons[p];
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        for (std::size_t j = i + 1; j < polygon.size(); ++j) {
            if (surface.nodes[polygon[i]] == surface.nodes[polygon[j]]) return true;
        }
    }
    return polygon.size() < 3;
}

/// The height of a triangle over its longest side.
double smallest_height(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = minus(b, a), ac = minus(c, a), bc = minus(c, b);
    const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
    const Vec3 n = cross(ab, ac);
    return longest == 0 ? 0 : std::sqrt(dot(n, n) / longest);
}

}  // namespace

void check_near_points(const ModelScope& scope, std::vector<Finding>& findings) {
    const auto& model = scope.model();
    if (model.points_welded == 0) return;
    Finding finding = finding_of("M01", counted(model.points_welded, "point is", "points are") + " nearer than " +
                                            rounded(model.tolerance) + " to another one, but not equal: judged as if they were one");
    finding.entities.push_back({"model", scope.brep().name});
    finding.element_kind = "point";
    finding.count = model.points_welded;
    finding.points = model.welded_positions;
    findings.push_back(std::move(finding));
}

void check_isolated_points(const ModelScope& scope, std::vector<Finding>& findings) {
    judge_surfaces(scope, findings, [&](std::uint32_t s) -> std::optional<Finding> {
        const auto& surface = scope.brep().surfaces[s];
        std::vector<std::uint8_t> used(surface.nodes.size(), 0);
        for (const std::uint32_t node : surface.polygons.corners) used[node] = 1;
        const auto count = static_cast<std::uint64_t>(std::ranges::count(used, 0));
        if (count == 0) return std::nullopt;
        Finding finding = finding_of("M02", counted(count, "point", "points") + " of " + quoted(surface.name) +
                                                (count == 1 ? " belongs" : " belong") + " to no triangle");
        finding.entities.push_back(surface_ref(scope, s));
        finding.element_kind = "point";
        finding.count = count;
        for (std::uint32_t n = 0; n < used.size() && finding.index.size() < listed_elements; ++n) {
            if (used[n] != 0) continue;
            finding.index.push_back(n);
            finding.points.push_back(scope.vertex_of_node(surface, n));
        }
        return finding;
    });
}

void check_degenerate(const ModelScope& scope, std::vector<Finding>& findings) {
    judge_polygons(scope, findings, "B01", "uses a vertex twice, and so has no area", "use a vertex twice, and so have no area",
                   uses_vertex_twice);
}

void check_flat_triangles(const ModelScope& scope, std::vector<Finding>& findings) {
    const auto words = [&](std::uint32_t s) {
        const std::string than = "flatter than " + rounded(scope.lengths(s).tolerance);
        return PolygonWords{"is " + than, "are " + than};
    };
    judge_polygons(scope, findings, "M03", words, [&](std::uint32_t s, std::uint32_t p) {
        const auto& surface = scope.brep().surfaces[s];
        const auto polygon = surface.polygons[p];
        if (polygon.size() != 3 || uses_vertex_twice(surface, p)) return false;
        const auto& lengths = scope.lengths(s);
        const auto corner = [&](std::size_t i) { return lengths.drawn_out(scope.vertex_of_node(surface, polygon[i])); };
        return smallest_height(corner(0), corner(1), corner(2)) <= lengths.tolerance;
    });
}

void check_repeats(const ModelScope& scope, std::vector<Finding>& findings) {
    judge_surfaces(scope, findings, [&](std::uint32_t s) -> std::optional<Finding> {
        const auto& surface = scope.brep().surfaces[s];
        if (!scope.has_twin_nodes(s) && scope.model().faces[s].duplicate.empty()) return std::nullopt;  // no two have the same nodes
        struct Key {
            std::array<std::uint32_t, 3> lowest;  // enough to find candidates; the whole decides
            std::uint32_t polygon;
        };
        std::vector<Key> keys;
        const auto vertices_of = [&](std::uint32_t p) {
            std::vector<std::uint32_t> all;
            for (const std::uint32_t node : surface.polygons[p]) all.push_back(surface.nodes[node].value);
            std::ranges::sort(all);
            return all;
        };
        keys.reserve(surface.polygons.size());
        for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
            if (uses_vertex_twice(surface, p)) continue;
            std::array<std::uint32_t, 3> low{no_index, no_index, no_index};
            for (const std::uint32_t node : surface.polygons[p]) {
                std::uint32_t v = surface.nodes[node].value;
                for (std::uint32_t& slot : low) {
                    if (v < slot) std::swap(v, slot);
                }
            }
            keys.push_back({low, p});
        }
        std::ranges::sort(keys,
                          [](const Key& a, const Key& b) { return a.lowest != b.lowest ? a.lowest < b.lowest : a.polygon < b.polygon; });
        std::vector<std::uint32_t> repeats;
        for (std::size_t i = 1; i < keys.size(); ++i) {
            if (keys[i].lowest != keys[i - 1].lowest) continue;
            if (surface.polygons[keys[i].polygon].size() == 3 && surface.polygons[keys[i - 1].polygon].size() == 3)
                repeats.push_back(keys[i].polygon);
            else if (vertices_of(keys[i].polygon) == vertices_of(keys[i - 1].polygon)) repeats.push_back(keys[i].polygon);
        }
        if (repeats.empty()) return std::nullopt;
        std::ranges::sort(repeats);
        return polygons_finding(scope, "M04", s,
                                counted(repeats.size(), "triangle", "triangles") + " of " + quoted(surface.name) +
                                    (repeats.size() == 1 ? " repeats" : " repeat") + " another one of the same three vertices",
                                repeats);
    });
}

void check_winding(const ModelScope& scope, std::vector<Finding>& findings) {
    judge_surfaces(scope, findings, [&](std::uint32_t s) -> std::optional<Finding> {
        const auto& surface = scope.brep().surfaces[s];
        auto winding = topology::winding_of(surface);
        if (winding.one_sided) {
            Finding finding = finding_of(
                "M06", quoted(surface.name) + " is not orientable: it has one side only, so that no region lies before or behind it");
            finding.entities.push_back(surface_ref(scope, s));
            finding.count = 1;
            return finding;
        }
        const auto& turned = scope.model().turned_polygons;
        if (!turned.empty() && !turned[s].empty()) winding.wrong = turned[s];  // they were turned over to follow the surface
        if (winding.wrong.empty()) return std::nullopt;
        Finding finding = polygons_finding(scope, "M05", s,
                                           counted(winding.wrong.size(), "triangle", "triangles") + " of " + quoted(surface.name) +
                                               (winding.wrong.size() == 1 ? " is" : " are") + " wound against " +
                                               (winding.wrong.size() == 1 ? "its" : "their") + " neighbours",
                                           winding.wrong);
        if (!scope.model().stated) use_other_severity(finding);
        return finding;
    });
}

}  // namespace geomend::validators
