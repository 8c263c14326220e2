// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/intersections.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <unordered_set>

#include "base/length.h"
#include "geometry/cell_volume.h"
#include "validators/cell_findings.h"
#include "validators/model_checks.h"
#include "validators/polyline_join.h"
#include "validators/single_valued_surfaces.h"
#include "validators/triangle_overlap.h"

namespace geomend::validators {

namespace {

/// Edges of triangles, and vertices, that lie on lines of the model.
class LineEdges {
public:
    explicit LineEdges(const ModelScope& scope) {
        const auto& graph = scope.model().graph;
        edges_.reserve(graph.edges.size());
        for (const auto& edge : graph.edges) {
            const auto& use = graph.uses[edge.first_use];
            edges_.insert(key(use.low, use.high));
            vertices_.insert({use.low, use.high});
        }
    }
    bool contains(std::uint32_t vertex) const { return vertices_.contains(vertex); }
    bool contains(std::uint32_t a, std::uint32_t b) const { return edges_.contains(key(a, b)); }

private:
    static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b); }
    std::unordered_set<std::uint64_t> edges_;
    std::unordered_set<std::uint32_t> vertices_;
};

/// What two surfaces, or one with itself, have in common beside what they share.
struct Common {
    std::uint64_t crossing = 0, overlap = 0, border = 0, inside = 0, point = 0;
    std::uint64_t shallow = 0;  // of `border`: crossings by no more than the tolerance
    std::vector<std::array<Vec3, 2>> segments;
    std::vector<Vec3> points;
    std::vector<std::uint32_t> polygons;  // of the first surface
    bool is_crowded = false;              // so many pairs that only triangles that were in none yet are looked at
    bool has_more = false;                // pairs were passed over

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

/// The least height of a triangle.
double least_height(const std::array<Vec3, 3>& t) {
    const Vec3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, length(minus(t[(i + 1) % 3], t[i])));
    return longest > 0 ? length(n) / longest : 0;
}

/// Whether two triangles share an edge, and one of them is flat: what they have in common beside it is for rounding to say, and that the
/// triangle is flat is told by itself.
bool is_flat_neighbour(const ModelScope& scope, const TriangleMeetingPair& pair, double tolerance) {
    const auto &a = scope.triangles()[pair.a], &b = scope.triangles()[pair.b];
    const auto shared = std::ranges::count_if(a, [&](std::uint32_t v) { return std::ranges::find(b, v) != b.end(); });
    return shared == 2 && (least_height(corners_of(scope, pair.a)) <= tolerance || least_height(corners_of(scope, pair.b)) <= tolerance);
}

/// What two triangles have in common once the tolerance is granted, so that rounding (or a rotation) does not change the kind: a
/// border that reaches through by no more only touches, and a segment as short as that is a point.
Meeting judged_kind(const ModelScope& scope, const TriangleMeetingPair& pair) {
    if (pair.how.kind == Meeting::none) return Meeting::none;
    const double tolerance = scope.tolerance(scope.surface_of(pair.a), scope.surface_of(pair.b));
    if (pair.how.kind == Meeting::overlap) return is_flat_neighbour(scope, pair, tolerance) ? Meeting::none : Meeting::overlap;
    const auto a = corners_of(scope, pair.a), b = corners_of(scope, pair.b);
    if (lie_on_each_other(a, b, tolerance)) return Meeting::overlap;
    const Vec3 way = minus(pair.how.segment[1], pair.how.segment[0]);  // none for a point
    if (dot(way, way) <= tolerance * tolerance) return Meeting::point;
    return pair.how.kind == Meeting::crossing && std::min(depth(a, b), depth(b, a)) > tolerance ? Meeting::crossing : Meeting::touch;
}

double distance_to_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = minus(b, a), ap = minus(p, a);
    const double square = dot(ab, ab);
    const Vec3 off = minus(ap, times(square > 0 ? std::clamp(dot(ap, ab) / square, 0.0, 1.0) : 0.0, ab));
    return std::sqrt(dot(off, off));
}

