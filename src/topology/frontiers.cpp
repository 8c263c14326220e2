// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/frontiers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "base/bounds.h"
#include "base/disjoint_sets.h"
#include "geometry/predicates.h"
#include "geometry/vectors.h"
#include "topology/face_volume.h"
#include "topology/upward_ray.h"

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
class RadialOrder {
public:
    RadialOrder(const Vec3& a, const Vec3& b, const Vec3& reference) : a_(a), b_(b), reference_(reference) {}

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

/// Points as near the axis as this say nothing of the direction in which a polygon leaves it.
constexpr double tolerances_beside_axis = 10;

bool is_beside(const Vec3& a, const Vec3& b, const Vec3& p, double tolerance) {
    const Vec3 u = across(minus(p, a), minus(b, a));
    return dot(u, u) <= tolerances_beside_axis * tolerances_beside_axis * tolerance * tolerance;
}

/// Whether two half-planes from a to b, with a point of each, are apart by no more than the tolerance as far as the nearer point goes.
bool coincide(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q, double tolerance) {
    const Vec3 axis = minus(b, a), u = across(minus(p, a), axis), v = across(minus(q, a), axis);
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v);
    if (uv <= 0) return false;
    return std::min(uu, vv) * std::max(0.0, 1 - uv * uv / (uu * vv)) <= tolerance * tolerance;
}

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

/// Which polygons of a surface belong to a part that shares no edge with the one that has most; asked for when needed.
class MinorPieces {
public:
    explicit MinorPieces(const BrepData& brep) : brep_(brep), of_surface_(brep.surfaces.size()) {}

    bool contains(std::uint32_t surface, std::uint32_t polygon) {
        if (!of_surface_[surface]) of_surface_[surface] = find(brep_.surfaces[surface]);
        const auto& lesser = *of_surface_[surface];
        return !lesser.empty() && lesser[polygon] != 0;
    }

private:
    const BrepData& brep_;
    std::vector<std::optional<std::vector<std::uint8_t>>> of_surface_;  // flags of polygons; empty: all in one

    static std::vector<std::uint8_t> find(const BrepData::Surface& surface) {
        const std::size_t count = surface.polygons.size();
        std::vector<std::array<std::uint32_t, 3>> edges;  // two vertices, ascending, and the polygon
        edges.reserve(surface.polygons.corners.size());
        for (std::uint32_t p = 0; p < count; ++p) {
            const auto polygon = surface.polygons[p];
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const auto ends = std::minmax(surface.nodes[polygon[i]].value, surface.nodes[polygon[(i + 1) % polygon.size()]].value);
                edges.push_back({ends.first, ends.second, p});
            }
        }
        std::ranges::sort(edges);
        DisjointSets parts(count);
        for (std::size_t e = 1; e < edges.size(); ++e) {
            if (edges[e][0] == edges[e - 1][0] && edges[e][1] == edges[e - 1][1]) parts.join(edges[e][2], edges[e - 1][2]);
        }
        std::vector<std::uint32_t> polygons_of(count, 0);
        for (std::uint32_t p = 0; p < count; ++p) ++polygons_of[parts.root(p)];
        const auto largest = static_cast<std::uint32_t>(std::ranges::max_element(polygons_of) - polygons_of.begin());
        if (polygons_of[largest] == count) return {};
        std::vector<std::uint8_t> lesser(count);
        for (std::uint32_t p = 0; p < count; ++p) lesser[p] = parts.root(p) == largest ? 0 : 1;
        return lesser;
    }
};

