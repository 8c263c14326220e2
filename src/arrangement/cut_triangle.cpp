// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/cut_triangle.h"

#include <algorithm>
#include <cmath>

#include "geometry/predicates.h"
#include "geometry/vectors.h"
#include "model/objects.h"

namespace geomend::arrangement {

namespace {

/// The axis that the normal follows most, and the triangle's turn seen along it.
struct View {
    unsigned axis = 2;
    int turn = 0;

    View(std::span<const Vec3> points, const Triangle& t) {
        const Vec3 n = cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
        if (std::abs(n[0]) > std::abs(n[axis])) axis = 0;
        if (std::abs(n[1]) > std::abs(n[axis])) axis = 1;
        turn = orientation_2d(points[t[0]], points[t[1]], points[t[2]], axis);
    }
};

/// Local numbers of vertices: corners first, then in order of coming in.
class Names {
public:
    explicit Names(CutScratch& s) : s_(s) {
        s_.names.clear();
        s_.numbers.clear();
    }
    /// Adds those that are new at the end; call index() only after sorted().
    void add(std::uint32_t vertex) { s_.names.push_back(vertex); }
    std::size_t size() const { return s_.names.size(); }
    void sort() {
        s_.numbers.clear();
        for (std::uint32_t i = 0; i < s_.names.size(); ++i) s_.numbers.emplace_back(s_.names[i], i);
        std::sort(s_.numbers.begin(), s_.numbers.end());
    }
    std::uint32_t index(std::uint32_t vertex) const {
        const auto at = std::lower_bound(s_.numbers.begin(), s_.numbers.end(), std::pair(vertex, 0u));
        return at != s_.numbers.end() && at->first == vertex ? at->second : no_index;
    }
    bool has_twice() const {
        return std::adjacent_find(s_.numbers.begin(), s_.numbers.end(), [](const auto& p, const auto& q) { return p.first == q.first; }) !=
               s_.numbers.end();
    }

private:
    CutScratch& s_;
};

/// Whether b lies strictly inside of the corner a, b, c of a polygon that turns counter-clockwise, with no other corner in it.
bool is_ear(std::span<const Vec3> points, const View& view, std::span<const std::uint32_t> loop, std::size_t i) {
    const std::size_t n = loop.size();
    const std::uint32_t a = loop[(i + n - 1) % n], b = loop[i], c = loop[(i + 1) % n];
    const auto turn = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
        return view.turn * orientation_2d(points[p], points[q], points[r], view.axis);
    };
    if (turn(a, b, c) <= 0) return false;
    for (const std::uint32_t v : loop) {
        if (v != a && v != b && v != c && turn(a, b, v) >= 0 && turn(b, c, v) >= 0 && turn(c, a, v) >= 0) return false;
    }
    return true;
}

/// Triangles over a simple polygon, ear by ear; where rounding leaves no ear, whatever corner is next.
void clip_ears(std::span<const Vec3> points, const View& view, std::vector<std::uint32_t> loop, std::vector<Triangle>& parts) {
    while (loop.size() >= 3) {
        const std::size_t n = loop.size();
        std::size_t ear = 0;
        while (ear < n && !is_ear(points, view, loop, ear)) ++ear;
        if (ear == n) ear = 0;
        parts.push_back({loop[(ear + n - 1) % n], loop[ear], loop[(ear + 1) % n]});
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(ear));
    }
}

/// A border that comes back to a vertex falls apart there into loops that do not; loops of two vertices have no area.
void triangulate_pinched(std::span<const Vec3> points, const View& view, std::span<const std::uint32_t> border, CutScratch& scratch,
                         std::vector<Triangle>& parts) {
    auto& open = scratch.loop;
    open.clear();
    for (const std::uint32_t v : border) {
        const auto before = std::find(open.begin(), open.end(), v);
        if (before != open.end()) {
            clip_ears(points, view, {before, open.end()}, parts);
            open.erase(before, open.end());
        }
        open.push_back(v);
    }
    clip_ears(points, view, open, parts);
}

/// Puts the points of its sides into a triangle by numbers alone, whatever their places: where a point lies beyond the line from
/// its neighbour to the corner opposite, a part of this is turned over and flat, and the next look sets it right.
void split_sides(const Triangle& triangle, const std::array<std::vector<std::uint32_t>, 3>& chain, std::vector<Triangle>& parts) {
    const std::size_t first = parts.size();
    parts.push_back(triangle);
    for (std::size_t side = 0; side < 3; ++side) {
        std::uint32_t from = triangle[side];
        const std::uint32_t to = triangle[(side + 1) % 3];
        for (const std::uint32_t v : chain[side]) {
            for (std::size_t t = first; t < parts.size(); ++t) {
                std::size_t k = 0;
                while (k < 3 && (parts[t][k] != from || parts[t][(k + 1) % 3] != to)) ++k;
                if (k == 3) continue;
                const std::uint32_t apex = parts[t][(k + 2) % 3];
                parts[t] = {from, v, apex};
                parts.push_back({v, to, apex});
                break;
            }
            from = v;
        }
    }
}