/// Whether an edge of one triangle goes through the other one, on both sides by more than the tolerance, and not at a line. Where it goes
/// through an edge or a corner within the tolerance, it goes through both triangles there: exact predicates see a point in one position
/// of the model, and a crossing in another.
bool pierces(const ModelScope& scope, const LineEdges& lines, std::uint32_t one, std::uint32_t other) {
    const double tolerance = scope.tolerance(scope.surface_of(one), scope.surface_of(other));
    const auto& numbers = scope.triangles()[other];
    const auto a = corners_of(scope, one), b = corners_of(scope, other);
    const Vec3 n = cross(minus(b[1], b[0]), minus(b[2], b[0]));
    const double length = std::sqrt(dot(n, n));
    if (!(length > 0)) return false;
    std::array<double, 3> height{};
    for (std::size_t i = 0; i < 3; ++i) height[i] = dot(minus(a[i], b[0]), n) / length;
    for (std::size_t i = 0; i < 3; ++i) {
        const double from = height[i], to = height[(i + 1) % 3];
        if (!(std::min(from, to) < -tolerance && std::max(from, to) > tolerance)) continue;
        const Vec3 at = plus(a[i], times(from / (from - to), minus(a[(i + 1) % 3], a[i])));
        bool is_inside = true, is_near = false, is_at_line = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &start = b[k], &end = b[(k + 1) % 3];
            is_inside = is_inside && dot(cross(n, minus(end, start)), minus(at, start)) >= 0;
            if (distance_to_edge(at, start, end) > tolerance) continue;
            is_near = true;
            is_at_line = is_at_line || lines.contains(numbers[k], numbers[(k + 1) % 3]) ||
                         (lines.contains(numbers[k]) && distance_to_edge(at, start, start) <= tolerance) ||
                         (lines.contains(numbers[(k + 1) % 3]) && distance_to_edge(at, end, end) <= tolerance);
        }
        if ((is_inside || is_near) && !is_at_line) return true;
    }
    return false;
}

