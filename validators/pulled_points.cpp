// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/pulled_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "geometry/vectors.h"
#include "validators/stacked_points.h"

namespace geomend::validators {

namespace {

const std::vector<Vec3>* points_of(const Object& object) {
    if (const auto* surface = std::get_if<Surface>(&object)) return &surface->points;
    if (const auto* mesh = std::get_if<CellMesh>(&object)) return &mesh->points;
    return nullptr;
}

std::vector<Vec3>* points_of(Object& object) { return const_cast<std::vector<Vec3>*>(points_of(std::as_const(object))); }

/// Calls with the points of each polygon or cell of an object.
template <class Visit>
void each_element(const Object& object, const Visit& visit) {
    if (const auto* surface = std::get_if<Surface>(&object)) {
        for (std::size_t p = 0; p < surface->polygons.size(); ++p) visit(surface->polygons[p]);
    } else if (const auto* mesh = std::get_if<CellMesh>(&object)) {
        for (std::size_t c = 0; c < mesh->cell_count(); ++c) visit(mesh->cell_nodes(c));
    }
}

/// Where points lie on the map.
struct Bounds2 {
    double low[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    double high[2] = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

    void add(const Vec3& p) {
        for (std::size_t x = 0; x < 2; ++x) {
            low[x] = std::min(low[x], p[x]);
            high[x] = std::max(high[x], p[x]);
        }
    }
    /// No farther away than they are wide.
    bool has_near(const Vec3& p) const {
        const double wide = std::max(high[0] - low[0], high[1] - low[1]);
        return wide >= 0 && p[0] >= low[0] - wide && p[0] <= high[0] + wide && p[1] >= low[1] - wide && p[1] <= high[1] + wide;
    }
};

/// An outlying position and where it is to go.
struct Outlier {
    Vec3 at{}, place{};
    bool height_only = false, placed = false, fixed = false;
    std::set<std::uint32_t> objects;   ///< that have a point there
    std::vector<Vec3> joined, border;  ///< positions that elements, and free borders, join it with
    /// Positions at the same place of the map in other objects, with what edges join these to: borders of faces, and others.
    std::vector<std::pair<Vec3, Vec3>> offered, offered_within;
};

/// Finds places for outlying positions.
class Places {
public:
    Places(const Dataset& dataset, std::span<const std::uint32_t> objects, std::map<Vec3, bool> outlying)
        : dataset_(dataset), objects_(objects) {
        for (const auto& [at, usual] : outlying) {
            Outlier one;
            one.at = at;
            one.height_only = usual;
            index_.emplace(at, outliers_.size());
            outliers_.push_back(std::move(one));
        }
        join();
        look_at_map();
        offer_keys();
        offer_edges();
        while (place_some()) {
        }
        smooth();
    }

    void move(Vec3& p) const {
        const auto found = index_.find(p);
        if (found != index_.end() && outliers_[found->second].placed) p = outliers_[found->second].place;
    }

private:
    static constexpr int most_smoothing = 200;

    const Dataset& dataset_;
    std::span<const std::uint32_t> objects_;
    std::vector<Outlier> outliers_;
    std::map<Vec3, std::size_t> index_;
    std::map<std::array<double, 2>, std::vector<std::size_t>> on_map_;  // those of which only the height is wrong

    Outlier* find(const Vec3& p) {
        const auto found = index_.find(p);
        return found == index_.end() ? nullptr : &outliers_[found->second];
    }
    /// Where a position is, or has been put; nothing where it has no place yet.
    const Vec3* known(const Vec3& p) const {
        const auto found = index_.find(p);
        if (found == index_.end()) return &p;
        return outliers_[found->second].placed ? &outliers_[found->second].place : nullptr;
    }

