// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/planar_cut.h"

#include <algorithm>
#include <cmath>

#include "arrangement/face_mesh.h"
#include "arrangement/link_table.h"
#include "arrangement/segment_contact.h"
#include "geometry/predicates.h"
#include "geometry/vectors.h"
#include "model/objects.h"

namespace geomend::arrangement {

namespace {

using Way = std::vector<std::uint32_t>;

void sort_links(std::vector<Link>& links) {
    std::sort(links.begin(), links.end());
    links.erase(std::unique(links.begin(), links.end()), links.end());
}

/// The sides of triangles, each once, as ways through points.
std::vector<Way> sides_of(std::span<const Triangle> wholes) {
    std::vector<Link> sides;
    for (const Triangle& t : wholes) {
        for (std::size_t i = 0; i < 3; ++i) sides.emplace_back(t[i], t[(i + 1) % 3]);
    }
    sort_links(sides);
    std::vector<Way> ways;
    for (const Link& s : sides) ways.push_back({s.a, s.b});
    return ways;
}

std::vector<Link> segments_of(const std::vector<Way>& ways) {
    std::vector<Link> segments;
    for (const Way& way : ways) {
        for (std::size_t i = 1; i < way.size(); ++i) segments.emplace_back(way[i - 1], way[i]);
    }
    sort_links(segments);
    return segments;
}

/// Points that stand on segments and points where segments cross, which are made.
class Look {
public:
    Look(SpacedPoints& points, std::span<const Link> segments, std::size_t axis, double reach)
        : points_(points), segments_(segments), axis_(axis), reach_(reach) {}

    std::vector<VertexOnEdge> run() {
        std::vector<Extent> extents;
        for (std::uint32_t s = 0; s < segments_.size(); ++s) {
            const auto [low, high] = std::minmax(at(segments_[s].a)[axis_], at(segments_[s].b)[axis_]);
            extents.push_back({low - reach_, high + reach_, s});
        }
        std::sort(extents.begin(), extents.end(),
                  [](const Extent& p, const Extent& q) { return p.low != q.low ? p.low < q.low : p.segment < q.segment; });
        std::vector<Extent> open;
        for (const Extent& next : extents) {
            std::erase_if(open, [&](const Extent& o) { return o.high < next.low; });
            for (const Extent& o : open) meet(segments_[std::min(o.segment, next.segment)], segments_[std::max(o.segment, next.segment)]);
            open.push_back(next);
        }
        for (const NewPoint& p : crossings_) {
            const std::uint32_t vertex = points_.add(p.position);
            if (!p.edge.has(vertex)) found_.push_back({p.edge, vertex});
            if (!p.other.has(vertex)) found_.push_back({p.other, vertex});
        }
        return std::move(found_);
    }

private:
    struct Extent {
        double low, high;
        std::uint32_t segment;
    };
    SpacedPoints& points_;
    std::span<const Link> segments_;
    std::size_t axis_;
    double reach_;
    std::vector<VertexOnEdge> found_;
    std::vector<NewPoint> crossings_;

    const Vec3& at(std::uint32_t v) const { return points_.points()[v]; }

    bool put_end_on(std::uint32_t v, const Link& s) {
        if (s.has(v) || !is_near_segment(at(v), at(s.a), at(s.b), reach_)) return false;
        found_.push_back({s, v});
        return true;
    }

    void meet(const Link& s, const Link& t) {
        bool touch = put_end_on(s.a, t);
        touch |= put_end_on(s.b, t);
        touch |= put_end_on(t.a, s);
        touch |= put_end_on(t.b, s);
        if (touch || s.has(t.a) || s.has(t.b)) return;
        NewPoint made{s, t};
        if (pass_near(at(s.a), at(s.b), at(t.a), at(t.b), 2 * reach_, made.position)) crossings_.push_back(made);
    }
};

void follow(const LinkTable& links, std::vector<Way>& ways) {
    Way longer;
    for (Way& way : ways) {
        longer.assign(1, way[0]);
        for (std::size_t i = 1; i < way.size(); ++i) {
            links.append(way[i - 1], way[i], longer);
            longer.push_back(way[i]);
        }
        std::swap(way, longer);
    }
}

/// Cuts the ways against each other. False where it does not end.
bool cut_ways(SpacedPoints& points, std::vector<Way>& ways, std::size_t axis, double reach) {
    constexpr unsigned most_looks = 60;
    for (unsigned look = 0; look < most_looks; ++look) {
        auto found = Look(points, segments_of(ways), axis, reach).run();
        if (found.empty()) return true;
        follow(LinkTable(points.points(), std::move(found)), ways);
    }
    return false;
}

/// The plane seen along the axis that its normal follows most.
struct View {
    unsigned axis = 2;
    int turn = 1;

