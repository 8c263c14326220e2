// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/cut_round.h"

#include <algorithm>
#include <cmath>

#include "arrangement/circles.h"
#include "arrangement/cut_triangle.h"
#include "arrangement/search.h"
#include "arrangement/triple_points.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "geometry/predicates.h"
#include "geometry/vectors.h"
#include "model/objects.h"

namespace geomend::arrangement {

namespace {

template <class T>
void sort_unique(std::vector<T>& all) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
}

constexpr unsigned patient_rounds = 3;

/// Where planes are next to parallel, each look may find edges that pass each other a little farther on, and make points there without
/// end. So what late rounds make keeps more than the tolerance from what is there: they become what is near.
double distance_of_round(const CutState& state) {
    constexpr double most = 32;
    const double widened = state.rounds > patient_rounds ? std::exp2(state.rounds - patient_rounds) : 1;
    return state.points.distance() * std::min(most, widened);
}

/// Gives each new point its vertex, in the order of their keys; the result runs along `made`.
std::vector<std::uint32_t> add_points(CutState& state, const std::vector<NewPoint>& made) {
    SpacedPoints& points = state.points;
    const double distance = distance_of_round(state);
    std::vector<std::uint32_t> order(made.size()), vertex(made.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto p = made[a].key(), q = made[b].key();
        return p != q ? p < q : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool again = i > 0 && made[order[i]].key() == made[order[i - 1]].key();
        vertex[order[i]] = again ? vertex[order[i - 1]] : points.add(made[order[i]].position, distance);
    }
    return vertex;
}

/// Whether a vertex lies strictly inside of a triangle, seen as a cut sees it: along the axis that its normal follows most.
bool is_seen_inside(std::span<const Vec3> points, const Triangle& t, std::uint32_t vertex) {
    const Vec3 n = cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
    unsigned axis = 2;
    if (std::abs(n[0]) > std::abs(n[axis])) axis = 0;
    if (std::abs(n[1]) > std::abs(n[axis])) axis = 1;
    const int turn = orientation_2d(points[t[0]], points[t[1]], points[t[2]], axis);
    for (std::size_t i = 0; i < 3; ++i) {
        if (turn * orientation_2d(points[t[i]], points[t[(i + 1) % 3]], points[vertex], axis) <= 0) return false;
    }
    return true;
}

double square_from_segment(const Vec3& x, const Vec3& p, const Vec3& q) {
    const Vec3 d = minus(q, p), w = minus(x, p);
    const Vec3 off = minus(w, times(std::clamp(dot(w, d) / dot(d, d), 0.0, 1.0), d));
    return dot(off, off);
}

/// A point where an edge pierces a face may have become a vertex that is near, and lies beside the face: it goes onto the side
/// of the face that is next to it, or could never be brought in.
void move_to_sides(const CutState& state, std::vector<VertexOnEdge>& on_edges, std::vector<VertexOnFace>& on_faces) {
    const auto& points = state.points.points();
    std::erase_if(on_faces, [&](const VertexOnFace& on) {
        const Triangle& t = state.triangles[on.triangle];
        if (on.vertex == t[0] || on.vertex == t[1] || on.vertex == t[2]) return true;
        if (is_seen_inside(points, t, on.vertex)) return false;
        std::size_t nearest = 0;
        double least = HUGE_VAL;
        for (std::size_t i = 0; i < 3; ++i) {
            const double square = square_from_segment(points[on.vertex], points[t[i]], points[t[(i + 1) % 3]]);
            if (square < least) {
                least = square;
                nearest = i;
            }
        }
        on_edges.push_back({Link(t[nearest], t[(nearest + 1) % 3]), on.vertex});
        return true;
    });
}

void put_on_features(const NearFeatures& found, const std::vector<std::uint32_t>& vertex, std::vector<VertexOnEdge>& on_edges,
                     std::vector<VertexOnFace>& on_faces) {
    on_edges = found.on_edges;
    on_faces = found.on_faces;
    for (std::size_t i = 0; i < found.points.size(); ++i) {
        const NewPoint& p = found.points[i];
        on_edges.push_back({p.edge, vertex[i]});
        if (p.pierces) on_faces.push_back({p.other.a, vertex[i]});
        else on_edges.push_back({p.other, vertex[i]});
    }
}

/// The segments in which two triangles meet, from the points that they have in common: one line of them, or, where they lie on
/// each other, what runs along the edges of both.
class PairSegments {
public:
    PairSegments(const CutState& state, const LinkTable& links, std::vector<SegmentInFace>& to) : state_(state), links_(links), to_(to) {}

