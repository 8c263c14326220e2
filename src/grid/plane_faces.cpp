// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/plane_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace geomend::grid {

namespace {

constexpr std::uint32_t nobody = 0xffffffffu;

void push_between(std::vector<std::uint32_t>& polygon, std::uint32_t from, std::uint32_t to) {
    // Points of a pillar are numbered downwards, without holes.
    if (from < to) {
        for (std::uint32_t n = from + 1; n < to; ++n) polygon.push_back(n);
    } else {
        for (std::uint32_t n = from; n > to + 1; --n) polygon.push_back(n - 1);
    }
}

}  // namespace

void shift_crossings(FaceBatch& batch, std::uint32_t pillar_nodes, std::uint32_t shift) {
    if (shift == 0) return;
    for (std::uint32_t& node : batch.nodes) node += node >= pillar_nodes ? shift : 0;
}

void PlaneMaker::make(std::uint32_t j, PlaneRow& to) {
    std::swap(row_, to);
    row_.clear();
    plane_points_ = plane_faces_ = 0;
    row_.first.push_back(0);
    for (std::uint32_t i = 0; i <= grid_.dims[0]; ++i) {
        if (j < grid_.dims[1]) across_i(i, j);
        end_plane();
        if (i < grid_.dims[0]) across_j(i, j);
        end_plane();
    }
    std::swap(row_, to);
}

void PlaneMaker::across_i(std::uint32_t i, std::uint32_t j) {
    const std::size_t lines = std::size_t{grid_.dims[0]} + 1, a = i + lines * j;
    const Between between{a, a + lines};
    if (i > 0 && i < grid_.dims[0])
        return pair({i - 1, j, true, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a + lines)}, between);
    border(i > 0 ? i - 1 : 0, j, i > 0 ? CellFace::i_plus : CellFace::i_minus, between);
}

void PlaneMaker::across_j(std::uint32_t i, std::uint32_t j) {
    const std::size_t a = i + (std::size_t{grid_.dims[0]} + 1) * j;
    const Between between{a, a + 1};
    if (j > 0 && j < grid_.dims[1])
        return pair({i, j - 1, false, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a + 1)}, between);
    border(i, j > 0 ? j - 1 : 0, j > 0 ? CellFace::j_plus : CellFace::j_minus, between);
}

// The sides of a column at the edge of the grid, whole.
void PlaneMaker::border(std::uint32_t i, std::uint32_t j, CellFace face, const Between& between) {
    sides_.first.resize(grid_.dims[2]);
    sides_.first_active.resize(grid_.dims[2]);
    column_sides(sides_.depths, i, j, face, sides_.first);
    for (std::uint32_t k = 0; k < grid_.dims[2]; ++k) sides_.first_active[k] = present_[grid_.cell(i, j, k)];
    number(sides_.first, sides_.first_active, between, first_nodes_);
    for (std::uint32_t k = 0; k < grid_.dims[2]; ++k) {
        if (sides_.first_active[k] != 0)
            whole(sides_.first[k], first_nodes_[k], static_cast<std::uint32_t>(grid_.cell(i, j, k)), nobody, face);
    }
}

void PlaneMaker::pair(const ColumnPair& columns, const Between& between) {
    load(grid_, present_, columns, sides_);
    number(sides_.first, sides_.first_active, between, first_nodes_);
    number(sides_.second, sides_.second_active, between, second_nodes_);
    const auto first = static_cast<std::uint32_t>(grid_.cell(columns.i, columns.j, 0));
    const std::uint32_t second = first + (columns.along_i ? 1 : grid_.dims[0]), layer = grid_.dims[0] * grid_.dims[1];
    const CellFace face = columns.along_i ? CellFace::i_plus : CellFace::j_plus;
    const CellFace back = columns.along_i ? CellFace::i_minus : CellFace::j_minus;
    if (!sides_.ordered || !grid_.reservoirs.empty()) return unmatched(first, second, face, back);
    each_contact(sides_, [&](std::uint32_t k, std::uint32_t m) {
        share({sides_.first[k], first_nodes_[k]}, {sides_.second[m], second_nodes_[m]}, first + k * layer, second + m * layer, face,
              between);
    });
    const auto range = depth_range();
    find_voids(sides_.second, sides_.second_active, second_nodes_, range);
    free_sides(sides_.first, sides_.first_active, first_nodes_, first, face, between);
    find_voids(sides_.first, sides_.first_active, first_nodes_, range);
    free_sides(sides_.second, sides_.second_active, second_nodes_, second, back, between);
}

