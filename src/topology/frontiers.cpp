// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/frontiers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/disjoint_sets.h"
#include "geometry/predicates.h"
#include "geometry/vectors.h"
#include "topology/face_volume.h"

namespace geomend::topology {

namespace {

std::uint32_t side_index(std::uint32_t surface, bool front) { return 2 * surface + (front ? 1 : 0); }

/// A polygon seen along a line: where it points to, and its surface.
struct Leaf {
    Vec3 tip;
    std::uint32_t surface;
    bool front_first;  // going around the axis counter-clockwise, one leaves it through its front
};

/// Order of half-planes around the axis a -> b, counter-clockwise from that of `reference`.
class Around {
public:
    Around(const Vec3& a, const Vec3& b, const Vec3& reference) : a_(a), b_(b), reference_(reference) {}

    /// 0 the reference's own direction, 1 less than half a turn, 2 opposite, 3 more.
    int half(const Vec3& p) const {
        const int turn = orientation(a_, b_, reference_, p);
        if (turn > 0) return 1;
        if (turn < 0) return 3;
        const Vec3 axis = minus(b_, a_);
        return dot(across(minus(reference_, a_), axis), across(minus(p, a_), axis)) >= 0 ? 0 : 2;
    }
    /// Negative when p comes before q, 0 when they coincide.
    int compare(const Vec3& p, const Vec3& q) const {
        const int hp = half(p), hq = half(q);
        if (hp != hq) return hp < hq ? -1 : 1;
        if (hp == 0 || hp == 2) return 0;
        return -orientation(a_, b_, p, q);
    }

private:
    Vec3 a_, b_, reference_;
};

std::uint32_t longest_edge(const BrepData& brep, const LineGraph& graph, std::uint32_t line) {
    std::uint32_t best = graph.line_edges[graph.line_first_edge[line]];
    double longest = -1;
    for (std::uint32_t k = graph.line_first_edge[line]; k < graph.line_first_edge[line + 1]; ++k) {
        const EdgeUse& use = graph.uses[graph.edges[graph.line_edges[k]].first_use];
        const Vec3 d = minus(brep.vertices[use.high], brep.vertices[use.low]);
        if (dot(d, d) > longest) {
            longest = dot(d, d);
            best = graph.line_edges[k];
        }
    }
    return best;
}

/// Lists the sides that face each other around a line. False when two polygons coincide.
bool join_around(const BrepData& brep, const LineGraph& graph, std::span<const PolygonEdges> all_edges, std::uint32_t line,
                 std::vector<FoundRegions::Join>& joins) {
    const auto uses = graph.edge_uses(graph.edges[longest_edge(brep, graph, line)]);
    const Vec3& a = brep.vertices[uses[0].low];
    const Vec3& b = brep.vertices[uses[0].high];
    std::vector<Leaf> leaves;
    for (const EdgeUse& use : uses) {
        if (use.surface == no_index) continue;
        const auto& surface = brep.surfaces[use.surface];
        const VertexId tip = far_vertex(brep, surface, all_edges[use.surface].polygon(use.corner), a, b);
        leaves.push_back({brep.vertices[tip.value], use.surface, use.direction > 0});
    }
    if (leaves.empty()) return true;
    const Around around(a, b, leaves[0].tip);
    std::stable_sort(leaves.begin(), leaves.end(), [&](const Leaf& x, const Leaf& y) { return around.compare(x.tip, y.tip) < 0; });
    for (std::size_t i = 0; i + 1 < leaves.size(); ++i) {
        if (around.compare(leaves[i].tip, leaves[i + 1].tip) == 0) return false;
    }
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const Leaf& here = leaves[i];
        const Leaf& next = leaves[(i + 1) % leaves.size()];
        joins.push_back({side_index(here.surface, here.front_first), side_index(next.surface, !next.front_first), line});
    }
    return true;
}

struct Shell {
    std::vector<BrepData::Side> sides;
    double volume = 0;  // inwards positive
    std::uint32_t group = 0;
    Vec3 low{}, high{};
};

void measure(const BrepData& brep, std::span<const double> cones, Shell& shell) {
    PreciseSum sum;
    double scale = 0;
    shell.low = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    shell.high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const auto& side : shell.sides) {
        sum.add(side.front ? -cones[side.surface.value] : cones[side.surface.value]);
        scale += std::abs(cones[side.surface.value]);
        for (const VertexId v : brep.surfaces[side.surface.value].nodes) {
            for (std::size_t k = 0; k < 3; ++k) {
                shell.low[k] = std::min(shell.low[k], brep.vertices[v.value][k]);
                shell.high[k] = std::max(shell.high[k], brep.vertices[v.value][k]);
            }
        }
    }
    shell.volume = std::abs(sum.value()) <= 1e-14 * scale ? 0 : sum.value();  // both sides of a sheet cancel
}

bool box_contains(const Shell& shell, const Vec3& p) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (p[k] < shell.low[k] || p[k] > shell.high[k]) return false;
    }
    return true;
}

/// Solid angle under which a triangle is seen (van Oosterom and Strackee), positive from behind.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    const double numerator = dot(a, cross(b, c));
    const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return 2 * std::atan2(numerator, denominator);
}