    void add(const NearFeatures::Pair& pair, std::vector<std::uint32_t>& common) {
        sort_unique(common);
        if (common.size() < 2) return;
        if (in_line(common)) {
            connect(pair, common, true);
            return;
        }
        for (const std::uint32_t t : {pair.first, pair.second}) {
            const Triangle& c = state_.triangles[t];
            for (std::size_t i = 0; i < 3; ++i) {
                way_.assign(1, c[i]);
                links_.append(c[i], c[(i + 1) % 3], way_);
                way_.push_back(c[(i + 1) % 3]);
                std::erase_if(way_, [&](std::uint32_t v) { return !std::ranges::binary_search(common, v); });
                connect(pair, way_, false);
            }
        }
    }

private:
    const CutState& state_;
    const LinkTable& links_;
    std::vector<SegmentInFace>& to_;
    std::vector<std::uint32_t> way_;

    /// Sorts them along their line where they are in one.
    bool in_line(std::vector<std::uint32_t>& common) const {
        const auto& points = state_.points.points();
        std::uint32_t from = common[0], to = common[1];
        double longest = -1;
        for (const std::uint32_t v : common) {
            const Vec3 d = minus(points[v], points[from]);
            if (dot(d, d) > longest) {
                longest = dot(d, d);
                to = v;
            }
        }
        const Vec3 origin = points[to];
        longest = -1;
        for (const std::uint32_t v : common) {
            const Vec3 d = minus(points[v], origin);
            if (dot(d, d) > longest) {
                longest = dot(d, d);
                from = v;
            }
        }
        const Vec3 direction = minus(points[to], points[from]);
        const double square = dot(direction, direction), reach = 4 * state_.reach;
        for (const std::uint32_t v : common) {
            const Vec3 w = minus(points[v], points[from]), off = minus(w, times(dot(w, direction) / square, direction));
            if (dot(off, off) > reach * reach) return false;
        }
        std::sort(common.begin(), common.end(), [&](std::uint32_t a, std::uint32_t b) {
            const double p = dot(direction, points[a]), q = dot(direction, points[b]);
            return p != q ? p < q : a < b;
        });
        return true;
    }

    void connect(const NearFeatures::Pair& pair, std::span<const std::uint32_t> way, bool is_all) {
        for (std::size_t i = 1; i < way.size(); ++i) {
            const Link segment(way[i - 1], way[i]);
            if (!is_along_edge(pair.first, segment)) to_.push_back({pair.first, segment, is_all ? pair.second : no_index});
            if (!is_along_edge(pair.second, segment)) to_.push_back({pair.second, segment, is_all ? pair.first : no_index});
        }
    }

    /// Whether both ends are corners, or next to each other on one edge: then the edge has it already.
    bool is_along_edge(std::uint32_t t, const Link& segment) const {
        const Triangle& c = state_.triangles[t];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t p = c[i], q = c[(i + 1) % 3];
            const auto on = links_.on(Link(p, q));
            const auto is_on = [&](std::uint32_t v) { return v == p || v == q || std::ranges::find(on, v) != on.end(); };
            if (is_on(segment.a) && is_on(segment.b)) return true;
        }
        return false;
    }
};

std::vector<SegmentInFace> segments_of_pairs(const CutState& state, const LinkTable& links, const NearFeatures& found,
                                             const std::vector<std::uint32_t>& vertex) {
    std::vector<SegmentInFace> segments;
    PairSegments maker(state, links, segments);
    std::vector<std::uint32_t> common;
    for (const auto& pair : found.pairs) {
        common.clear();
        for (std::uint32_t i = pair.begin; i < pair.end; ++i) {
            const std::uint32_t c = found.common[i];
            common.push_back(c < NearFeatures::first_new ? c : vertex[c - NearFeatures::first_new]);
        }
        maker.add(pair, common);
    }
    sort_unique(segments);
    return segments;
}

