// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/cell_mesh.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/big_array.h"
#include "base/parallel.h"
#include "geometry/cell_volume.h"
#include "grid/cell_faces.h"
#include "grid/cell_geometry.h"
#include "grid/pillar_nodes.h"
#include "grid/pinched_cell.h"

namespace geomend::grid {

namespace {

void take_info(const CornerPointGrid& grid, Cells& cells) {
    ObjectInfo& info = cells.mesh.info;
    info.name = grid.info.name;
    info.role = grid.info.role;
    info.role_text = grid.info.role_text;
    info.feature = grid.info.feature;
    info.crs = grid.info.crs;
    info.groups = grid.info.groups;
}

void list_collapsed(const CornerPointGrid& grid, std::span<const std::uint8_t> present, Cells& cells) {
    for (std::size_t c = 0; c < present.size(); ++c) {
        if (present[c] == 0 && grid.is_active(c)) cells.collapsed.push_back(static_cast<std::uint32_t>(c));
    }
}

// The distinct values of a list, ascending. Lists are short: a look at all that were found costs less than sorting.
void find_distinct(std::span<const std::uint32_t> all, std::vector<std::uint32_t>& distinct) {
    distinct.clear();
    if (all.size() > 48) {
        distinct.assign(all.begin(), all.end());
    } else {
        for (const std::uint32_t n : all) {
            if (std::ranges::find(distinct, n) == distinct.end()) distinct.push_back(n);
        }
    }
    std::ranges::sort(distinct);
    distinct.erase(std::ranges::unique(distinct).begin(), distinct.end());
}

// The distinct corners of the faces of each cell, ascending. Made in pieces, so that they hardly lie in memory twice.
void add_cell_nodes(CellMesh& mesh) {
    constexpr std::size_t block = 8192, blocks_at_once = 64;
    const std::size_t cells = mesh.types.size(), blocks = (cells + block - 1) / block;
    std::vector<std::vector<std::uint32_t>> nodes(blocks_at_once);
    make_big(mesh.offsets, cells + 1);
    mesh.nodes.reserve(cells * 8 + cells / 2);
    for (std::size_t start = 0; start < blocks; start += blocks_at_once) {
        const std::size_t count = std::min(blocks_at_once, blocks - start);
        parallel_for_each_index(count, [&](std::size_t part) {
            std::vector<std::uint32_t> distinct;
            nodes[part].clear();
            const std::size_t first = (start + part) * block;
            for (std::size_t c = first; c < std::min(cells, first + block); ++c) {
                const std::uint64_t from = mesh.face_offsets[mesh.cell_faces[c]], to = mesh.face_offsets[mesh.cell_faces[c + 1]];
                find_distinct({mesh.face_nodes.data() + from, static_cast<std::size_t>(to - from)}, distinct);
                nodes[part].insert(nodes[part].end(), distinct.begin(), distinct.end());
                mesh.offsets[c + 1] = distinct.size();
            }
        });
        for (std::size_t part = 0; part < count; ++part) mesh.nodes.insert(mesh.nodes.end(), nodes[part].begin(), nodes[part].end());
    }
    for (std::size_t c = 0; c < cells; ++c) mesh.offsets[c + 1] += mesh.offsets[c];
}

}  // namespace

bool right_handed(const CornerPointGrid& grid) {
    std::atomic<std::int64_t> votes{0};
    parallel_blocks(grid.cell_count(), 4096, [&](std::size_t first, std::size_t last) {
        std::int64_t own = 0;
        for (std::size_t cell = first; cell < last; ++cell) {
            if (!grid.is_active(cell)) continue;
            const auto [i, j, k] = grid.ijk(cell);
            const double v = cell_volume(grid, i, j, k);
            own += v > 0 ? 1 : v < 0 ? -1 : 0;
        }
        votes += own;
    });
    return votes >= 0;
}

Cells plain_cells(const CornerPointGrid& grid) {
    Cells cells;
    const std::vector<std::uint8_t> present = present_cells(grid);
    const PillarNodes nodes(grid, present);
    cells.mesh.points = nodes.points(grid);
    const bool right = right_handed(grid);
    for (std::uint32_t c = 0; c < present.size(); ++c) {
        if (present[c] == 0) continue;
        const auto [i, j, k] = grid.ijk(c);
        std::array<std::uint32_t, 8> corner;
        for (unsigned n = 0; n < 8; ++n)
            corner[n] = nodes.id(pillar_of(grid, i, j, k, n), grid.depths[corner_index(grid.dims, i, j, k, n)]);
        add_cell(corner, right, cells.mesh);
        cells.source.push_back(c);
    }
    list_collapsed(grid, present, cells);
    take_info(grid, cells);
    cells.mesh.info.attributes = cell_attributes(grid, cells.source);
    return cells;
}

Cells conforming_cells(const CornerPointGrid& grid) {
    Cells cells;
    add_conforming_faces(grid, cells);
    add_cell_nodes(cells.mesh);
    take_info(grid, cells);
    cells.mesh.info.attributes = cell_attributes(grid, cells.source);
    return cells;
}

Cells take_conforming_cells(CornerPointGrid& grid) {
    Cells cells;
    add_conforming_faces(grid, cells);
    grid.depths = std::vector<double>();  // an empty list would keep the memory
    grid.pillars = std::vector<double>();
    add_cell_nodes(cells.mesh);
    take_info(grid, cells);
    cells.mesh.info.attributes = take_cell_attributes(grid, cells.source);
    return cells;
}

}  // namespace geomend::grid
