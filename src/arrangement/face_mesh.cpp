// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/face_mesh.h"

#include <algorithm>
#include <cmath>

#include "arrangement/segment_contact.h"
#include "geometry/predicates.h"
#include "geometry/vectors.h"
#include "model/objects.h"

namespace geomend::arrangement {

namespace {

std::uint32_t after(std::uint32_t i) { return i == 2 ? 0 : i + 1; }
std::uint32_t before(std::uint32_t i) { return i == 0 ? 2 : i - 1; }

}  // namespace

int FaceMesh::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return turn_ * orientation_2d(points_[a], points_[b], points_[c], axis_);
}

std::uint32_t FaceMesh::corner_of(std::uint32_t triangle, std::uint32_t point) const {
    const Triangle& t = triangles_[triangle];
    return t[0] == point ? 0 : t[1] == point ? 1 : 2;
}

void FaceMesh::set(std::uint32_t triangle, const Triangle& corners) {
    triangles_[triangle] = corners;
    for (const std::uint32_t point : corners) at_[point] = triangle;
}

/// The edge of a triangle whose neighbour is the other one.
std::uint32_t FaceMesh::edge_towards(std::uint32_t triangle, std::uint32_t other) const {
    const auto& n = neighbours_[triangle];
    return n[0] == other ? 0 : n[1] == other ? 1 : 2;
}

bool FaceMesh::begin(std::span<const Vec3> points, std::span<const std::uint32_t> names, std::span<const std::uint64_t> ways, unsigned axis,
                     int turn_of_face, double reach) {
    points_ = points;
    names_ = names;
    ways_ = ways;
    axis_ = axis;
    turn_ = turn_of_face;
    reach_ = reach;
    triangles_.assign(1, {0, 1, 2});
    neighbours_.assign(1, {no_index, no_index, no_index});
    fixed_.assign(1, {1, 1, 1});
    at_.assign(points.size(), no_index);
    at_[0] = at_[1] = at_[2] = 0;
    stack_.clear();
    last_ = 0;
    return turn(0, 1, 2) > 0;
}

bool FaceMesh::add_on_border(std::uint32_t from, std::uint32_t to, std::span<const std::uint32_t> chain) {
    if (chain.empty()) return true;
    Place place = find_edge(from, to);
    std::uint32_t previous = from;
    for (const std::uint32_t point : chain) {
        const std::uint32_t t = place.triangle, apex = triangles_[t][before(place.edge)];
        if (turn(previous, point, apex) <= 0 || turn(point, to, apex) <= 0) return false;
        const std::uint32_t left = neighbours_[t][before(place.edge)], right = neighbours_[t][after(place.edge)];
        const std::uint8_t left_fixed = fixed_[t][before(place.edge)], right_fixed = fixed_[t][after(place.edge)];
        const auto made = static_cast<std::uint32_t>(triangles_.size());
        triangles_.push_back({});
        neighbours_.push_back({no_index, right, t});
        fixed_.push_back({1, right_fixed, 0});
        if (right != no_index) neighbours_[right][edge_towards(right, t)] = made;
        neighbours_[t] = {no_index, made, left};
        fixed_[t] = {1, 0, left_fixed};
        set(t, {previous, point, apex});
        set(made, {point, to, apex});
        stack_.push_back({t, 2});
        stack_.push_back({t, 1});
        stack_.push_back({made, 1});
        place = {made, 0};
        previous = point;
    }
    settle();
    return true;
}

bool FaceMesh::add_inside(std::uint32_t point) {
    std::uint32_t t = last_ < triangles_.size() ? last_ : 0;
    std::uint32_t from = no_index;
    for (std::size_t steps = 0; steps <= 4 * triangles_.size() + 8; ++steps) {
        const Triangle& c = triangles_[t];
        std::uint32_t out = no_index, on = no_index;
        for (std::uint32_t i = 0; i < 3 && out == no_index; ++i) {
            if (neighbours_[t][i] != no_index && neighbours_[t][i] == from) continue;
            const int side = turn(c[i], c[after(i)], point);
            if (side < 0) out = i;
            if (side == 0) on = i;
        }
        if (out == no_index) {
            // Where it came in, the point lies on the inner side or, at worst, on the edge.
            if (from != no_index && on == no_index) {
                const std::uint32_t entry = edge_towards(t, from);
                if (turn(c[entry], c[after(entry)], point) == 0) on = entry;
            }
            if (on != no_index && (neighbours_[t][on] == no_index || is_seen_at(point, c[on]) || is_seen_at(point, c[after(on)])))
                return false;
            if (on != no_index) split_edge({t, on}, point);
            else split_triangle(t, point);
            settle();
            last_ = at_[point];
            return true;
        }
        if (neighbours_[t][out] == no_index) return false;
        from = t;
        t = neighbours_[t][out];
    }
    return false;
}

