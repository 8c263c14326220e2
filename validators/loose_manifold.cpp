// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/loose_manifold.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "topology/face_edges.h"
#include "topology/faces_from_mesh.h"
#include "topology/surface_array.h"
#include "validators/cell_findings.h"

namespace geomend::validators {

namespace {

/// A part of an object, as its file has it.
using Part = std::pair<std::uint32_t, std::uint32_t>;

Part part_of(const BrepData::Surface& surface) { return {surface.source_object, surface.source_part}; }

/// What is wrong with a part.
struct Wrong {
    std::vector<std::array<Vec3, 2>> edges;
    std::set<Vec3> points;
    std::set<std::uint32_t> surfaces;
    std::set<std::pair<std::uint32_t, std::uint32_t>> polygons;  // surface, and its polygon
};

bool parts_regions(const ModelScope& scope, std::uint32_t surface) {
    const auto& side = scope.model().found.region_of_side;
    const std::size_t front = 2 * std::size_t{surface};
    return !side.empty() && side[front] != side[front + 1];
}

void find_edges(const ModelScope& scope, std::map<Part, Wrong>& wrong) {
    const BrepData& brep = scope.brep();
    const topology::LineGraph& graph = scope.model().graph;
    std::vector<topology::PolygonEdges> edges_of;
    for (const auto& surface : brep.surfaces) edges_of.emplace_back(surface.polygons);
    std::map<Part, std::vector<const topology::EdgeUse*>> by_part;
    for (const auto& edge : graph.edges) {
        const auto uses = graph.edge_uses(edge);
        if (uses.size() < 3) continue;
        by_part.clear();
        for (const auto& use : uses) {
            if (use.surface != no_index) by_part[part_of(brep.surfaces[use.surface])].push_back(&use);
        }
        for (const auto& [part, of_part] : by_part) {
            if (of_part.size() < 3) continue;
            if (std::ranges::all_of(of_part, [&](const auto* use) { return parts_regions(scope, use->surface); })) continue;
            Wrong& here = wrong[part];
            here.edges.push_back({brep.vertices[uses[0].low], brep.vertices[uses[0].high]});
            for (const auto* use : of_part) {
                here.surfaces.insert(use->surface);
                here.polygons.emplace(use->surface, edges_of[use->surface].polygon(use->corner));
            }
        }
    }
}

/// A corner of a polygon of an object, and the points before and after it.
struct CornerNeighbours {
    std::uint32_t point, before, after;
    std::uint64_t polygon;
};

/// Whether the polygons around one point hang together by the edges there, or in another way.
template <class AlsoJoined>
bool is_one_ring(std::span<const CornerNeighbours> around, const AlsoJoined& also_joined) {
    DisjointSets rings(around.size());
    for (std::uint32_t i = 0; i < around.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
            const CornerNeighbours &a = around[i], &b = around[j];
            if (a.before == b.before || a.before == b.after || a.after == b.before || a.after == b.after || also_joined(a, b))
                rings.join(i, j);
        }
    }
    for (std::uint32_t i = 0; i < around.size(); ++i) {
        if (rings.root(i) != 0) return false;
    }
    return true;
}

/// Numbers of points; where polygons have points of their own, those at one position have one number.
std::vector<std::uint32_t> numbers_of(const Surface& surface) {
    std::vector<std::uint32_t> number(surface.points.size());
    for (std::uint32_t i = 0; i < number.size(); ++i) number[i] = i;
    if (10 * number.size() < 9 * surface.polygons.corners.size()) return number;
    std::map<Vec3, std::uint32_t> first;
    std::vector<std::uint32_t> by_position(number.size());
    for (std::uint32_t i = 0; i < number.size(); ++i) by_position[i] = first.emplace(surface.points[i], i).first->second;
    return 4 * first.size() < 3 * number.size() ? by_position : number;  // two triangles side by side have four positions
}

/// Corners at some points, of the polygons that have a point once only, by part and point.
/// \param parts per polygon its part
std::vector<std::pair<std::uint32_t, CornerNeighbours>> corners_at(const Surface& surface, const std::vector<std::uint32_t>& number,
                                                                   const std::vector<std::uint8_t>& wanted,
                                                                   std::span<const std::uint32_t> parts) {
    std::vector<std::pair<std::uint32_t, CornerNeighbours>> corners;
    std::vector<std::uint32_t> ring;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto polygon = surface.polygons[p];
        const std::size_t n = polygon.size();
        if (n < 3 || std::ranges::none_of(polygon, [&](std::uint32_t corner) { return wanted[number[corner]] != 0; })) continue;
        ring.clear();
        for (const std::uint32_t corner : polygon) ring.push_back(number[corner]);
        if (std::set(ring.begin(), ring.end()).size() != n) continue;
        for (std::size_t i = 0; i < n; ++i) {
            if (wanted[ring[i]] != 0) corners.push_back({parts[p], {ring[i], ring[(i + n - 1) % n], ring[(i + 1) % n], p}});
        }
    }
    std::ranges::sort(corners, [](const auto& a, const auto& b) {
        return std::tie(a.first, a.second.point, a.second.polygon) < std::tie(b.first, b.second.point, b.second.polygon);
    });
    return corners;
}

