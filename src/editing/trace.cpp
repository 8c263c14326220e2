// SPDX-License-Identifier: AGPL-3.0-or-later
#include "editing/trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "base/vectors.h"
#include "model/objects.h"

namespace geomend::editing {

namespace {

/// The triangles at a vertex that hang together over edges inside of one patch.
struct Fan {
    std::vector<std::uint32_t> ring;       ///< vertices, in the order in which the first triangle turns
    std::vector<std::uint32_t> triangles;  ///< triangle i lies between places i and i + 1
    bool closed = false;
};

/// An edge of a vertex, as one of its triangles has it.
struct Spoke {
    std::uint32_t end, triangle, other;  ///< other: the third vertex of the triangle
    auto operator<=>(const Spoke&) const = default;
};

std::vector<Spoke> spokes_of(const SoupMesh& mesh, std::uint32_t v) {
    std::vector<Spoke> spokes;
    for (const std::uint32_t t : mesh.around(v)) {
        const Triangle& tri = mesh.triangle(t);
        const auto k = static_cast<std::size_t>(std::ranges::find(tri, v) - tri.begin());
        const std::uint32_t a = tri[(k + 1) % 3], b = tri[(k + 2) % 3];
        spokes.push_back({a, t, b});
        spokes.push_back({b, t, a});
    }
    std::ranges::sort(spokes);
    return spokes;
}

/// The star of a vertex in fans, and the ends of the line edges in it.
class Star {
public:
    Star(const SoupMesh& mesh, std::uint32_t v) : mesh_(mesh), v_(v), spokes_(spokes_of(mesh, v)) {
        for (std::size_t i = 0; i < spokes_.size();) {
            std::size_t j = i;
            while (j < spokes_.size() && spokes_[j].end == spokes_[i].end) ++j;
            if (!is_inner(i, j)) line_ends_.push_back(spokes_[i].end);
            i = j;
        }
    }

    std::span<const std::uint32_t> line_ends() const { return line_ends_; }

    /// False where triangles hang together in no simple way: one twice, or one with the vertex twice.
    bool make_fans() {
        std::vector<std::uint32_t> starts;
        for (const Spoke& s : spokes_) {
            if (is_line_end(s.end)) starts.push_back(s.triangle);
        }
        for (const std::uint32_t t : mesh_.around(v_)) starts.push_back(t);
        for (const std::uint32_t t : starts) {
            if (!is_done(t) && !walk(t)) return false;
        }
        return true;
    }
    std::vector<Fan>& fans() { return fans_; }

private:
    bool is_inner(std::size_t i, std::size_t j) const {
        return j == i + 2 && mesh_.patch(spokes_[i].triangle) == mesh_.patch(spokes_[i + 1].triangle) &&
               spokes_[i].triangle != spokes_[i + 1].triangle;
    }
    bool is_line_end(std::uint32_t end) const { return std::ranges::binary_search(line_ends_, end); }
    bool is_done(std::uint32_t t) const { return std::ranges::find(done_, t) != done_.end(); }

    std::uint32_t across(std::uint32_t t, std::uint32_t end) const {
        for (auto s = std::ranges::lower_bound(spokes_, end, {}, &Spoke::end); s != spokes_.end() && s->end == end; ++s) {
            if (s->triangle != t) return s->triangle;
        }
        return no_index;
    }

    std::uint32_t third(std::uint32_t t, std::uint32_t end) const {
        for (const std::uint32_t v : mesh_.triangle(t)) {
            if (v != end && v != v_) return v;
        }
        return no_index;
    }

