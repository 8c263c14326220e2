// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/model_scope.h"

#include <algorithm>
#include <cmath>

#include "base/codes.h"
#include "base/place_words.h"
#include "geometry/cell_volume.h"
#include "validators/cell_findings.h"

namespace geomend::validators {

namespace {

/// Calls with each point that an element uses, once for each object that it is in: visit(object, its number there).
template <class Visit>
void each_used_point(const Dataset& dataset, const Visit& visit) {
    std::vector<std::uint8_t> used;
    const auto visit_used = [&](const Object& object, const std::vector<Vec3>& points, const std::vector<std::uint32_t>& corners) {
        used.assign(points.size(), 0);
        for (const std::uint32_t c : corners) used[c] = 1;
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            if (used[i] != 0) visit(object, i);
        }
    };
    for (const Object& object : dataset.objects) {
        if (const auto* surface = std::get_if<Surface>(&object)) visit_used(object, surface->points, surface->polygons.corners);
        else if (const auto* mesh = std::get_if<CellMesh>(&object)) visit_used(object, mesh->points, mesh->nodes);
    }
}

const Labels& point_labels(const Object& object) {
    const auto* mesh = std::get_if<CellMesh>(&object);
    return mesh != nullptr ? mesh->point_labels : std::get<Surface>(object).labels;
}

const std::vector<Vec3>& points_of(const Object& object) {
    const auto* mesh = std::get_if<CellMesh>(&object);
    return mesh != nullptr ? mesh->points : std::get<Surface>(object).points;
}

/// A height in the file's own sense.
double stated_height(const Object& object, double z) { return info_of(object).crs.z_positive == ZPositive::depth ? 0.0 - z : z; }

/// "(x, y, z)" in the file's own sense.
std::string stated_position(const Object& object, const Vec3& p) { return place_words({p[0], p[1], stated_height(object, p[2])}); }

}  // namespace

topology::LocalLengths lengths_of(const Dataset& dataset, const CheckOptions& options) {
    return topology::local_lengths(dataset, {options.tolerance, options.near});
}

std::vector<Finding> huge_coordinates(const Dataset& dataset) {
    constexpr double huge = 1e20;
    Finding finding = finding_of("M09", {});
    std::string first;
    each_used_point(dataset, [&](const Object& object, std::uint32_t point) {
        const Vec3& p = points_of(object)[point];
        if (std::ranges::all_of(p, [](double x) { return std::abs(x) < huge; })) return;
        const EntityRef entity{kind_name(object), info_of(object).name};
        const auto& known = finding.entities;
        const bool is_new = known.empty() || known.back().kind != entity.kind || known.back().name != entity.name;
        if (is_new && known.size() < listed_elements) finding.entities.push_back(entity);
        if (finding.count++ == 0)
            first =
                "point " + std::to_string(point_labels(object)[point]) + " of " + quoted(entity.name) + " at " + stated_position(object, p);
        if (finding.points.size() >= listed_elements) return;
        finding.points.push_back(p);
        finding.elements.push_back(point_labels(object)[point]);
        finding.index.push_back(point);
    });
    if (finding.count == 0) return {};
    if (finding.entities.size() > 1) {  // numbers of which object?
        finding.elements.clear();
        finding.index.clear();
    }
    finding.element_kind = "point";
    finding.message = counted(finding.count, "point has", "points have") + " a coordinate that is not finite or as large as 1e20" +
                      (finding.count == 1 ? ": " : ", first ") + first + ", which looks like no-data; surfaces and cells were not judged";
    return {finding};
}

namespace {

/// \pre all of one object, at least one
Finding outlying_finding(const Object& object, std::span<const topology::OutlyingPoint> outlying) {
    const auto& first = outlying[0];
    const Vec3& p = points_of(object)[first.point];
    const std::int64_t number = point_labels(object)[first.point];
    const bool alone = outlying.size() == 1;
    const bool usual = std::ranges::any_of(outlying, &topology::OutlyingPoint::usual);
    std::string message = (alone ? "point " + std::to_string(number) : std::to_string(outlying.size()) + " points") + " of " +
                          quoted(info_of(object).name) + (alone ? " lies" : " lie") +
                          " far off: " + (alone ? "" : "point " + std::to_string(number) + ", the first, is ") + (alone ? "it is " : "") +
                          "at " + stated_position(object, p);
    if (first.times > 0) message += ", " + rounded(first.times) + " times as far from the others as these are from each other";
    if (usual) message += "; the height looks like no-data";
    message +=
        alone ? "; all else is judged as if it lay between its neighbours" : "; all else is judged as if they lay between their neighbours";
    Finding finding = finding_of("M15", std::move(message));
    finding.entities.push_back({kind_name(object), info_of(object).name});
    finding.element_kind = "point";
    finding.count = outlying.size();
    for (const auto& one : outlying.first(std::min(outlying.size(), listed_elements))) {
        finding.elements.push_back(point_labels(object)[one.point]);
        finding.index.push_back(one.point);
        finding.points.push_back(points_of(object)[one.point]);
    }
    finding.measures = {{"times", first.times}, {"height", stated_height(object, p[2])}};
    return finding;
}

}  // namespace

void report_outlying(const Dataset& dataset, const topology::LocalLengths& lengths, std::vector<Finding>& findings) {
    const std::span all(lengths.outlying);
    for (std::size_t i = 0; i < all.size();) {
        std::size_t end = i;
        while (end < all.size() && all[end].object == all[i].object) ++end;
        findings.push_back(outlying_finding(dataset.objects[all[i].object], all.subspan(i, end - i)));
        i = end;
    }
}