/// Per vertex whether it is on a line, or in several surfaces: elsewhere the surfaces by themselves are known to be in order.
std::vector<std::uint8_t> vertices_between(const BrepData& brep) {
    std::vector<std::uint8_t> between(brep.vertices.size(), 0);
    for (const auto& line : brep.lines) {
        for (const VertexId v : line.vertices) between[v.value] = 1;
    }
    std::vector<std::uint32_t> owner(brep.vertices.size(), no_index);
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const VertexId v : brep.surfaces[s].nodes) {
            if (owner[v.value] != no_index && owner[v.value] != s) between[v.value] = 1;
            owner[v.value] = s;
        }
    }
    return between;
}

/// Per vertex whether surfaces of several parts have it: there they meet, and lines divide them.
std::vector<std::uint8_t> vertices_of_several_parts(const BrepData& brep) {
    std::vector<std::uint8_t> several(brep.vertices.size(), 0);
    std::vector<std::uint32_t> owner(brep.vertices.size(), no_index);
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const VertexId v : brep.surfaces[s].nodes) {
            std::uint32_t& first = owner[v.value];
            if (first != no_index && part_of(brep.surfaces[first]) != part_of(brep.surfaces[s])) several[v.value] = 1;
            first = s;
        }
    }
    return several;
}

/// Per surface a number that those of one part have in common which hang together along edges.
std::vector<std::uint32_t> connected_surfaces(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    DisjointSets sets(brep.surfaces.size());
    for (const auto& edge : scope.model().graph.edges) {
        const auto uses = scope.model().graph.edge_uses(edge);
        for (std::size_t i = 0; i < uses.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (uses[i].surface == no_index || uses[j].surface == no_index) continue;
                if (part_of(brep.surfaces[uses[i].surface]) == part_of(brep.surfaces[uses[j].surface]))
                    sets.join(uses[i].surface, uses[j].surface);
            }
        }
    }
    return std::move(sets).roots();
}

/// What is asked again and again of a model.
struct Connections {
    std::vector<std::uint8_t> between;     ///< per vertex, as vertices_between()
    std::vector<std::uint8_t> contacts;    ///< per vertex, as vertices_of_several_parts()
    std::vector<std::uint32_t> connected;  ///< per surface, as connected_surfaces()
};

/// The vertex of a polygon that is nearest to a point.
std::uint32_t vertex_near(const BrepData& brep, const std::pair<std::uint32_t, std::uint32_t>& polygon, const Vec3& point) {
    const auto& surface = brep.surfaces[polygon.first];
    std::uint32_t nearest = no_index;
    double least = HUGE_VAL;
    for (const std::uint32_t node : surface.polygons[polygon.second]) {
        const Vec3 d = minus(brep.vertices[surface.nodes[node].value], point);
        if (dot(d, d) >= least) continue;
        least = dot(d, d);
        nearest = surface.nodes[node].value;
    }
    return nearest;
}