bool FaceMesh::is_seen_at(std::uint32_t a, std::uint32_t b) const {
    const Vec3 &p = points_[a], &q = points_[b];
    const unsigned i = axis_ == 0 ? 1 : 0, k = axis_ == 2 ? 1 : 2;
    return p[i] == q[i] && p[k] == q[k];
}

void FaceMesh::split_triangle(std::uint32_t t, std::uint32_t point) {
    const Triangle c = triangles_[t];
    const auto n = neighbours_[t];
    const auto f = fixed_[t];
    const auto second = static_cast<std::uint32_t>(triangles_.size()), third = second + 1;
    triangles_.resize(triangles_.size() + 2);
    neighbours_.resize(triangles_.size());
    fixed_.resize(triangles_.size());
    const std::array<std::uint32_t, 3> part{t, second, third};
    for (std::uint32_t i = 0; i < 3; ++i) {
        if (n[i] != no_index && i != 0) neighbours_[n[i]][edge_towards(n[i], t)] = part[i];
        neighbours_[part[i]] = {n[i], part[after(i)], part[before(i)]};
        fixed_[part[i]] = {f[i], 0, 0};
        set(part[i], {c[i], c[after(i)], point});
        stack_.push_back({part[i], 0});
    }
}

void FaceMesh::split_edge(Place place, std::uint32_t point) {
    const std::uint32_t t = place.triangle, o = neighbours_[t][place.edge];
    const std::uint32_t e = place.edge, g = edge_towards(o, t);
    const std::uint32_t a = triangles_[t][e], b = triangles_[t][after(e)], c = triangles_[t][before(e)], d = triangles_[o][before(g)];
    const std::uint8_t along = fixed_[t][e];
    const std::uint32_t bc = neighbours_[t][after(e)], ca = neighbours_[t][before(e)];
    const std::uint32_t ad = neighbours_[o][after(g)], db = neighbours_[o][before(g)];
    const std::uint8_t bc_fixed = fixed_[t][after(e)], ca_fixed = fixed_[t][before(e)];
    const std::uint8_t ad_fixed = fixed_[o][after(g)], db_fixed = fixed_[o][before(g)];
    const auto t2 = static_cast<std::uint32_t>(triangles_.size()), o2 = t2 + 1;
    triangles_.resize(triangles_.size() + 2);
    neighbours_.resize(triangles_.size());
    fixed_.resize(triangles_.size());
    if (bc != no_index) neighbours_[bc][edge_towards(bc, t)] = t2;
    if (ad != no_index) neighbours_[ad][edge_towards(ad, o)] = o2;
    neighbours_[t] = {o2, t2, ca};
    fixed_[t] = {along, 0, ca_fixed};
    neighbours_[t2] = {o, bc, t};
    fixed_[t2] = {along, bc_fixed, 0};
    neighbours_[o] = {t2, o2, db};
    fixed_[o] = {along, 0, db_fixed};
    neighbours_[o2] = {t, ad, o};
    fixed_[o2] = {along, ad_fixed, 0};
    set(t, {a, point, c});
    set(t2, {point, b, c});
    set(o, {b, point, d});
    set(o2, {point, a, d});
    stack_.insert(stack_.end(), {{t, 2}, {t2, 1}, {o, 2}, {o2, 1}});
}

/// Both triangles at the edge make a quadrangle that bends at no corner.
bool FaceMesh::can_flip(Place place) const {
    const std::uint32_t t = place.triangle, o = neighbours_[t][place.edge];
    if (o == no_index) return false;
    const std::uint32_t a = triangles_[t][place.edge], b = triangles_[t][after(place.edge)], c = triangles_[t][before(place.edge)];
    const std::uint32_t d = triangles_[o][before(edge_towards(o, t))];
    return turn(c, a, d) > 0 && turn(d, b, c) > 0;
}