    explicit View(const Vec3& normal) {
        if (std::abs(normal[0]) > std::abs(normal[axis])) axis = 0;
        if (std::abs(normal[1]) > std::abs(normal[axis])) axis = 1;
        turn = normal[axis] > 0 ? 1 : -1;
    }
};

/// All points of the segments in three far corners, and the segments as edges.
struct Net {
    std::vector<std::uint32_t> names;  ///< global numbers of points; the first three are the corners, which have none
    std::vector<Triangle> triangles;   ///< by places in the names

    bool make(std::span<const Vec3> points, std::span<const Link> segments, const Vec3& normal, double reach) {
        for (const Link& s : segments) names.insert(names.end(), {s.a, s.b});
        std::sort(names.begin(), names.end());
        names.erase(std::unique(names.begin(), names.end()), names.end());
        std::vector<Vec3> positions = far_corners(points, normal);
        for (const std::uint32_t v : names) positions.push_back(points[v]);
        names.insert(names.begin(), {no_index - 3, no_index - 2, no_index - 1});
        const std::vector<std::uint64_t> no_ways(names.size(), 0);
        const View view(normal);
        FaceMesh mesh;
        if (!mesh.begin(positions, names, no_ways, view.axis, view.turn, reach)) return false;
        for (std::uint32_t i = 3; i < names.size(); ++i) {
            if (!mesh.add_inside(i)) return false;
        }
        for (const Link& s : segments) {
            if (!mesh.fix(place_of(s.a), place_of(s.b))) return false;
        }
        triangles.assign(mesh.triangles().begin(), mesh.triangles().end());
        return true;
    }
    std::uint32_t place_of(std::uint32_t name) const {
        return static_cast<std::uint32_t>(std::lower_bound(names.begin() + 3, names.end(), name) - names.begin());
    }

private:
    std::vector<Vec3> far_corners(std::span<const Vec3> points, const Vec3& normal) const {
        constexpr double far = 16;  // extents
        Vec3 middle{};
        for (const std::uint32_t v : names) middle = plus(middle, times(1 / static_cast<double>(names.size()), points[v]));
        double extent = 1;
        for (const std::uint32_t v : names) extent = std::max(extent, length(minus(points[v], middle)));
        std::size_t least = 0;
        for (std::size_t k = 1; k < 3; ++k) least = std::abs(normal[k]) < std::abs(normal[least]) ? k : least;
        Vec3 axis{};
        axis[least] = 1;
        Vec3 u = cross(axis, normal);
        u = times(1 / length(u), u);
        const Vec3 v = cross(normal, u);
        const auto corner = [&](double x, double y) { return rounded(plus(middle, times(far * extent, plus(times(x, u), times(y, v))))); };
        return {corner(-1, -0.6), corner(1, -0.6), corner(0, 1.2)};
    }
};

/// What a border does, piece by piece: whoever crosses it from left to right is beneath one triangle less.
struct BorderPiece {
    std::uint32_t from, to, whole;
    auto operator<=>(const BorderPiece&) const = default;
};

std::vector<BorderPiece> borders_of(std::span<const Triangle> wholes, const std::vector<Way>& ways) {
    std::vector<BorderPiece> pieces;
    const auto is_before = [](const Way& way, const Link& side) { return Link(way.front(), way.back()) < side; };
    for (std::uint32_t t = 0; t < wholes.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = wholes[t][i], to = wholes[t][(i + 1) % 3];
            const Way& way = *std::lower_bound(ways.begin(), ways.end(), Link(from, to), is_before);
            for (std::size_t k = 1; k < way.size(); ++k) {
                if (from < to) pieces.push_back({way[k - 1], way[k], t});
                else pieces.push_back({way[k], way[k - 1], t});
            }
        }
    }
    std::sort(pieces.begin(), pieces.end());
    return pieces;
}

/// How often a triangle is wound around.
struct Winding {
    std::uint32_t whole;
    int times;
};

/// From outside to everywhere: which triangles each triangle of the net is beneath.
class Spread {
public:
    Spread(const Net& net, std::vector<BorderPiece> borders) : net_(net), borders_(std::move(borders)), windings_(net.triangles.size()) {
        for (std::uint32_t t = 0; t < net.triangles.size(); ++t) {
            for (std::size_t i = 0; i < 3; ++i) edges_.push_back({Link(net.triangles[t][i], net.triangles[t][(i + 1) % 3]), t});
        }
        std::sort(edges_.begin(), edges_.end(),
                  [](const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle; });
    }

