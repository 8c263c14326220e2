// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/intersections.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>

#include "geometry/cell_volume.h"
#include "validators/found_cells.h"
#include "validators/model_checks.h"
#include "validators/polyline_join.h"
#include "validators/triangle_overlap.h"

namespace geomend::validators {

namespace {

/// Edges of triangles that lie on lines of the model.
class LineEdges {
public:
    explicit LineEdges(const ModelScope& scope) {
        const auto& graph = scope.model().graph;
        edges_.reserve(graph.edges.size());
        for (const auto& edge : graph.edges) edges_.insert(key(graph.uses[edge.first_use].low, graph.uses[edge.first_use].high));
    }
    bool contains(std::uint32_t a, std::uint32_t b) const { return edges_.contains(key(a, b)); }

private:
    static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b); }
    std::unordered_set<std::uint64_t> edges_;
};

/// What two surfaces, or one with itself, have in common beside what they share.
struct Common {
    std::uint64_t crossing = 0, overlap = 0, border = 0, inside = 0, point = 0;
    std::vector<std::array<Vec3, 2>> segments;
    std::vector<Vec3> points;
    std::vector<std::uint32_t> polygons;  // of the first surface

    std::uint64_t all() const { return crossing + overlap + border + inside + point; }
};

bool lies_on(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = minus(b, a), ap = minus(p, a);
    const Vec3 n = cross(ab, ap);
    constexpr double rounding = 1e-9;
    return dot(n, n) <= rounding * rounding * dot(ab, ab) * std::max(dot(ab, ab), dot(ap, ap));
}

/// Whether the segment along which two triangles touch lies on an edge of the first that is on a line of the model.
bool on_line_edge(const ModelScope& scope, const LineEdges& lines, const std::array<std::uint32_t, 3>& t,
                  const std::array<Vec3, 2>& segment) {
    const auto& v = scope.brep().vertices;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = t[i], b = t[(i + 1) % 3];
        if (lines.contains(a, b) && lies_on(segment[0], v[a], v[b]) && lies_on(segment[1], v[a], v[b])) return true;
    }
    return false;
}

/// How far a triangle reaches through the plane of another one, on the side where it reaches less.
double depth(const std::array<Vec3, 3>& t, const std::array<Vec3, 3>& plane) {
    const Vec3 n = cross(minus(plane[1], plane[0]), minus(plane[2], plane[0]));
    const double length = std::sqrt(dot(n, n));
    double above = 0, below = 0;
    for (const Vec3& corner : t) {
        const double distance = dot(minus(corner, plane[0]), n) / length;
        above = std::max(above, distance);
        below = std::max(below, -distance);
    }
    return std::min(above, below);
}

std::array<Vec3, 3> corners_of(const ModelScope& scope, std::uint32_t triangle) {
    const auto& t = scope.triangles()[triangle];
    const auto& v = scope.brep().vertices;
    return {v[t[0]], v[t[1]], v[t[2]]};
}

/// What two triangles have in common once the tolerance is granted, so that rounding (or a rotation) does not change the kind: a
/// border that reaches through by no more only touches, and a segment as short as that is a point.
Meeting judged_kind(const ModelScope& scope, const TriangleMeetingPair& pair) {
    if (pair.how.kind == Meeting::none || pair.how.kind == Meeting::overlap) return pair.how.kind;
    const auto a = corners_of(scope, pair.a), b = corners_of(scope, pair.b);
    const double tolerance = scope.lengths().tolerance;
    if (lie_on_each_other(a, b, tolerance)) return Meeting::overlap;
    if (pair.how.kind == Meeting::crossing && std::min(depth(a, b), depth(b, a)) > tolerance) return Meeting::crossing;
    const Vec3 way = minus(pair.how.segment[1], pair.how.segment[0]);  // none for a point
    return dot(way, way) <= tolerance * tolerance ? Meeting::point : Meeting::touch;
}

/// Where exact predicates see a point, rounding may have taken the rest of an edge off a triangle that it lies on.
enum class Edge { none, inside, border };
Edge edge_on_it(const ModelScope& scope, const LineEdges& lines, std::uint32_t a, std::uint32_t b) {
    const double tolerance = scope.lengths().tolerance;
    constexpr double clearly = 100;  // tolerances: else it only leans
    const auto& t = scope.triangles()[a];
    const auto& other = scope.triangles()[b];
    const auto corners = corners_of(scope, a), base = corners_of(scope, b);
    Edge found = Edge::none;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const auto shared = [&](std::uint32_t v) { return std::ranges::find(other, v) != other.end(); };
        if (shared(t[i]) && shared(t[j])) continue;
        if (length_on({corners[i], corners[j]}, base, tolerance) <= clearly * tolerance) continue;
        if (lines.contains(t[i], t[j])) return Edge::border;
        found = Edge::inside;
    }
    return found;
}

using SurfacePair = std::pair<std::uint32_t, std::uint32_t>;

