// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/cell_mesh.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/parallel.h"
#include "geometry/cell_volume.h"
#include "grid/cell_geometry.h"
#include "grid/pillar_nodes.h"
#include "grid/pinched_cell.h"
#include "model/attribute_operations.h"

namespace geomend::grid {

namespace {

constexpr std::uint32_t nobody = 0xffffffffu;

void take_info(const CornerPointGrid& grid, Cells& cells) {
    ObjectInfo& info = cells.mesh.info;
    info.name = grid.info.name;
    info.role = grid.info.role;
    info.role_text = grid.info.role_text;
    info.feature = grid.info.feature;
    info.crs = grid.info.crs;
    info.groups = grid.info.groups;
    info.attributes = cell_attributes(grid, cells.source);
}

void list_collapsed(const CornerPointGrid& grid, std::span<const std::uint8_t> present, Cells& cells) {
    for (std::size_t c = 0; c < present.size(); ++c) {
        if (present[c] == 0 && grid.is_active(c)) cells.collapsed.push_back(static_cast<std::uint32_t>(c));
    }
}

// Faces of each cell, in the order in which they were made.
struct FacesOfCells {
    std::vector<std::uint64_t> first;
    std::vector<std::uint32_t> faces;

    FacesOfCells(const GridFaces& all, std::size_t cells) : first(cells + 1, 0) {
        for (const auto& f : all.faces) {
            ++first[f.first + 1];
            if (f.second != nobody) ++first[f.second + 1];
        }
        for (std::size_t c = 0; c < cells; ++c) first[c + 1] += first[c];
        faces.resize(first.back());
        std::vector<std::uint64_t> at(first.begin(), first.end() - 1);
        for (std::uint32_t f = 0; f < all.faces.size(); ++f) {
            faces[at[all.faces[f].first]++] = f;
            if (all.faces[f].second != nobody) faces[at[all.faces[f].second]++] = f;
        }
    }
};

// Lengths first, so that all cells can be filled at the same time.
void add_cell_faces(const GridFaces& faces, const FacesOfCells& own, bool turn_first, Cells& cells) {
    CellMesh& mesh = cells.mesh;
    mesh.cell_faces.reserve(cells.source.size() + 1);
    mesh.cell_faces.push_back(0);
    for (const std::uint32_t c : cells.source) mesh.cell_faces.push_back(mesh.cell_faces.back() + own.first[c + 1] - own.first[c]);
    mesh.face_offsets.reserve(mesh.cell_faces.back() + 1);
    mesh.face_offsets.push_back(0);
    for (const std::uint32_t c : cells.source) {
        for (std::uint64_t f = own.first[c]; f < own.first[c + 1]; ++f)
            mesh.face_offsets.push_back(mesh.face_offsets.back() + faces.polygon(own.faces[f]).size());
    }
    mesh.face_nodes.resize(mesh.face_offsets.back());
    parallel_blocks(cells.source.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s) {
            const std::uint32_t c = cells.source[s];
            auto to = mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[mesh.cell_faces[s]]);
            for (std::uint64_t f = own.first[c]; f < own.first[c + 1]; ++f) {
                const auto polygon = faces.polygon(own.faces[f]);
                const bool turn = (faces.faces[own.faces[f]].first == c) == turn_first;
                to = turn ? std::ranges::reverse_copy(polygon, to).out : std::ranges::copy(polygon, to).out;
            }
        }
    });
}

// The distinct corners of the faces of each cell, ascending.
void add_cell_nodes(CellMesh& mesh) {
    constexpr std::size_t at_once = 8192;
    const std::size_t cells = mesh.types.size(), blocks = (cells + at_once - 1) / at_once;
    std::vector<std::vector<std::uint32_t>> nodes(blocks);
    mesh.offsets.resize(cells + 1);
    mesh.offsets[0] = 0;
    parallel_for_each_index(blocks, [&](std::size_t block) {
        std::vector<std::uint32_t> distinct;
        for (std::size_t c = block * at_once; c < std::min(cells, (block + 1) * at_once); ++c) {
            const auto* const corners = mesh.face_nodes.data();
            distinct.assign(corners + mesh.face_offsets[mesh.cell_faces[c]], corners + mesh.face_offsets[mesh.cell_faces[c + 1]]);
            std::ranges::sort(distinct);
            distinct.erase(std::ranges::unique(distinct).begin(), distinct.end());
            nodes[block].insert(nodes[block].end(), distinct.begin(), distinct.end());
            mesh.offsets[c + 1] = distinct.size();
        }
    });
    for (std::size_t c = 0; c < cells; ++c) mesh.offsets[c + 1] += mesh.offsets[c];
    mesh.nodes.reserve(mesh.offsets.back());
    for (auto& part : nodes) {
        mesh.nodes.insert(mesh.nodes.end(), part.begin(), part.end());
        part = {};
    }
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

std::vector<Attribute> cell_attributes(const CornerPointGrid& grid, std::span<const std::uint32_t> source) {
    std::vector<std::int32_t> i, j, k, active;
    std::vector<std::int64_t> global;
    std::vector<std::int32_t> rank(grid.activity.empty() ? 0 : grid.cell_count());
    std::int32_t next = 0;
    for (std::size_t c = 0; c < rank.size(); ++c) rank[c] = grid.is_active(c) ? ++next : 0;
    for (const std::uint32_t cell : source) {
        const auto at = grid.ijk(cell);
        i.push_back(static_cast<std::int32_t>(at[0] + 1));
        j.push_back(static_cast<std::int32_t>(at[1] + 1));
        k.push_back(static_cast<std::int32_t>(at[2] + 1));
        global.push_back(std::int64_t{cell} + 1);
        active.push_back(rank.empty() ? static_cast<std::int32_t>(cell + 1) : rank[cell]);
    }
    std::vector<Attribute> all;
    const auto add = [&](const char* name, AttributeValues values) {
        if (find_attribute(grid.info.attributes, name, AttributeLocation::cell) != nullptr) return;
        Attribute a;
        a.name = name;
        a.location = AttributeLocation::cell;
        a.values = std::move(values);
        all.push_back(std::move(a));
    };
    add("I", std::move(i));
    add("J", std::move(j));
    add("K", std::move(k));
    add("GlobalIndex", std::move(global));
    add("ActiveIndex", std::move(active));
    for (const Attribute& a : grid.info.attributes) {
        if (a.location == AttributeLocation::cell) all.push_back(taken(a, source));
        else if (a.location == AttributeLocation::object) all.push_back(a);
    }
    return all;
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
    return cells;
}

Cells conforming_cells(const CornerPointGrid& grid) { return conforming_cells(grid, conforming_faces(grid)); }

Cells conforming_cells(const CornerPointGrid& grid, const GridFaces& faces) {
    Cells cells;
    for (std::uint32_t c = 0; c < grid.cell_count(); ++c) {
        if (faces.present[c] != 0) cells.source.push_back(c);
    }
    const FacesOfCells own(faces, grid.cell_count());
    cells.mesh.points = faces.points;
    cells.mesh.types.assign(cells.source.size(), CellType::polyhedron);
    // Elevation turns the hand round: what leaves the cell in (I,J,K) enters it where the grid is right-handed.
    add_cell_faces(faces, own, right_handed(grid), cells);
    add_cell_nodes(cells.mesh);
    cells.unmatched_columns = faces.unmatched_columns;
    list_collapsed(grid, faces.present, cells);
    take_info(grid, cells);
    return cells;
}

}  // namespace geomend::grid