/// Lists the sides that face each other around a line. False when two polygons coincide. Around the free border of a part that
/// does not hang together with its surface none are listed: a stray triangle would make a leak of the surface.
bool join_around(const BrepData& brep, const LineGraph& graph, std::span<const PolygonEdges> all_edges, std::uint32_t line,
                 std::span<const double> tolerances, MinorPieces& lesser, std::vector<FoundRegions::Join>& joins) {
    const auto uses = graph.edge_uses(graph.edges[longest_edge(brep, graph, line)]);
    const Vec3& a = brep.vertices[uses[0].low];
    const Vec3& b = brep.vertices[uses[0].high];
    std::vector<Leaf> leaves;
    double tolerance = 0;
    const auto of_surfaces = std::ranges::count_if(uses, [](const EdgeUse& use) { return use.surface != no_index; });
    for (const EdgeUse& use : uses) {
        if (use.surface == no_index) continue;
        if (!tolerances.empty()) tolerance = std::max(tolerance, tolerances[use.surface]);
        const auto& surface = brep.surfaces[use.surface];
        const std::uint32_t polygon = all_edges[use.surface].polygon(use.corner);
        if (of_surfaces == 1 && lesser.contains(use.surface, polygon)) return true;
        const VertexId tip = far_vertex(brep, surface, polygon, a, b);
        leaves.push_back({brep.vertices[tip.value], use.surface, use.direction > 0});
    }
    if (leaves.empty()) return true;
    const RadialOrder around(a, b, leaves[0].tip);
    std::stable_sort(leaves.begin(), leaves.end(), [&](const Leaf& x, const Leaf& y) { return around.compare(x.tip, y.tip) < 0; });
    for (std::size_t i = 0; leaves.size() > 1 && i < leaves.size(); ++i) {
        const Vec3 &p = leaves[i].tip, &q = leaves[(i + 1) % leaves.size()].tip;
        // Of a polygon as flat as the tolerance (M03) any order will do.
        if (tolerance > 0 && (is_beside(a, b, p, tolerance) || is_beside(a, b, q, tolerance))) continue;
        if (i + 1 < leaves.size() && around.compare(p, q) == 0) return false;
        if (tolerance > 0 && coincide(a, b, p, q, tolerance)) return false;
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
};

void measure(std::span<const double> cones, Shell& shell) {
    PreciseSum sum;
    double scale = 0;
    for (const auto& side : shell.sides) {
        sum.add(side.front ? -cones[side.surface.value] : cones[side.surface.value]);
        scale += std::abs(cones[side.surface.value]);
    }
    shell.volume = std::abs(sum.value()) <= 1e-14 * scale ? 0 : sum.value();  // both sides of a sheet cancel
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
    for (Shell& shell : shells) measure(cones, shell);
    return shells;
}

/// Finds which shell lies in which.
class Containment {
public:
    Containment(const BrepData& brep, const std::vector<Shell>& shells, DisjointSets& groups)
        : brep_(brep), shells_(shells), groups_(groups), shell_of_side_(2 * brep.surfaces.size(), no_index) {
        for (std::uint32_t s = 0; s < shells.size(); ++s) {
            for (const auto& side : shells[s].sides) shell_of_side_[side_index(side.surface.value, side.front)] = s;
            several_ = several_ || shells[s].group != shells[0].group;
        }
    }

    /// The smallest shell with a volume, of another group, around a shell; or nothing.
    std::optional<std::size_t> around(const Shell& inner) {
        if (!several_ || !another_group_is_around(inner)) return std::nullopt;
        if (!ray_) ray_.emplace(brep_);
        // Points inside polygons, so that they are on no other shell even where the two touch.
        constexpr std::size_t attempts = 20;  // a polygon on another surface: there is no answer then
        std::size_t attempt = 0;
        for (const auto& side : inner.sides) {
            const auto& surface = brep_.surfaces[side.surface.value];
            for (std::size_t p = 0; p < surface.polygons.size() && attempt < attempts; ++p) {
                if (surface.polygons[p].size() < 3) continue;
                const auto above = ray_->above(point_inside(surface, p), [&](std::uint32_t s) { return groups_.root(s) != inner.group; });
                if (above) return smallest_around(*above);
                ++attempt;
            }
        }
        return std::nullopt;
    }

private:
    /// False only where no other group reaches around the whole group of a shell. Rays answer for very many groups.
    bool another_group_is_around(const Shell& inner) {
        constexpr std::size_t many = 1000;
        if (extents_.empty()) measure_groups();
        if (extents_.size() > many) return true;
        const Bounds& own = extents_.at(inner.group);
        return std::ranges::any_of(extents_, [&](const auto& other) {
            const auto& [group, extent] = other;
            bool around = group != inner.group;
            for (std::size_t k = 0; k < 3; ++k) around = around && extent.low[k] <= own.low[k] && own.high[k] <= extent.high[k];
            return around;
        });
    }

    void measure_groups() {
        for (const Shell& shell : shells_) {
            Bounds& extent = extents_[shell.group];
            for (const auto& side : shell.sides) {
                if (!side.front) continue;  // both sides have the same vertices
                for (const VertexId v : brep_.surfaces[side.surface.value].nodes) extent.add(brep_.vertices[v.value]);
            }
        }
    }

    Vec3 point_inside(const BrepData::Surface& surface, std::size_t p) const {
        const auto polygon = surface.polygons[p];
        const auto at = [&](std::size_t k) { return brep_.vertices[surface.nodes[polygon[k]].value]; };
        return plus(at(0), plus(times(0.37, minus(at(1), at(0))), times(0.29, minus(at(2), at(0)))));
    }

    std::optional<std::size_t> smallest_around(const std::vector<UpwardRay::Hit>& above) {
        std::map<std::uint32_t, int> passed;  // how often the way up leaves each shell with a volume
        for (const auto& hit : above) {
            for (const bool front : {false, true}) {
                const std::uint32_t shell = shell_of_side_[side_index(hit.surface, front)];
                if (shell != no_index && shells_[shell].volume > 0) passed[shell] += front ? -hit.sign : hit.sign;
            }
        }
        std::optional<std::size_t> best;
        for (const auto& [shell, times_left] : passed) {
            if (times_left > 0 && (!best || shells_[shell].volume < shells_[*best].volume)) best = shell;
        }
        return best;
    }

    const BrepData& brep_;
    const std::vector<Shell>& shells_;
    DisjointSets& groups_;
    std::vector<std::uint32_t> shell_of_side_;
    bool several_ = false;
    std::map<std::uint32_t, Bounds> extents_;  ///< around the vertices of each group, once asked for
    std::optional<UpwardRay> ray_;
};

}  // namespace

FoundRegions find_regions(const BrepData& brep, const LineGraph& graph, std::span<const double> cones, std::span<const double> tolerances) {
    FoundRegions found;
    DisjointSets sides(2 * brep.surfaces.size()), groups(brep.surfaces.size());
    std::vector<PolygonEdges> all_edges;
    for (const auto& surface : brep.surfaces) all_edges.emplace_back(surface.polygons);
    MinorPieces lesser(brep);
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        if (!join_around(brep, graph, all_edges, l, tolerances, lesser, found.joins)) found.uncertain_lines.emplace_back(l);
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
    Containment containment(brep, shells, groups);
    for (const Shell& shell : shells) {
        if (shell.volume > 0) continue;
        const auto around = containment.around(shell);
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
