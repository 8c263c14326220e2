// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "base/vectors.h"
#include "geometry/box_tree.h"
#include "geometry/closest_points.h"
#include "repair/edit_contacts.h"
#include "repair/soup_edges.h"
#include "repair/soup_measures.h"

namespace geomend::repair {

namespace {

constexpr double cosine_of_corner = 0.766;  // 40 degrees: a border that turns by more has a corner
constexpr double least_slant = 0.05;        // sine between a border's direction and the controller that it could meet

Vec3 unit(const Vec3& v) { return times(1 / std::sqrt(dot(v, v)), v); }

/// Where controllers lie along a straight line.
class ControllerSearch {
public:
    explicit ControllerSearch(const SurfaceModel& model)
        : soup_(model.model.soup),
          interfaces_(interface_numbers(model)),
          tree_(triangle_boxes(soup_)),
          slack_(4 * model.lengths.tolerance) {}

    /// How far from a point a controller lies along a direction, backwards below 0: the nearest one within reach.
    /// \param direction unit
    /// Where there is none, the plane of one that lies beside the line, by at most a share of the reach: it may have to be lengthened, too.
    std::optional<double> along(const Vec3& from, const Vec3& direction, std::span<const std::uint32_t> controllers, double reach) const {
        const auto met = along(from, direction, controllers, reach, slack_);
        return met ? met : along(from, direction, controllers, reach, 0.2 * reach);
    }

private:
    std::optional<double> along(const Vec3& from, const Vec3& direction, std::span<const std::uint32_t> controllers, double reach,
                                double beside) const {
        BoxTree::Corners box;
        for (std::size_t k = 0; k < 3; ++k) {
            const double half = reach * std::abs(direction[k]) + beside;
            box[0][k] = from[k] - half;
            box[1][k] = from[k] + half;
        }
        struct Hit {
            double off, at;
        };
        std::optional<Hit> best;
        tree_.visit(box, -slack_, [&](std::uint32_t t) {
            if (!std::ranges::binary_search(controllers, interfaces_.of[soup_.patches[t]])) return;
            const auto hit = meets<Hit>(from, direction, t, beside);
            if (!hit || std::abs(hit->at) > reach) return;
            const auto key = [](const Hit& h) { return std::tuple(h.off, std::abs(h.at), h.at); };
            if (!best || key(*hit) < key(*best)) best = hit;
        });
        return best ? std::optional(best->at) : std::nullopt;
    }

    /// \return how far along, and how far beside the triangle: 0 within the slack
    template <class Hit>
    std::optional<Hit> meets(const Vec3& from, const Vec3& direction, std::uint32_t t, double beside) const {
        const Vec3 n = triangle_normal(soup_, t);
        const double length = std::sqrt(dot(n, n)), slant = dot(n, direction);
        if (!(std::abs(slant) > least_slant * length)) return std::nullopt;
        const auto& [a, b, c] = soup_.triangles[t];
        const std::array<Vec3, 3> triangle{soup_.vertices[a], soup_.vertices[b], soup_.vertices[c]};
        const double at = dot(n, minus(triangle[0], from)) / slant;
        const Vec3 point = plus(from, times(at, direction));
        const double off = closest_points(point, triangle).distance;
        if (off > beside) return std::nullopt;
        return Hit{off <= slack_ ? 0 : off, at};
    }

    const TriangleSoup& soup_;
    InterfaceNumbers interfaces_;
    BoxTree tree_;
    double slack_;
};

/// An edge of a patch's border as it lies in its triangle.
struct Border {
    std::uint32_t from, to, triangle, patch;
    Vec3 outward;                        ///< unit
    const EndingEdge* ending = nullptr;  ///< nullptr: it stays
};

/// A vertex of a border that is brought onto what its edges end on.
struct BorderEnd {
    std::uint32_t patch, vertex;
    std::vector<std::uint32_t> ending, staying;  ///< borders at it
};

/// The place of a vertex in directions that are not square to each other: \return v + s u + t w with (.. - v) u = a and (.. - v) w = b.
Vec3 mitre(const Vec3& v, const Vec3& u, double a, const Vec3& w, double b) {
    const double uw = dot(u, w), det = 1 - uw * uw;
    return plus(v, plus(times((a - b * uw) / det, u), times((b - a * uw) / det, w)));
}

class Extender {
public:
    Extender(SurfaceModel& model, std::span<const EndingEdge> endings, double reach)
        : m_(model), soup_(model.model.soup), endings_(endings), reach_(reach), search_(model) {
        find_borders();
        find_ends();
    }