    bool walk(std::uint32_t start) {
        const Triangle& tri = mesh_.triangle(start);
        const auto k = static_cast<std::size_t>(std::ranges::find(tri, v_) - tri.begin());
        std::uint32_t from = tri[(k + 1) % 3];
        const std::uint32_t second = tri[(k + 2) % 3];
        const bool backwards = is_line_end(second) && !is_line_end(from);  // the fan begins at its end
        if (backwards) from = second;
        Fan fan;
        fan.ring.push_back(from);
        for (std::uint32_t t = start, end = from;;) {
            if (t == no_index || is_done(t)) return false;
            done_.push_back(t);
            fan.triangles.push_back(t);
            end = third(t, end);
            if (end == no_index) return false;
            if (end == from) {
                fan.closed = !is_line_end(end);
                if (!fan.closed || fan.ring.size() < 3) return false;
                break;
            }
            fan.ring.push_back(end);
            if (is_line_end(end)) break;
            t = across(t, end);
            if (t == start) return false;
        }
        if (backwards) {
            std::ranges::reverse(fan.ring);
            std::ranges::reverse(fan.triangles);
        }
        fans_.push_back(std::move(fan));
        return true;
    }

    const SoupMesh& mesh_;
    std::uint32_t v_;
    std::vector<Spoke> spokes_;
    std::vector<std::uint32_t> line_ends_, done_;
    std::vector<Fan> fans_;
};

bool runs_straight(const Vec3& a, const Vec3& v, const Vec3& b, double distance) {
    const Vec3 before = minus(v, a), after = minus(b, v);
    if (!(dot(before, after) > 0)) return false;
    const Vec3 off = across(before, minus(b, a));
    return dot(off, off) <= distance * distance;
}

bool are_of_one_surface(const SoupMesh& mesh, const std::vector<Fan>& fans, const TraceRules& rules) {
    const auto surface = [&](const Fan& fan) {
        const std::uint32_t patch = mesh.patch(fan.triangles.front());
        return rules.surfaces.empty() ? patch : rules.surfaces[patch];
    };
    return std::ranges::all_of(fans, [&](const Fan& fan) { return surface(fan) == surface(fans.front()); });
}

using Filling = std::vector<std::array<std::uint32_t, 3>>;

std::optional<Filling> filling_of(const SoupMesh& mesh, std::uint32_t v, const Fan& fan, const TraceRules& rules,
                                  std::span<const std::uint8_t> on_trace) {
    if (fan.ring.size() < 3 || fan.ring.size() > longest_ring) return std::nullopt;
    Ring ring;
    ring.closed = fan.closed;
    for (const std::uint32_t w : fan.ring) {
        ring.places.push_back(mesh.place(w));
        ring.on_trace.push_back(on_trace[w]);
    }
    return fill_ring(ring, mesh.place(v), rules.rings,
                     [&](std::uint32_t i, std::uint32_t j) { return mesh.has_edge(fan.ring[i], fan.ring[j]); });
}

/// The triangle of a fan that a new one comes from: the one at the longest of its edges on the ring, else the one at its middle place.
std::uint32_t parent_of(const SoupMesh& mesh, const Fan& fan, const std::array<std::uint32_t, 3>& places) {
    std::uint32_t best = std::min<std::uint32_t>(places[1], static_cast<std::uint32_t>(fan.triangles.size()) - 1);
    double longest = -1;
    const auto look = [&](std::uint32_t i, std::uint32_t j) {
        const bool on_ring = j == i + 1 || (fan.closed && i == 0 && j + 1 == fan.ring.size());
        if (!on_ring) return;
        const Vec3 d = minus(mesh.place(fan.ring[j]), mesh.place(fan.ring[i]));
        if (dot(d, d) <= longest) return;
        longest = dot(d, d);
        best = j == i + 1 ? i : j;
    };
    look(places[0], places[1]);
    look(places[1], places[2]);
    look(places[0], places[2]);
    return fan.triangles[best];
}

void fill(SoupMesh& mesh, const Fan& fan, const Filling& filling) {
    std::vector<std::uint32_t> from;
    for (const auto& places : filling) from.push_back(mesh.from(parent_of(mesh, fan, places)));
    const std::uint32_t patch = mesh.patch(fan.triangles.front());
    for (const std::uint32_t t : fan.triangles) mesh.drop(t);
    for (std::size_t i = 0; i < filling.size(); ++i) {
        const auto& [a, b, c] = filling[i];
        mesh.add({fan.ring[a], fan.ring[b], fan.ring[c]}, patch, from[i]);
    }
}

std::size_t ring_triangles(const SoupMesh& mesh, std::uint32_t v) { return mesh.around(v).size(); }

/// Vertices that wait, those with small rings first, then by number.
class Waiting {
public:
    Waiting(const SoupMesh& mesh, std::size_t vertices) : mesh_(mesh), large_(vertices, 0) {}
    bool empty() const { return waiting_.empty(); }
    void put(std::uint32_t v) {
        waiting_.erase({large_[v], v});
        large_[v] = ring_triangles(mesh_, v) > 4 ? 1 : 0;
        waiting_.insert({large_[v], v});
    }
    std::uint32_t next() {
        const std::uint32_t v = waiting_.begin()->second;
        waiting_.erase(waiting_.begin());
        return v;
    }

private:
    const SoupMesh& mesh_;
    std::vector<std::uint8_t> large_;
    std::set<std::pair<std::uint8_t, std::uint32_t>> waiting_;
};

}  // namespace

Erasure erase_vertex(SoupMesh& mesh, std::uint32_t v, const TraceRules& rules, std::span<const std::uint8_t> on_trace) {
    if (mesh.is_marked(v) || mesh.around(v).empty()) return Erasure::needed;
    Star star(mesh, v);
    if (!star.make_fans()) return Erasure::needed;
    const auto ends = star.line_ends();
    const auto& fans = star.fans();
    const bool inside = ends.empty() && fans.size() == 1 && fans[0].closed;
    const bool on_line = ends.size() == 2 && std::ranges::none_of(fans, &Fan::closed);
    if (!inside && !(on_line && rules.lines)) return Erasure::needed;
    if (on_line && !rules.free_borders && are_of_one_surface(mesh, fans, rules)) return Erasure::border;
    if (on_line && !runs_straight(mesh.place(ends[0]), mesh.place(v), mesh.place(ends[1]), rules.rings.distance)) return Erasure::needed;
    std::vector<Filling> fillings;
    for (const Fan& fan : fans) {
        auto filling = filling_of(mesh, v, fan, rules, on_trace);
        if (!filling) return Erasure::not_flat;
        fillings.push_back(std::move(*filling));
    }
    for (std::size_t i = 0; i < fans.size(); ++i) fill(mesh, fans[i], fillings[i]);
    return Erasure::erased;
}

ErasedTrace erase_trace(SoupMesh& mesh, std::span<const std::uint32_t> trace, const TraceRules& rules) {
    std::vector<std::uint8_t> on_trace(mesh.soup().vertices.size(), 0);
    for (const std::uint32_t v : trace) on_trace[v] = 1;
    std::vector<Erasure> stays(on_trace.size(), Erasure::erased);
    Waiting waiting(mesh, on_trace.size());
    for (const std::uint32_t v : trace) waiting.put(v);
    ErasedTrace sum;
    while (!waiting.empty()) {
        const std::uint32_t v = waiting.next();
        std::vector<std::uint32_t> around;
        for (const std::uint32_t t : mesh.around(v)) {
            for (const std::uint32_t w : mesh.triangle(t)) {
                if (w != v && on_trace[w] != 0) around.push_back(w);
            }
        }
        const bool small = ring_triangles(mesh, v) <= 4;
        stays[v] = erase_vertex(mesh, v, rules, on_trace);
        if (stays[v] != Erasure::erased) continue;
        on_trace[v] = 0;
        ++sum.erased;
        sum.small_rings += small ? 1 : 0;
        for (const std::uint32_t w : around) waiting.put(w);
    }
    for (const std::uint32_t v : trace) {
        sum.needed += stays[v] == Erasure::needed ? 1 : 0;
        sum.border += stays[v] == Erasure::border ? 1 : 0;
        sum.not_flat += stays[v] == Erasure::not_flat ? 1 : 0;
    }
    return sum;
}

}  // namespace geomend::editing
