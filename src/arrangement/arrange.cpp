// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/arrange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/cut_round.h"
#include "arrangement/sheets.h"
#include "arrangement/snap_grid.h"
#include "arrangement/unfold.h"
#include "base/length.h"
#include "base/parallel.h"
#include "geometry/vectors.h"

namespace geomend::arrangement {

namespace {

/// The soup on the grid, near vertices made one, triangles and edges that have become nothing left out.
struct Snapped {
    SnapGrid grid;
    CutState state;
    std::vector<std::uint32_t> first_of;  ///< per point the first vertex of the soup that became it
    std::vector<std::uint32_t> point_of;  ///< per vertex of the soup
};

Snapped snapped(const TriangleSoup& soup, double tolerance) {
    const SnapGrid grid = snap_grid(soup.vertices, tolerance);
    Snapped s{grid, {SpacedPoints(grid.tolerance_steps, soup.vertices.size()), {}, {}, {}, {}, {}, {}, {}}, {}, {}};
    s.state.patches = soup.patches;
    s.point_of.resize(soup.vertices.size());
    for (std::uint32_t v = 0; v < soup.vertices.size(); ++v) {
        const std::uint32_t p = s.point_of[v] = s.state.points.add(grid.to_steps(soup.vertices[v]));
        if (p == s.first_of.size()) s.first_of.push_back(v);
    }
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const auto [a, b, c] = soup.triangles[t];
        const Triangle made{s.point_of[a], s.point_of[b], s.point_of[c]};
        if (made[0] == made[1] || made[1] == made[2] || made[2] == made[0]) continue;
        s.state.triangles.push_back(made);
        s.state.source.push_back(t);
    }
    s.state.is_new.assign(s.state.triangles.size(), 1);
    for (std::uint32_t e = 0; e < soup.edges.size(); ++e) {
        const auto [a, b] = soup.edges[e];
        if (s.point_of[a] == s.point_of[b]) continue;
        s.state.edges.push_back({s.point_of[a], s.point_of[b]});
        s.state.edge_source.push_back(e);
    }
    return s;
}

/// Up to which distance features are one in a round: a share of the tolerance, by default a thirty-second, where rounding to the grid does
/// no harm. What is still new after many rounds is looked at ever more widely, up to half of the tolerance: planes that are next
/// to parallel become one where they are that near.
double reach_of_round(const SnapGrid& grid, double share, unsigned rounds) {
    constexpr unsigned patient_rounds = 6;
    const double first = std::max(2.0, grid.tolerance_steps * share), most = std::max(first, grid.tolerance_steps / 2);
    return rounds < patient_rounds ? first : std::min(most, first * std::exp2(rounds - patient_rounds));
}

/// Vertices of the result: those of the soup that are used, in their order, then new ones as they were made.
void write_vertices(const TriangleSoup& soup, const Snapped& s, Arrangement& result) {
    const auto& points = s.state.points.points();
    std::vector<std::uint32_t> number(points.size(), no_index);
    std::vector<std::uint8_t> used(points.size(), 0);
    for (const Triangle& t : s.state.triangles) {
        for (const std::uint32_t v : t) used[v] = 1;
    }
    for (const auto& edge : s.state.edges) used[edge[0]] = used[edge[1]] = 1;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        if (used[p] == 0) continue;
        number[p] = static_cast<std::uint32_t>(result.soup.vertices.size());
        const bool was_there = p < s.first_of.size();
        const bool stayed = was_there && points[p] == s.grid.to_steps(soup.vertices[s.first_of[p]]);
        result.soup.vertices.push_back(stayed && s.grid.is_fine ? soup.vertices[s.first_of[p]] : s.grid.to_position(points[p]));
        result.origin.vertices.push_back(was_there ? Origin::from_vertex(s.first_of[p]) : Origin::Vertex{});
        result.made += was_there ? 0 : 1;
    }
    result.soup.triangles.resize(s.state.triangles.size());
    for (std::size_t t = 0; t < s.state.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) result.soup.triangles[t][k] = number[s.state.triangles[t][k]];
    }
    for (std::size_t e = 0; e < s.state.edges.size(); ++e) {
        result.soup.edges.push_back({number[s.state.edges[e][0]], number[s.state.edges[e][1]]});
        result.soup.edge_ids.push_back(soup.edge_ids[s.state.edge_source[e]]);
    }
    for (const auto& [point, became] : s.state.gave_way | std::views::reverse) {
        if (number[point] == no_index) number[point] = number[became];
    }
    for (std::uint32_t v = 0; v < soup.vertices.size(); ++v) {
        const std::uint32_t now = number[s.point_of[v]];
        result.becomes.push_back(now);
        if (now == no_index) continue;
        const Vec3 d = minus(result.soup.vertices[now], soup.vertices[v]);
        result.largest_move = std::max(result.largest_move, std::sqrt(dot(d, d)));
    }
}

