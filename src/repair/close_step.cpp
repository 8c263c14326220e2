// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "base/wording.h"
#include "repair/contact_table.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

/// Where the line beside an edge runs to which the border goes: through `from` and `to`.
struct Offset {
    Vec3 from, to;
    bool moved = false;
};

/// How far an end of an edge goes: to what lies ahead of it, else as far as the middle of the edge.
double reach_at(const GapSearch& search, const Vec3& end, const BorderEdge& edge, std::uint32_t patch, const GapHit& middle) {
    const GapHit own = search.ahead(end, edge.outward, patch, middle.patch);
    return own.found() ? own.along : middle.along;
}

/// How far a surface lies ahead of an edge where it lies farthest, between its ends: over a hinge that opens away from it.
/// Looked for at eight places, and more closely around the farthest one of them. 0: nowhere.
double reach_between(const GapSearch& search, const Vec3& from, const Vec3& to, const BorderEdge& edge, std::uint32_t patch,
                     std::uint32_t on) {
    const auto reach = [&](double t) {
        const GapHit hit = search.ahead(plus(times(1 - t, from), times(t, to)), edge.outward, patch, on);
        return hit.within ? hit.along : 0;
    };
    constexpr int places = 8, closer = 6;
    double best = 0, at = 0.5;
    for (int i = 1; i < places; ++i) {
        const double t = static_cast<double>(i) / places, r = reach(t);
        if (r > best) best = r, at = t;
    }
    for (double step = 0.5 / places; best > 0 && step > 0.5 / places / (1 << closer); step /= 2) {
        for (const double t : {at - step, at + step}) {
            const double r = reach(t);
            if (r > best) best = r, at = t;
        }
    }
    return best;
}

/// Per edge the line that its border goes to; edges of closed pieces that have nothing ahead go as far as the nearest one of their piece.
std::vector<Offset> offsets_of(const TriangleSoup& soup, const FreeBorders& borders, const std::vector<Contact>& contacts,
                               const GapSearch& search, std::vector<GapHit>& hits, double tolerance) {
    std::vector<Offset> offsets;
    for (const BorderEdge& e : borders.edges) offsets.push_back({soup.vertices[e.from], soup.vertices[e.to], false});
    for (const Contact& contact : contacts) {
        if (contact.decision != GapDecision::closed) continue;
        const auto& piece = borders.pieces[contact.piece];
        const double beyond = std::max(8 * tolerance, 0.02 * search.limit(contact.patch));
        for (std::size_t i = 0; i < piece.size(); ++i) {
            if (contact.in_part && hits[piece[i]].patch != contact.on) continue;
            const BorderEdge& e = borders.edges[piece[i]];
            const Vec3 middle = times(0.5, plus(soup.vertices[e.from], soup.vertices[e.to]));
            GapHit hit = search.ahead(middle, e.outward, contact.patch, contact.on);  // that of the whole piece comes first
            if (!hit.found() || (!hit.within && hits[piece[i]].within)) hit = hits[piece[i]];
            for (std::size_t d = 1; !hit.found() && d < piece.size(); ++d) {
                if (i >= d) hit = hits[piece[i - d]];
                if (!hit.found() && i + d < piece.size()) hit = hits[piece[i + d]];
            }
            Offset& offset = offsets[piece[i]];
            double from = reach_at(search, offset.from, e, contact.patch, hit), to = reach_at(search, offset.to, e, contact.patch, hit);
            const double between = reach_between(search, offset.from, offset.to, e, contact.patch, hit.patch);
            if (between > std::max(from, to) + beyond / 2) from = to = between;
            offset.from = plus(offset.from, times(from + beyond, e.outward));
            offset.to = plus(offset.to, times(to + beyond, e.outward));
            offset.moved = true;
        }
    }
    return offsets;
}

/// The point where two offset lines meet, or the farther of their ends where they run along each other.
Vec3 joined(const Offset& before, const Offset& after, const Vec3& vertex, double farthest) {
    const Vec3 u = minus(before.to, before.from), v = minus(after.to, after.from), w = minus(after.from, before.from);
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), det = uu * vv - uv * uv;
    const Vec3 one = minus(before.to, vertex), other = minus(after.from, vertex);
    const Vec3 between = dot(one, one) > dot(other, other) ? before.to : after.from;  // what is too long is cut off
    // Lines that go on nearly straight meet anywhere: less than 20 degrees; those of a sharp tip, of 3 degrees or more, at its point.
    if (det < (uv > 0 ? 0.117 : 0.0027) * uu * vv) return between;
    const double s = (vv * dot(u, w) - uv * dot(v, w)) / det, t = (uv * dot(u, w) - uu * dot(v, w)) / det;
    const Vec3 meet = times(0.5, plus(plus(before.from, times(s, u)), plus(after.from, times(t, v))));
    const Vec3 away = minus(meet, vertex);
    return dot(away, away) <= farthest * farthest ? meet : between;
}

struct Strip {
    TriangleSoup soup;
    Origin origin;
    std::uint64_t made = 0, moved = 0;
    double largest = 0, sum = 0;
};

/// Goes along the borders and puts triangles between them and the lines that they go to.
class StripMaker {
public:
    StripMaker(const TriangleSoup& soup, const FreeBorders& borders, const std::vector<Offset>& offsets, const GapSearch& search)
        : soup_(soup), borders_(borders), offsets_(offsets), search_(search), at_from_(borders.edges.size(), no_index) {
        strip_.soup = soup;
        strip_.origin = identity_origin(soup);
    }