/// A triangle between a point inside and each piece of the border; nothing where one of them would be turned over.
bool fan_out(std::span<const Vec3> points, const View& view, std::span<const std::uint32_t> border, std::uint32_t middle,
             std::vector<Triangle>& parts) {
    const auto next = [&](std::size_t i) { return border[i + 1 == border.size() ? 0 : i + 1]; };
    for (std::size_t i = 0; i < border.size(); ++i) {
        if (view.turn * orientation_2d(points[border[i]], points[next(i)], points[middle], view.axis) <= 0) return false;
    }
    for (std::size_t i = 0; i < border.size(); ++i) parts.push_back({border[i], next(i), middle});
    return true;
}

}  // namespace

bool cut_triangle(std::span<const Vec3> points, const Triangle& triangle, const LinkTable& links, std::span<const Link> segments,
                  std::span<const std::uint32_t> on_face, double reach, CutScratch& scratch, std::vector<Triangle>& parts) {
    const View view(points, triangle);
    std::array<std::vector<std::uint32_t>, 3> chain;
    for (std::size_t i = 0; i < 3; ++i) {
        links.append(triangle[i], triangle[(i + 1) % 3], chain[i]);
        if (std::ranges::find(chain[i], triangle[(i + 2) % 3]) != chain[i].end()) return true;  // it has no area left
    }
    const bool plain = segments.empty() && on_face.empty();
    Names names(scratch);
    for (const std::uint32_t v : triangle) names.add(v);
    for (const auto& c : chain) {
        for (const std::uint32_t v : c) names.add(v);
    }
    names.sort();
    const auto border = [&]() -> const std::vector<std::uint32_t>& {
        scratch.way.clear();
        for (std::size_t i = 0; i < 3; ++i) {
            scratch.way.push_back(triangle[i]);
            scratch.way.insert(scratch.way.end(), chain[i].begin(), chain[i].end());
        }
        return scratch.way;
    };
    const auto pinched = [&] {
        triangulate_pinched(points, view, border(), scratch, parts);
        return plain;
    };
    if (names.has_twice()) return pinched();

    // Points inside, and pieces of segments between points that stand on them.
    std::vector<std::uint32_t> inside(on_face.begin(), on_face.end());
    std::vector<Link> pieces;
    std::vector<std::vector<std::uint32_t>> bent;  // segments with something on them
    for (const Link& s : segments) {
        scratch.way.assign(1, s.a);
        links.append(s.a, s.b, scratch.way);
        scratch.way.push_back(s.b);
        if (scratch.way.size() > 2) bent.push_back(scratch.way);
        for (std::size_t i = 0; i < scratch.way.size(); ++i) {
            inside.push_back(scratch.way[i]);
            if (i > 0) pieces.emplace_back(scratch.way[i - 1], scratch.way[i]);
        }
    }
    std::erase_if(inside, [&](std::uint32_t v) { return names.index(v) != no_index; });
    std::vector<std::uint32_t> ordered = inside;  // along the segments: neighbours come one after the other
    std::sort(inside.begin(), inside.end());
    inside.erase(std::unique(inside.begin(), inside.end()), inside.end());
    std::vector<std::uint8_t> taken(inside.size(), 0);
    std::erase_if(ordered, [&](std::uint32_t v) {
        auto& seen = taken[static_cast<std::size_t>(std::ranges::lower_bound(inside, v) - inside.begin())];
        return std::exchange(seen, std::uint8_t{1}) != 0;
    });
    const std::size_t border_size = names.size();
    for (const std::uint32_t v : ordered) names.add(v);
    names.sort();
    scratch.positions.clear();
    for (const std::uint32_t v : scratch.names) scratch.positions.push_back(points[v]);

    scratch.ways.assign(names.size(), 0);
    for (std::uint32_t i = 0, next = 3; i < 3; ++i) {
        const std::uint64_t bit = std::uint64_t{1} << i;
        scratch.ways[i] |= bit;
        scratch.ways[i == 2 ? 0 : i + 1] |= bit;
        for (std::size_t k = 0; k < chain[i].size(); ++k) scratch.ways[next++] |= bit;
    }
    for (std::size_t w = 0; w < bent.size(); ++w) {
        for (const std::uint32_t v : bent[w]) scratch.ways[names.index(v)] |= std::uint64_t{1} << (3 + w % 61);
    }
    FaceMesh& mesh = scratch.mesh;
    if (view.turn == 0 || !mesh.begin(scratch.positions, scratch.names, scratch.ways, view.axis, view.turn, reach)) return pinched();
    std::uint32_t next = 3;
    for (std::uint32_t i = 0; i < 3; ++i) {
        scratch.local.clear();
        for (std::size_t k = 0; k < chain[i].size(); ++k) scratch.local.push_back(next++);
        if (mesh.add_on_border(i, i == 2 ? 0 : i + 1, scratch.local)) continue;
        const auto fan = [&](std::uint32_t v) { return fan_out(points, view, border(), v, parts); };
        if (!std::ranges::any_of(on_face, fan)) split_sides(triangle, chain, parts);
        return plain;
    }
    bool complete = true;
    for (std::size_t k = border_size; k < names.size(); ++k) complete &= mesh.add_inside(static_cast<std::uint32_t>(k));
    std::sort(pieces.begin(), pieces.end());
    pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
    for (const Link& p : pieces) complete &= mesh.fix(names.index(p.a), names.index(p.b));
    for (const Triangle& t : mesh.triangles()) parts.push_back({scratch.names[t[0]], scratch.names[t[1]], scratch.names[t[2]]});
    return complete;
}

}  // namespace geomend::arrangement