// Where cells of a column overlap or are folded only sides that are alike are shared.
void PlaneMaker::unmatched(std::uint32_t first, std::uint32_t second, CellFace face, CellFace back) {
    const std::uint32_t layer = grid_.dims[0] * grid_.dims[1];
    bool all = true;
    for (std::uint32_t k = 0; k < grid_.dims[2]; ++k) {
        const bool one = sides_.first_active[k] != 0, two = sides_.second_active[k] != 0;
        if (one && two && sides_.first[k] == sides_.second[k]) {
            whole(sides_.first[k], first_nodes_[k], first + k * layer, second + k * layer, face);
            continue;
        }
        if (one) whole(sides_.first[k], first_nodes_[k], first + k * layer, nobody, face);
        if (two) whole(sides_.second[k], second_nodes_[k], second + k * layer, nobody, back);
        all = all && !one && !two;
    }
    if (!all) ++row_.unmatched;
}

void PlaneMaker::number(std::span<const Side> sides, std::span<const std::uint8_t> active, const Between& between,
                        std::vector<SideNodes>& to) const {
    to.resize(sides.size());
    std::uint32_t a = 0, b = 0;  // where the last one was
    for (std::uint32_t k = 0; k < sides.size(); ++k) {
        if (active[k] == 0) continue;
        const std::size_t shift = grid_.reservoirs.empty() ? 0 : pillar_count(grid_.dims) * pillar_set(grid_, k);
        const Side& s = sides[k];
        SideNodes& n = to[k];
        n.top_a = nodes_.id(between.pillar_a + shift, s.top_a, a);
        n.top_b = nodes_.id(between.pillar_b + shift, s.top_b, b);
        n.bottom_a = a = nodes_.id(between.pillar_a + shift, s.bottom_a, n.top_a);
        n.bottom_b = b = nodes_.id(between.pillar_b + shift, s.bottom_b, n.top_b);
    }
}

// Depths beyond all sides of both columns.
std::array<double, 2> PlaneMaker::depth_range() const {
    double least = 0, most = 0;
    bool any = false;
    const auto widen = [&](const Side& s) {
        const double low = std::min(s.top_a, s.top_b), high = std::max(s.bottom_a, s.bottom_b);
        least = any ? std::min(least, low) : low;
        most = any ? std::max(most, high) : high;
        any = true;
    };
    for (std::size_t k = 0; k < sides_.first.size(); ++k) {
        if (sides_.first_active[k] != 0) widen(sides_.first[k]);
        if (sides_.second_active[k] != 0) widen(sides_.second[k]);
    }
    const double beyond = most - least + 1;
    return {least - beyond, most + beyond};
}

// Where a column turns nothing to its neighbour: above, between and below its cells.
void PlaneMaker::find_voids(const std::vector<Side>& sides, const std::vector<std::uint8_t>& active, const std::vector<SideNodes>& nodes,
                            const std::array<double, 2>& range) {
    voids_.clear();
    Numbered open{{range[0], range[0], range[1], range[1]}, {nobody, nobody, nobody, nobody}};
    for (std::size_t k = 0; k < sides.size(); ++k) {
        if (active[k] == 0) continue;
        const Side& s = sides[k];
        if (open.side.top_a != s.top_a || open.side.top_b != s.top_b) {
            voids_.push_back({{open.side.top_a, open.side.top_b, s.top_a, s.top_b},
                              {open.nodes.top_a, open.nodes.top_b, nodes[k].top_a, nodes[k].top_b}});
        }
        open.side.top_a = s.bottom_a;
        open.side.top_b = s.bottom_b;
        open.nodes.top_a = nodes[k].bottom_a;
        open.nodes.top_b = nodes[k].bottom_b;
    }
    voids_.push_back(open);
}

