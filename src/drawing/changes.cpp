// SPDX-License-Identifier: AGPL-3.0-or-later
#include "drawing/changes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace geomend {

namespace {

struct PlaceHash {
    static std::uint64_t mixed(std::uint64_t h) {
        h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
        return h ^ h >> 27;
    }
    std::size_t operator()(const Vec3& p) const {
        std::uint64_t h = 0;
        for (const double v : p) h = mixed(h ^ std::bit_cast<std::uint64_t>(v + 0.0));  // -0 is 0
        return h;
    }
    std::size_t operator()(const std::pair<std::uint32_t, Vec3>& place) const { return mixed((*this)(place.second) + place.first); }
    std::size_t operator()(const std::array<Vec3, 2>& edge) const { return mixed((*this)(edge[0])) ^ (*this)(edge[1]); }
    std::size_t operator()(const std::array<Vec3, 3>& t) const { return mixed(mixed((*this)(t[0])) ^ (*this)(t[1])) ^ (*this)(t[2]); }
};

template <std::size_t N>
std::array<Vec3, N> in_order(std::array<Vec3, N> places) {
    std::ranges::sort(places);
    return places;
}

/// Changes by place.
class Places {
public:
    explicit Places(const repair::ModelChanges& changes) {
        for (std::uint32_t s = 0; s < changes.surfaces.size(); ++s) number_.emplace(changes.surfaces[s], s);
        for (const auto& m : changes.moved) {
            double& by = moved_[{m.surface, m.at}];
            by = std::max(by, m.by);
        }
        for (const auto& t : changes.added) added_.emplace(in_order(t), true);
        for (const auto& line : changes.lines)
            lines_.emplace(in_order(std::array{line.from, line.to}), line.joined ? PartChange::joined : PartChange::cut);
    }

    /// How far the points of a part moved, which is of a surface of that name; nothing where none did.
    std::vector<float> moved(const std::vector<Vec3>& points, std::string_view surface) const {
        auto of = number_.find(surface);
        if (of == number_.end()) of = number_.find(std::string_view());  // of anything
        std::vector<float> by;
        if (of == number_.end() || moved_.empty()) return by;
        bool any = false;
        for (const Vec3& p : points) {
            const auto found = moved_.find({of->second, p});
            by.push_back(found == moved_.end() ? 0.0f : static_cast<float>(found->second));
            any |= found != moved_.end();
        }
        return any ? by : std::vector<float>();
    }
    bool adds() const { return !added_.empty(); }
    bool is_added(const Vec3& a, const Vec3& b, const Vec3& c) const { return added_.contains(in_order(std::array{a, b, c})); }
    bool has_lines() const { return !lines_.empty(); }
    PartChange line(const Vec3& a, const Vec3& b) const {
        const auto found = lines_.find(in_order(std::array{a, b}));
        return found == lines_.end() ? PartChange::none : found->second;
    }

private:
    std::unordered_map<std::string_view, std::uint32_t> number_;
    std::unordered_map<std::pair<std::uint32_t, Vec3>, double, PlaceHash> moved_;
    std::unordered_map<std::array<Vec3, 3>, bool, PlaceHash> added_;
    std::unordered_map<std::array<Vec3, 2>, PartChange, PlaceHash> lines_;
};

/// A part like another one, without anything in it.
ScenePart empty_like(const ScenePart& part, PartChange change) {
    ScenePart made;
    made.kind = part.kind;
    made.name = part.name;
    made.id = part.id;
    made.role = part.role;
    made.change = change;
    return made;
}

/// Takes elements over with their points, each point once.
class PointTaker {
public:
    PointTaker(const ScenePart& from, ScenePart& to) : from_(from), to_(to), number_(from.points.size(), no_index) {}