/// Each segment once for its triangle, whatever others meet it there.
std::vector<SegmentInFace> each_once(std::vector<SegmentInFace> segments) {
    const auto is_same = [](const SegmentInFace& a, const SegmentInFace& b) { return a.triangle == b.triangle && a.segment == b.segment; };
    segments.erase(std::unique(segments.begin(), segments.end(), is_same), segments.end());
    return segments;
}

/// What one triangle is cut by.
struct Job {
    std::uint32_t triangle;
    std::size_t first_point, end_point, first_segment, end_segment;
};

/// Triangles with points or segments inside, or with something on an edge, ascending.
std::vector<Job> jobs_of(const CutState& state, const LinkTable& links, const std::vector<VertexOnFace>& on_faces,
                         const std::vector<SegmentInFace>& segments) {
    std::vector<Job> jobs;
    std::size_t p = 0, s = 0;
    for (std::uint32_t t = 0; t < state.triangles.size(); ++t) {
        Job job{t, p, p, s, s};
        while (p < on_faces.size() && on_faces[p].triangle == t) job.end_point = ++p;
        while (s < segments.size() && segments[s].triangle == t) job.end_segment = ++s;
        bool touched = job.first_point != job.end_point || job.first_segment != job.end_segment;
        const Triangle& c = state.triangles[t];
        for (std::size_t i = 0; i < 3 && !touched; ++i) touched = !links.on(Link(c[i], c[(i + 1) % 3])).empty();
        if (touched) jobs.push_back(job);
    }
    return jobs;
}

/// The inputs of jobs as plain lists.
struct JobLists {
    std::vector<std::uint32_t> on_face;
    std::vector<Link> segments;

    JobLists(const std::vector<VertexOnFace>& points, const std::vector<SegmentInFace>& in) {
        for (const auto& p : points) on_face.push_back(p.vertex);
        for (const auto& s : in) segments.push_back(s.segment);
    }
    std::span<const std::uint32_t> points_of(const Job& j) const {
        return std::span(on_face).subspan(j.first_point, j.end_point - j.first_point);
    }
    std::span<const Link> segments_of(const Job& j) const {
        return std::span(segments).subspan(j.first_segment, j.end_segment - j.first_segment);
    }
};

constexpr std::size_t jobs_in_block = 256;

/// Calls run(job, scratch, block) for all jobs, block by block, possibly at the same time.
template <class Run>
void each_job(const std::vector<Job>& jobs, const Run& run) {
    parallel_for_each_index((jobs.size() + jobs_in_block - 1) / jobs_in_block, [&](std::size_t block) {
        CutScratch scratch;
        const std::size_t end = std::min(jobs.size(), (block + 1) * jobs_in_block);
        for (std::size_t j = block * jobs_in_block; j < end; ++j) run(jobs[j], scratch, block);
    });
}

/// Points where segments cross inside triangles go onto both; those that segments pass go onto them.
void add_crossings(CutState& state, const LinkTable& links, const std::vector<SegmentInFace>& meetings, const std::vector<Job>& jobs,
                   const JobLists& lists, std::vector<VertexOnEdge>& on_edges) {
    struct Block {
        std::vector<NewPoint> crossings;
        std::vector<std::uint32_t> triangles;  ///< of the crossings
        std::vector<VertexOnEdge> on_segments;
    };
    std::vector<Block> blocks((jobs.size() + jobs_in_block - 1) / jobs_in_block);
    each_job(jobs, [&](const Job& job, CutScratch& scratch, std::size_t block) {
        const auto segments = lists.segments_of(job);
        if (segments.empty()) return;
        cross_segments(state.points.points(), state.triangles[job.triangle], links, segments, lists.points_of(job), state.reach,
                       blocks[block].crossings, blocks[block].on_segments, scratch);
        blocks[block].triangles.resize(blocks[block].crossings.size(), job.triangle);
    });
    std::vector<NewPoint> crossings;
    std::vector<std::uint32_t> triangles;
    for (const Block& b : blocks) {
        on_edges.insert(on_edges.end(), b.on_segments.begin(), b.on_segments.end());
        crossings.insert(crossings.end(), b.crossings.begin(), b.crossings.end());
        triangles.insert(triangles.end(), b.triangles.begin(), b.triangles.end());
    }
    join_triple_points(state.points.points(), meetings, triangles, crossings);
    const auto vertex = add_points(state, crossings);
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        on_edges.push_back({crossings[i].edge, vertex[i]});
        on_edges.push_back({crossings[i].other, vertex[i]});
    }
}