void PlaneMaker::free_sides(const std::vector<Side>& sides, const std::vector<std::uint8_t>& active, const std::vector<SideNodes>& nodes,
                            std::uint32_t column, CellFace face, const Between& between) {
    const std::uint32_t layer = grid_.dims[0] * grid_.dims[1];
    std::size_t start = 0;
    for (std::uint32_t k = 0; k < sides.size(); ++k) {
        if (active[k] == 0) continue;
        const Side& s = sides[k];
        while (start < voids_.size() && voids_[start].side.bottom_a <= s.top_a && voids_[start].side.bottom_b <= s.top_b) ++start;
        for (std::size_t v = start; v < voids_.size(); ++v) {
            if (voids_[v].side.top_a >= s.bottom_a && voids_[v].side.top_b >= s.bottom_b) break;
            share({s, nodes[k]}, voids_[v], column + k * layer, nobody, face, between);
        }
    }
}

// Along the top from a to b, down b, back along the bottom and up a.
void PlaneMaker::whole(const Side& side, const SideNodes& nodes, std::uint32_t first, std::uint32_t second, CellFace face) {
    polygon_.clear();
    polygon_.push_back(nodes.top_a);
    polygon_.push_back(nodes.top_b);
    if (side.top_b <= side.bottom_b) push_between(polygon_, nodes.top_b, nodes.bottom_b);
    if (side.bottom_b != side.top_b) polygon_.push_back(nodes.bottom_b);
    if (side.bottom_a != side.top_a) polygon_.push_back(nodes.bottom_a);
    if (side.top_a <= side.bottom_a) push_between(polygon_, nodes.bottom_a, nodes.top_a);
    add(first, second, face);
}

// What two sides share becomes a face.
void PlaneMaker::share(const Numbered& one, const Numbered& two, std::uint32_t first, std::uint32_t second, CellFace face,
                       const Between& between) {
    if (one.side == two.side) return whole(one.side, one.nodes, first, second, face);
    const Overlap shared = overlap(one.side, two.side);
    if (shared.count == 0) return;
    const auto on_a = [&](double depth) {
        if (depth == one.side.top_a) return one.nodes.top_a;
        if (depth == one.side.bottom_a) return one.nodes.bottom_a;
        return depth == two.side.top_a ? two.nodes.top_a : two.nodes.bottom_a;
    };
    const auto on_b = [&](double depth) {
        if (depth == one.side.top_b) return one.nodes.top_b;
        if (depth == one.side.bottom_b) return one.nodes.bottom_b;
        return depth == two.side.top_b ? two.nodes.top_b : two.nodes.bottom_b;
    };
    polygon_.clear();
    for (std::uint32_t c = 0; c < shared.count; ++c) {
        const OverlapCorner& corner = shared.corners[c];
        const OverlapCorner& next = shared.corners[(c + 1) % shared.count];
        const std::uint32_t node = corner.u == 0   ? on_a(corner.first[0])
                                   : corner.u == 1 ? on_b(corner.first[1])
                                                   : crossing_node(corner, between);
        polygon_.push_back(node);
        if (corner.u == 1 && next.u == 1) push_between(polygon_, node, on_b(next.first[1]));
        if (corner.u == 0 && next.u == 0) push_between(polygon_, node, on_a(next.first[0]));
    }
    add(first, second, face);
}

std::uint32_t PlaneMaker::crossing_node(const OverlapCorner& corner, const Between& between) {
    const auto fresh = static_cast<std::uint32_t>(nodes_.size() + row_.points.size());
    const std::uint32_t node = table_.number(corner.first, corner.second, fresh);
    if (node != fresh) return node;
    const Vec3 p = position(corner, [&](int pillar, double depth) {
        return pillar_point(grid_.pillars.data() + 6 * (pillar == 0 ? between.pillar_a : between.pillar_b), depth, grid_.cylindrical);
    });
    row_.points.push_back({p[0], p[1], 0.0 - p[2]});
    row_.crossings.push_back({corner.first, corner.u, node});
    row_.crossings.push_back({corner.second, corner.u, node});
    return node;
}

