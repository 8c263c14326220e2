// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/cut_by_wells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/bounds.h"
#include "base/length.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "geometry/closest_points.h"
#include "geometry/predicates.h"
#include "geometry/segment_tree.h"
#include "geometry/triangle_tree.h"
#include "topology/upward_ray.h"
#include "volume/surface_points.h"

namespace geomend::volumes {

namespace {

using WellEdge = std::array<std::uint32_t, 2>;

WellEdge well_edge(std::uint32_t a, std::uint32_t b) { return a < b ? WellEdge{a, b} : WellEdge{b, a}; }

/// A place on a triangle: at a corner, on an edge (from that corner on), or inside.
struct PlaceOnTriangle {
    enum class Part : std::uint8_t { corner, edge, inside };
    Part part = Part::inside;
    std::size_t number = 0;
    Vec3 place{};
};

/// A point of a triangle as its corner or on its edge where it is within the tolerance of that.
PlaceOnTriangle snapped(const std::array<Vec3, 3>& t, const Vec3& p, double tolerance) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (length(minus(p, t[k])) <= tolerance) return {PlaceOnTriangle::Part::corner, k, t[k]};
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const auto near = closest_points(Segment{t[k], t[(k + 1) % 3]}, Segment{p, p});
        if (near.distance > tolerance) continue;
        for (const std::size_t end : {k, (k + 1) % 3}) {
            if (length(minus(near.on_first, t[end])) <= tolerance) return {PlaceOnTriangle::Part::corner, end, t[end]};
        }
        return {PlaceOnTriangle::Part::edge, k, near.on_first};
    }
    return {PlaceOnTriangle::Part::inside, 0, p};
}

/// Where a segment meets a triangle, or comes within the tolerance of its corners and edges or with its own ends of itself.
std::vector<PlaceOnTriangle> meeting_places(const Segment& s, const std::array<Vec3, 3>& t, double tolerance) {
    std::vector<PlaceOnTriangle> places;
    std::array<bool, 3> near_corner{};
    for (std::size_t k = 0; k < 3; ++k) {
        near_corner[k] = closest_points(s, Segment{t[k], t[k]}).distance <= tolerance;
        if (near_corner[k]) places.push_back({PlaceOnTriangle::Part::corner, k, t[k]});
    }
    bool has_end = false;
    for (const Vec3& end : s) {
        const Closest near = closest_points(end, t);
        if (near.distance > tolerance) continue;
        has_end = true;
        places.push_back(snapped(t, near.on_second, tolerance));
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const Segment edge{t[k], t[next]};
        const auto near = closest_points(s, edge);
        if (near.distance > tolerance) continue;
        const auto ends_near = [&](const Segment& one, const Segment& other) {
            return closest_points(one, Segment{other[0], other[0]}).distance <= tolerance ||
                   closest_points(one, Segment{other[1], other[1]}).distance <= tolerance;
        };
        if (near_corner[k] || near_corner[next] || ends_near(edge, s)) continue;  // it meets the edge there
        places.push_back(snapped(t, near.on_second, tolerance));
    }
    if (has_end || !places.empty()) return places;
    const int first = orientation(t[0], t[1], t[2], s[0]), second = orientation(t[0], t[1], t[2], s[1]);
    if (first * second >= 0 || !meets(s, t)) return places;
    const Vec3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0])), a = minus(s[0], t[0]), b = minus(s[1], t[0]);
    const double from = dot(normal, a), to = dot(normal, b), share = from / (from - to);
    if (!(share >= 0 && share <= 1)) return places;
    places.push_back(snapped(t, plus(t[0], plus(a, times(share, minus(b, a)))), tolerance));
    return places;
}

/// Cuts the surfaces of a model by a network, and the network by them, until nothing is left to cut.
class WellCutter {
public:
    WellCutter(const BrepData& brep, const topology::FoundRegions& found, std::span<const WellPath> paths, double tolerance)
        : found_(found), tolerance_(tolerance), network_(network_of(paths, tolerance)) {
        cut_.brep = brep;
        for (const WellPath& path : paths) {
            WellChain& chain = cut_.chains.emplace_back();
            chain.name = path.name;
            for (std::size_t i = 0; i + 1 < path.points.size(); ++i) chain.length += length(minus(path.points[i + 1], path.points[i]));
        }
    }