    Extended extend() {
        for (const BorderEnd& end : ends_) gaps_.push_back(gap_of(end));
        look_between();
        spread();
        double farthest = 0;
        for (const Gap& gap : gaps_) farthest = std::max({farthest, gap.first, gap.second});
        beyond_ = 0.05 * farthest + 20 * m_.lengths.tolerance;
        done_.farthest = farthest;
        make_strips();
        return std::move(done_);
    }

private:
    /// How far an end is from its controllers along one or two directions.
    struct Gap {
        bool found = false;
        double first = 0, second = 0;
        Vec3 u{}, w{};
        bool two = false;
    };

    void find_borders() {
        std::map<std::array<std::uint32_t, 3>, const EndingEdge*> wanted;  // patch, low, high
        for (const EndingEdge& e : endings_) wanted[{e.patch, std::min(e.a, e.b), std::max(e.a, e.b)}] = &e;
        std::vector<std::uint8_t> ends(m_.model.patches.size(), 0);
        for (const EndingEdge& e : endings_) ends[e.patch] = 1;
        const SoupEdges edges = edges_of(soup_);
        for (std::size_t e = 0; e < edges.size(); ++e) {
            if (is_inner(soup_, edges[e])) continue;
            for (const auto& use : edges[e]) {
                const std::uint32_t patch = soup_.patches[use.triangle];
                const bool is_border =
                    std::ranges::count_if(edges[e], [&](const auto& other) { return soup_.patches[other.triangle] == patch; }) == 1;
                if (ends[patch] != 0 && is_border) add_border(use, wanted);
            }
        }
    }

    void add_border(const SoupEdges::Use& use, const std::map<std::array<std::uint32_t, 3>, const EndingEdge*>& wanted) {
        const Triangle& t = soup_.triangles[use.triangle];
        Border border{t[use.corner], t[(use.corner + 1u) % 3], use.triangle, soup_.patches[use.triangle], {}};
        const Vec3 along = minus(soup_.vertices[border.to], soup_.vertices[border.from]);
        const Vec3 inward = across(minus(soup_.vertices[t[(use.corner + 2u) % 3]], soup_.vertices[border.from]), along);
        if (!(dot(inward, inward) > 0)) return;
        border.outward = times(-1, unit(inward));
        const auto found = wanted.find({border.patch, use.low, use.high});
        if (found != wanted.end()) border.ending = found->second;
        borders_.push_back(border);
    }

    void find_ends() {
        for (std::uint32_t i = 0; i < borders_.size(); ++i) {
            for (const std::uint32_t v : {borders_[i].from, borders_[i].to}) {
                const auto [at, is_new] = end_of_.emplace(std::pair(borders_[i].patch, v), static_cast<std::uint32_t>(ends_.size()));
                if (is_new) ends_.push_back({borders_[i].patch, v, {}, {}});
                (borders_[i].ending != nullptr ? ends_[at->second].ending : ends_[at->second].staying).push_back(i);
            }
        }
    }

    Vec3 along_from(const Border& b, std::uint32_t v) const {  // unit, from its other end to v
        const std::uint32_t other = b.from == v ? b.to : b.from;
        return unit(minus(soup_.vertices[v], soup_.vertices[other]));
    }

    std::optional<double> look(const BorderEnd& end, const Vec3& direction, const Border& border) const {
        return search_.along(soup_.vertices[end.vertex], direction, border.ending->controllers, reach_);
    }

