// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/sheets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "arrangement/planar_cut.h"
#include "arrangement/search.h"
#include "arrangement/segment_contact.h"
#include "geometry/vectors.h"
#include "model/objects.h"

namespace geomend::arrangement {

namespace {

struct Plane {
    Vec3 point, normal;  ///< the normal of length 1
    double height(const Vec3& x) const { return dot(normal, minus(x, point)); }
};
struct Sheet {
    Plane plane;
    std::vector<std::uint32_t> triangles;  ///< of the state, the largest first
};

/// Per triangle the others that it meets.
struct Meetings {
    std::vector<std::uint32_t> first, others;

    Meetings(const NearFeatures& found, std::size_t triangles) : first(triangles + 1, 0) {
        const auto each = [&](const auto& visit) {
            for (const auto& pair : found.pairs) visit(pair.first, pair.second);
            for (const auto& pair : found.same) visit(pair[0], pair[1]);
        };
        each([&](std::uint32_t a, std::uint32_t b) {
            ++first[a + 1];
            ++first[b + 1];
        });
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        others.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        each([&](std::uint32_t a, std::uint32_t b) {
            others[next[a]++] = b;
            others[next[b]++] = a;
        });
    }
    std::span<const std::uint32_t> of(std::uint32_t t) const { return std::span(others).subspan(first[t], first[t + 1] - first[t]); }
};

/// Whether a triangle lies within the width of a plane, along it or thin.
bool lies_on(const CutState& state, const Triangle& t, const Plane& plane, double width) {
    const auto& points = state.points.points();
    for (const std::uint32_t v : t) {
        if (std::abs(plane.height(points[v])) > width) return false;
    }
    const FlatTriangle flat(points, t);
    NearFeatures thin;
    add_flat_corner(flat, 2 * state.points.distance(), thin);
    return !thin.on_edges.empty() || std::abs(dot(flat.normal, plane.normal)) > 0.5;
}

/// Those with area, the largest first.
std::vector<std::uint32_t> by_area(const CutState& state) {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t t = 0; t < state.triangles.size(); ++t) {
        const auto& points = state.points.points();
        const auto [a, b, c] = state.triangles[t];
        const Vec3 n = cross(minus(points[b], points[a]), minus(points[c], points[a]));
        if (dot(n, n) > 0) order.emplace_back(-dot(n, n), t);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> triangles;
    for (const auto& [area, t] : order) triangles.push_back(t);
    return triangles;
}

std::vector<Sheet> find_sheets(const CutState& state, double width, std::span<const std::uint8_t> may_lie, const Monitor* monitor) {
    const Meetings meetings(search(state.points.points(), state.triangles, state.is_new, width, monitor), state.triangles.size());
    std::vector<std::uint8_t> is_taken(state.triangles.size(), 0);
    for (std::size_t t = 0; t < is_taken.size(); ++t) is_taken[t] = may_lie[state.source[t]] == 0 ? 1 : 0;
    std::vector<Sheet> sheets;
    for (const std::uint32_t t : by_area(state)) {
        if (is_taken[t] != 0) continue;
        const FlatTriangle base(state.points.points(), state.triangles[t]);
        Sheet sheet{{base.corner[0], base.normal}, {t}};
        is_taken[t] = 1;
        for (std::size_t i = 0; i < sheet.triangles.size(); ++i) {
            for (const std::uint32_t other : meetings.of(sheet.triangles[i])) {
                if (is_taken[other] != 0 || !lies_on(state, state.triangles[other], sheet.plane, width)) continue;
                is_taken[other] = 1;
                sheet.triangles.push_back(other);
            }
        }
        if (sheet.triangles.size() > 1) sheets.push_back(std::move(sheet));
    }
    return sheets;
}

/// Each point of sheets goes into the plane of the first one that has it; points that come together are one. Per point the one it is now.
std::vector<std::uint32_t> press(CutState& state, const std::vector<Sheet>& sheets) {
    const auto& points = state.points.points();
    std::vector<std::uint8_t> is_used(points.size(), 0), is_seen(points.size(), 0);
    for (const Triangle& t : state.triangles) {
        for (const std::uint32_t v : t) is_used[v] = 1;
    }
    for (const auto& e : state.edges) is_used[e[0]] = is_used[e[1]] = 1;
    std::vector<SpacedPoints::Move> moves;
    for (const Sheet& sheet : sheets) {
        for (const std::uint32_t t : sheet.triangles) {
            for (const std::uint32_t v : state.triangles[t]) {
                if (std::exchange(is_seen[v], std::uint8_t{1}) != 0) continue;
                const Vec3 to = rounded(minus(points[v], times(sheet.plane.height(points[v]), sheet.plane.normal)));
                if (to != points[v]) moves.push_back({v, to});
            }
        }
    }
    auto becomes = state.points.move(moves, is_used);
    for (std::uint32_t p = 0; p < becomes.size(); ++p) state.merged += becomes[p] != p ? 1 : 0;
    return becomes;
}

/// One number for each set of triangles that lie upon each other, from the soup's number of triangles on.
class Stacks {
public:
    explicit Stacks(CutState& state) : state_(state) {}