/// Each new vertex lies in the first triangle that has it.
void write_origins(const TriangleSoup& soup, const Snapped& s, Arrangement& result) {
    result.origin.triangles = s.state.source;
    for (const std::uint32_t t : s.state.source) result.soup.patches.push_back(soup.patches[t]);
    for (std::size_t t = 0; t < result.soup.triangles.size(); ++t) {
        for (const std::uint32_t v : result.soup.triangles[t]) {
            auto& origin = result.origin.vertices[v];
            if (origin.vertex != no_index || origin.triangle != no_index) continue;
            const auto [a, b, c] = soup.triangles[s.state.source[t]];
            origin = Origin::from_triangle(s.state.source[t],
                                           weights_in(soup.vertices[a], soup.vertices[b], soup.vertices[c], result.soup.vertices[v]));
        }
    }
}

void count_changes(const TriangleSoup& soup, const Snapped& s, Arrangement& result) {
    std::vector<std::uint32_t> pieces(soup.triangles.size(), 0);
    for (const std::uint32_t t : s.state.source) ++pieces[t];
    for (const std::uint32_t n : pieces) {
        result.collapsed += n == 0 ? 1 : 0;
        result.cut += n > 1 ? 1 : 0;
    }
    result.laid = s.state.laid;
    result.doubled = s.state.doubled;
    result.merged = soup.vertices.size() - s.first_of.size() + s.state.merged;
}

constexpr unsigned later_patience = 8;  // rounds

/// In tolerances: how thick what is taken for one sheet may be, where it cannot be cut otherwise. What only brings together what is near
/// moves by no more than the tolerance.
constexpr std::array sheet_widths{0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0};
constexpr double reach_of_welds = 0.4;  // or more

double thickest_sheet(const ArrangeOptions& options) { return options.reach < reach_of_welds ? sheet_widths.back() : 1.0; }

/// What there is to cut, by the first rounds of the first try.
struct Usual {
    std::size_t triangles = 0;  ///< after these rounds; 0: it is the first try
    std::size_t points = 0;     ///< most that one of them found
};

/// Cuts until nothing is found any more, or it is given up.
void cut(const TriangleSoup& soup, double share, const Monitor* monitor, unsigned most_rounds, Usual& usual, Snapped& s,
         Arrangement& result) {
    result.clean = false;
    constexpr unsigned most_unfoldings = 4;
    unsigned unfoldings = 0;
    const auto stopped = [&] { return monitor != nullptr && monitor->stopped(); };
    // What there is to cut is cut in the first rounds. Where the tolerance is as large as triangles are, pieces may come to lie near
    // others again and again, and grow in number without end, a hundredfold in one round: then it is given up.
    constexpr unsigned first_rounds = 2;
    constexpr std::size_t most_growth = 4;
    const bool is_first = usual.triangles == 0;
    unsigned rounds = 0;
    const auto grows = [&] {
        if (is_first && rounds <= first_rounds) return false;
        return s.state.found_points > s.state.most_points || s.state.triangles.size() > most_growth * usual.triangles + 1000;
    };
    while (!result.clean && rounds < most_rounds && !stopped() && !grows()) {
        if (rounds >= first_rounds) s.state.most_points = most_growth * usual.points + 1000;
        s.state.reach = reach_of_round(s.grid, share, rounds);
        result.clean = cut_round(s.state, monitor);
        ++rounds;
        ++result.rounds;
        if (is_first && rounds <= first_rounds) usual = {s.state.triangles.size(), std::max(usual.points, s.state.found_points)};
        if (result.clean && unfoldings < most_unfoldings && unfold(s.state, soup, s.grid.tolerance_steps)) {
            ++unfoldings;
            result.clean = false;
        }
    }
    if (stopped()) result.clean = false;
}