void PlaneMaker::add(std::uint32_t first, std::uint32_t second, CellFace side) {
    if (polygon_.size() < 3) return;
    // As gathered a side runs along +J (or +I) above and back below: outwards for i_plus and j_minus.
    if (side == CellFace::i_minus || side == CellFace::j_plus) std::ranges::reverse(polygon_);
    row_.batch.add({first, second, side}, polygon_);
}

// Layers as thin as the rounding of their depths have crossings whose order is not certain: those are one point.
std::vector<std::uint32_t> PlaneMaker::joined_crossings() const {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const std::size_t count = row_.points.size() - plane_points_;
    const auto fraction = [&](std::uint32_t n) { return row_.crossings[row_.first.back() + 2 * std::size_t{n}].u; };
    const auto depth = [&](std::uint32_t n) { return row_.points[plane_points_ + n][2]; };
    std::vector<std::uint32_t> order(count), joined(count);
    std::iota(order.begin(), order.end(), 0u);
    std::iota(joined.begin(), joined.end(), 0u);
    std::ranges::sort(order, [&](std::uint32_t p, std::uint32_t q) { return std::pair(fraction(p), p) < std::pair(fraction(q), q); });
    for (std::size_t n = 0; n < count; ++n) {
        for (std::size_t m = n + 1; m < count && fraction(order[m]) - fraction(order[n]) <= 8 * epsilon; ++m) {
            const double p = depth(order[n]), q = depth(order[m]);
            if (std::abs(p - q) <= 8 * epsilon * std::max(std::abs(p), std::abs(q))) joined[order[m]] = joined[order[n]];
        }
    }
    return joined;
}

void PlaneMaker::join_crossings() {
    std::vector<std::uint32_t> number = joined_crossings();
    // Points that are left get numbers without holes.
    std::uint32_t kept = 0;
    std::vector<std::uint32_t> fresh(number.size());
    for (std::uint32_t n = 0; n < number.size(); ++n) {
        if (number[n] != n) continue;
        row_.points[plane_points_ + kept] = row_.points[plane_points_ + n];
        fresh[n] = kept++;
    }
    if (kept == number.size()) return;
    row_.points.resize(plane_points_ + kept);
    const auto before = static_cast<std::uint32_t>(nodes_.size() + plane_points_);
    const auto renumbered = [&](std::uint32_t node) { return node < before ? node : before + fresh[number[node - before]]; };
    for (std::size_t c = row_.first.back(); c < row_.crossings.size(); ++c) row_.crossings[c].node = renumbered(row_.crossings[c].node);
    FaceBatch batch = std::move(row_.batch);
    row_.batch = {};
    std::size_t at = 0;
    for (std::size_t f = 0; f < batch.faces.size(); at += batch.sizes[f++]) {
        polygon_.assign(batch.nodes.begin() + static_cast<std::ptrdiff_t>(at),
                        batch.nodes.begin() + static_cast<std::ptrdiff_t>(at + batch.sizes[f]));
        if (f >= plane_faces_) {
            for (std::uint32_t& node : polygon_) node = renumbered(node);
            polygon_.erase(std::ranges::unique(polygon_).begin(), polygon_.end());
            while (polygon_.size() > 1 && polygon_.front() == polygon_.back()) polygon_.pop_back();
        }
        if (polygon_.size() >= 3) row_.batch.add(batch.faces[f], polygon_);
    }
}

void PlaneMaker::end_plane() {
    if (row_.points.size() > plane_points_ + 1) join_crossings();
    const auto begin = row_.crossings.begin() + static_cast<std::ptrdiff_t>(row_.first.back());
    std::sort(begin, row_.crossings.end(),
              [](const EdgeCrossing& p, const EdgeCrossing& q) { return std::tie(p.edge, p.u, p.node) < std::tie(q.edge, q.u, q.node); });
    const auto same = [](const EdgeCrossing& p, const EdgeCrossing& q) { return p.edge == q.edge && p.node == q.node; };
    row_.crossings.erase(std::unique(begin, row_.crossings.end(), same), row_.crossings.end());
    row_.first.push_back(row_.crossings.size());
    plane_points_ = row_.points.size();
    plane_faces_ = row_.batch.faces.size();
    table_.clear();
}

}  // namespace geomend::grid