std::map<SurfacePair, Common> gather(const ModelScope& scope) {
    std::map<SurfacePair, Common> all;
    const auto pairs = intersections(scope.tree(), scope.monitor());
    if (pairs.empty()) return all;
    const LineEdges lines(scope);
    constexpr std::size_t most_segments = 100000;
    for (const TriangleMeetingPair& pair : pairs) {
        const std::uint32_t sa = scope.surface_of(pair.a), sb = scope.surface_of(pair.b);
        Common& common = all[{sa, sb}];
        const std::uint32_t polygon = scope.polygon_of(pair.a);
        if (sa == sb && scope.polygon_of(pair.b) == polygon) continue;  // a polygon that is not plane
        common.polygons.push_back(polygon);
        if (sa == sb) common.polygons.push_back(scope.polygon_of(pair.b));
        const Meeting kind = judged_kind(scope, pair);
        if (kind == Meeting::point) {
            const Edge edge = std::max(edge_on_it(scope, lines, pair.a, pair.b), edge_on_it(scope, lines, pair.b, pair.a));
            if (edge != Edge::none) {
                ++(edge == Edge::border ? common.border : common.inside);
                continue;
            }
        }
        switch (kind) {
            case Meeting::none:
                break;
            case Meeting::point:
                ++common.point;
                break;
            case Meeting::touch:
                if (pair.how.kind == Meeting::crossing || on_line_edge(scope, lines, scope.triangles()[pair.a], pair.how.segment) ||
                    on_line_edge(scope, lines, scope.triangles()[pair.b], pair.how.segment))
                    ++common.border;
                else ++common.inside;
                break;
            case Meeting::crossing:
                ++common.crossing;
                break;
            case Meeting::overlap:
                ++common.overlap;
                break;
        }
        if (kind == Meeting::point && common.points.size() < listed_elements) common.points.push_back(pair.how.segment[0]);
        if (kind != Meeting::point && common.segments.size() < most_segments) common.segments.push_back(pair.how.segment);
    }
    return all;
}

void add_kind(std::string& text, std::uint64_t count, std::string_view what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(what);
}

Finding common_finding(const ModelScope& scope, std::string_view code, const SurfacePair& pair, Common& common, std::string message) {
    std::ranges::sort(common.polygons);
    common.polygons.erase(std::unique(common.polygons.begin(), common.polygons.end()), common.polygons.end());
    std::string kinds;
    add_kind(kinds, common.crossing, "crossing");
    add_kind(kinds, common.overlap, "overlapping in a plane");
    add_kind(kinds, common.border, "touching along a border");
    add_kind(kinds, common.inside, "touching along an inner edge");
    add_kind(kinds, common.point, "touching in a point");
    Finding finding = polygons_finding(scope, code, pair.first, std::move(message) + ": pairs of triangles " + kinds, common.polygons);
    if (pair.second != pair.first) finding.entities.push_back(surface_ref(scope, pair.second));
    finding.count = common.all();
    finding.points = std::move(common.points);
    finding.polylines = join_segments(common.segments);
    double length = 0;
    for (const auto& line : finding.polylines) {
        for (std::size_t i = 1; i < line.size(); ++i) {
            const Vec3 d = minus(line[i], line[i - 1]);
            length += std::sqrt(dot(d, d));
        }
    }
    finding.measures = {{"crossing", static_cast<double>(common.crossing)},
                        {"overlap", static_cast<double>(common.overlap)},
                        {"touch", static_cast<double>(common.border + common.inside)},
                        {"point", static_cast<double>(common.point)},
                        {"length", length}};
    if (finding.polylines.size() > listed_elements) finding.polylines.resize(listed_elements);
    return finding;
}

/// What a surface has in common with itself, by the worst of it: the code, and what goes on after its name.
std::pair<std::string_view, const char*> meeting_with_itself(const Common& common) {
    if (common.overlap > 0 && common.overlap >= common.crossing) return {"B26", " lies on itself"};
    if (common.crossing + common.inside + common.overlap > 0) return {"B02", " crosses itself where its triangles are no neighbours"};
    if (common.border > 0) return {"B27", " ends on itself without sharing vertices"};
    return {"B28", " touches itself in points that its triangles do not share"};
}

}  // namespace

void check_intersections(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    for (auto& [pair, common] : gather(scope)) {
        if (common.all() == 0) continue;
        const auto& a = brep.surfaces[pair.first];
        const auto& b = brep.surfaces[pair.second];
        const std::string both = quoted(a.name) + " and " + quoted(b.name);
        if (pair.first == pair.second) {
            const auto [code, what] = meeting_with_itself(common);
            findings.push_back(common_finding(scope, code, pair, common, quoted(a.name) + what));
        } else if (common.overlap > 0 && common.overlap >= common.crossing) {
            findings.push_back(common_finding(scope, "B20", pair, common, both + " lie on each other"));
        } else if (common.crossing + common.inside + common.overlap > 0) {
            const bool stratigraphic = is_stratigraphic(a.role) && is_stratigraphic(b.role) && a.interface_id != b.interface_id;
            findings.push_back(
                common_finding(scope, stratigraphic ? "B10" : "B08", pair, common,
                               stratigraphic ? "stratigraphic surfaces " + both + " cross" : both + " cross without a line between them"));
        } else if (common.border > 0) {
            findings.push_back(common_finding(scope, "B11", pair, common, both + " meet at a border without sharing vertices"));
        } else {
            findings.push_back(common_finding(scope, "B22", pair, common, both + " touch in points that they do not share"));
        }
    }
}

}  // namespace geomend::validators