/// Notes which triangles of the soup have pieces that were found near others in the last round.
void add_unsettled(const Snapped& s, std::vector<std::uint8_t>& unsettled) {
    for (std::size_t t = 0; t < s.state.triangles.size(); ++t) {
        if (s.state.is_new[t] == 0) continue;
        const std::uint32_t source = s.state.source[t];
        if (source < unsettled.size()) unsettled[source] = 1;
        else {
            for (const auto& layer : s.state.stacks[source - unsettled.size()].layers) unsettled[layer.source] = 1;
        }
    }
}

/// Triangles of the soup whose pieces do not add up to them, by more than points may move along their border: points that late rounds made
/// one may have taken pieces with them. Those in sheets are not looked at. 1 for each.
std::vector<std::uint8_t> short_of_area(const TriangleSoup& soup, const Snapped& s, double tolerance) {
    constexpr double most = 4;  // tolerances
    std::vector<double> left(soup.triangles.size(), 0);
    for (std::size_t t = 0; t < s.state.triangles.size(); ++t) {
        if (s.state.source[t] >= left.size()) continue;
        const auto& [a, b, c] = s.state.triangles[t];
        const auto& points = s.state.points.points();
        left[s.state.source[t]] +=
            triangle_area(s.grid.to_position(points[a]), s.grid.to_position(points[b]), s.grid.to_position(points[c]));
    }
    std::vector<std::uint8_t> looked_at(left.size(), 1), is_short(left.size(), 0);
    for (const auto& stack : s.state.stacks) {
        for (const auto& layer : stack.layers) looked_at[layer.source] = 0;
    }
    if (s.state.doubled > 0) {  // of doubles in a patch one stays
        std::vector<std::uint32_t> in_patch(std::ranges::max(soup.patches) + std::size_t{1}, 0);
        for (const std::uint32_t p : soup.patches) ++in_patch[p];
        for (std::size_t t = 0; t < left.size(); ++t) {
            if (in_patch[soup.patches[t]] > 1) looked_at[t] = 0;
        }
    }
    for (std::size_t t = 0; t < left.size(); ++t) {
        if (looked_at[t] == 0) continue;
        const Vec3 &a = soup.vertices[soup.triangles[t][0]], &b = soup.vertices[soup.triangles[t][1]],
                   &c = soup.vertices[soup.triangles[t][2]];
        double border = 0;
        for (const Vec3& side : {minus(b, a), minus(c, b), minus(a, c)}) border += length(side);
        is_short[t] = std::abs(left[t] - triangle_area(a, b, c)) > most * tolerance * (border + tolerance) ? 1 : 0;
    }
    return is_short;
}

/// A cut that is clean since pieces are missing is none. Whether it was one; triangles that lost some, and those that they meet, are
/// marked.
bool has_lost_area(const TriangleSoup& soup, const Snapped& s, double tolerance, std::vector<std::uint8_t>& marked) {
    const auto is_short = short_of_area(soup, s, tolerance);
    if (std::ranges::find(is_short, std::uint8_t{1}) == is_short.end()) return false;
    std::vector<std::uint8_t> is_at(s.state.points.points().size(), 0);
    for (std::size_t t = 0; t < s.state.triangles.size(); ++t) {
        const std::uint32_t source = s.state.source[t];
        if (source >= is_short.size() || is_short[source] == 0) continue;
        for (const std::uint32_t p : s.state.triangles[t]) is_at[p] = 1;
    }
    for (std::size_t t = 0; t < s.state.triangles.size(); ++t) {
        const std::uint32_t source = s.state.source[t];
        const bool meets = std::ranges::any_of(s.state.triangles[t], [&](std::uint32_t p) { return is_at[p] != 0; });
        if (meets && source < marked.size()) marked[source] = 1;
    }
    for (std::size_t t = 0; t < marked.size(); ++t) marked[t] |= is_short[t];
    return true;
}