    void join();
    void join_borders(const Surface& surface);
    void look_at_map();
    void offer_keys();
    void offer_edges();
    void offer(std::uint32_t object, const std::map<std::array<Vec3, 2>, int>& uses);
    std::optional<Vec3> on_others(const Outlier& one, std::span<const std::pair<Vec3, Vec3>> offered, double height) const;
    std::optional<Vec3> middle(const Outlier& one) const;
    bool place_some();
    void smooth();
};

/// Collects what each is joined with.
void Places::join() {
    for (const std::uint32_t o : objects_) {
        const std::vector<Vec3>& points = *points_of(dataset_.objects[o]);
        each_element(dataset_.objects[o], [&](std::span<const std::uint32_t> element) {
            for (const std::uint32_t a : element) {
                Outlier* one = find(points[a]);
                if (one == nullptr) continue;
                one->objects.insert(o);
                for (const std::uint32_t b : element) {
                    if (points[b] != points[a]) one->joined.push_back(points[b]);
                }
            }
        });
        if (const auto* surface = std::get_if<Surface>(&dataset_.objects[o])) join_borders(*surface);
    }
}

/// Collects the edges that one polygon of a surface alone has.
void Places::join_borders(const Surface& surface) {
    std::map<std::array<Vec3, 2>, int> uses;
    const auto& points = surface.points;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto polygon = surface.polygons[p];
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec3 &a = points[polygon[i]], &b = points[polygon[(i + 1) % polygon.size()]];
            if (index_.contains(a) || index_.contains(b)) ++uses[{std::min(a, b), std::max(a, b)}];
        }
    }
    for (const auto& [ends, count] : uses) {
        for (std::size_t i = 0; count == 1 && i < 2; ++i) {
            if (Outlier* one = find(ends[i])) one->border.push_back(ends[1 - i]);
        }
    }
}

/// Finds those of which only the height is wrong: on the map they lie within the object, or no farther from it than it is wide.
void Places::look_at_map() {
    for (const std::uint32_t o : objects_) {
        Bounds2 bounds;
        for (const Vec3& p : *points_of(dataset_.objects[o])) {
            if (!index_.contains(p)) bounds.add(p);
        }
        for (Outlier& one : outliers_) {
            if (one.objects.contains(o) && bounds.has_near(one.at)) one.height_only = true;
        }
    }
    for (std::size_t i = 0; i < outliers_.size(); ++i) {
        if (outliers_[i].height_only) on_map_[{outliers_[i].at[0], outliers_[i].at[1]}].push_back(i);
    }
}

/// A key triangle of the surface that lacks nothing but the height of a vertex has that height.
void Places::offer_keys() {
    const auto same_place = [](const Vec3& a, const Vec3& b) { return a[0] == b[0] && a[1] == b[1]; };
    for (const StatedModel& model : dataset_.models) {
        for (const auto& face : model.faces) {
            for (std::size_t i = 0; face.key && i < 3; ++i) {
                const Vec3& corner = (*face.key)[i];
                const auto here = on_map_.find({corner[0], corner[1]});
                if (here == on_map_.end() || index_.contains(corner)) continue;
                for (const std::size_t k : here->second) {
                    Outlier& one = outliers_[k];
                    const auto joined = [&](const Vec3& other) {
                        return std::ranges::any_of(
                            one.joined, [&](const Vec3& p) { return p == other || (index_.contains(p) && same_place(p, other)); });
                    };
                    if (!one.objects.contains(face.object) || !joined((*face.key)[(i + 1) % 3]) || !joined((*face.key)[(i + 2) % 3]))
                        continue;
                    one.place = corner;
                    one.placed = one.fixed = true;
                }
            }
        }
    }
}

/// Collects the edges of other objects that end above or below outlying points.
void Places::offer_edges() {
    for (std::uint32_t o = 0; o < dataset_.objects.size(); ++o) {
        const auto* surface = std::get_if<Surface>(&dataset_.objects[o]);
        if (surface == nullptr) continue;
        std::map<std::array<Vec3, 2>, int> uses;  // by one part, from where they end there
        std::size_t part = 0;
        for (std::size_t p = 0; p < surface->polygons.size(); ++p) {
            if (part + 1 < surface->parts.size() && p >= surface->parts[part + 1].first_polygon) {
                offer(o, uses);
                uses.clear();
                while (part + 1 < surface->parts.size() && p >= surface->parts[part + 1].first_polygon) ++part;
            }
            const auto polygon = surface->polygons[p];
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Vec3 &a = surface->points[polygon[i]], &b = surface->points[polygon[(i + 1) % polygon.size()]];
                if (on_map_.contains({a[0], a[1]})) ++uses[{a, b}];
                if (on_map_.contains({b[0], b[1]})) ++uses[{b, a}];
            }
        }
        offer(o, uses);
    }
}

void Places::offer(std::uint32_t object, const std::map<std::array<Vec3, 2>, int>& uses) {
    for (const auto& [edge, count] : uses) {
        if (index_.contains(edge[0])) continue;
        for (const std::size_t k : on_map_.at({edge[0][0], edge[0][1]})) {
            Outlier& one = outliers_[k];
            if (!one.objects.contains(object)) (count == 1 ? one.offered : one.offered_within).emplace_back(edge[0], edge[1]);
        }
    }
}

