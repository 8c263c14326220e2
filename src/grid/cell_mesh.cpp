// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/cell_mesh.h"

#include <algorithm>
#include <array>

#include "geometry/cell_volume.h"
#include "grid/cell_geometry.h"
#include "grid/pillar_nodes.h"
#include "grid/pinched_cell.h"

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

Attribute picked(const Attribute& from, std::span<const std::uint32_t> rows) {
    Attribute to = from;
    std::visit(
        [&](auto& values) {
            auto all = std::move(values);
            values.clear();
            values.reserve(rows.size() * from.components);
            for (const std::uint32_t row : rows) {
                for (std::uint32_t c = 0; c < from.components; ++c) values.push_back(all[std::size_t{row} * from.components + c]);
            }
        },
        to.values);
    return to;
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

}  // namespace

bool right_handed(const CornerPointGrid& grid) {
    std::int64_t votes = 0;
    for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
        for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
            for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
                if (!grid.is_active(grid.cell(i, j, k))) continue;
                const double v = cell_volume(grid, i, j, k);
                votes += v > 0 ? 1 : v < 0 ? -1 : 0;
            }
        }
    }
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
        if (a.location == AttributeLocation::cell) all.push_back(picked(a, source));
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
    CellMesh& mesh = cells.mesh;
    mesh.points = faces.points;
    const FacesOfCells own(faces, grid.cell_count());
    // Elevation turns the hand round: what leaves the cell in (I,J,K) enters it where the grid is right-handed.
    const bool turn_first = right_handed(grid);
    std::vector<std::uint32_t> distinct;
    mesh.cell_faces.push_back(0);
    mesh.face_offsets.push_back(0);
    for (std::uint32_t c = 0; c < grid.cell_count(); ++c) {
        if (faces.present[c] == 0) continue;
        distinct.clear();
        for (std::uint64_t f = own.first[c]; f < own.first[c + 1]; ++f) {
            const auto polygon = faces.polygon(own.faces[f]);
            const bool turn = (faces.faces[own.faces[f]].first == c) == turn_first;
            if (turn) mesh.face_nodes.insert(mesh.face_nodes.end(), polygon.rbegin(), polygon.rend());
            else mesh.face_nodes.insert(mesh.face_nodes.end(), polygon.begin(), polygon.end());
            mesh.face_offsets.push_back(mesh.face_nodes.size());
            distinct.insert(distinct.end(), polygon.begin(), polygon.end());
        }
        std::ranges::sort(distinct);
        distinct.erase(std::ranges::unique(distinct).begin(), distinct.end());
        mesh.types.push_back(CellType::polyhedron);
        mesh.nodes.insert(mesh.nodes.end(), distinct.begin(), distinct.end());
        mesh.offsets.push_back(mesh.nodes.size());
        mesh.cell_faces.push_back(mesh.face_offsets.size() - 1);
        cells.source.push_back(c);
    }
    cells.unmatched_columns = faces.unmatched_columns;
    list_collapsed(grid, faces.present, cells);
    take_info(grid, cells);
    return cells;
}

}  // namespace geomend::grid