bool FaceMesh::wants_flip(Place place) const {
    const std::uint32_t t = place.triangle, o = neighbours_[t][place.edge];
    if (o == no_index || fixed_[t][place.edge] != 0) return false;
    const std::uint32_t a = triangles_[t][place.edge], b = triangles_[t][after(place.edge)], c = triangles_[t][before(place.edge)];
    const std::uint32_t d = triangles_[o][before(edge_towards(o, t))];
    const Vec3 u = minus(points_[a], points_[c]), v = minus(points_[b], points_[c]);
    const Vec3 p = minus(points_[a], points_[d]), q = minus(points_[b], points_[d]);
    const double uv = length(cross(u, v)), pq = length(cross(p, q));  // twice the areas
    const double sine = uv * dot(p, q) + dot(u, v) * pq;              // of the sum of both angles
    const double unsure = 1e-10 * length(u) * length(v) * length(p) * length(q);
    const bool by_name = std::min(names_[c], names_[d]) < std::min(names_[a], names_[b]);
    const int was = fault_of(a, b, c, d), becomes = fault_of(d, c, a, b);
    if (becomes > was || (becomes == was && (sine > unsure || (sine >= -unsure && !by_name)))) return false;
    return can_flip(place);
}

/// What is wrong with an edge a b between corners c and d: 2 where it passes by points of its own way, 1 where a triangle at it is flat.
int FaceMesh::fault_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    if ((ways_[a] & ways_[b]) != 0) return 2;
    return is_flat(a, b, c) || is_flat(b, a, d) ? 1 : 0;
}

/// Whether a corner lies within reach of the edge opposite.
bool FaceMesh::is_flat(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Vec3 u = minus(points_[b], points_[a]), v = minus(points_[c], points_[a]), w = minus(v, u), n = cross(u, v);
    return dot(n, n) <= reach_ * reach_ * std::max({dot(u, u), dot(v, v), dot(w, w)});
}

/// a b c and b a d become a d c and d b c.
void FaceMesh::flip(Place place) {
    const std::uint32_t t = place.triangle, e = place.edge, o = neighbours_[t][e], g = edge_towards(o, t);
    const std::uint32_t a = triangles_[t][e], b = triangles_[t][after(e)], c = triangles_[t][before(e)], d = triangles_[o][before(g)];
    const std::uint32_t bc = neighbours_[t][after(e)], ca = neighbours_[t][before(e)];
    const std::uint32_t ad = neighbours_[o][after(g)], db = neighbours_[o][before(g)];
    const std::uint8_t bc_fixed = fixed_[t][after(e)], ca_fixed = fixed_[t][before(e)];
    const std::uint8_t ad_fixed = fixed_[o][after(g)], db_fixed = fixed_[o][before(g)];
    if (bc != no_index) neighbours_[bc][edge_towards(bc, t)] = o;
    if (ad != no_index) neighbours_[ad][edge_towards(ad, o)] = t;
    neighbours_[t] = {ad, o, ca};
    fixed_[t] = {ad_fixed, 0, ca_fixed};
    neighbours_[o] = {db, bc, t};
    fixed_[o] = {db_fixed, bc_fixed, 0};
    set(t, {a, d, c});
    set(o, {d, b, c});
}

void FaceMesh::settle() {
    std::size_t left = 100 + 60 * triangles_.size();  // rounding may make ties go round in circles
    while (!stack_.empty()) {
        const Place place = stack_.back();
        stack_.pop_back();
        if (left == 0 || !wants_flip(place)) continue;
        --left;
        const std::uint32_t o = neighbours_[place.triangle][place.edge];
        flip(place);
        stack_.insert(stack_.end(), {{place.triangle, 0}, {place.triangle, 2}, {o, 0}, {o, 1}});
    }
}

/// The triangle that has the edge in this direction; triangle none where there is no such.
FaceMesh::Place FaceMesh::find_edge(std::uint32_t from, std::uint32_t to) const {
    const std::uint32_t start = at_[from];
    for (std::uint32_t t = start; t != no_index;) {
        const std::uint32_t k = corner_of(t, from);
        if (triangles_[t][after(k)] == to) return {t, k};
        t = neighbours_[t][before(k)];
        if (t == start) return {no_index, 0};
    }
    for (std::uint32_t t = neighbours_[start][corner_of(start, from)]; t != no_index;) {
        const std::uint32_t k = corner_of(t, from);
        if (triangles_[t][after(k)] == to) return {t, k};
        t = neighbours_[t][k];
    }
    return {no_index, 0};
}

