// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/disjoint_sets.h"
#include "geometry/segment_tree.h"
#include "geometry/vectors.h"
#include "topology/weld.h"
#include "validators/cell_findings.h"
#include "validators/object_checks.h"

namespace geomend::validators {

namespace {

/// Polylines with what their checks share.
struct Lines {
    const PolylineSet& set;
    std::vector<std::uint32_t> vertex_of;  ///< per point; points at one position have the same
    std::vector<std::uint32_t> line_of;    ///< per edge: its part, or where there are none what hangs together
    std::vector<double> length;            ///< per edge

    explicit Lines(const PolylineSet& polylines) : set(polylines) {
        topology::Welder welder(set.points.size());
        for (const Vec3& p : set.points) vertex_of.push_back(welder.add(p));
        for (const auto& edge : set.edges) {
            const Vec3 d = minus(set.points[edge[1]], set.points[edge[0]]);
            length.push_back(std::sqrt(dot(d, d)));
        }
        if (set.parts.empty()) lines_by_points();
        else lines_by_parts();
    }
    bool share_vertex(std::uint32_t e, std::uint32_t f) const {
        for (const std::uint32_t p : set.edges[e]) {
            for (const std::uint32_t q : set.edges[f]) {
                if (vertex_of[p] == vertex_of[q]) return true;
            }
        }
        return false;
    }
    std::pair<std::uint32_t, std::uint32_t> ends(std::uint32_t e) const {
        return std::minmax(vertex_of[set.edges[e][0]], vertex_of[set.edges[e][1]]);
    }

private:
    void lines_by_points() {
        DisjointSets joined(set.points.size());
        for (const auto& edge : set.edges) joined.join(edge[0], edge[1]);
        for (const auto& edge : set.edges) line_of.push_back(joined.root(edge[0]));
    }
    void lines_by_parts() {
        std::uint32_t part = 0;
        for (std::uint64_t e = 0; e < set.edges.size(); ++e) {
            while (part + 1 < set.parts.size() && set.parts[part + 1].first_edge <= e) ++part;
            line_of.push_back(part);
        }
    }
};

void list_edges(const PolylineSet& set, std::span<const std::uint32_t> edges, Finding& finding) {
    finding.element_kind = "edge";
    finding.count = edges.size();
    for (const std::uint32_t e : edges.first(std::min(edges.size(), listed_elements))) {
        finding.elements.push_back(static_cast<std::int64_t>(e) + 1);
        finding.index.push_back(e);
        finding.polylines.push_back({set.points[set.edges[e][0]], set.points[set.edges[e][1]]});
    }
}

/// How two edges meet away from what they share.
enum class EdgesMeet : std::uint8_t { no, crossing, touching, overlapping };

/// What the edges of one line, or of different ones, have in common beside their points.
struct Meetings {
    std::uint64_t crossing = 0, touching = 0, overlapping = 0;
    std::vector<std::uint32_t> edges;
    std::vector<Vec3> points;
    std::vector<Segment> overlaps;

    std::uint64_t all() const { return crossing + touching + overlapping; }
};

/// Finds the pairs of edges that meet within the tolerance.
class MeetingSearch {
public:
    MeetingSearch(const ObjectScope& scope, const PolylineSet& set) : scope_(scope), lines_(set) {
        for (std::uint32_t e = 0; e < set.edges.size(); ++e) {
            if (lines_.length[e] <= tolerance()) continue;  // M11
            edge_.push_back(e);
            segments_.push_back({set.points[set.edges[e][0]], set.points[set.edges[e][1]]});
        }
    }

    void run() {
        const SegmentTree tree(segments_, tolerance());
        tree.visit_pairs([&](std::uint32_t a, std::uint32_t b) {
            look_at(std::min(a, b), std::max(a, b));
            return within_.all() + between_.all() < most && !scope_.stopped();
        });
    }
    Meetings& within() { return within_; }
    Meetings& between() { return between_; }
    bool broken_off() const { return within_.all() + between_.all() >= most; }

private:
    static constexpr std::uint64_t most = 1000000;  // where all edges go through one place there are as many as their square

    const ObjectScope& scope_;
    Lines lines_;
    std::vector<std::uint32_t> edge_;
    std::vector<Segment> segments_;
    Meetings within_, between_;

    double tolerance() const { return scope_.lengths().tolerance; }