    Result<CutByWells> run() {
        constexpr int most_rounds = 100;
        for (int round = 0;; ++round) {
            const SurfacePoints wanted = find_wanted();
            if (wanted.size() == 0) break;
            if (round == most_rounds)
                return failure(FailureKind::limit, "F026", {},
                               "a well does not come to rest on surface " + quoted(cut_.brep.surfaces[last_].name));
            cut_.brep = with_points(cut_.brep, wanted);
        }
        take_chains();
        return std::move(cut_);
    }

private:
    struct InTriangle {
        std::uint32_t surface;
        Triangle corners;
        auto operator<=>(const InTriangle&) const = default;
    };

    const topology::FoundRegions& found_;
    double tolerance_;
    WellNetwork network_;
    CutByWells cut_;
    std::map<std::uint32_t, std::uint32_t> point_of_, vertex_of_;  ///< vertex of the model to point of the network, and back
    std::map<WellEdge, std::set<std::uint32_t>> on_edges_;         ///< points of the network that are to be on an edge
    std::map<InTriangle, std::vector<std::uint32_t>> inside_;      ///< or in a triangle
    std::uint32_t last_ = 0;                                       ///< surface that was cut

    bool is_of_a_region(std::uint32_t surface) const {
        return found_.region_of_side[2 * std::size_t{surface}] != no_index ||
               found_.region_of_side[2 * std::size_t{surface} + 1] != no_index;
    }

    /// The point of the network that is a vertex of the model.
    std::uint32_t point_at_vertex(std::uint32_t vertex) {
        if (const auto known = point_of_.find(vertex); known != point_of_.end()) return known->second;
        const Vec3& place = cut_.brep.vertices[vertex];
        std::uint32_t point = network_.pool.find(place);
        if (point == no_index || vertex_of_.contains(point)) point = network_.pool.add_new(place);
        network_.pool.move(point, place);
        point_of_[vertex] = point;
        vertex_of_[point] = vertex;
        return point;
    }

    std::uint32_t point_at(std::uint32_t surface, const Triangle& corners, const PlaceOnTriangle& at) {
        if (at.part == PlaceOnTriangle::Part::corner) return point_at_vertex(corners[at.number]);
        const std::uint32_t point = network_.pool.add(at.place);
        if (vertex_of_.contains(point)) return point;
        last_ = surface;
        if (at.part == PlaceOnTriangle::Part::edge) on_edges_[well_edge(corners[at.number], corners[(at.number + 1) % 3])].insert(point);
        else inside_[{surface, corners}].push_back(point);
        return point;
    }