/// Of triangles over the same vertices in one patch the first stays: 1 for each other one.
std::vector<std::uint8_t> doubles_of(CutState& state, const NearFeatures& found) {
    std::vector<std::uint8_t> is_double;
    for (const auto& [first, second] : found.same) {
        if (!are_of_one_patch(state, state.source[first], state.source[second])) continue;
        is_double.resize(state.triangles.size(), 0);
        state.doubled += is_double[second] == 0 ? 1 : 0;
        is_double[second] = 1;
    }
    return is_double;
}

/// Replaces the triangles of jobs by their parts, and leaves out doubles.
void replace(CutState& state, const LinkTable& links, const std::vector<Job>& jobs, const JobLists& lists,
             const std::vector<std::uint8_t>& is_double) {
    struct Block {
        std::vector<Triangle> parts;
        std::vector<std::uint32_t> counts;
    };
    std::vector<Block> blocks((jobs.size() + jobs_in_block - 1) / jobs_in_block);
    each_job(jobs, [&](const Job& job, CutScratch& scratch, std::size_t block) {
        auto& [parts, counts] = blocks[block];
        const std::size_t before = parts.size();
        cut_triangle(state.points.points(), state.triangles[job.triangle], links, lists.segments_of(job), lists.points_of(job), state.reach,
                     scratch, parts);
        counts.push_back(static_cast<std::uint32_t>(parts.size() - before));
    });
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> source;
    std::vector<std::uint8_t> is_new;
    std::size_t total = state.triangles.size();
    for (const Block& b : blocks) total += b.parts.size();
    triangles.reserve(total);
    source.reserve(total);
    is_new.reserve(total);
    std::size_t next = 0, part = 0;
    for (std::uint32_t t = 0; t < state.triangles.size(); ++t) {
        const bool stays = is_double.empty() || is_double[t] == 0;
        if (next == jobs.size() || jobs[next].triangle != t) {
            if (!stays) continue;
            triangles.push_back(state.triangles[t]);
            source.push_back(state.source[t]);
            is_new.push_back(0);
            continue;
        }
        const Block& b = blocks[next / jobs_in_block];
        if (next % jobs_in_block == 0) part = 0;
        for (std::uint32_t k = b.counts[next % jobs_in_block]; k > 0; --k, ++part) {
            if (!stays) continue;
            triangles.push_back(b.parts[part]);
            source.push_back(state.source[t]);
            is_new.push_back(1);
        }
        ++next;
    }
    state.triangles = std::move(triangles);
    state.source = std::move(source);
    state.is_new = std::move(is_new);
}

/// Embedded edges are cut where something stands on them.
void cut_edges(CutState& state, const LinkTable& links) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint32_t> source, way;
    for (std::size_t e = 0; e < state.edges.size(); ++e) {
        const auto [from, to] = state.edges[e];
        way.assign(1, from);
        links.append(from, to, way);
        way.push_back(to);
        for (std::size_t i = 1; i < way.size(); ++i) {
            edges.push_back({way[i - 1], way[i]});
            source.push_back(state.edge_source[e]);
        }
    }
    state.edges = std::move(edges);
    state.edge_source = std::move(source);
}