/// Where exact predicates see a point, rounding may have taken the rest of an edge off a triangle that it lies on.
enum class Edge { none, inside, border };
Edge edge_on_it(const ModelScope& scope, const LineEdges& lines, std::uint32_t a, std::uint32_t b) {
    const double tolerance = scope.tolerance(scope.surface_of(a), scope.surface_of(b));
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

void sort_and_unite(std::vector<std::uint32_t>& numbers) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Sums up the pairs of triangles for each two surfaces. Very many triangles on each other have more pairs than can be told or
/// kept: where two surfaces have so many in a part of the search, or in all, only triangles that were in no pair yet are looked at.
/// Likewise where very many surfaces meet each other, as the loose triangles of a file do: then only surfaces that met none yet.
class Gathering {
public:
    explicit Gathering(const ModelScope& scope)
        : scope_(scope),
          surfaces_(scope.surfaces_of_triangles()),
          parts_(intersection_parts(scope.tree())),
          meets_others_(scope.brep().surfaces.size()) {}

    /// Whether surfaces that meet were passed over in run().
    bool has_more_pairs() const { return has_more_pairs_; }

    std::map<SurfacePair, Common> run() {
        const std::vector<std::uint32_t> proven = single_valued_surfaces(scope_);
        visit_intersections(
            scope_.tree(), [&](std::size_t part) -> PairTaker& { return taker_of(parts_[part]); },
            [&](std::size_t first, std::size_t last) {
                for (std::size_t part = first; part < last; ++part) {
                    for (auto& [pair, some] : parts_[part].pairs) add(all_[pair], some.common);
                    for (const std::uint32_t s : parts_[part].surfaces) meets_others_[s] = 1;
                    known_.insert(parts_[part].known.begin(), parts_[part].known.end());
                    has_more_pairs_ = has_more_pairs_ || parts_[part].has_more_pairs;
                    parts_[part] = {};
                }
            },
            scope_.monitor(), proven);
        return std::move(all_);
    }

private:
    static constexpr std::size_t most_segments = 100000;
    static constexpr std::uint64_t crowd_in_part = 20000, crowd_in_all = 200000;
    static constexpr std::size_t most_pairs_in_part = 2000, most_pairs = 10000;  // of surfaces

    struct Some {
        Common common;
        std::unordered_set<std::uint32_t> seen;  // triangles
    };
    struct Part {
        PairTaker taker;
        std::map<SurfacePair, Some> pairs;
        SurfacePair last_pair{};
        Some* last = nullptr;
        std::unordered_set<std::uint32_t> surfaces;  // that meet others
        std::unordered_set<std::uint64_t> known;     // pairs of surfaces
        bool has_more_pairs = false;
    };

    const ModelScope& scope_;
    std::span<const std::uint32_t> surfaces_;  // of the triangles
    std::vector<Part> parts_;
    std::map<SurfacePair, Common> all_;
    std::vector<std::uint8_t> meets_others_;  // of the surfaces
    std::unordered_set<std::uint64_t> known_;
    bool has_more_pairs_ = false;
    std::once_flag lines_are_known_;
    std::optional<LineEdges> lines_;

    PairTaker& taker_of(Part& part) {
        part.taker.take = [this, &part](const TriangleMeetingPair& pair) { take(part, pair); };
        part.taker.wants = [this, &part](std::uint32_t a, std::uint32_t b) {
            if (is_passed_over(part, surfaces_[a], surfaces_[b])) return false;
            Some& some = of_surfaces(part, std::min(a, b), std::max(a, b));
            if (!some.common.is_crowded || !some.seen.contains(a) || !some.seen.contains(b)) return true;
            some.common.has_more = true;
            return false;
        };
        part.taker.is_choosy =
            all_.size() >= most_pairs || std::ranges::any_of(all_, [](const auto& pair) { return pair.second.is_crowded; });
        return part.taker;
    }

    /// Two surfaces of which nothing is known yet, although each is known to meet others, when there are very many such.
    bool is_passed_over(Part& part, std::uint32_t a, std::uint32_t b) const {
        if (part.pairs.size() < most_pairs_in_part && all_.size() < most_pairs) return false;
        const auto meets_others = [&](std::uint32_t s) { return meets_others_[s] != 0 || part.surfaces.contains(s); };
        if (!meets_others(a) || !meets_others(b)) return false;
        const std::uint64_t key = key_of(std::minmax(a, b));
        if (part.known.contains(key) || known_.contains(key)) return false;
        part.has_more_pairs = true;
        return true;
    }

    Some& of_surfaces(Part& part, std::uint32_t a, std::uint32_t b) const {
        const SurfacePair pair{surfaces_[a], surfaces_[b]};
        if (part.last != nullptr && part.last_pair == pair) return *part.last;
        const auto [at, added] = part.pairs.try_emplace(pair);
        if (added) {
            part.known.insert(key_of(pair));
            const auto known = all_.find(pair);
            at->second.common.is_crowded = known != all_.end() && known->second.is_crowded;
        }
        part.last_pair = pair;
        part.last = &at->second;
        return at->second;
    }

    static std::uint64_t key_of(const SurfacePair& pair) { return std::uint64_t{pair.first} << 32 | pair.second; }

    const LineEdges& lines() {
        std::call_once(lines_are_known_, [&] { lines_.emplace(scope_); });
        return *lines_;
    }

    void take(Part& part, const TriangleMeetingPair& pair) {
        const bool one_surface = surfaces_[pair.a] == surfaces_[pair.b];
        if (one_surface && scope_.polygon_of(pair.a) == scope_.polygon_of(pair.b)) return;  // a polygon that is not plane
        if (one_surface && are_repeats(pair)) return;                                       // M04
        Meeting kind = judged_kind(scope_, pair);
        if (kind == Meeting::none) return;
        Some& some = of_surfaces(part, pair.a, pair.b);
        Common& common = some.common;
        if (some.seen.insert(pair.a).second) common.polygons.push_back(scope_.polygon_of(pair.a));
        if (some.seen.insert(pair.b).second && one_surface) common.polygons.push_back(scope_.polygon_of(pair.b));
        if ((kind == Meeting::point || kind == Meeting::touch) &&
            (pierces(scope_, lines(), pair.a, pair.b) || pierces(scope_, lines(), pair.b, pair.a)))
            kind = Meeting::crossing;
        if (kind == Meeting::point) count_point(common, pair);
        else count(common, kind, pair);
        part.surfaces.insert({surfaces_[pair.a], surfaces_[pair.b]});
        if (part.pairs.size() >= most_pairs_in_part) part.taker.is_choosy = true;
        if (common.all() == crowd_in_part) common.is_crowded = part.taker.is_choosy = true;
    }

    void count_point(Common& common, const TriangleMeetingPair& pair) {
        const Edge edge = std::max(edge_on_it(scope_, lines(), pair.a, pair.b), edge_on_it(scope_, lines(), pair.b, pair.a));
        if (edge == Edge::border) ++common.border;
        else if (edge == Edge::inside) ++common.inside;
        else {
            ++common.point;
            if (common.points.size() < listed_elements) common.points.push_back(pair.how.segment[0]);
        }
    }

    bool are_repeats(const TriangleMeetingPair& pair) const {
        const auto &a = scope_.triangles()[pair.a], &b = scope_.triangles()[pair.b];
        return std::is_permutation(a.begin(), a.end(), b.begin());
    }

    void count(Common& common, Meeting kind, const TriangleMeetingPair& pair) {
        if (pair.how.segment[0] == pair.how.segment[1]) {
            if (common.points.size() < listed_elements) common.points.push_back(pair.how.segment[0]);
        } else if (common.segments.size() < most_segments) {
            common.segments.push_back(pair.how.segment);
        }
        switch (kind) {
            case Meeting::none:
            case Meeting::point:
                break;
            case Meeting::touch:
                if (pair.how.kind == Meeting::crossing || on_line_edge(scope_, lines(), scope_.triangles()[pair.a], pair.how.segment) ||
                    on_line_edge(scope_, lines(), scope_.triangles()[pair.b], pair.how.segment))
                    ++common.border;
                else ++common.inside;
                if (pair.how.kind == Meeting::crossing && !touches_line(pair)) ++common.shallow;
                break;
            case Meeting::crossing:
                ++common.crossing;
                break;
            case Meeting::overlap:
                ++common.overlap;
                break;
        }
    }

    bool touches_line(const TriangleMeetingPair& pair) {
        return on_line_edge(scope_, lines(), scope_.triangles()[pair.a], pair.how.segment) ||
               on_line_edge(scope_, lines(), scope_.triangles()[pair.b], pair.how.segment) ||
               edge_on_it(scope_, lines(), pair.a, pair.b) == Edge::border || edge_on_it(scope_, lines(), pair.b, pair.a) == Edge::border;
    }

    static void add(Common& all, Common& part) {
        all.shallow += part.shallow;
        all.crossing += part.crossing;
        all.overlap += part.overlap;
        all.border += part.border;
        all.inside += part.inside;
        all.point += part.point;
        all.is_crowded = all.is_crowded || all.all() >= crowd_in_all;
        all.has_more = all.has_more || part.has_more;
        const auto append = [](auto& to, const auto& from, std::size_t most) {
            const std::size_t room = std::min(from.size(), most - std::min(most, to.size()));
            to.insert(to.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(room));
        };
        append(all.segments, part.segments, most_segments);
        append(all.points, part.points, listed_elements);
        const bool is_long = all.polygons.size() + part.polygons.size() > std::max<std::size_t>(100000, all.polygons.capacity());
        append(all.polygons, part.polygons, SIZE_MAX);
        if (is_long) sort_and_unite(all.polygons);
    }
};

void add_kind(std::string& text, std::uint64_t count, std::string_view what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(what);
}

Finding common_finding(const ModelScope& scope, std::string_view code, const SurfacePair& pair, Common& common, std::string message) {
    sort_and_unite(common.polygons);
    std::string kinds;
    add_kind(kinds, common.crossing, "crossing");
    add_kind(kinds, common.overlap, "overlapping in a plane");
    add_kind(kinds, common.border, "touching along a border");
    add_kind(kinds, common.inside, "touching along an inner edge");
    add_kind(kinds, common.point, "touching at a point");
    if (common.has_more) kinds += ", and more that were not counted";
    Finding finding = polygons_finding(scope, code, pair.first, std::move(message) + ": pairs of triangles: " + kinds, common.polygons);
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
    if (common.overlap > 0 && common.overlap >= common.crossing) return {"B26", " overlaps itself"};
    if (common.crossing + common.inside + common.overlap > 0) return {"B02", " crosses itself where its triangles are no neighbours"};
    if (common.border > 0) return {"B27", " ends on itself without sharing vertices"};
    return {"B28", " touches itself at points that its triangles do not share"};
}

}  // namespace