    /// Parts pieces where they meet surfaces. \return what these need as vertices for that
    SurfacePoints find_wanted() {
        std::vector<Triangle> triangles;
        std::vector<std::uint32_t> surfaces;
        for (std::uint32_t s = 0; s < cut_.brep.surfaces.size(); ++s) {
            if (!is_of_a_region(s)) continue;
            const auto& surface = cut_.brep.surfaces[s];
            for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
                const auto t = surface.polygons[p];
                triangles.push_back({surface.nodes[t[0]].value, surface.nodes[t[1]].value, surface.nodes[t[2]].value});
                surfaces.push_back(s);
            }
        }
        on_edges_.clear();
        inside_.clear();
        if (triangles.empty()) return {};
        const TriangleTree tree(cut_.brep.vertices, triangles);
        for (auto& chain : network_.chains) {
            std::vector<PointsAlong> along(chain.empty() ? 0 : chain.size() - 1);
            for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
                const Segment s{network_.pool.places()[chain[i]], network_.pool.places()[chain[i + 1]]};
                const Bounds around = bounds_around(s);
                tree.visit_triangles(tree.box(around.low, around.high, 2 * tolerance_), [&](std::size_t n) {
                    const std::uint32_t t = tree.number(n);
                    const std::array<Vec3, 3> corners{cut_.brep.vertices[triangles[t][0]], cut_.brep.vertices[triangles[t][1]],
                                                      cut_.brep.vertices[triangles[t][2]]};
                    for (const PlaceOnTriangle& at : meeting_places(s, corners, tolerance_)) {
                        along[i].emplace_back(share_along(s[0], s[1], at.place), point_at(surfaces[t], triangles[t], at));
                    }
                });
            }
            chain = with_points_along(chain, std::move(along));
        }
        return wanted();
    }

    /// One point for each triangle at a time, the one in the middle, so that no other lies on an edge which that makes.
    SurfacePoints wanted() const {
        SurfacePoints points;
        std::set<std::uint32_t> taken;
        for (const auto& [edge, of] : on_edges_) {
            for (const std::uint32_t point : of) {
                if (taken.insert(point).second) points.on_edges.push_back({edge, network_.pool.places()[point]});
            }
        }
        for (const auto& [triangle, of] : inside_) {
            const std::uint32_t point = of[of.size() / 2];
            if (taken.insert(point).second) points.inside.push_back({triangle.surface, triangle.corners, network_.pool.places()[point]});
        }
        return points;
    }

    std::set<WellEdge> surface_edges() const {
        std::set<WellEdge> edges;
        for (std::uint32_t s = 0; s < cut_.brep.surfaces.size(); ++s) {
            if (!is_of_a_region(s)) continue;
            const auto& surface = cut_.brep.surfaces[s];
            for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
                const auto t = surface.polygons[p];
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t a = surface.nodes[t[k]].value, b = surface.nodes[t[(k + 1) % 3]].value;
                    if (point_of_.contains(a) && point_of_.contains(b)) edges.insert(well_edge(a, b));
                }
            }
        }
        return edges;
    }

    /// The region that a point lies in, or no_index.
    std::uint32_t region_at(const topology::UpwardRay& ray, const Vec3& place) const {
        const auto hits = ray.above(place, [&](std::uint32_t s) { return is_of_a_region(s); });
        if (!hits) return no_index;
        std::map<std::uint32_t, int> times_left;
        for (const auto& hit : *hits) {
            const std::size_t left = 2 * std::size_t{hit.surface} + (hit.sign > 0 ? 0 : 1);
            ++times_left[found_.region_of_side[left]];
            --times_left[found_.region_of_side[left ^ 1u]];
        }
        times_left.erase(no_index);
        for (const auto& [region, times] : times_left) {
            if (times > 0) return region;
        }
        return no_index;
    }

    void take_chains() {
        const auto on_surfaces = surface_edges();
        const topology::UpwardRay ray(cut_.brep);
        std::set<InnerEdge> inner;
        std::vector<std::pair<std::uint32_t, Vec3>> more;  // points that become vertices
        std::uint32_t next = static_cast<std::uint32_t>(cut_.brep.vertices.size());
        const auto vertex = [&](std::uint32_t point) {
            const auto [found, is_new] = vertex_of_.emplace(point, next);
            if (is_new) more.emplace_back(next++, network_.pool.places()[point]);
            return found->second;
        };
        const auto is_of_model = vertex_of_;
        for (std::size_t c = 0; c < network_.chains.size(); ++c) {
            WellChain& chain = cut_.chains[c];
            std::set<WellEdge> taken;
            std::set<std::uint32_t> crossed;
            const auto& points = network_.chains[c];
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                const Vec3 &a = network_.pool.places()[points[i]], &b = network_.pool.places()[points[i + 1]];
                const auto first = is_of_model.find(points[i]), second = is_of_model.find(points[i + 1]);
                const bool on_one = first != is_of_model.end() && second != is_of_model.end() &&
                                    on_surfaces.contains(well_edge(first->second, second->second));
                const std::uint32_t region = on_one ? no_index : region_at(ray, times(0.5, plus(a, b)));
                if (!on_one && region == no_index) continue;
                const WellEdge edge{vertex(points[i]), vertex(points[i + 1])};
                if (!taken.insert(well_edge(edge[0], edge[1])).second) {
                    chain.repeated += length(minus(b, a));
                    continue;
                }
                chain.edges.push_back(edge);
                chain.inside += length(minus(b, a));
                if (on_one) ++chain.on_surfaces;
                else inner.insert({region, well_edge(edge[0], edge[1])});
                if (first != is_of_model.end()) crossed.insert(points[i]);
                if (second != is_of_model.end()) crossed.insert(points[i + 1]);
            }
            chain.crossings = crossed.size();
        }
        for (const auto& [number, place] : more) cut_.brep.vertices.push_back(place);
        cut_.inner.assign(inner.begin(), inner.end());
    }
};

}  // namespace

Result<CutByWells> cut_by_wells(const BrepData& brep, const topology::FoundRegions& found, std::span<const WellPath> paths,
                                double tolerance) {
    return WellCutter(brep, found, paths, tolerance).run();
}

}  // namespace geomend::volumes