/// The edge across which a segment leaves the triangles around its first point; `through` is a point that it passes instead.
FaceMesh::Place FaceMesh::first_crossing(std::uint32_t from, std::uint32_t to, std::uint32_t& through) const {
    through = no_index;
    const auto look = [&](std::uint32_t t, Place& found) {
        const std::uint32_t k = corner_of(t, from), p = triangles_[t][after(k)], q = triangles_[t][before(k)];
        if (p == to || q == to) {
            through = to;
            return true;
        }
        const int at_p = turn(from, to, p), at_q = turn(from, to, q);
        const auto is_ahead = [&](std::uint32_t x) { return dot(minus(points_[x], points_[from]), minus(points_[to], points_[from])) > 0; };
        if (at_p == 0 && is_ahead(p)) through = p;
        else if (at_q == 0 && is_ahead(q)) through = q;
        else if (at_p < 0 && at_q > 0) found = {t, after(k)};
        else return false;
        return true;
    };
    Place found{no_index, 0};
    const std::uint32_t start = at_[from];
    std::uint32_t t = start;
    do {
        if (look(t, found)) return found;
        t = neighbours_[t][before(corner_of(t, from))];
    } while (t != no_index && t != start);
    if (t == start) return found;
    for (t = neighbours_[start][corner_of(start, from)]; t != no_index; t = neighbours_[t][corner_of(t, from)]) {
        if (look(t, found)) return found;
    }
    return found;
}

bool FaceMesh::fix_edge(std::uint32_t from, std::uint32_t to) {
    Place place = find_edge(from, to);
    if (place.triangle == no_index) place = find_edge(to, from);
    if (place.triangle == no_index) return false;
    fixed_[place.triangle][place.edge] = 1;
    const std::uint32_t o = neighbours_[place.triangle][place.edge];
    if (o != no_index) fixed_[o][edge_towards(o, place.triangle)] = 1;
    return true;
}

bool FaceMesh::fix(std::uint32_t from, std::uint32_t to) {
    if (at_[from] == no_index || at_[to] == no_index) return false;
    for (std::size_t parts = 0; from != to && parts <= points_.size(); ++parts) {
        std::uint32_t through = no_index;
        Place place = first_crossing(from, to, through);
        if (through != no_index) {
            if (!fix_edge(from, through)) return false;
            from = through;
            continue;
        }
        // The edges on the way, by their ends: flips change which triangles they are in.
        std::vector<std::array<std::uint32_t, 2>> crossed;
        std::uint32_t end = no_index;
        while (end == no_index) {
            if (place.triangle == no_index || fixed_[place.triangle][place.edge] != 0) return false;
            const Triangle& c = triangles_[place.triangle];
            const std::uint32_t p = c[place.edge], q = c[after(place.edge)];
            crossed.push_back({p, q});
            const std::uint32_t o = neighbours_[place.triangle][place.edge], g = edge_towards(o, place.triangle);
            const std::uint32_t r = triangles_[o][before(g)];
            const int side = r == to ? 0 : turn(from, to, r);
            if (side == 0) end = r;
            else place = side > 0 ? Place{o, after(g)} : Place{o, before(g)};  // p r, or r q
        }
        std::size_t left = crossed.size() * crossed.size() + 64;  // more often nothing waits, where all turns are right
        for (std::size_t i = 0; i < crossed.size(); ++i) {
            const auto [p, q] = crossed[i];
            Place at = find_edge(p, q);
            if (at.triangle == no_index) at = find_edge(q, p);
            if (at.triangle == no_index) continue;
            if (!can_flip(at)) {
                if (left-- == 0) return false;
                crossed.push_back({p, q});
                continue;
            }
            const std::uint32_t o = neighbours_[at.triangle][at.edge];
            flip(at);
            stack_.insert(stack_.end(), {{at.triangle, 0}, {at.triangle, 2}, {o, 0}, {o, 1}, {at.triangle, 1}});
            const std::uint32_t c = triangles_[at.triangle][2], d = triangles_[at.triangle][1];
            if (c == from || d == from || c == end || d == end) continue;
            if (turn(from, end, c) * turn(from, end, d) >= 0) continue;
            if (left-- == 0) return false;
            crossed.push_back({c, d});
        }
        if (!fix_edge(from, end)) return false;
        settle();
        from = end;
    }
    return true;
}

}  // namespace geomend::arrangement