ModelScope::ModelScope(const Dataset& dataset, const topology::JudgedModel& model, const topology::LocalLengths& lengths,
                       const CheckOptions& options)
    : dataset_(dataset), model_(model), monitor_(options.monitor) {
    const BrepData& b = brep();
    for (const auto& surface : b.surfaces) lengths_.push_back(lengths.of(surface.source_object));
    const bool plain = std::ranges::all_of(b.surfaces, [](const auto& s) { return s.polygons.all_triangles(); });
    for (const auto& surface : b.surfaces) {
        first_triangle_.push_back(static_cast<std::uint32_t>(triangles_.size()));
        for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
                triangles_.push_back(
                    {surface.nodes[polygon[0]].value, surface.nodes[polygon[i]].value, surface.nodes[polygon[i + 1]].value});
                if (!plain) polygon_.push_back(p);
            }
        }
    }
    first_triangle_.push_back(static_cast<std::uint32_t>(triangles_.size()));
    for (std::uint32_t s = 0; s + 1 < first_triangle_.size(); ++s) surface_of_.resize(first_triangle_[s + 1], s);
    std::vector<std::uint32_t> uses(b.lines.size(), 0);
    for (const auto& surface : b.surfaces) {
        for (const auto& use : surface.lines) ++uses[use.line.value];
    }
    free_line_.resize(b.lines.size());
    for (std::size_t l = 0; l < uses.size(); ++l) free_line_[l] = uses[l] == 1 ? 1 : 0;
    find_twin_nodes();
}

void ModelScope::find_twin_nodes() {
    const BrepData& b = brep();
    has_twin_nodes_.resize(b.surfaces.size());
    std::vector<std::uint32_t> last_surface(b.vertices.size(), no_index), last_node(b.vertices.size());
    for (std::uint32_t s = 0; s < b.surfaces.size(); ++s) {
        for (const std::uint32_t node : b.surfaces[s].polygons.corners) {
            const std::uint32_t v = b.surfaces[s].nodes[node].value;
            if (last_surface[v] == s && last_node[v] != node) has_twin_nodes_[s] = 1;
            last_surface[v] = s;
            last_node[v] = node;
        }
    }
}

const TriangleTree& ModelScope::tree() const {
    if (!tree_) {
        tree_ = std::make_unique<TriangleTree>(brep().vertices, triangles_, 0, surface_of_);
    }
    return *tree_;
}

std::uint32_t ModelScope::polygon_of(std::uint32_t triangle) const {
    return polygon_.empty() ? triangle - first_triangle_[surface_of(triangle)] : polygon_[triangle];
}

std::int64_t ModelScope::file_number(std::uint32_t surface, std::uint32_t polygon) const {
    const auto& from = model_.source_polygons;
    const std::uint64_t inside = from.empty() || from[surface].empty() ? polygon : from[surface][polygon];
    return static_cast<std::int64_t>(model_.first_polygon[surface] + inside + 1);
}

Finding finding_of(std::string_view code, std::string message) { return make_finding(code, std::move(message), {}, 0); }

Finding polygons_finding(const ModelScope& scope, std::string_view code, std::uint32_t s, std::string message,
                         std::span<const std::uint32_t> polygons) {
    Finding finding = finding_of(code, std::move(message));
    const auto& surface = scope.brep().surfaces[s];
    finding.entities.push_back(surface_ref(scope, s));
    finding.element_kind = surface.polygons.all_triangles() ? "triangle" : "polygon";
    finding.count = polygons.size();
    for (const std::uint32_t p : polygons.first(std::min(polygons.size(), listed_elements))) {
        finding.elements.push_back(scope.file_number(s, p));
        finding.index.push_back(p);
        Vec3 middle{};
        const auto polygon = surface.polygons[p];
        for (const std::uint32_t node : polygon) {
            const Vec3& v = scope.vertex_of_node(surface, node);
            for (std::size_t k = 0; k < 3; ++k) middle[k] += v[k] / static_cast<double>(polygon.size());
        }
        finding.points.push_back(middle);
    }
    return finding;
}

EntityRef surface_ref(const ModelScope& scope, std::uint32_t surface) { return {"surface", scope.brep().surfaces[surface].name, surface}; }

void name_surfaces(const ModelScope& scope, std::span<const std::uint32_t> surfaces, Finding& finding) {
    finding.element_kind = "surface";
    finding.count = surfaces.size();
    for (const std::uint32_t s : surfaces) {
        if (finding.entities.size() >= listed_elements) break;
        finding.entities.push_back(surface_ref(scope, s));
        finding.index.push_back(s);
    }
}

EntityRef line_ref(const ModelScope& scope, std::uint32_t line) {
    const auto& l = scope.brep().lines[line];
    if (!l.name.empty() || !l.contact.valid()) return {"line", l.name, line};
    return {"line", scope.brep().contacts[l.contact.value].name, line};
}

EntityRef region_ref(const ModelScope& scope, std::uint32_t region) {
    return {"region", region < scope.brep().regions.size() ? scope.brep().regions[region].name : std::string(), region};
}

std::string found_region_name(const ModelScope& scope, std::uint32_t found) {
    if (found == no_index) return "the outside";
    const auto& sides = scope.model().found.regions[found];
    const auto& s = scope.brep().surfaces[sides[0].surface.value];
    const RegionId id = s.regions[sides[0].front ? 1 : 0];
    return id.valid() ? "region " + quoted(scope.brep().regions[id.value].name) : "a region";
}

void mark_line(const ModelScope& scope, std::uint32_t line, Finding& finding) {
    if (finding.polylines.size() >= listed_elements) return;
    std::vector<Vec3> course;
    for (const VertexId v : scope.brep().lines[line].vertices) course.push_back(scope.brep().vertices[v.value]);
    finding.polylines.push_back(std::move(course));
}

}  // namespace geomend::validators
