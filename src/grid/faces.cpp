// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/faces.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "grid/connections.h"
#include "grid/pillar_nodes.h"
#include "grid/plane_faces.h"

namespace geomend::grid {

namespace {

constexpr std::uint32_t nobody = 0xffffffffu;
constexpr std::size_t rows_at_once = 16;  // so that faces do not lie in memory twice

// Crossings of the rows that are done, kept for the tops and bottoms of columns.
struct RowCrossings {
    PlaneRow row;
    std::uint32_t shift = 0;  // what is added to the row's own numbers of crossings
};

// Tops and bottoms of the columns of one row.
class LevelMaker {
public:
    LevelMaker(const CornerPointGrid& grid, std::span<const std::uint8_t> present, const PillarNodes& nodes,
               std::span<const RowCrossings> rows)
        : grid_(grid), present_(present), nodes_(nodes), rows_(rows) {}

    FaceBatch make(std::uint32_t j) {
        batch_ = {};
        for (std::uint32_t i = 0; i < grid_.dims[0]; ++i) stack(i, j);
        return std::move(batch_);
    }

private:
    void stack(std::uint32_t i, std::uint32_t j) {
        std::uint32_t above = nobody;
        last_ = {};
        for (std::uint32_t k = 0; k < grid_.dims[2]; ++k) {
            const auto cell = static_cast<std::uint32_t>(grid_.cell(i, j, k));
            if (present_[cell] == 0) continue;
            const bool touching = above != nobody && stacked(grid_, above, cell);
            if (above != nobody) level(above, touching ? cell : nobody, CellFace::k_plus);
            if (!touching) level(cell, nobody, CellFace::k_minus);
            above = cell;
        }
        if (above != nobody) level(above, nobody, CellFace::k_plus);
    }

    void level(std::uint32_t cell, std::uint32_t other, CellFace side) {
        const auto [i, j, k] = grid_.ijk(cell);
        const unsigned base = side == CellFace::k_plus ? 4 : 0;
        std::array<double, 4> depth;
        for (unsigned c = 0; c < 4; ++c) {
            depth[c] = grid_.depths[corner_index(grid_.dims, i, j, k, c + base)];
            last_[c] = nodes_.id(pillar_of(grid_, i, j, k, c), depth[c], last_[c]);
        }
        polygon_.clear();
        polygon_.push_back(last_[0]);
        along(j, PlaneRow::plane_across_j(i), {depth[0], depth[1]}, true);
        polygon_.push_back(last_[1]);
        along(j, PlaneRow::plane_across_i(i + 1), {depth[1], depth[3]}, true);
        polygon_.push_back(last_[3]);
        along(j + 1, PlaneRow::plane_across_j(i), {depth[2], depth[3]}, false);
        polygon_.push_back(last_[2]);
        along(j, PlaneRow::plane_across_i(i), {depth[0], depth[2]}, false);
        if (side == CellFace::k_minus) std::ranges::reverse(polygon_);
        batch_.add({cell, other, side}, polygon_);
    }

    // Crossings on an edge between two pillars, from a to b or back.
    void along(std::uint32_t row, std::size_t plane, const std::array<double, 2>& edge, bool forward) {
        const auto all = rows_[row].row.of_plane(plane);
        if (all.empty()) return;
        const auto found = std::ranges::equal_range(all, edge, {}, &EdgeCrossing::edge);
        const std::size_t start = polygon_.size();
        for (const EdgeCrossing& c : found) polygon_.push_back(c.node + rows_[row].shift);
        if (!forward) std::reverse(polygon_.begin() + static_cast<std::ptrdiff_t>(start), polygon_.end());
    }

    const CornerPointGrid& grid_;
    std::span<const std::uint8_t> present_;
    const PillarNodes& nodes_;
    std::span<const RowCrossings> rows_;
    FaceBatch batch_;
    std::array<std::uint32_t, 4> last_{};  // points of the level before, where the next are near
    std::vector<std::uint32_t> polygon_;
};

/// \param pillar_nodes numbers from here on are of crossings and get `shift` added
void append(const FaceBatch& batch, std::uint32_t pillar_nodes, std::uint32_t shift, GridFaces& to) {
    const std::size_t start = to.nodes.size();
    to.faces.insert(to.faces.end(), batch.faces.begin(), batch.faces.end());
    to.nodes.insert(to.nodes.end(), batch.nodes.begin(), batch.nodes.end());
    std::uint64_t end = to.offsets.back();
    for (const std::uint32_t size : batch.sizes) to.offsets.push_back(end += size);
    if (shift == 0) return;
    for (std::size_t n = start; n < to.nodes.size(); ++n) to.nodes[n] += to.nodes[n] >= pillar_nodes ? shift : 0;
}

void reserve(std::size_t present, GridFaces& to) {
    const std::size_t faces = present * 3 + present / 4 + 64;
    to.faces.reserve(faces);
    to.offsets.reserve(faces + 1);
    to.nodes.reserve(faces * 4 + faces / 4);
}

std::vector<RowCrossings> add_planes(const CornerPointGrid& grid, const PillarNodes& nodes, GridFaces& to) {
    std::vector<RowCrossings> rows(std::size_t{grid.dims[1]} + 1);
    const auto pillar_nodes = static_cast<std::uint32_t>(nodes.size());
    for (std::size_t start = 0; start < rows.size(); start += rows_at_once) {
        const std::size_t count = std::min(rows_at_once, rows.size() - start);
        parallel_blocks(count, 1, [&](std::size_t first, std::size_t last) {
            PlaneMaker maker(grid, to.present, nodes);
            for (std::size_t r = first; r < last; ++r) rows[start + r].row = maker.make(static_cast<std::uint32_t>(start + r));
        });
        for (std::size_t r = start; r < start + count; ++r) {
            PlaneRow& row = rows[r].row;
            rows[r].shift = static_cast<std::uint32_t>(to.points.size()) - pillar_nodes;
            append(row.batch, pillar_nodes, row.points.empty() ? 0 : rows[r].shift, to);
            to.points.insert(to.points.end(), row.points.begin(), row.points.end());
            to.unmatched_columns += row.unmatched;
            row.batch = {};
            row.points = {};
        }
    }
    return rows;
}

void add_levels(const CornerPointGrid& grid, const PillarNodes& nodes, std::span<const RowCrossings> rows, GridFaces& to) {
    std::vector<FaceBatch> batches(rows_at_once);
    for (std::size_t start = 0; start < grid.dims[1]; start += rows_at_once) {
        const std::size_t count = std::min<std::size_t>(rows_at_once, grid.dims[1] - start);
        parallel_blocks(count, 1, [&](std::size_t first, std::size_t last) {
            LevelMaker maker(grid, to.present, nodes, rows);
            for (std::size_t r = first; r < last; ++r) batches[r] = maker.make(static_cast<std::uint32_t>(start + r));
        });
        for (std::size_t r = 0; r < count; ++r) append(batches[r], 0, 0, to);
    }
}

}  // namespace

GridFaces conforming_faces(const CornerPointGrid& grid) {
    GridFaces result;
    result.present = present_cells(grid);
    const PillarNodes nodes(grid, result.present);
    result.points = nodes.points(grid);
    reserve(static_cast<std::size_t>(std::ranges::count_if(result.present, [](std::uint8_t p) { return p != 0; })), result);
    const auto rows = add_planes(grid, nodes, result);
    add_levels(grid, nodes, rows, result);
    return result;
}

}  // namespace geomend::grid