/// What does not end is begun anew, and taken for one sheet where it lies upon each other: ever thicker ones; then with features that are
/// one from farther away; at last whether it settled before or not. Where nothing of it ends, it stays as it was.
/// \param may_lie per triangle of the soup: what lost area
void cut_in_sheets(const TriangleSoup& soup, const ArrangeOptions& options, std::vector<std::uint8_t> may_lie, Usual usual, Snapped& s,
                   Arrangement& result) {
    add_unsettled(s, may_lie);
    for (const double coarser : {1.0, 4.0, 8.0, 16.0, 1.0}) {
        const double share = std::max(options.reach, std::min(0.5, coarser * options.reach));
        if (coarser != 1 && share == options.reach) continue;
        for (const double width : sheet_widths) {
            if (width > thickest_sheet(options)) break;
            if (options.monitor != nullptr && options.monitor->stopped()) return;
            Snapped anew = snapped(soup, options.tolerance);
            anew.state.reach = reach_of_round(s.grid, share, 0);
            lay_sheets(anew.state, width * s.grid.tolerance_steps, may_lie, options.monitor);
            // Without sheets it is as before, but for the reach.
            if (anew.state.stacks.empty() && (share == options.reach || width != sheet_widths.front())) continue;
            cut(soup, share, options.monitor, later_patience, usual, anew, result);
            if (result.clean && has_lost_area(soup, anew, options.tolerance, may_lie)) result.clean = false;
            if (result.clean) {
                s = std::move(anew);
                return;
            }
            add_unsettled(anew, may_lie);
        }
        if (share >= reach_of_welds) std::ranges::fill(may_lie, std::uint8_t{1});
    }
}

/// A soup whose vertices at marked triangles are moved by up to a distance along each axis: at random, but the same each time.
TriangleSoup shaken(const TriangleSoup& soup, std::span<const std::uint8_t> marked, double distance, std::uint32_t seed) {
    std::vector<std::uint8_t> moves(soup.vertices.size(), 0);
    for (std::size_t t = 0; t < marked.size(); ++t) {
        if (marked[t] == 0) continue;
        for (const std::uint32_t v : soup.triangles[t]) moves[v] = 1;
    }
    TriangleSoup other = soup;
    std::uint32_t random = 12345 + 7919 * seed;
    for (std::size_t v = 0; v < moves.size(); ++v) {
        if (moves[v] == 0) continue;
        for (double& x : other.vertices[v]) {
            random = random * 1664525u + 1013904223u;
            x += distance * (static_cast<double>(random >> 8U) * 0x1p-23 - 1);
        }
    }
    return other;
}

/// What does not end even as sheets is a matter of chance: where many points lie a few tolerances apart, each cut brings others near, in
/// ever more pieces. Shaken by no more than a tolerance most of it ends; so it is tried a few times.
void cut_shaken(const TriangleSoup& soup, const ArrangeOptions& options, Usual usual, Snapped& s, Arrangement& result) {
    constexpr std::array shares{0.1, 0.1, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};  // of the tolerance
    std::vector<std::uint8_t> unsettled(soup.triangles.size(), 0), not_used(soup.triangles.size(), 0);
    add_unsettled(s, unsettled);
    for (std::uint32_t i = 0; i < shares.size(); ++i) {
        if (options.monitor != nullptr && options.monitor->stopped()) return;
        const TriangleSoup other = shaken(soup, unsettled, shares[i] * options.tolerance, i);
        Snapped anew = snapped(other, options.tolerance);
        cut(other, options.reach, options.monitor, options.most_rounds, usual, anew, result);
        if (result.clean && has_lost_area(soup, anew, options.tolerance, not_used)) result.clean = false;
        if (result.clean) {
            s = std::move(anew);
            return;
        }
        add_unsettled(anew, unsettled);
    }
}

}  // namespace

Result<Arrangement> arrange(const TriangleSoup& soup, const ArrangeOptions& options) {
    if (auto sound = check(soup); !sound) return std::move(sound).why();
    if (!(options.tolerance > 0)) return failure(FailureKind::usage, "F018", {}, "a cut needs a tolerance above 0");
    Snapped s = snapped(soup, options.tolerance);
    Arrangement result;
    Usual usual;
    cut(soup, options.reach, options.monitor, options.most_rounds, usual, s, result);
    std::vector<std::uint8_t> may_lie(soup.triangles.size(), 0);
    if (result.clean && options.sheets && has_lost_area(soup, s, options.tolerance, may_lie)) result.clean = false;
    if (!result.clean && options.sheets) cut_in_sheets(soup, options, std::move(may_lie), usual, s, result);
    if (!result.clean && options.sheets) cut_shaken(soup, options, usual, s, result);
    take_stacks_apart(s.state);
    write_vertices(soup, s, result);
    write_origins(soup, s, result);
    count_changes(soup, s, result);
    return result;
}

}  // namespace geomend::arrangement