void check_intersections(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    Gathering gathering(scope);
    for (auto& [pair, common] : gathering.run()) {
        if (common.all() == 0) continue;
        const auto& a = brep.surfaces[pair.first];
        const auto& b = brep.surfaces[pair.second];
        const std::string both = quoted(a.name) + " and " + quoted(b.name);
        if (pair.first == pair.second) {
            const auto [code, what] = meeting_with_itself(common);
            findings.push_back(common_finding(scope, code, pair, common, quoted(a.name) + what));
        } else if (common.overlap > 0 && common.overlap >= common.crossing) {
            findings.push_back(common_finding(scope, "B20", pair, common, both + " overlap"));
        } else if (common.crossing + common.inside + common.overlap > 0) {
            const bool stratigraphic = is_stratigraphic(a.role) && is_stratigraphic(b.role) && a.interface_id != b.interface_id;
            findings.push_back(
                common_finding(scope, stratigraphic ? "B10" : "B08", pair, common,
                               stratigraphic ? "stratigraphic surfaces " + both + " cross" : both + " cross without a line between them"));
        } else if (common.border > 0) {
            // Where no border takes part they pass through each other, but by so little that it is a matter of the tolerance.
            const bool shallow = common.shallow == common.border;
            const char* what = shallow ? " barely cross, by about the tolerance" : " meet at a border without sharing vertices";
            findings.push_back(common_finding(scope, "B11", pair, common, both + what));
            if (shallow) findings.back().measures.emplace_back("shallow_crossings", static_cast<double>(common.shallow));
        } else {
            findings.push_back(common_finding(scope, "B22", pair, common, both + " touch at points that they do not share"));
        }
    }
    if (gathering.has_more_pairs()) {
        findings.push_back(finding_of("B08",
                                      "very many surfaces cross or touch others: further pairs of those reported here were not examined"
                                      ", nor were near misses"));
    }
}

}  // namespace geomend::validators