    std::vector<std::vector<Winding>> run() {
        std::vector<std::uint8_t> seen(net_.triangles.size(), 0);
        std::vector<std::uint32_t> queue;
        for (std::uint32_t t = 0; t < seen.size() && queue.empty(); ++t) {
            if (std::ranges::find(net_.triangles[t], 0u) != net_.triangles[t].end()) queue.push_back(t);
        }
        if (!queue.empty()) seen[queue[0]] = 1;
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const std::uint32_t t = queue[i];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t other = across(t, k);
                if (other == no_index || seen[other] != 0) continue;
                seen[other] = 1;
                windings_[other] = beyond(t, net_.names[net_.triangles[t][k]], net_.names[net_.triangles[t][(k + 1) % 3]]);
                queue.push_back(other);
            }
        }
        return std::move(windings_);
    }

private:
    struct Side {
        Link edge;
        std::uint32_t triangle;
    };
    const Net& net_;
    std::vector<BorderPiece> borders_;
    std::vector<std::vector<Winding>> windings_;
    std::vector<Side> edges_;

    std::uint32_t across(std::uint32_t t, std::size_t k) const {
        const Link edge(net_.triangles[t][k], net_.triangles[t][(k + 1) % 3]);
        auto at = std::lower_bound(edges_.begin(), edges_.end(), edge, [](const Side& s, const Link& e) { return s.edge < e; });
        for (; at != edges_.end() && at->edge == edge; ++at) {
            if (at->triangle != t) return at->triangle;
        }
        return no_index;
    }

    /// The triangle lies to the left of the way from a to b; what is on the other side?
    std::vector<Winding> beyond(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
        std::vector<Winding> windings = windings_[t];
        const auto change = [&](std::uint32_t from, std::uint32_t to, int by) {
            auto at = std::lower_bound(borders_.begin(), borders_.end(), BorderPiece{from, to, 0});
            for (; at != borders_.end() && at->from == from && at->to == to; ++at) {
                const auto has = std::ranges::find(windings, at->whole, &Winding::whole);
                if (has == windings.end()) windings.push_back({at->whole, by});
                else has->times += by;
            }
        };
        change(a, b, -1);
        change(b, a, 1);
        std::erase_if(windings, [](const Winding& w) { return w.times == 0; });
        return windings;
    }
};

}  // namespace

std::optional<PlanarCut> cut_in_plane(SpacedPoints& points, std::span<const Triangle> wholes, const Vec3& normal, double reach) {
    auto ways = sides_of(wholes);
    const View view(normal);
    if (!cut_ways(points, ways, view.axis == 0 ? 1 : 0, reach)) return {};
    Net net;
    if (!net.make(points.points(), segments_of(ways), normal, reach)) return {};
    auto windings = Spread(net, borders_of(wholes, ways)).run();
    PlanarCut cut;
    for (std::size_t t = 0; t < net.triangles.size(); ++t) {
        if (windings[t].empty()) continue;
        std::ranges::sort(windings[t], {}, &Winding::whole);
        const Triangle& c = net.triangles[t];
        if (std::ranges::min(c) < 3) return {};
        cut.first.push_back(static_cast<std::uint32_t>(cut.covers.size()));
        cut.triangles.push_back({net.names[c[0]], net.names[c[1]], net.names[c[2]]});
        for (const Winding& w : windings[t]) cut.covers.push_back({w.whole, w.times < 0});
    }
    cut.first.push_back(static_cast<std::uint32_t>(cut.covers.size()));
    return cut;
}

}  // namespace geomend::arrangement