    Strip make() {
        for (std::uint32_t e = 0; e < borders_.edges.size(); ++e) add_edge(e);
        return std::move(strip_);
    }

private:
    /// The vertex that the beginning of an edge goes to: itself, or a new one.
    std::uint32_t target_from(std::uint32_t e) {
        if (at_from_[e] != no_index) return at_from_[e];
        const BorderEdge& edge = borders_.edges[e];
        const std::uint32_t before = edge.previous;
        const Offset still{soup_.vertices[edge.from], soup_.vertices[edge.from], false};
        const bool moves = offsets_[e].moved || (before != no_index && offsets_[before].moved);
        if (!moves) return at_from_[e] = edge.from;
        const Vec3 place = before == no_index
                               ? offsets_[e].from
                               : joined(offsets_[before], offsets_[e], still.from, 6 * search_.limit(soup_.patches[edge.triangle]));
        return at_from_[e] = add_vertex(place, edge, edge.from);
    }

    std::uint32_t target_to(std::uint32_t e) {
        const BorderEdge& edge = borders_.edges[e];
        if (edge.next != no_index) return target_from(edge.next);
        return offsets_[e].moved ? add_vertex(offsets_[e].to, edge, edge.to) : edge.to;
    }

    std::uint32_t add_vertex(const Vec3& place, const BorderEdge& edge, std::uint32_t from) {
        const Triangle& t = soup_.triangles[edge.triangle];
        strip_.soup.vertices.push_back(place);
        strip_.origin.vertices.push_back(Origin::from_triangle(
            edge.triangle, weights_in(soup_.vertices[t[0]], soup_.vertices[t[1]], soup_.vertices[t[2]], soup_.vertices[from])));
        const Vec3 move = minus(place, soup_.vertices[from]);
        const double distance = std::sqrt(dot(move, move));
        ++strip_.moved;
        strip_.sum += distance;
        strip_.largest = std::max(strip_.largest, distance);
        return static_cast<std::uint32_t>(strip_.soup.vertices.size() - 1);
    }

    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t source) {
        strip_.soup.triangles.push_back({a, b, c});
        strip_.soup.patches.push_back(soup_.patches[source]);
        strip_.origin.triangles.push_back(source);
        ++strip_.made;
    }

    void add_edge(std::uint32_t e) {
        const BorderEdge& edge = borders_.edges[e];
        const std::uint32_t from = target_from(e), to = target_to(e);
        if (from != edge.from && to != edge.to) {
            add_triangle(edge.to, edge.from, from, edge.triangle);
            add_triangle(edge.to, from, to, edge.triangle);
        } else if (from != edge.from) {
            add_triangle(edge.to, edge.from, from, edge.triangle);
        } else if (to != edge.to) {
            add_triangle(edge.to, edge.from, to, edge.triangle);
        }
    }

    const TriangleSoup& soup_;
    const FreeBorders& borders_;
    const std::vector<Offset>& offsets_;
    const GapSearch& search_;
    std::vector<std::uint32_t> at_from_;
    Strip strip_;
};

void tell(const SurfaceModel& model, const std::vector<Contact>& contacts, StepOutcome& outcome) {
    for (const Contact& c : contacts) {
        ContactDecision told;
        told.border = model.model.patches[c.patch].name;
        if (c.on != no_index) told.on = model.model.patches[c.on].name;
        told.gap = c.max_gap;
        told.decision = to_string(c.decision);
        told.why = c.why;
        outcome.contacts.push_back(std::move(told));
    }
}

}  // namespace

Result<StepOutcome> close_borders(SurfaceModel& model, const SurfaceStepOptions& options) {
    const TriangleSoup& soup = model.model.soup;
    const double limit = gap_limit(model, options);
    const FreeBorders borders = free_borders(soup, edges_of(soup));
    const GapSearch search(soup, gap_limits(model, options));
    std::vector<GapHit> hits;
    const auto wishes = patch_wishes(model, options.contacts);
    if (!wishes) return wishes.why();
    const auto contacts = decide_contacts(soup, borders, search, model.lengths.tolerance, *wishes, hits);
    StepOutcome outcome;
    tell(model, contacts, outcome);
    const auto closed = static_cast<std::uint64_t>(std::ranges::count(contacts, GapDecision::closed, &Contact::decision));
    if (closed == 0) {
        outcome.what.message = "no border stops short of a surface by less than " + rounded(limit);
        return outcome;
    }
    const auto offsets = offsets_of(soup, borders, contacts, search, hits, model.lengths.tolerance);
    Strip strip = StripMaker(soup, borders, offsets, search).make();
    outcome.changed = strip.made;
    outcome.max_displacement = strip.largest;
    outcome.mean_displacement = strip.sum / static_cast<double>(std::max<std::uint64_t>(strip.moved, 1));
    outcome.what.message = counted(closed, "piece of a border was", "pieces of borders were") + " brought onto the surfaces ahead, by " +
                           counted(strip.made, "triangle", "triangles");
    const auto first = static_cast<std::uint32_t>(soup.triangles.size());
    take_soup(model, std::move(strip.soup), strip.origin);
    mark_added(model, first);
    return outcome;
}

}  // namespace geomend::repair
