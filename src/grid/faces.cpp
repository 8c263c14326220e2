// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/faces.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "grid/column_depths.h"
#include "grid/level_faces.h"
#include "grid/pillar_nodes.h"
#include "grid/plane_faces.h"

namespace geomend::grid {

namespace {

constexpr std::size_t rows_at_once = 16;  // so that faces do not lie in memory twice

struct NumberedRow {
    PlaneRow row;
    std::uint32_t shift = 0;  // what is added to the row's own numbers of crossings
};

void append(const FaceBatch& batch, GridFaces& to) {
    to.faces.insert(to.faces.end(), batch.faces.begin(), batch.faces.end());
    to.nodes.insert(to.nodes.end(), batch.nodes.begin(), batch.nodes.end());
    std::uint64_t end = to.offsets.back();
    for (const std::uint32_t size : batch.sizes) to.offsets.push_back(end += size);
}

void reserve(std::size_t present, GridFaces& to) {
    const std::size_t faces = present * 3 + present / 4 + 64;
    to.faces.reserve(faces);
    to.offsets.reserve(faces + 1);
    to.nodes.reserve(faces * 4 + faces / 4);
}

std::vector<NumberedRow> add_planes(const CornerPointGrid& grid, const PillarNodes& nodes, GridFaces& to) {
    std::vector<NumberedRow> rows(std::size_t{grid.dims[1]} + 1);
    const auto pillar_nodes = static_cast<std::uint32_t>(nodes.size());
    for (std::size_t start = 0; start < rows.size(); start += rows_at_once) {
        const std::size_t count = std::min(rows_at_once, rows.size() - start);
        parallel_blocks(count, 1, [&](std::size_t first, std::size_t last) {
            PlaneMaker maker(grid, to.present, nodes);
            for (std::size_t r = first; r < last; ++r) maker.make(static_cast<std::uint32_t>(start + r), rows[start + r].row);
        });
        for (std::size_t r = start; r < start + count; ++r) {
            PlaneRow& row = rows[r].row;
            rows[r].shift = static_cast<std::uint32_t>(to.points.size()) - pillar_nodes;
            shift_crossings(row.batch, pillar_nodes, rows[r].shift);
            append(row.batch, to);
            to.points.insert(to.points.end(), row.points.begin(), row.points.end());
            to.unmatched_columns += row.unmatched;
            row.batch = {};
            row.points = {};
        }
    }
    return rows;
}

void add_levels(const CornerPointGrid& grid, const PillarNodes& nodes, std::span<const NumberedRow> rows, GridFaces& to) {
    std::vector<FaceBatch> batches(rows_at_once);
    for (std::size_t start = 0; start < grid.dims[1]; start += rows_at_once) {
        const std::size_t count = std::min<std::size_t>(rows_at_once, grid.dims[1] - start);
        parallel_blocks(count, 1, [&](std::size_t first, std::size_t last) {
            ColumnDepths depths(grid);
            LevelMaker maker(grid, to.present, nodes, depths);
            for (std::size_t r = first; r < last; ++r) {
                const NumberedRow &north = rows[start + r], &south = rows[start + r + 1];
                maker.make(static_cast<std::uint32_t>(start + r), {&north.row, north.shift}, {&south.row, south.shift}, batches[r]);
            }
        });
        for (std::size_t r = 0; r < count; ++r) append(batches[r], to);
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