    /// Along the line of the neighbouring border, where it leads outwards; else square to the border that ends.
    Vec3 sliding(const BorderEnd& end, const Border& ending, const Border& neighbour) const {
        const Vec3 along = along_from(neighbour, end.vertex);
        return dot(along, ending.outward) > 0.2 ? along : ending.outward;
    }

    Gap along_one(const BorderEnd& end, const Border& border, const Vec3& direction) const {
        Gap gap;
        gap.u = direction;
        if (const auto at = look(end, direction, border)) {
            gap.found = true;
            gap.first = *at;
        }
        return gap;
    }

    Gap gap_of(const BorderEnd& end) const {
        if (end.ending.empty()) return {};
        const Border& one = borders_[end.ending[0]];
        if (end.ending.size() == 1) {
            if (end.staying.size() != 1) return along_one(end, one, one.outward);
            return along_one(end, one, sliding(end, one, borders_[end.staying[0]]));
        }
        const Border& other = borders_[end.ending[1]];
        const bool smooth = dot(one.outward, other.outward) > cosine_of_corner && one.ending->controllers == other.ending->controllers;
        if (end.ending.size() > 2 || smooth) return along_one(end, one, unit(plus(one.outward, other.outward)));
        return corner_gap(end, one, other);
    }

    bool is_there(double gap) const { return std::abs(gap) <= m_.lengths.tolerance; }

    Gap corner_gap(const BorderEnd& end, const Border& one, const Border& other) const {
        const auto a = look(end, one.outward, one), b = look(end, other.outward, other);
        // What is on one of its controllers already slides along it towards the other.
        if (b && is_there(*b)) return along_one(end, one, sliding(end, one, other));
        if (a && is_there(*a)) return along_one(end, other, sliding(end, other, one));
        if (!a && !b) return {};
        const double cosine = dot(one.outward, other.outward);
        if (!a || !b || std::abs(cosine) > 0.94) {
            Gap gap = a ? along_one(end, one, one.outward) : along_one(end, other, other.outward);
            return gap;
        }
        return {true, *a, *b, one.outward, other.outward, true};
    }

    /// A controller that is hollow as the border runs along it lies farther off between two ends than at them.
    void look_between() {
        for (const Border& b : borders_) {
            if (b.ending == nullptr) continue;
            for (const double share : {0.25, 0.5, 0.75}) {
                const Vec3 from = soup_.vertices[b.from], place = plus(from, times(share, minus(soup_.vertices[b.to], from)));
                const auto at = search_.along(place, b.outward, b.ending->controllers, reach_);
                if (!at || *at <= m_.lengths.tolerance / 64) continue;
                for (const std::uint32_t v : {b.from, b.to}) widen(gaps_[end_of_.at({b.patch, v})], b.outward, *at);
            }
        }
    }

    void widen(Gap& gap, const Vec3& outward, double least) const {
        if (!gap.found) return;
        const bool second = gap.two && dot(gap.w, outward) > dot(gap.u, outward);
        double& own = second ? gap.second : gap.first;
        const double slant = dot(second ? gap.w : gap.u, outward);
        if (slant > 0.1) own = std::max(own, least / slant);
    }

    /// Ends that found nothing go as far as the nearest one along the border that did.
    void spread() {
        for (bool again = true; again;) {
            again = false;
            std::vector<std::pair<std::uint32_t, double>> news;
            for (const Border& b : borders_) {
                if (b.ending == nullptr) continue;
                const std::uint32_t i = end_of_.at({b.patch, b.from}), j = end_of_.at({b.patch, b.to});
                if (gaps_[i].found && !gaps_[j].found) news.emplace_back(j, std::max(gaps_[i].first, gaps_[i].second));
                if (gaps_[j].found && !gaps_[i].found) news.emplace_back(i, std::max(gaps_[j].first, gaps_[j].second));
            }
            for (const auto& [i, gap] : news) {
                if (gaps_[i].found) gaps_[i].first = std::max(gaps_[i].first, gap);
                else gaps_[i] = {true, gap, 0, gaps_[i].two || dot(gaps_[i].u, gaps_[i].u) > 0 ? gaps_[i].u : first_outward(i), {}, false};
                again = true;
            }
        }
    }