/// A corner next to another one may make whatever triangle is tried around it a flat one, so that rounds go in circles: then the two
/// become one. Only what is new and flat is looked at, and only edges of a few times the distance that points keep.
void merge_ends_of_flat_triangles(CutState& state) {
    const auto& points = state.points.points();
    const double longest = std::max(128 * state.reach, distance_of_round(state));
    DisjointSets same(points.size());
    std::uint64_t merged = 0;
    for (std::size_t t = 0; t < state.triangles.size(); ++t) {
        if (state.is_new[t] == 0) continue;
        NearFeatures flat;
        const FlatTriangle triangle(points, state.triangles[t]);
        add_flat_corner(triangle, state.reach, flat);
        if (flat.on_edges.empty()) continue;
        std::array<double, 3> square{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 d = minus(triangle.corner[(i + 1) % 3], triangle.corner[i]);
            square[i] = dot(d, d);
        }
        const auto i = static_cast<std::size_t>(std::ranges::min_element(square) - square.begin());
        if (square[i] > longest * longest) continue;
        const Link edge = triangle.edge(i);
        if (same.root(edge.a) != same.root(edge.b)) ++merged;
        same.join(edge.a, edge.b);
    }
    if (merged == 0) return;
    state.merged += merged;
    rename_points(state, std::move(same).roots());
}

}  // namespace

void rename_points(CutState& state, const std::vector<std::uint32_t>& becomes) {
    for (std::uint32_t p = 0; p < becomes.size(); ++p) {
        if (becomes[p] != p) state.gave_way.push_back({p, becomes[p]});
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < state.triangles.size(); ++t) {
        const Triangle was = state.triangles[t], now{becomes[was[0]], becomes[was[1]], becomes[was[2]]};
        if (now[0] == now[1] || now[1] == now[2] || now[2] == now[0]) continue;
        state.triangles[kept] = now;
        state.source[kept] = state.source[t];
        state.is_new[kept++] = now != was ? 1 : state.is_new[t];
    }
    state.triangles.resize(kept);
    state.source.resize(kept);
    state.is_new.resize(kept);
    kept = 0;
    for (std::size_t e = 0; e < state.edges.size(); ++e) {
        const std::array<std::uint32_t, 2> now{becomes[state.edges[e][0]], becomes[state.edges[e][1]]};
        if (now[0] == now[1]) continue;
        state.edges[kept] = now;
        state.edge_source[kept++] = state.edge_source[e];
    }
    state.edges.resize(kept);
    state.edge_source.resize(kept);
}

bool cut_round(CutState& state, const Monitor* monitor) {
    if (++state.rounds > patient_rounds) merge_ends_of_flat_triangles(state);
    NearFeatures found = search(state.points.points(), state.triangles, state.is_new, state.reach, monitor, state.most_points);
    state.found_points = found.points.size();
    if (state.found_points > state.most_points) return false;
    if (state.rounds > patient_rounds) break_circles(state, found, state.points.distance());
    return !cut_at(state, found);
}

bool cut_at(CutState& state, const NearFeatures& found) {
    const auto is_double = doubles_of(state, found);
    if (found.on_edges.empty() && found.on_faces.empty() && found.points.empty() && is_double.empty()) return false;
    const auto vertex = add_points(state, found.points);
    std::vector<VertexOnEdge> on_edges;
    std::vector<VertexOnFace> on_faces;
    put_on_features(found, vertex, on_edges, on_faces);
    sort_unique(on_faces);
    move_to_sides(state, on_edges, on_faces);
    LinkTable links(state.points.points(), on_edges);
    const auto meetings = segments_of_pairs(state, links, found, vertex);
    const auto segments = each_once(meetings);
    const JobLists lists(on_faces, segments);
    const auto jobs = jobs_of(state, links, on_faces, segments);
    const std::size_t before = on_edges.size();
    add_crossings(state, links, meetings, jobs, lists, on_edges);
    if (on_edges.size() != before) links = LinkTable(state.points.points(), std::move(on_edges));
    // Points that came onto edges in the last step touch no triangle that was not touched already: segments run inside them.
    replace(state, links, jobs, lists, is_double);
    cut_edges(state, links);
    return true;
}

}  // namespace geomend::arrangement
