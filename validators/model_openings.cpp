// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include "base/length.h"
#include "geometry/vectors.h"
#include "topology/face_edges.h"
#include "validators/cell_findings.h"
#include "validators/free_borders.h"
#include "validators/model_checks.h"

// Surfaces that should part something, and do not, where no region is stated: what their roles say is an error (B06, B12), what
// no role says a warning (B29).

namespace geomend::validators {

namespace {

bool is_outer(FeatureRole role) { return role == FeatureRole::boundary || role == FeatureRole::topography; }
/// Bodies are mostly closed, and cut off at the outside of the model.
bool may_close(FeatureRole role) { return is_undecided(role) || role == FeatureRole::intrusion; }

/// Surfaces that hang together along lines and have one region, or the outside, on both of their sides.
struct OpenGroup {
    std::vector<std::uint32_t> surfaces;
    std::uint32_t region = no_index;
    bool closes = false;  ///< other surfaces that hang together with them close around something
};

std::vector<OpenGroup> open_groups(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    const auto& side = scope.model().found.region_of_side;
    const auto groups = surface_groups(scope);
    const auto closing = closing_groups(scope);
    std::map<std::pair<std::uint32_t, std::uint32_t>, OpenGroup> open;  // by group and region
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        if (brep.surfaces[s].polygons.size() == 0 || side[2 * s] != side[2 * s + 1]) continue;
        OpenGroup& group = open[{groups[s], side[2 * s]}];
        group.surfaces.push_back(s);
        group.region = side[2 * s];
        group.closes = closing[s] != 0;
    }
    std::vector<OpenGroup> all;
    for (auto& [key, group] : open) all.push_back(std::move(group));
    return all;
}

std::vector<std::uint32_t> lines_of(const ModelScope& scope, std::span<const std::uint32_t> surfaces) {
    std::vector<std::uint32_t> lines;
    for (const std::uint32_t s : surfaces) {
        for (const auto& use : scope.brep().surfaces[s].lines) lines.push_back(use.line.value);
    }
    return lines;
}

/// Whether all but free borders of little extent is there of a closed surface: they go round less than a third as much area as
/// the surfaces have, or much of these stands across the plane of the widest, as the walls of a box do.
bool nearly_closes(const ModelScope& scope, std::span<const std::uint32_t> surfaces, std::span<const FreeBorder> borders) {
    constexpr double across = 0.17, much = 0.15;  // steeper than 80 degrees, of the area
    if (borders.empty() || !std::ranges::all_of(borders, &FreeBorder::closed)) return false;
    double area = 0, missing = 0, walls = 0;
    const auto widest = std::ranges::max_element(borders, {}, [](const FreeBorder& b) { return length(b.facing); });
    const double width = length(widest->facing);
    for (const FreeBorder& border : borders) missing += length(border.facing);
    for (const std::uint32_t s : surfaces) {
        for (std::uint32_t t = scope.first_triangle(s); t < scope.first_triangle(s + 1); ++t) {
            const auto& [a, b, c] = scope.triangles()[t];
            const auto& v = scope.brep().vertices;
            const Vec3 n = times(0.5, cross(minus(v[b], v[a]), minus(v[c], v[a])));
            area += length(n);
            if (std::abs(dot(n, widest->facing)) < across * length(n) * width) walls += length(n);
        }
    }
    return 3 * missing < area || walls > much * area;
}

/// Whether two surfaces are one in the file, and were taken apart.
bool of_one_part(const BrepData::Surface& a, const BrepData::Surface& b) {
    return a.source_object == b.source_object && a.source_part == b.source_part && a.source_part != no_index;
}

/// Calls visit(a, b) for each two surfaces that end at an edge where nothing else is, at an angle: as the sides of a box do, and
/// other than one going on where the other ends. Surfaces that go through one another say nothing.
template <class Visit>
void each_bend(const ModelScope& scope, const Visit& visit) {
    constexpr double bend = 0.7;  // cosine: half a right angle
    const BrepData& brep = scope.brep();
    const topology::LineGraph& graph = scope.model().graph;
    std::vector<topology::PolygonEdges> edges_of;
    for (const auto& surface : brep.surfaces) edges_of.emplace_back(surface.polygons);
    struct Leaf {
        std::uint32_t surface;
        Vec3 way;
    };
    std::vector<Leaf> leaves;
    for (const auto& edge : graph.edges) {
        const auto uses = graph.edge_uses(edge);
        if (std::ranges::count_if(uses, [](const auto& use) { return use.surface != no_index; }) != 2) continue;
        const Vec3 &a = brep.vertices[uses[0].low], &b = brep.vertices[uses[0].high];
        leaves.clear();
        for (const auto& use : uses) {
            if (use.surface == no_index) continue;
            const VertexId tip = topology::far_vertex(brep, brep.surfaces[use.surface], edges_of[use.surface].polygon(use.corner), a, b);
            const Vec3 way = across(minus(brep.vertices[tip.value], a), minus(b, a));
            if (length(way) > 0) leaves.push_back({use.surface, times(1 / length(way), way)});
        }
        const bool two = leaves.size() == 2 && !of_one_part(brep.surfaces[leaves[0].surface], brep.surfaces[leaves[1].surface]);
        if (two && dot(leaves[0].way, leaves[1].way) > -bend) visit(leaves[0].surface, leaves[1].surface);
    }
}

/// How a group of surfaces around nothing is to be taken.
enum class Meant { open, undecided, closed };

/// Per surface what it and those that meet it at an angle say: two outer sides are meant to close.
std::vector<Meant> meant_by_bends(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    std::vector<Meant> meant(brep.surfaces.size(), Meant::open);
    each_bend(scope, [&](std::uint32_t a, std::uint32_t b) {
        const FeatureRole roles[] = {brep.surfaces[a].role, brep.surfaces[b].role};
        Meant says = Meant::open;
        if (is_outer(roles[0]) && is_outer(roles[1])) says = Meant::closed;
        else if ((may_close(roles[0]) && !may_end_freely(roles[1])) || (may_close(roles[1]) && !may_end_freely(roles[0])))
            says = Meant::undecided;
        meant[a] = std::max(meant[a], says);
        meant[b] = std::max(meant[b], says);
    });
    return meant;
}

Meant meant_of(const ModelScope& scope, const OpenGroup& group, std::span<const FreeBorder> borders, std::span<const Meant> bends) {
    const BrepData& brep = scope.brep();
    Meant meant = Meant::open;
    for (const std::uint32_t s : group.surfaces) meant = std::max(meant, bends[s]);
    const auto any = [&](bool (*is)(FeatureRole)) {
        return std::ranges::any_of(group.surfaces, [&](std::uint32_t s) { return is(brep.surfaces[s].role); });
    };
    if (meant == Meant::closed || !nearly_closes(scope, group.surfaces, borders)) return meant;
    if (any(is_outer)) return Meant::closed;
    return any([](FeatureRole role) { return !may_end_freely(role); }) ? Meant::undecided : meant;
}

std::string names_of(const ModelScope& scope, std::span<const std::uint32_t> surfaces) {
    std::string text = quoted(scope.brep().surfaces[surfaces[0]].name);
    if (surfaces.size() > 1) text += " and " + counted(surfaces.size() - 1, "other surface", "other surfaces");
    return text;
}

std::string free_border_text(const ModelScope& scope, std::span<const FreeBorder> borders, bool many) {
    return borders.empty() ? "" : (many ? "; they end freely along " : "; it ends freely along ") + border_text(scope, borders);
}

void report_around_nothing(const ModelScope& scope, const OpenGroup& group, std::span<const Meant> bends, std::vector<Finding>& findings) {
    const auto borders = free_borders(scope, lines_of(scope, group.surfaces));
    if (borders.empty()) return;  // nothing is open: surfaces lie on each other, or the order around a line is not known
    const Meant meant = meant_of(scope, group, borders, bends);
    if (meant == Meant::open) return;
    const bool many = group.surfaces.size() > 1;
    std::string message =
        names_of(scope, group.surfaces) + (many ? " enclose" : " encloses") + " no volume" + free_border_text(scope, borders, many);
    if (meant == Meant::undecided)
        message += "; the file states no role that lets " + std::string(many ? "them" : "it") + " be open, as that of a fault does";
    Finding finding = finding_of(meant == Meant::closed ? "B06" : "B29", std::move(message));
    name_surfaces(scope, group.surfaces, finding);
    mark_borders(scope, borders, finding);
    findings.push_back(std::move(finding));
}

/// Of surfaces that have one region, or the outside of a model that closes, on both sides those that no role decides about.
void report_undecided(const ModelScope& scope, const OpenGroup& group, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    std::vector<std::uint32_t> undecided;
    for (const std::uint32_t s : group.surfaces) {
        if (is_undecided(brep.surfaces[s].role)) undecided.push_back(s);
    }
    if (undecided.empty()) return;
    const auto borders = free_borders(scope, lines_of(scope, undecided));
    const bool outside = group.region == no_index, many = undecided.size() > 1;
    if (outside && borders.empty()) return;  // nothing is open
    Finding finding = finding_of(
        "B29", std::string(many ? "both sides of each of " : "both sides of ") + names_of(scope, undecided) + " lie " +
                   (outside ? std::string("outside all regions") : "in " + found_region_name(scope, group.region)) +
                   free_border_text(scope, borders, many) + "; the file states no role for " + (many ? "them" : "it") + ": if " +
                   (many ? "they are" : "it is") + " meant to separate " +
                   (outside ? "a region from the outside, the region is open there" : "two regions, these are open to each other there"));
    name_surfaces(scope, undecided, finding);
    mark_borders(scope, borders, finding);
    findings.push_back(std::move(finding));
}

}  // namespace

void check_openings(const ModelScope& scope, std::vector<Finding>& findings) {
    if (scope.model().regions_stated) return check_model_closed(scope, findings);
    if (scope.model().found.region_of_side.empty()) return;
    const auto bends = meant_by_bends(scope);
    for (const OpenGroup& group : open_groups(scope)) {
        if (group.region != no_index || group.closes) report_undecided(scope, group, findings);
        else report_around_nothing(scope, group, bends, findings);
    }
}

}  // namespace geomend::validators