/// The points, by their numbers, of all polygons of an object with such a vertex.
std::vector<std::uint8_t> points_of_polygons_at(const ModelScope& scope, const std::vector<std::uint8_t>& between, const Surface& source,
                                                std::span<const std::uint32_t> surfaces, const std::vector<std::uint32_t>& number) {
    std::vector<std::uint8_t> wanted(source.points.size(), 0);
    for (const std::uint32_t s : surfaces) {
        const auto& surface = scope.brep().surfaces[s];
        for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            if (std::ranges::none_of(polygon, [&](std::uint32_t node) { return between[surface.nodes[node].value] != 0; })) continue;
            const auto of_file = static_cast<std::size_t>(scope.file_number(s, p) - 1);
            if (of_file >= source.polygons.size()) continue;
            for (const std::uint32_t corner : source.polygons[of_file]) wanted[number[corner]] = 1;
        }
    }
    return wanted;
}

/// Per polygon of an object the surface of the model that it belongs to, and its number there.
using Belongs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Belongs surfaces_of_polygons(const ModelScope& scope, std::span<const std::uint32_t> surfaces, std::size_t polygons) {
    Belongs belongs(polygons, {no_index, 0});
    for (const std::uint32_t s : surfaces) {
        for (std::uint32_t p = 0; p < scope.brep().surfaces[s].polygons.size(); ++p) {
            const auto number = static_cast<std::size_t>(scope.file_number(s, p) - 1);
            if (number < polygons) belongs[number] = {s, p};
        }
    }
    return belongs;
}

/// The cells of a mesh as the polygons of a surface, so that their numbers are the same.
Surface cells_as_polygons(const CellMesh& mesh) {
    Surface faces;
    faces.points = mesh.points;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) faces.polygons.push_back(topology::corner_nodes(mesh, c));
    return faces;
}

/// Points where a part only touches itself. Where others meet it lines divide it, as in a model that is stated: there it is enough that
/// what touches hangs together elsewhere.
void find_points(const ModelScope& scope, const Connections& known, std::uint32_t object, std::span<const std::uint32_t> surfaces,
                 std::map<Part, Wrong>& wrong) {
    if (object >= scope.dataset().objects.size()) return;
    std::optional<Surface> faces;
    if (const auto* mesh = std::get_if<CellMesh>(&scope.dataset().objects[object])) faces = cells_as_polygons(*mesh);
    const auto* source = faces ? &*faces : std::get_if<Surface>(&scope.dataset().objects[object]);
    if (source == nullptr) return;
    const Belongs belongs = surfaces_of_polygons(scope, surfaces, source->polygons.size());
    std::vector<std::uint32_t> parts;
    for (const auto& [s, p] : belongs) parts.push_back(s == no_index ? no_index : scope.brep().surfaces[s].source_part);
    const auto number = numbers_of(*source);
    const auto corners = corners_at(*source, number, points_of_polygons_at(scope, known.between, *source, surfaces, number), parts);
    std::vector<CornerNeighbours> around;
    for (std::size_t i = 0; i < corners.size();) {
        around.clear();
        std::size_t j = i;
        for (; j < corners.size() && corners[j].first == corners[i].first && corners[j].second.point == corners[i].second.point; ++j)
            around.push_back(corners[j].second);
        const std::uint32_t part = corners[i].first;
        i = j;
        if (is_one_ring(around, [](const auto&, const auto&) { return false; })) continue;
        const auto is_sound = [&](const CornerNeighbours& a) {
            return belongs[a.polygon].first != no_index && parts_regions(scope, belongs[a.polygon].first);
        };
        if (std::ranges::all_of(around, is_sound)) continue;
        const auto& first = belongs[around[0].polygon];
        const std::uint32_t vertex = first.first == no_index ? no_index : vertex_near(scope.brep(), first, source->points[around[0].point]);
        const auto elsewhere = [&](const CornerNeighbours& a, const CornerNeighbours& b) {
            const std::uint32_t s = belongs[a.polygon].first, t = belongs[b.polygon].first;
            return s != no_index && t != no_index && known.connected[s] == known.connected[t];
        };
        if (vertex != no_index && known.contacts[vertex] != 0 && is_one_ring(around, elsewhere)) continue;
        Wrong& here = wrong[{object, part}];
        here.points.insert(source->points[around[0].point]);
        for (const CornerNeighbours& a : around) {
            if (belongs[a.polygon].first == no_index) continue;
            here.surfaces.insert(belongs[a.polygon].first);
            here.polygons.insert(belongs[a.polygon]);
        }
    }
}