    void look_at(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t e = edge_[a], f = edge_[b];
        const bool one_line = lines_.line_of[e] == lines_.line_of[f];
        if (lines_.ends(e) == lines_.ends(f)) return;  // M12; different lines may share a border
        Meetings& found = one_line ? within_ : between_;
        const double longer = std::max(lines_.length[e], lines_.length[f]);
        const SideBySide beside = side_by_side(segments_[a], segments_[b], tolerance());
        if (beside.length > 4 * tolerance()) {
            ++found.overlapping;
            if (found.overlaps.size() < listed_elements) found.overlaps.push_back(beside.where);
        } else if (lines_.share_vertex(e, f)) {
            return;
        } else {
            const SegmentDistance near = closest_points(segments_[a], segments_[b]);
            if (near.distance > tolerance() + 1e-15 * longer) return;
            const bool end_a = at_end(near.along_first, lines_.length[e]), end_b = at_end(near.along_second, lines_.length[f]);
            if (end_a && end_b) return;  // M01
            ++(end_a || end_b ? found.touching : found.crossing);
            if (found.points.size() < listed_elements) found.points.push_back(near.on_first);
        }
        if (found.edges.size() < 2 * most) {
            found.edges.push_back(e);
            found.edges.push_back(f);
        }
    }
    bool at_end(double along, double length) const { return std::min(along, 1 - along) * length <= tolerance(); }
};

/// M13 of one line with itself, M14 of several.
void tell_meetings(const ObjectScope& scope, const PolylineSet& set, bool one_line, Meetings& found, bool broken_off,
                   std::vector<Finding>& findings) {
    if (found.all() == 0) return;
    std::ranges::sort(found.edges);
    found.edges.erase(std::unique(found.edges.begin(), found.edges.end()), found.edges.end());
    std::string kinds;
    const auto add = [&](std::uint64_t count, const char* kind) {
        if (count > 0) kinds += (kinds.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
    };
    add(found.crossing, "crossing");
    add(found.touching, "touching");
    add(found.overlapping, "overlapping");
    std::string message = one_line ? "a line" + of_object(scope) + " meets itself where it has no point"
                                   : "lines" + of_object(scope) + " meet where they share no point";
    message += ": pairs of edges: " + kinds + (broken_off ? "; there are more, which were not counted" : "");
    Finding finding = object_finding(scope, one_line ? "M13" : "M14", std::move(message));
    list_edges(set, found.edges, finding);
    finding.count = found.all();
    finding.polylines.clear();
    finding.points = std::move(found.points);
    for (const Segment& s : found.overlaps) finding.polylines.push_back({s[0], s[1]});
    finding.measures = {{"crossing", static_cast<double>(found.crossing)},
                        {"touch", static_cast<double>(found.touching)},
                        {"overlap", static_cast<double>(found.overlapping)}};
    findings.push_back(std::move(finding));
}

}  // namespace

void check_edge_lengths(const ObjectScope& scope, std::vector<Finding>& findings) {
    const auto* set = scope.as<PolylineSet>();
    if (set == nullptr) return;
    std::vector<std::uint32_t> short_ones;
    for (std::uint32_t e = 0; e < set->edges.size(); ++e) {
        const Vec3 d = minus(set->points[set->edges[e][1]], set->points[set->edges[e][0]]);
        if (dot(d, d) <= scope.lengths().tolerance * scope.lengths().tolerance) short_ones.push_back(e);
    }
    if (short_ones.empty()) return;
    Finding finding =
        object_finding(scope, "M11",
                       counted(short_ones.size(), "edge", "edges") + of_object(scope) + (short_ones.size() == 1 ? " has" : " have") +
                           " no length: the ends are no farther apart than " + rounded(scope.lengths().tolerance));
    list_edges(*set, short_ones, finding);
    findings.push_back(std::move(finding));
}

void check_edge_repeats(const ObjectScope& scope, std::vector<Finding>& findings) {
    const auto* set = scope.as<PolylineSet>();
    if (set == nullptr) return;
    const Lines lines(*set);
    std::vector<std::array<std::uint32_t, 4>> keys;  // line, both ends, edge
    for (std::uint32_t e = 0; e < set->edges.size(); ++e) {
        const auto [low, high] = lines.ends(e);
        if (low != high) keys.push_back({lines.line_of[e], low, high, e});
    }
    std::ranges::sort(keys);
    std::vector<std::uint32_t> repeats;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (std::equal(keys[i].begin(), keys[i].begin() + 3, keys[i - 1].begin())) repeats.push_back(keys[i][3]);
    }
    if (repeats.empty()) return;
    std::ranges::sort(repeats);
    Finding finding = object_finding(scope, "M12",
                                     counted(repeats.size(), "edge", "edges") + of_object(scope) +
                                         (repeats.size() == 1 ? " repeats" : " repeat") + " another one of the same line");
    list_edges(*set, repeats, finding);
    findings.push_back(std::move(finding));
}

void check_line_meetings(const ObjectScope& scope, std::vector<Finding>& findings) {
    const auto* set = scope.as<PolylineSet>();
    if (set == nullptr) return;
    MeetingSearch search(scope, *set);
    search.run();
    tell_meetings(scope, *set, true, search.within(), search.broken_off(), findings);
    tell_meetings(scope, *set, false, search.between(), search.broken_off(), findings);
}

}  // namespace geomend::validators
