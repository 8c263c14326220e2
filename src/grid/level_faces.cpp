// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/level_faces.h"

#include <algorithm>

namespace geomend::grid {

namespace {

constexpr std::uint32_t no_cell = 0xffffffffu;

}  // namespace

void LevelMaker::make(std::uint32_t j, const ShiftedRow& north, const ShiftedRow& south, FaceBatch& to) {
    north_ = north;
    south_ = south;
    to_ = &to;
    to.clear();
    for (std::uint32_t i = 0; i < grid_.dims[0]; ++i) stack(i, j);
}

void LevelMaker::stack(std::uint32_t i, std::uint32_t j) {
    const std::size_t layer = std::size_t{grid_.dims[0]} * grid_.dims[1], column = grid_.cell(i, j, 0);
    std::uint32_t above = no_cell;
    last_ = {};
    for (unsigned c = 0; c < 4; ++c) columns_[c] = depths_.column(2 * std::size_t{i} + (c & 1u), 2 * std::size_t{j} + (c >> 1));
    for (std::uint32_t k = 0; k < grid_.dims[2]; ++k) {
        const auto cell = static_cast<std::uint32_t>(column + k * layer);
        if (present_[cell] == 0) continue;
        const bool touch = above != no_cell && touching(above, k);
        if (above != no_cell) level(i, j, above, touch ? cell : no_cell, CellFace::k_plus);
        if (!touch) level(i, j, k, no_cell, CellFace::k_minus);
        above = k;
    }
    if (above != no_cell) level(i, j, above, no_cell, CellFace::k_plus);
}

// The bottom of one cell of the column is the top of another.
bool LevelMaker::touching(std::uint32_t upper, std::uint32_t lower) const {
    const std::size_t bottom = 2 * std::size_t{upper} + 1, top = 2 * std::size_t{lower};
    return on_same_pillars(grid_, upper, lower) &&
           std::ranges::all_of(columns_, [&](const double* depths) { return depths[bottom] == depths[top]; });
}

void LevelMaker::level(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t other, CellFace side) {
    const std::size_t place = 2 * std::size_t{k} + (side == CellFace::k_plus ? 1 : 0);
    const std::size_t pillar = pillar_of(grid_, i, j, k, 0), lines = std::size_t{grid_.dims[0]} + 1;
    std::array<double, 4> depth;
    for (unsigned c = 0; c < 4; ++c) {
        depth[c] = columns_[c][place];
        last_[c] = nodes_.id(pillar + (c & 1u) + (c >> 1) * lines, depth[c], last_[c]);
    }
    polygon_.clear();
    polygon_.push_back(last_[0]);
    along(north_, PlaneRow::plane_across_j(i), {depth[0], depth[1]}, true);
    polygon_.push_back(last_[1]);
    along(north_, PlaneRow::plane_across_i(i + 1), {depth[1], depth[3]}, true);
    polygon_.push_back(last_[3]);
    along(south_, PlaneRow::plane_across_j(i), {depth[2], depth[3]}, false);
    polygon_.push_back(last_[2]);
    along(north_, PlaneRow::plane_across_i(i), {depth[0], depth[2]}, false);
    if (side == CellFace::k_minus) std::ranges::reverse(polygon_);
    to_->add({static_cast<std::uint32_t>(grid_.cell(i, j, k)), other, side}, polygon_);
}

// Crossings on an edge between two pillars, from a to b or back.
void LevelMaker::along(const ShiftedRow& row, std::size_t plane, const std::array<double, 2>& edge, bool forward) {
    const auto all = row.row->of_plane(plane);
    if (all.empty()) return;
    const auto found = std::ranges::equal_range(all, edge, {}, &EdgeCrossing::edge);
    const std::size_t start = polygon_.size();
    for (const EdgeCrossing& c : found) polygon_.push_back(c.node + row.shift);
    if (!forward) std::reverse(polygon_.begin() + static_cast<std::ptrdiff_t>(start), polygon_.end());
}

}  // namespace geomend::grid
