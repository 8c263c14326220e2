// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "geometry/vectors.h"
#include "model/cell_faces.h"
#include "validators/cell_findings.h"
#include "validators/stated_records.h"

namespace geomend::validators {

namespace {

Vec3 middle_of_triangle(const ModelScope& scope, std::uint32_t triangle) {
    const auto& [a, b, c] = scope.triangles()[triangle];
    const auto& v = scope.brep().vertices;
    return times(1.0 / 3, plus(v[a], plus(v[b], v[c])));
}

/// The number of an entity among those of its kind: its id where that has its name, else the first of that name.
template <class Named>
std::optional<std::uint32_t> number_of(const EntityRef& e, const std::vector<Named>& all) {
    if (e.id >= 0 && static_cast<std::size_t>(e.id) < all.size() && all[static_cast<std::size_t>(e.id)].name == e.name)
        return static_cast<std::uint32_t>(e.id);
    const auto found = std::ranges::find(all, e.name, &Named::name);
    if (found == all.end()) return std::nullopt;
    return static_cast<std::uint32_t>(found - all.begin());
}

class Places {
public:
    Places(const ModelScope& scope, NamesInFile& names) : scope_(scope), records_(scope), names_(names) {}

    void give(Finding& finding) {
        for (const EntityRef& e : finding.entities) name_in_file(e);
        if (finding.where.line == 0 && !finding.entities.empty()) finding.where.line = line_of(finding.entities.front());
        if (!finding.points.empty() || !finding.polylines.empty()) return;
        mark_lines_by_index(finding);
        for (const EntityRef& e : finding.entities) {
            if (e.kind == "surface") mark_surface(number_of(e, scope_.brep().surfaces), finding);
        }
        if (!is_placed(finding)) mark_others(finding);
    }

private:
    static bool is_placed(const Finding& f) { return !f.points.empty() || !f.polylines.empty(); }

    void name_in_file(const EntityRef& e) {
        if (names_.contains({e.kind, e.name})) return;
        InFile in_file;
        if (e.kind == "surface") {
            const auto s = number_of(e, scope_.brep().surfaces);
            if (!s) return;
            const std::uint32_t object = scope_.brep().surfaces[*s].source_object;
            in_file.name = records_.surface_in_file(*s);
            if (object < scope_.dataset().objects.size()) in_file.object = info_of(scope_.dataset().objects[object]).name;
        } else if (e.kind == "region" && e.id >= 0) {
            if (const auto r = number_of(e, scope_.brep().regions)) in_file.name = records_.region_in_file(*r);
        }
        if (!in_file.name.empty() || !in_file.object.empty()) names_.emplace(std::pair(e.kind, e.name), std::move(in_file));
    }

    std::uint64_t line_of(const EntityRef& e) const {
        if (e.kind != "surface") return 0;
        const auto s = number_of(e, scope_.brep().surfaces);
        const auto* face = s ? records_.face(*s) : nullptr;
        return face != nullptr ? face->line : 0;
    }

    /// Findings count lines that they do not draw.
    void mark_lines_by_index(Finding& finding) const {
        if (finding.element_kind != "line") return;
        for (const std::int64_t l : finding.index) {
            if (l >= 0 && static_cast<std::size_t>(l) < scope_.brep().lines.size())
                mark_line(scope_, static_cast<std::uint32_t>(l), finding);
        }
    }

    void mark_surface(std::optional<std::uint32_t> s, Finding& finding) {
        if (!s || finding.points.size() >= listed_elements || scope_.first_triangle(*s) == scope_.first_triangle(*s + 1)) return;
        auto& middle = middles_[*s];
        if (!middle) middle = middle_of_surface(scope_, *s);
        finding.points.push_back(*middle);
    }

    void mark_others(Finding& finding) {
        const BrepData& brep = scope_.brep();
        for (const EntityRef& e : finding.entities) {
            if (e.kind == "surface") {
                mark_surfaces_of_object(e.name, finding);
            } else if (e.kind == "region") {
                if (const auto r = number_of(e, brep.regions)) mark_region(brep.regions[*r], finding);
            } else if (e.kind == "interface") {
                const auto i = number_of(e, brep.interfaces);
                if (i && !brep.interfaces[*i].surfaces.empty()) mark_surface(brep.interfaces[*i].surfaces.front().value, finding);
            } else if (e.kind == "line") {
                if (e.id >= 0 && static_cast<std::size_t>(e.id) < brep.lines.size())
                    mark_line(scope_, static_cast<std::uint32_t>(e.id), finding);
            } else if (e.kind == "corner") {
                const auto c = number_of(e, brep.corners);
                if (c) finding.points.push_back(brep.vertices[brep.corners[*c].vertex.value]);
            }
        }
    }

    /// Objects of loose surfaces are named as a whole where their surfaces are parts of them.
    void mark_surfaces_of_object(const std::string& name, Finding& finding) {
        const auto& surfaces = scope_.brep().surfaces;
        std::set<std::uint32_t> marked;
        for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
            const std::uint32_t object = surfaces[s].source_object;
            if (object >= scope_.dataset().objects.size() || info_of(scope_.dataset().objects[object]).name != name) continue;
            if (marked.insert(object).second) mark_surface(s, finding);
        }
    }