    Vec3 first_outward(std::uint32_t i) const { return borders_[ends_[i].ending[0]].outward; }

    /// Where an end goes; nothing where it stays: it is on its controllers, or beyond them.
    std::optional<Vec3> target(std::uint32_t i) const {
        const Gap& gap = gaps_[i];
        const double least = m_.lengths.tolerance / 64;
        const double a = gap.first > least ? gap.first + beyond_ : 0, b = gap.two && gap.second > least ? gap.second + beyond_ : 0;
        if (!gap.found || (a == 0 && b == 0)) return std::nullopt;
        const Vec3& v = soup_.vertices[ends_[i].vertex];
        return gap.two ? mitre(v, gap.u, a, gap.w, b) : plus(v, times(a, gap.u));
    }

    bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c) const {
        const Vec3 u = minus(b, a), v = minus(c, a), w = minus(c, b), n = cross(u, v);
        const double longest = std::max({dot(u, u), dot(v, v), dot(w, w)}), low = m_.lengths.tolerance;
        return dot(n, n) <= low * low * longest;
    }

    void make_strips() {
        TriangleSoup made = soup_;
        Origin origin = identity_origin(soup_);
        std::vector<std::uint32_t> goes_to(ends_.size(), no_index);
        const auto target_of = [&](std::uint32_t v, const Border& b) {
            const std::uint32_t i = end_of_.at({b.patch, v});
            if (goes_to[i] != no_index) return goes_to[i];
            const auto place = target(i);
            if (!place) return goes_to[i] = v;
            done_.borders.push_back(v);
            Weights corner{};
            corner[static_cast<std::size_t>(std::ranges::find(soup_.triangles[b.triangle], v) - soup_.triangles[b.triangle].begin())] = 1;
            made.vertices.push_back(*place);
            origin.vertices.push_back(Origin::from_triangle(b.triangle, corner));
            return goes_to[i] = static_cast<std::uint32_t>(made.vertices.size() - 1);
        };
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, const Border& border) {
            if (is_flat(made.vertices[a], made.vertices[b], made.vertices[c])) return;  // an end that slid along the border
            made.triangles.push_back({a, b, c});
            made.patches.push_back(border.patch);
            origin.triangles.push_back(border.triangle);
            ++done_.triangles;
        };
        for (const Border& b : borders_) {
            if (b.ending == nullptr) continue;
            ++done_.edges;
            if (!gaps_[end_of_.at({b.patch, b.from})].found || !gaps_[end_of_.at({b.patch, b.to})].found) ++done_.left;
            const std::uint32_t from = target_of(b.from, b), to = target_of(b.to, b);
            if (from != b.from) add(b.to, b.from, from, b);
            if (to != b.to) add(b.to, from, to, b);
        }
        std::ranges::sort(done_.borders);
        done_.borders.erase(std::unique(done_.borders.begin(), done_.borders.end()), done_.borders.end());
        if (done_.triangles == 0) return;
        const auto first = static_cast<std::uint32_t>(soup_.triangles.size());
        take_soup(m_, std::move(made), origin);
        mark_added(m_, first);
    }

    SurfaceModel& m_;
    const TriangleSoup& soup_;
    std::span<const EndingEdge> endings_;
    double reach_, beyond_ = 0;
    ControllerSearch search_;
    std::vector<Border> borders_;
    std::vector<BorderEnd> ends_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> end_of_;  // patch, vertex -> into ends_
    std::vector<Gap> gaps_;
    Extended done_;
};

}  // namespace

Extended extend_endings(SurfaceModel& model, std::span<const EndingEdge> endings, double reach) {
    return Extender(model, endings, reach).extend();
}

}  // namespace geomend::repair