/// A point of a border goes where edges of other surfaces lead from all its neighbours on that border: on the line that they share.
/// Of several such positions the one nearest to a height.
std::optional<Vec3> Places::on_others(const Outlier& one, std::span<const std::pair<Vec3, Vec3>> offered, double height) const {
    std::map<Vec3, std::set<Vec3>> from;
    for (const auto& [position, other] : offered) from[position].insert(other);
    std::optional<Vec3> best;
    for (const auto& [position, others] : from) {
        bool any = false, all = true;
        for (const Vec3& neighbour : one.border) {
            const Vec3* there = known(neighbour);
            if (there == nullptr) continue;
            any = true;
            all = all && others.contains(*there);
        }
        if (any && all && (!best || std::abs(position[2] - height) < std::abs((*best)[2] - height))) best = position;
    }
    return best;
}

/// The middle of what it is joined with and is known; taken relative to the first, so that map coordinates cost no digits.
std::optional<Vec3> Places::middle(const Outlier& one) const {
    const Vec3* first = nullptr;
    Vec3 sum{};
    std::uint64_t count = 0;
    for (const Vec3& other : one.joined) {
        const Vec3* p = known(other);
        if (p == nullptr) continue;
        if (first == nullptr) first = p;
        sum = plus(sum, minus(*p, *first));
        ++count;
    }
    if (count == 0) return std::nullopt;
    Vec3 at = plus(*first, times(1.0 / static_cast<double>(count), sum));
    if (one.height_only) at = {one.at[0], one.at[1], at[2]};
    return at;
}

/// One round: those that are joined with something known. Where others offer places for points of a border, these wait for their
/// neighbours on the border, as long as any gets a place.
/// \return false where none got a place
bool Places::place_some() {
    std::vector<std::pair<std::size_t, Vec3>> found, waiting;
    std::vector<std::size_t> fixed;
    for (std::size_t i = 0; i < outliers_.size(); ++i) {
        const Outlier& one = outliers_[i];
        if (one.placed) continue;
        const auto between = middle(one);
        if (!between) continue;
        auto shared = on_others(one, one.offered, (*between)[2]);
        if (!shared) shared = on_others(one, one.offered_within, (*between)[2]);
        if (shared) fixed.push_back(i);
        const bool may_come = !shared && !one.border.empty() && !(one.offered.empty() && one.offered_within.empty());
        (may_come ? waiting : found).emplace_back(i, shared ? *shared : *between);
    }
    if (found.empty()) found = std::move(waiting);
    for (const auto& [i, place] : found) {
        outliers_[i].place = place;
        outliers_[i].placed = true;
    }
    for (const std::size_t i : fixed) outliers_[i].fixed = true;
    return !found.empty();
}

/// Evens heights out between the known ones.
void Places::smooth() {
    for (int round = 0; round < most_smoothing; ++round) {
        double moved = 0, size = 0;
        for (Outlier& one : outliers_) {
            if (!one.placed || one.fixed || !one.height_only) continue;
            const double z = (*middle(one))[2];
            moved = std::max(moved, std::abs(z - one.place[2]));
            size = std::max(size, std::abs(z));
            one.place[2] = z;
        }
        if (moved <= 1e-6 * size) break;
    }
}

}  // namespace

std::optional<Dataset> with_outlying_points_pulled_in(const Dataset& dataset, const topology::LocalLengths& lengths) {
    if (lengths.outlying.empty()) return std::nullopt;
    Dataset pulled = dataset;
    part_stacked_points(pulled, lengths.outlying);
    std::map<Vec3, bool> outlying;
    for (const auto& one : lengths.outlying) outlying.emplace((*points_of(pulled.objects[one.object]))[one.point], one.usual);
    std::vector<std::uint32_t> objects;  // with a point at such a position
    for (std::uint32_t o = 0; o < pulled.objects.size(); ++o) {
        const auto* points = points_of(pulled.objects[o]);
        if (points != nullptr && std::ranges::any_of(*points, [&](const Vec3& p) { return outlying.contains(p); })) objects.push_back(o);
    }
    const Places places(pulled, objects, std::move(outlying));
    const auto move = [&](Vec3& p) { places.move(p); };
    for (const std::uint32_t o : objects) std::ranges::for_each(*points_of(pulled.objects[o]), move);
    for (StatedModel& model : pulled.models) {
        for (auto& face : model.faces) {
            if (face.key) std::ranges::for_each(*face.key, move);
        }
    }
    return pulled;
}

}  // namespace geomend::validators