/// Whether nothing says which surfaces the polygons of an object belong to: an array or an entity would, even of one surface, or a second
/// object, or a file of a geological program, in which each surface is an object of its own.
bool is_all_there_is(const ModelScope& scope, const Part& part) {
    const auto& [object, number] = part;
    if (number == no_index) return true;
    const std::string& format = scope.dataset().format;
    const auto* source = std::get_if<Surface>(&scope.dataset().objects[object]);
    if (source == nullptr || topology::has_surface_array(*source) || (format != "surface" && format != "vtk")) return false;
    const auto& surfaces = scope.brep().surfaces;
    const ObjectInfo& info = info_of(scope.dataset().objects[object]);
    return info.role == FeatureRole::unknown && info.role_text.empty() && info.feature.empty() &&
           std::ranges::all_of(surfaces, [&](const auto& s) { return part_of(s) == part && s.role == FeatureRole::unknown; });
}

Finding finding_of_part(const ModelScope& scope, const Wrong& wrong, const Part& part) {
    const auto& [object, number] = part;
    std::string what;
    if (!wrong.edges.empty()) what = counted(wrong.edges.size(), "edge is", "edges are") + " shared by more than two of its triangles";
    if (!wrong.points.empty())
        what += (what.empty() ? "" : ", and ") + counted(wrong.points.size(), "point is", "points are") + " where it only touches itself";
    const std::string& name = info_of(scope.dataset().objects[object]).name;
    Finding finding = finding_of("B03", quoted(name) + " is not manifold: " + what);
    for (const std::uint32_t s : wrong.surfaces) {
        if (finding.entities.size() < listed_elements) finding.entities.push_back(surface_ref(scope, s));
    }
    if (is_all_there_is(scope, part)) use_other_severity(finding);
    finding.element_kind = "triangle";
    for (const auto& [s, p] : wrong.polygons) {
        if (finding.elements.size() >= listed_elements) break;
        finding.elements.push_back(scope.file_number(s, p));
        finding.index.push_back(p);
    }
    finding.count = std::max<std::uint64_t>(1, wrong.polygons.size());
    for (const auto& edge : wrong.edges) {
        if (finding.polylines.size() < listed_elements) finding.polylines.push_back({edge[0], edge[1]});
    }
    for (const Vec3& p : wrong.points) {
        if (finding.points.size() < listed_elements) finding.points.push_back(p);
    }
    finding.measures = {{"edges_shared_by_more_than_two", static_cast<double>(wrong.edges.size())},
                        {"pinched_points", static_cast<double>(wrong.points.size())}};
    return finding;
}

}  // namespace

void report_loose_manifold(const ModelScope& scope, const std::vector<std::vector<std::uint32_t>>& pinched,
                           std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    std::map<Part, Wrong> wrong;
    find_edges(scope, wrong);
    std::map<std::uint32_t, std::vector<std::uint32_t>> surfaces_of;  // per object
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        surfaces_of[brep.surfaces[s].source_object].push_back(s);
        for (const std::uint32_t v : pinched[s]) {
            wrong[part_of(brep.surfaces[s])].points.insert(brep.vertices[v]);
            wrong[part_of(brep.surfaces[s])].surfaces.insert(s);
        }
    }
    const Connections known{vertices_between(brep), vertices_of_several_parts(brep), connected_surfaces(scope)};
    for (const auto& [object, surfaces] : surfaces_of) find_points(scope, known, object, surfaces, wrong);
    for (const auto& [part, what] : wrong) findings.push_back(finding_of_part(scope, what, part));
}

}  // namespace geomend::validators
