// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/model_scope.h"

#include <algorithm>
#include <cmath>

#include "base/codes.h"
#include "geometry/cell_volume.h"
#include "validators/found_cells.h"

namespace geomend::validators {

namespace {

/// Calls with each point that an element uses, once for each object that it is in, with the precision of the file and with
/// the object.
template <class Visit>
void each_used_point(const Dataset& dataset, const Visit& visit) {
    std::vector<std::uint8_t> used;
    const auto visit_used = [&](const Object& object, const std::vector<Vec3>& points, const std::vector<std::uint32_t>& corners) {
        const bool single = std::ranges::any_of(info_of(object).annotations,
                                                [](const Annotation& a) { return a.key == "vtk.points_type" && a.value == "Float32"; });
        used.assign(points.size(), 0);
        for (const std::uint32_t c : corners) used[c] = 1;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (used[i] != 0) visit(points[i], single, object);
        }
    };
    for (const Object& object : dataset.objects) {
        if (const auto* surface = std::get_if<Surface>(&object)) visit_used(object, surface->points, surface->polygons.corners);
        else if (const auto* mesh = std::get_if<CellMesh>(&object)) visit_used(object, mesh->points, mesh->nodes);
    }
}

}  // namespace

Lengths lengths_of(const Dataset& dataset, const CheckOptions& options) {
    Vec3 sum{};
    Vec3 origin{};
    double step = 0;
    std::uint64_t count = 0;
    each_used_point(dataset, [&](const Vec3& p, bool single, const Object&) {
        if (count++ == 0) origin = p;
        for (std::size_t k = 0; k < 3; ++k) {
            sum[k] += p[k] - origin[k];
            step = std::max(step, step_above(std::abs(p[k]), single));
        }
    });
    Lengths lengths;
    if (count > 0) {
        Vec3 middle = origin;
        for (std::size_t k = 0; k < 3; ++k) middle[k] += sum[k] / static_cast<double>(count);
        double farthest = 0;
        each_used_point(dataset, [&](const Vec3& p, bool, const Object&) {
            const Vec3 d = minus(p, middle);
            farthest = std::max(farthest, dot(d, d));
        });
        lengths.diameter = 2 * std::sqrt(farthest);
    }
    lengths.tolerance = options.tolerance >= 0 ? options.tolerance : std::max(1e-7 * lengths.diameter, 4 * step);
    lengths.near = options.near >= 0 ? options.near : 1e-3 * lengths.diameter;
    return lengths;
}

std::vector<Finding> huge_coordinates(const Dataset& dataset) {
    constexpr double huge = 1e20;
    Finding finding = finding_of("M09", {});
    each_used_point(dataset, [&](const Vec3& p, bool, const Object& object) {
        if (std::ranges::all_of(p, [](double x) { return std::abs(x) < huge; })) return;
        const EntityRef entity{kind_name(object), info_of(object).name};
        const auto& known = finding.entities;
        const bool is_new = known.empty() || known.back().kind != entity.kind || known.back().name != entity.name;
        if (is_new && known.size() < listed_elements) finding.entities.push_back(entity);
        ++finding.count;
        if (finding.points.size() < listed_elements) finding.points.push_back(p);
    });
    if (finding.count == 0) return {};
    finding.element_kind = "point";
    finding.message = counted(finding.count, "point has", "points have") +
                      " a coordinate that is not finite or as large as 1e20, first in " + quoted(finding.entities[0].name) +
                      ": surfaces and cells were not judged";
    return {finding};
}

ModelScope::ModelScope(const Dataset& dataset, const topology::JudgedModel& model, const Lengths& lengths, const CheckOptions& options)
    : dataset_(dataset), model_(model), lengths_(lengths), monitor_(options.monitor) {
    const BrepData& b = brep();
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
    std::vector<std::uint32_t> uses(b.lines.size(), 0);
    for (const auto& surface : b.surfaces) {
        for (const auto& use : surface.lines) ++uses[use.line.value];
    }
    free_line_.resize(b.lines.size());
    for (std::size_t l = 0; l < uses.size(); ++l) free_line_[l] = uses[l] == 1 ? 1 : 0;
}

const TriangleTree& ModelScope::tree() const {
    if (!tree_) tree_ = std::make_unique<TriangleTree>(brep().vertices, triangles_);
    return *tree_;
}

std::uint32_t ModelScope::surface_of(std::uint32_t triangle) const {
    const auto above = std::upper_bound(first_triangle_.begin(), first_triangle_.end(), triangle);
    return static_cast<std::uint32_t>(above - first_triangle_.begin() - 1);
}

std::uint32_t ModelScope::polygon_of(std::uint32_t triangle) const {
    return polygon_.empty() ? triangle - first_triangle_[surface_of(triangle)] : polygon_[triangle];
}

std::int64_t ModelScope::file_number(std::uint32_t surface, std::uint32_t polygon) const {
    const auto& from = model_.source_polygons;
    const std::uint64_t inside = from.empty() || from[surface].empty() ? polygon : from[surface][polygon];
    return static_cast<std::int64_t>(model_.first_polygon[surface] + inside + 1);
}

Finding finding_of(std::string_view code, std::string message) {
    Finding finding;
    finding.code = code;
    const CodeInfo* info = find_code(code);
    finding.severity = info == nullptr ? Severity::warning : info->severity;
    finding.message = std::move(message);
    return finding;
}

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

EntityRef line_ref(const ModelScope& scope, std::uint32_t line) {
    const auto& l = scope.brep().lines[line];
    if (!l.name.empty() || !l.contact.valid()) return {"line", l.name, line};
    return {"line", scope.brep().contacts[l.contact.value].name, line};
}

EntityRef region_ref(const ModelScope& scope, std::uint32_t region) {
    return {"region", region < scope.brep().regions.size() ? scope.brep().regions[region].name : std::string(), region};
}

void mark_line(const ModelScope& scope, std::uint32_t line, Finding& finding) {
    if (finding.polylines.size() >= listed_elements) return;
    std::vector<Vec3> course;
    for (const VertexId v : scope.brep().lines[line].vertices) course.push_back(scope.brep().vertices[v.value]);
    finding.polylines.push_back(std::move(course));
}

}  // namespace geomend::validators
