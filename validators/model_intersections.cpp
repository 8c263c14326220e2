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

/// How a triangle lies to the plane of another one.
struct Lie {
    double depth;     ///< how far it reaches through, on the side where it reaches less
    double farthest;  ///< the distance of its farthest corner
};

Lie lie_of(const ModelScope& scope, const std::array<std::uint32_t, 3>& t, const std::array<std::uint32_t, 3>& plane) {
    const auto& v = scope.brep().vertices;
    const Vec3 n = cross(minus(v[plane[1]], v[plane[0]]), minus(v[plane[2]], v[plane[0]]));
    const double length = std::sqrt(dot(n, n));
    double above = 0, below = 0;
    for (const std::uint32_t corner : t) {
        const double distance = dot(minus(v[corner], v[plane[0]]), n) / length;
        above = std::max(above, distance);
        below = std::max(below, -distance);
    }
    return {std::min(above, below), std::max(above, below)};
}

/// What a crossing is once the tolerance is granted: a border that reaches through by no more only touches.
Meeting judged_kind(const ModelScope& scope, const TriangleMeetingPair& pair) {
    if (pair.how.kind != Meeting::crossing) return pair.how.kind;
    const auto& a = scope.triangles()[pair.a];
    const auto& b = scope.triangles()[pair.b];
    const Lie ab = lie_of(scope, a, b), ba = lie_of(scope, b, a);
    const double tolerance = scope.lengths().tolerance;
    if (std::min(ab.farthest, ba.farthest) <= tolerance) return Meeting::overlap;
    return std::min(ab.depth, ba.depth) <= tolerance ? Meeting::touch : Meeting::crossing;
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