/// Whether a point is enclosed by a shell, by the angle under which it sees the shell: all around inside, nothing outside.
/// Nothing where it lies on the shell.
std::optional<bool> encloses(const BrepData& brep, const Shell& shell, const Vec3& p) {
    if (!box_contains(shell, p)) return false;
    double angle = 0;
    for (const auto& side : shell.sides) {
        const auto& surface = brep.surfaces[side.surface.value];
        double part = 0;
        for (std::size_t i = 0; i < surface.polygons.size(); ++i) {
            const auto polygon = surface.polygons[i];
            const auto at = [&](std::size_t k) { return minus(brep.vertices[surface.nodes[polygon[k]].value], p); };
            for (std::size_t k = 0; k < polygon.size(); ++k) {
                if (at(k) == Vec3{}) return std::nullopt;
            }
            for (std::size_t k = 1; k + 1 < polygon.size(); ++k) part += solid_angle(at(0), at(k), at(k + 1));
        }
        angle += side.front ? -part : part;
    }
    constexpr double all_around = 4 * std::numbers::pi;
    if (angle < 0.25 * all_around) return false;
    if (angle > 0.75 * all_around) return true;
    return std::nullopt;
}

/// Whether a shell lies within another one; they may touch, so that not each of its points can tell.
bool encloses(const BrepData& brep, const Shell& shell, const Shell& inner) {
    for (const auto& side : inner.sides) {
        const auto& surface = brep.surfaces[side.surface.value];
        for (const std::uint32_t node : surface.polygons.corners) {
            if (const auto inside = encloses(brep, shell, brep.vertices[surface.nodes[node].value])) return *inside;
        }
        for (std::size_t i = 0; i < surface.polygons.size(); ++i) {
            Vec3 middle{};
            const auto polygon = surface.polygons[i];
            for (const std::uint32_t node : polygon)
                middle = plus(middle, times(1.0 / static_cast<double>(polygon.size()), brep.vertices[surface.nodes[node].value]));
            if (const auto inside = encloses(brep, shell, middle)) return *inside;
        }
    }
    return false;
}

std::vector<Shell> make_shells(const BrepData& brep, std::span<const double> cones, DisjointSets& sides, DisjointSets& groups) {
    std::vector<std::uint32_t> shell_of(2 * brep.surfaces.size(), no_index);
    std::vector<Shell> shells;
    for (std::uint32_t i = 0; i < shell_of.size(); ++i) {
        if (brep.surfaces[i / 2].polygons.size() == 0) continue;
        const std::uint32_t root = sides.root(i);
        if (shell_of[root] == no_index) {
            shell_of[root] = static_cast<std::uint32_t>(shells.size());
            shells.emplace_back();
            shells.back().group = groups.root(i / 2);
        }
        shells[shell_of[root]].sides.push_back({SurfaceId(i / 2), i % 2 == 1});
    }
    for (Shell& shell : shells) measure(brep, cones, shell);
    return shells;
}

/// The smallest shell with a volume, of another group, around a group of surfaces; or nothing.
std::optional<std::size_t> shell_around(const BrepData& brep, const std::vector<Shell>& shells, const Shell& inner) {
    std::optional<std::size_t> best;
    for (std::size_t s = 0; s < shells.size(); ++s) {
        if (shells[s].volume <= 0 || shells[s].group == inner.group) continue;
        if (best && shells[*best].volume <= shells[s].volume) continue;
        if (encloses(brep, shells[s], inner)) best = s;
    }
    return best;
}

}  // namespace

FoundRegions find_regions(const BrepData& brep, const LineGraph& graph, std::span<const double> cones) {
    FoundRegions found;
    DisjointSets sides(2 * brep.surfaces.size()), groups(brep.surfaces.size());
    std::vector<PolygonEdges> all_edges;
    for (const auto& surface : brep.surfaces) all_edges.emplace_back(surface.polygons);
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        if (!join_around(brep, graph, all_edges, l, found.joins)) found.uncertain_lines.emplace_back(l);
        std::uint32_t first = no_index;
        for (const EdgeUse& use : graph.edge_uses(graph.edges[graph.line_edges[graph.line_first_edge[l]]])) {
            if (use.surface == no_index) continue;
            if (first == no_index) first = use.surface;
            groups.join(first, use.surface);
        }
    }
    for (const auto& join : found.joins) sides.join(join.first, join.second);
    const auto shells = make_shells(brep, cones, sides, groups);
    std::vector<std::size_t> region_of(shells.size(), SIZE_MAX);
    for (std::size_t s = 0; s < shells.size(); ++s) {
        if (shells[s].volume <= 0) continue;
        region_of[s] = found.regions.size();
        found.regions.push_back(shells[s].sides);
    }
    for (const Shell& shell : shells) {
        if (shell.volume > 0) continue;
        const auto around = shell_around(brep, shells, shell);
        auto& target = around ? found.regions[region_of[*around]] : found.universe;
        target.insert(target.end(), shell.sides.begin(), shell.sides.end());
    }
    found.region_of_side.assign(2 * brep.surfaces.size(), no_index);
    for (std::uint32_t r = 0; r < found.regions.size(); ++r) {
        for (const auto& side : found.regions[r]) found.region_of_side[side_index(side.surface.value, side.front)] = r;
    }
    return found;
}

}  // namespace geomend::topology