    std::uint32_t number_of(const CutState::Stack& stack) {
        std::vector<std::uint32_t> key;
        for (const auto& layer : stack.layers) key.push_back(2 * layer.source + (layer.turned ? 1 : 0));
        const auto [at, is_added] = numbers_.try_emplace(std::move(key), static_cast<std::uint32_t>(state_.stacks.size()));
        if (is_added) state_.stacks.push_back(stack);
        return static_cast<std::uint32_t>(state_.patches.size()) + at->second;
    }

private:
    CutState& state_;
    std::map<std::vector<std::uint32_t>, std::uint32_t> numbers_;
};

struct Piece {
    std::uint32_t source;
    Triangle triangle;
};

/// Of pieces of one patch over the same corners the first stays: how many went.
std::size_t leave_out_doubles(std::span<const std::uint32_t> patches, std::vector<Piece>& pieces) {
    const auto key = [&](std::uint32_t i) {
        Triangle corners = pieces[i].triangle;
        std::ranges::sort(corners);
        return std::pair(corners, patches[pieces[i].source]);
    };
    std::vector<std::uint32_t> order(pieces.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, key);
    std::vector<std::uint8_t> is_double(pieces.size(), 0);
    for (std::size_t i = 1; i < order.size(); ++i) is_double[order[i]] = key(order[i]) == key(order[i - 1]) ? 1 : 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (is_double[i] == 0) pieces[kept++] = pieces[i];
    }
    const std::size_t left_out = pieces.size() - kept;
    pieces.resize(kept);
    return left_out;
}

}  // namespace

void lay_sheets(CutState& state, double width, std::span<const std::uint8_t> may_lie, const Monitor* monitor) {
    auto sheets = find_sheets(state, width, may_lie, monitor);
    if (sheets.empty()) return;
    const auto becomes = press(state, sheets);
    const auto renamed = [&](const Triangle& t) { return Triangle{becomes[t[0]], becomes[t[1]], becomes[t[2]]}; };
    std::vector<std::uint8_t> is_laid(state.triangles.size(), 0);
    std::vector<Triangle> pieces;
    std::vector<std::uint32_t> piece_source;
    Stacks stacks(state);
    for (const Sheet& sheet : sheets) {
        std::vector<Triangle> wholes;
        std::vector<std::uint32_t> numbers;
        for (const std::uint32_t t : sheet.triangles) {
            const Triangle now = renamed(state.triangles[t]);
            if (now[0] == now[1] || now[1] == now[2] || now[2] == now[0]) continue;
            wholes.push_back(now);
            numbers.push_back(t);
        }
        const auto cut = cut_in_plane(state.points, wholes, sheet.plane.normal, state.reach);
        if (!cut) continue;
        for (const std::uint32_t t : sheet.triangles) is_laid[t] = 1;
        state.laid += sheet.triangles.size();
        for (std::size_t p = 0; p < cut->triangles.size(); ++p) {
            CutState::Stack stack{{}, sheet.plane.normal};
            for (std::uint32_t c = cut->first[p]; c < cut->first[p + 1]; ++c)
                stack.layers.push_back({state.source[numbers[cut->covers[c].whole]], cut->covers[c].turned});
            pieces.push_back(cut->triangles[p]);
            piece_source.push_back(stacks.number_of(stack));
        }
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < state.triangles.size(); ++t) {
        if (is_laid[t] != 0) continue;
        state.triangles[kept] = state.triangles[t];
        state.source[kept++] = state.source[t];
    }
    state.triangles.resize(kept);
    state.source.resize(kept);
    state.is_new.assign(kept, 1);
    rename_points(state, becomes);
    state.triangles.insert(state.triangles.end(), pieces.begin(), pieces.end());
    state.source.insert(state.source.end(), piece_source.begin(), piece_source.end());
    state.is_new.resize(state.triangles.size(), 1);
}

void take_stacks_apart(CutState& state) {
    if (state.stacks.empty()) return;
    std::vector<Piece> pieces;
    std::vector<std::uint32_t> seen;
    for (std::size_t t = 0; t < state.triangles.size(); ++t) {
        const auto [a, b, c] = state.triangles[t];
        if (state.source[t] < state.patches.size()) {
            pieces.push_back({state.source[t], {a, b, c}});
            continue;
        }
        seen.clear();
        for (const auto& layer : state.stacks[state.source[t] - state.patches.size()].layers) {
            const std::uint32_t patch = state.patches[layer.source];
            if (std::ranges::find(seen, patch) != seen.end()) {
                ++state.doubled;
                continue;
            }
            seen.push_back(patch);
            pieces.push_back({layer.source, layer.turned ? Triangle{a, c, b} : Triangle{a, b, c}});
        }
    }
    std::ranges::stable_sort(pieces, {}, &Piece::source);
    state.doubled += leave_out_doubles(state.patches, pieces);
    state.triangles.clear();
    state.source.clear();
    for (const Piece& p : pieces) {
        state.triangles.push_back(p.triangle);
        state.source.push_back(p.source);
    }
    state.is_new.assign(state.triangles.size(), 0);
}

}  // namespace geomend::arrangement