    /// The middle of a side, or that of a cell.
    void mark_region(const BrepData::Region& region, Finding& finding) {
        if (!region.sides.empty()) return mark_surface(region.sides.front().surface.value, finding);
        if (region.cell_types.empty() || finding.points.size() >= listed_elements) return;
        Vec3 sum{};
        for (std::uint64_t k = 0; k < region.cell_offsets[1]; ++k)
            sum = plus(sum, scope_.brep().vertices[region.nodes[region.cell_nodes[k]].value]);
        finding.points.push_back(times(1.0 / static_cast<double>(region.cell_offsets[1]), sum));
    }

    const ModelScope& scope_;
    StatedRecords records_;
    NamesInFile& names_;
    std::map<std::uint32_t, std::optional<Vec3>> middles_;
};

}  // namespace

Vec3 middle_of_surface(const ModelScope& scope, std::uint32_t s) {
    const auto& v = scope.brep().vertices;
    const std::uint32_t first = scope.first_triangle(s), end = scope.first_triangle(s + 1);
    const Vec3 origin = middle_of_triangle(scope, first);
    Vec3 sum{};
    double area = 0;
    for (std::uint32_t t = first; t < end; ++t) {
        const auto& [a, b, c] = scope.triangles()[t];
        const Vec3 n = cross(minus(v[b], v[a]), minus(v[c], v[a]));
        const double weight = std::sqrt(dot(n, n));
        sum = plus(sum, times(weight, minus(middle_of_triangle(scope, t), origin)));
        area += weight;
    }
    const Vec3 mean = area > 0 ? plus(origin, times(1 / area, sum)) : origin;
    std::pair best{std::numeric_limits<double>::infinity(), origin};
    for (std::uint32_t t = first; t < end; ++t) {
        const Vec3 middle = middle_of_triangle(scope, t), d = minus(middle, mean);
        best = std::min(best, std::pair(dot(d, d), middle));
    }
    return best.second;
}

namespace {

using Corners = std::vector<std::uint32_t>;

/// The polygons of some sides: their vertices, sorted, and the surface's own normal, turned into the side.
std::map<Corners, std::vector<Vec3>> polygons_on(const ModelScope& scope, std::span<const std::uint32_t> sides) {
    std::map<Corners, std::vector<Vec3>> normals;
    for (const std::uint32_t side : sides) {
        const auto& surface = scope.brep().surfaces[side / 2];
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            const auto at = [&](std::size_t i) { return scope.vertex_of_node(surface, polygon[i]); };
            Vec3 normal{};
            for (std::size_t i = 1; i + 1 < polygon.size(); ++i) normal = plus(normal, cross(minus(at(i), at(0)), minus(at(i + 1), at(0))));
            Corners corners;
            for (const std::uint32_t node : polygon) corners.push_back(surface.nodes[node].value);
            std::ranges::sort(corners);
            normals[std::move(corners)].push_back(side % 2 == 1 ? normal : times(-1, normal));
        }
    }
    return normals;
}

/// Calls visit(vertices of a face) for each face of a cell.
template <class Visit>
void each_cell_face(const BrepData::Region& region, std::size_t cell, const Visit& visit) {
    Corners face;
    if (region.cell_types[cell] == CellType::polyhedron && !region.cell_faces.empty()) {
        for (std::uint64_t f = region.cell_faces[cell]; f < region.cell_faces[cell + 1]; ++f) {
            face.clear();
            for (std::uint64_t k = region.face_offsets[f]; k < region.face_offsets[f + 1]; ++k)
                face.push_back(region.nodes[region.face_nodes[k]].value);
            visit(face);
        }
        return;
    }
    for (const LocalFace& local : faces_of(region.cell_types[cell])) {
        face.clear();
        for (const std::uint8_t i : local.corners()) face.push_back(region.nodes[region.cell_nodes[region.cell_offsets[cell] + i]].value);
        visit(face);
    }
}

Vec3 mean_of(const ModelScope& scope, const Corners& vertices) {
    Vec3 sum{};
    for (const std::uint32_t v : vertices) sum = plus(sum, scope.brep().vertices[v]);
    return times(1.0 / static_cast<double>(vertices.size()), sum);
}

}  // namespace

std::vector<Vec3> cell_faces_on(const ModelScope& scope, std::uint32_t r, std::span<const std::uint32_t> sides) {
    const auto& region = scope.brep().regions[r];
    const auto normals = polygons_on(scope, sides);
    std::vector<Vec3> middles;
    for (std::size_t cell = 0; cell < region.cell_types.size(); ++cell) {
        Corners all;
        for (std::uint64_t k = region.cell_offsets[cell]; k < region.cell_offsets[cell + 1]; ++k)
            all.push_back(region.nodes[region.cell_nodes[k]].value);
        const Vec3 inside = mean_of(scope, all);
        each_cell_face(region, cell, [&](Corners& face) {
            const Vec3 middle = mean_of(scope, face);
            std::ranges::sort(face);
            const auto found = normals.find(face);
            if (found == normals.end()) return;
            const auto is_in_front = [&](const Vec3& normal) { return dot(normal, minus(inside, middle)) > 0; };
            if (std::ranges::any_of(found->second, is_in_front)) middles.push_back(middle);
        });
    }
    return middles;
}

void give_places(const ModelScope& scope, std::span<Finding> findings, NamesInFile& names) {
    if (findings.empty()) return;
    Places places(scope, names);
    for (Finding& finding : findings) places.give(finding);
}

}  // namespace geomend::validators
