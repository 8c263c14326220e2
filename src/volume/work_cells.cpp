// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/work_cells.h"

#include <algorithm>

#include "geometry/predicates.h"
#include "volume/cell_quality.h"

namespace geomend::volumes {

FixedParts::FixedParts(const RegionFacets& facets, std::span<const std::array<std::uint32_t, 2>> edges) {
    for (const auto& e : facets.edges) edges_.insert(edge_key(e[0], e[1]));
    for (const auto& e : edges) edges_.insert(edge_key(e[0], e[1]));
    for (const Triangle& t : facets.triangles) {
        Triangle ascending = t;
        std::ranges::sort(ascending);
        faces_.insert(ascending);
        for (std::size_t k = 0; k < 3; ++k) edges_.insert(edge_key(t[k], t[(k + 1) % 3]));
    }
}

bool FixedParts::has_face(Triangle t) const {
    std::ranges::sort(t);
    return faces_.contains(t);
}

WorkCells::WorkCells(const RegionFacets& facets, RegionCells& region) : cells_(std::move(region.cells)), positions_(facets.positions) {
    positions_.insert(positions_.end(), region.new_vertices.begin(), region.new_vertices.end());
    around_.resize(positions_.size());
    for (std::uint32_t c = 0; c < cells_.size(); ++c) {
        for (const std::uint32_t v : cells_[c]) around_[v].push_back(c);
    }
    sine_.resize(cells_.size());
    tried_.resize(cells_.size(), 0);
    for (std::uint32_t c = 0; c < cells_.size(); ++c) sine_[c] = sine(cells_[c]);
}

double WorkCells::sine(const Cell& c) const { return least_sine(corners(c)); }

double WorkCells::sine_of_new(const Cell& c) const {
    if (orientation(positions_[c[0]], positions_[c[1]], positions_[c[2]], positions_[c[3]]) <= 0) return -1;
    return sine(c);
}

std::uint32_t WorkCells::across(std::uint32_t c, const Triangle& face) const {
    for (const std::uint32_t d : around_[face[0]]) {
        if (d != c && has(cells_[d], face[1]) && has(cells_[d], face[2])) return d;
    }
    return no_index;
}

void WorkCells::replace(std::span<const std::uint32_t> old, std::span<const Cell> made) {
    for (const std::uint32_t c : old) {
        for (const std::uint32_t v : cells_[c]) std::erase(around_[v], c);
        sine_[c] = -1;
    }
    for (std::size_t i = 0; i < made.size(); ++i) {
        const auto c = i < old.size() ? old[i] : static_cast<std::uint32_t>(cells_.size());
        if (i >= old.size()) cells_.emplace_back(), sine_.emplace_back(), tried_.emplace_back();
        cells_[c] = made[i];
        sine_[c] = sine(made[i]);
        for (const std::uint32_t v : made[i]) around_[v].push_back(c);
    }
    for (const Cell& cell : made) {
        for (const std::uint32_t v : cell) wake(v);
    }
}

bool WorkCells::move(std::uint32_t v, const Vec3& to) {
    constexpr double least_share = 0.01;  // many small moves cost more than they bring
    const std::uint32_t worst = worst_around(v);
    const double least = sine_[worst] * (1 + least_share) + least_gain;
    const Vec3 from = positions_[v];
    positions_[v] = to;
    const auto is_better = [&](std::uint32_t c) { return sine_of_new(cells_[c]) > least; };
    if (!is_better(worst) || !std::ranges::all_of(around_[v], is_better)) {  // the worst first: most moves fail there
        positions_[v] = from;
        return false;
    }
    for (const std::uint32_t c : around_[v]) sine_[c] = sine(cells_[c]);
    wake(v);
    return true;
}

bool WorkCells::move_and_turn(std::uint32_t v, const Vec3& to) {
    const Vec3 from = positions_[v];
    positions_[v] = to;
    if (!std::ranges::all_of(around_[v], [&](std::uint32_t c) { return sine_of_new(cells_[c]) > 0; })) {
        positions_[v] = from;
        return false;
    }
    for (const std::uint32_t c : around_[v]) sine_[c] = sine(cells_[c]);
    wake(v);
    return true;
}

std::uint32_t WorkCells::add_vertex(const Vec3& place) {
    positions_.push_back(place);
    around_.emplace_back();
    return static_cast<std::uint32_t>(positions_.size() - 1);
}

std::uint32_t WorkCells::worst_around(std::uint32_t v) const {
    return *std::ranges::min_element(around_[v], {}, [&](std::uint32_t c) { return sine_[c]; });
}

void WorkCells::put_back(const RegionFacets& facets, RegionCells& region) {
    std::size_t next = 0;
    for (std::uint32_t c = 0; c < cells_.size(); ++c) {
        if (is_there(c)) cells_[next++] = cells_[c];
    }
    cells_.resize(next);
    const auto known = static_cast<std::uint32_t>(facets.positions.size());
    std::vector<std::uint32_t> number(positions_.size() - known);
    region.new_vertices.clear();
    for (std::uint32_t v = known; v < positions_.size(); ++v) {
        if (around_[v].empty()) continue;
        number[v - known] = known + static_cast<std::uint32_t>(region.new_vertices.size());
        region.new_vertices.push_back(positions_[v]);
    }
    for (Cell& cell : cells_) {
        for (std::uint32_t& v : cell) v = v < known ? v : number[v - known];
    }
    region.cells = std::move(cells_);
}

void WorkCells::wake(std::uint32_t v) {
    for (const std::uint32_t c : around_[v]) tried_[c] = 0;
}

}  // namespace geomend::volumes