    std::uint32_t operator()(std::uint32_t point) {
        if (number_[point] == no_index) {
            number_[point] = static_cast<std::uint32_t>(to_.points.size());
            to_.points.push_back(from_.points[point]);
        }
        return number_[point];
    }

private:
    const ScenePart& from_;
    ScenePart& to_;
    std::vector<std::uint32_t> number_;
};

/// The triangles of a part that were added, which leave it; the part itself is marked where all were.
void part_added(ScenePart& part, const Places& places, std::vector<ScenePart>& more) {
    ScenePart added = empty_like(part, PartChange::added);
    PointTaker take(part, added);
    std::vector<std::array<std::uint32_t, 3>> left;
    for (const auto& t : part.triangles) {
        const auto& [a, b, c] = t;
        if (places.is_added(part.points[a], part.points[b], part.points[c])) added.triangles.push_back({take(a), take(b), take(c)});
        else left.push_back(t);
    }
    if (added.triangles.empty()) return;
    if (left.empty() && part.polylines.empty()) {
        part.change = PartChange::added;
        return;
    }
    part.triangles = std::move(left);
    more.push_back(std::move(added));
}

/// The edges of a line that are new, which leave it.
void part_lines(ScenePart& part, const Places& places, std::vector<ScenePart>& more) {
    std::array<ScenePart, 2> made{empty_like(part, PartChange::cut), empty_like(part, PartChange::joined)};
    std::array<PointTaker, 2> take{PointTaker(part, made[0]), PointTaker(part, made[1])};
    std::vector<std::vector<std::uint32_t>> left;
    for (const auto& line : part.polylines) {
        PartChange last = PartChange::none;
        bool any = false;
        for (std::size_t i = 1; i < line.size(); ++i) {
            const PartChange change = places.line(part.points[line[i - 1]], part.points[line[i]]);
            const bool goes_on = any && change == last;
            any = true;
            last = change;
            if (change == PartChange::none) {
                if (!goes_on) left.push_back({line[i - 1]});
                left.back().push_back(line[i]);
                continue;
            }
            const std::size_t n = change == PartChange::cut ? 0 : 1;
            if (!goes_on) made[n].polylines.push_back({take[n](line[i - 1])});
            made[n].polylines.back().push_back(take[n](line[i]));
        }
    }
    bool any = false;
    for (ScenePart& own : made) {
        if (own.polylines.empty()) continue;
        any = true;
        if (left.empty() && own.polylines.size() == part.polylines.size() && &own == &made[0] && made[1].polylines.empty()) {
            part.change = PartChange::cut;
            return;
        }
        more.push_back(std::move(own));
    }
    if (any) part.polylines = std::move(left);
}

/// Per part that is a surface of a boundary representation the name of its interface.
std::vector<std::string_view> interface_names(std::span<const Brep> breps, const std::vector<ScenePart>& parts) {
    std::vector<std::string_view> names(parts.size());
    for (std::size_t p = 0; p < parts.size(); ++p) names[p] = parts[p].name;
    std::size_t first = 0;
    for (const Brep& brep : breps) {
        for (std::size_t s = 0; s < brep->surfaces.size() && first + s < parts.size(); ++s) {
            const auto& surface = brep->surfaces[s];
            if (surface.interface_id.valid()) names[first + s] = brep->interfaces[surface.interface_id.value].name;
        }
        first += brep->surfaces.size() + brep->lines.size() + brep->corners.size();
    }
    return names;
}

ScenePart part_of(const repair::ModelChanges::Removed& removed) {
    ScenePart part;
    part.kind = "surface";
    part.name = removed.surface;
    part.change = PartChange::removed;
    part.points = removed.piece.points;
    part.triangles = removed.piece.triangles;
    return part;
}

ScenePart part_of(const std::vector<std::array<Vec3, 2>>& erased) {
    ScenePart part;
    part.kind = "line";
    part.name = "erased";
    part.change = PartChange::erased;
    for (const auto& [from, to] : erased) {
        const auto n = static_cast<std::uint32_t>(part.points.size());
        part.points.insert(part.points.end(), {from, to});
        part.polylines.push_back({n, n + 1});
    }
    return part;
}

}  // namespace

void mark_changes(Scene& scene, std::span<const Brep> breps, const repair::ModelChanges& changes) {
    const Places places(changes);
    const auto names = interface_names(breps, scene.parts);
    std::vector<ScenePart> more;
    for (std::size_t p = 0; p < scene.parts.size(); ++p) {
        ScenePart& part = scene.parts[p];
        if (part.triangles.empty() && part.polylines.empty()) continue;
        if (!part.triangles.empty() && places.adds()) part_added(part, places, more);
        if (part.change == PartChange::none && !part.triangles.empty()) part.moved = places.moved(part.points, names[p]);
        if (part.triangles.empty() && places.has_lines()) part_lines(part, places, more);
    }
    std::erase_if(scene.parts, [](const ScenePart& part) { return part.kind == "line" && part.polylines.empty(); });
    std::ranges::move(more, std::back_inserter(scene.parts));
}

ReportedChanges reported_changes(Scene before, const repair::ModelChanges& changes) {
    ReportedChanges reported;
    reported.vertices = changes.vertices;
    reported.moved = changes.moved_vertices;
    reported.largest = changes.largest;
    reported.mean = changes.mean;
    reported.added = changes.added.size();
    const auto joined = std::ranges::count_if(changes.lines, [](const auto& line) { return line.joined; });
    reported.joined_edges = static_cast<std::uint64_t>(joined);
    reported.cut_edges = changes.lines.size() - reported.joined_edges;
    for (const auto& removed : changes.removed) {
        ScenePart part = part_of(removed);
        before.parts.push_back(part);
        reported.removed.push_back({std::string(removed.piece.step),
                                    std::string(repair::word_of(removed.piece.why)),
                                    std::string(repair::reason_of(removed.piece.why)),
                                    std::move(part),
                                    {}});
    }
    if (!changes.erased_edges.empty()) before.parts.push_back(part_of(changes.erased_edges));
    finish(before);
    reported.before = std::move(before);
    return reported;
}

}  // namespace geomend
