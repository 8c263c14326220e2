// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/from_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grid/pillar_fit.h"

namespace geomend::grid {

namespace {

constexpr double double_rounding = 1.2e-16, single_rounding = 6e-8;

Vec3 depth_down(const Vec3& p) { return {p[0], p[1], 0.0 - p[2]}; }

double rounding_of(const ObjectInfo& info) {
    return info.precision == CoordinatePrecision::single_precision ? single_rounding : double_rounding;
}

void take_info(const ObjectInfo& from, CornerPointGrid& to) {
    to.info.name = from.name;
    to.info.role = from.role;
    to.info.role_text = from.role_text;
    to.info.feature = from.feature;
    to.info.crs = from.crs;
    to.info.crs.z_positive = ZPositive::depth;
    to.info.groups = from.groups;
}

// The corners of a lattice cell in the order of corner_index, z still elevation.
std::array<Vec3, 8> lattice_corners(const StructuredGrid& grid, std::size_t i, std::size_t j, std::size_t k) {
    std::array<Vec3, 8> corners;
    for (unsigned c = 0; c < 8; ++c)
        corners[c] =
            grid.points[i + (c & 1u) + std::size_t{grid.dims[0]} * (j + ((c >> 1) & 1u) + std::size_t{grid.dims[1]} * (k + (c >> 2)))];
    return corners;
}

struct Lattice {
    const StructuredGrid& grid;
    std::array<std::uint32_t, 3> cells;
    std::vector<std::array<Vec3, 8>> corners;

    explicit Lattice(const StructuredGrid& g) : grid(g), cells{g.dims[0] - 1, g.dims[1] - 1, g.dims[2] - 1} {
        for (std::size_t k = 0; k < cells[2]; ++k) {
            for (std::size_t j = 0; j < cells[1]; ++j) {
                for (std::size_t i = 0; i < cells[0]; ++i) corners.push_back(lattice_corners(grid, i, j, k));
            }
        }
        for (const auto& split : grid.splits) move(split);
    }

    void move(const StructuredGrid::Split& split) {
        for (unsigned b = 0; b < 8; ++b) {
            const std::array<std::uint32_t, 3> back{b & 1u, (b >> 1) & 1u, b >> 2};
            if ((split.cells >> b & 1) == 0) continue;
            std::array<std::uint32_t, 3> at{};
            bool inside = true;
            for (std::size_t a = 0; a < 3; ++a) {
                inside = inside && split.node[a] >= back[a] && split.node[a] - back[a] < cells[a];
                at[a] = split.node[a] - back[a];
            }
            if (inside) corners[at[0] + std::size_t{cells[0]} * (at[1] + std::size_t{cells[1]} * at[2])][b] = split.position;
        }
    }
};

// Attributes of cells with the layers in the order of the grid.
void take_layers(const StructuredGrid& from, bool turned, CornerPointGrid& to) {
    std::vector<std::uint32_t> rows(to.cell_count());
    for (std::size_t c = 0; c < rows.size(); ++c) {
        const auto [i, j, k] = to.ijk(c);
        rows[c] = static_cast<std::uint32_t>(to.cell(i, j, turned ? to.dims[2] - 1 - k : k));
    }
    for (const Attribute& a : from.info.attributes) {
        if (a.location != AttributeLocation::cell) continue;
        Attribute copy = a;
        std::visit(
            [&](auto& values) {
                const auto all = values;
                for (std::size_t c = 0; c < rows.size(); ++c) {
                    for (std::uint32_t n = 0; n < a.components; ++n)
                        values[c * a.components + n] = all[std::size_t{rows[c]} * a.components + n];
                }
            },
            copy.values);
        to.info.attributes.push_back(std::move(copy));
    }
}

const Attribute* place(const CellMesh& mesh, const char* name) {
    return find_attribute(mesh.info.attributes, name, AttributeLocation::cell);
}

Failure unfit(const std::string& message) { return failure(FailureKind::cannot_hold, "F021", {}, message); }

// Corners of a hexahedron as plain_cells orders them: the deeper quad first or last.
std::array<Vec3, 8> hexahedron_corners(const CellMesh& mesh, std::size_t cell) {
    std::array<Vec3, 8> p;
    const auto nodes = mesh.cell_nodes(cell);
    for (std::size_t n = 0; n < 8; ++n) p[n] = depth_down(mesh.points[nodes[n]]);
    const double first = p[0][2] + p[1][2] + p[2][2] + p[3][2], last = p[4][2] + p[5][2] + p[6][2] + p[7][2];
    if (first <= last) return {p[0], p[1], p[3], p[2], p[4], p[5], p[7], p[6]};
    return {p[4], p[5], p[7], p[6], p[0], p[1], p[3], p[2]};
}

}  // namespace

Result<CornerPointGrid> from_structured(const StructuredGrid& grid) {
    if (grid.dims[0] < 2 || grid.dims[1] < 2 || grid.dims[2] < 2)
        return unfit("grid '" + grid.info.name + "' has a single layer of points in one direction: it holds no cells");
    const Lattice lattice(grid);
    double down = 0;
    for (const auto& c : lattice.corners) down += c[0][2] + c[1][2] + c[2][2] + c[3][2] - c[4][2] - c[5][2] - c[6][2] - c[7][2];
    const bool turned = down < 0;  // k runs upwards
    const auto [nx, ny, nz] = lattice.cells;
    PillarFit fit(lattice.cells, rounding_of(grid.info));
    std::vector<std::size_t> dead;
    for (std::size_t c = 0; c < lattice.corners.size(); ++c) {
        const std::size_t i = c % nx, j = c / nx % ny, k = c / nx / ny;
        const std::size_t to = i + nx * (j + std::size_t{ny} * (turned ? nz - 1 - k : k));
        std::array<Vec3, 8> corners;
        for (unsigned n = 0; n < 8; ++n) corners[turned ? n ^ 4u : n] = depth_down(lattice.corners[c][n]);
        fit.add(to, corners);
        if (!grid.dead_cells.empty() && grid.dead_cells[c] != 0) dead.push_back(to);
    }
    auto made = fit.finish();
    if (!made) return made;
    if (!dead.empty() && made->activity.empty()) made->activity.assign(made->cell_count(), 1);
    for (const std::size_t c : dead) made->activity[c] = 0;
    take_info(grid.info, *made);
    take_layers(grid, turned, *made);
    return made;
}

bool has_places(const CellMesh& mesh) { return place(mesh, "I") != nullptr && place(mesh, "J") != nullptr && place(mesh, "K") != nullptr; }

Result<CornerPointGrid> from_tagged_cells(const CellMesh& mesh) {
    std::array<const Attribute*, 3> at{place(mesh, "I"), place(mesh, "J"), place(mesh, "K")};
    std::array<std::uint32_t, 3> dims{0, 0, 0};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::string name(1, "IJK"[a]);
        if (at[a] == nullptr)
            return failure(FailureKind::cannot_hold, "F007", {}, "mesh '" + mesh.info.name + "' has no attribute '" + name + "' of cells");
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
            const double v = value_as_double(*at[a], c);
            if (!(v >= 1) || v > 1e6 || v != std::floor(v))
                return unfit("cell " + std::to_string(c) + " of mesh '" + mesh.info.name + "' has no place: its " + name +
                             " is not a number from 1");
            dims[a] = std::max(dims[a], static_cast<std::uint32_t>(v));
        }
    }
    if (dims[0] == 0 || double(dims[0]) * dims[1] * dims[2] > 64.0 * double(mesh.cell_count()) + 1e6)
        return unfit("mesh '" + mesh.info.name + "': its I, J, K span far more cells than it holds");
    PillarFit fit(dims, rounding_of(mesh.info));
    std::vector<std::uint8_t> taken(std::size_t{dims[0]} * dims[1] * dims[2], 0);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        const auto step = [&](std::size_t a) { return static_cast<std::size_t>(value_as_double(*at[a], c)) - 1; };
        const std::size_t to = step(0) + dims[0] * (step(1) + std::size_t{dims[1]} * step(2));
        if (taken[to]++ != 0)
            return unfit("cell (" + std::to_string(step(0) + 1) + "," + std::to_string(step(1) + 1) + "," + std::to_string(step(2) + 1) +
                         ") is there twice in mesh '" + mesh.info.name + "'");
        if (mesh.types[c] == CellType::hexahedron) {
            fit.add(to, hexahedron_corners(mesh, c));
            continue;
        }
        std::vector<Vec3> points;
        for (const std::uint32_t n : mesh.cell_nodes(c)) points.push_back(depth_down(mesh.points[n]));
        fit.add_points(to, std::move(points), mesh.types[c] == CellType::polyhedron);
    }
    auto made = fit.finish();
    if (!made) return made;
    take_info(mesh.info, *made);
    if (auto put = put_attributes(mesh, *made); !put) return std::move(put).why();
    return made;
}

namespace {

// The grid cell of each mesh cell.
Result<std::vector<std::size_t>> places(const CellMesh& mesh, const CornerPointGrid& grid) {
    const Attribute* global = place(mesh, "GlobalIndex");
    if (global == nullptr && !has_places(mesh))
        return unfit("mesh '" + mesh.info.name + "' has neither GlobalIndex nor I, J, K: its cells cannot be found in the grid");
    std::vector<std::size_t> cells(mesh.cell_count());
    std::vector<std::uint8_t> taken(grid.cell_count(), 0);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        double at = 0;
        if (global != nullptr) {
            at = value_as_double(*global, c) - 1;
        } else {
            const double i = value_as_double(*place(mesh, "I"), c) - 1, j = value_as_double(*place(mesh, "J"), c) - 1,
                         k = value_as_double(*place(mesh, "K"), c) - 1;
            const bool inside = i >= 0 && j >= 0 && k >= 0 && i < grid.dims[0] && j < grid.dims[1] && k < grid.dims[2];
            at = inside ? i + grid.dims[0] * (j + double(grid.dims[1]) * k) : -1;
        }
        if (!(at >= 0) || at >= double(grid.cell_count()) || at != std::floor(at))
            return unfit("cell " + std::to_string(c) + " of mesh '" + mesh.info.name + "' is not in grid '" + grid.info.name + "'");
        cells[c] = static_cast<std::size_t>(at);
        if (taken[cells[c]]++ != 0)
            return unfit("two cells of mesh '" + mesh.info.name + "' have the same place, number " + std::to_string(cells[c] + 1));
    }
    return cells;
}

template <class T>
T missing_value(const Attribute& a) {
    if constexpr (std::is_same_v<T, std::string>) return {};
    else if constexpr (std::is_floating_point_v<T>) return static_cast<T>(a.no_data.value_or(-9.99e20f));
    else if constexpr (std::is_same_v<T, std::int32_t> || std::is_same_v<T, std::int64_t>)
        return static_cast<T>(a.no_data.value_or(-2147483647.0));
    else return static_cast<T>(a.no_data.value_or(0.0));
}

}  // namespace

Result<void> put_attributes(const CellMesh& mesh, CornerPointGrid& grid) {
    const auto cells = places(mesh, grid);
    if (!cells) return cells.why();
    constexpr std::array places_only{"I", "J", "K", "GlobalIndex", "ActiveIndex"};
    for (const Attribute& a : mesh.info.attributes) {
        if (a.location != AttributeLocation::cell || std::ranges::find(places_only, a.name) != places_only.end()) continue;
        Attribute spread = a;
        std::visit(
            [&](auto& values) {
                using T = typename std::decay_t<decltype(values)>::value_type;
                auto all = std::move(values);
                values.assign(grid.cell_count() * a.components, missing_value<T>(a));
                for (std::size_t c = 0; c < cells->size(); ++c) {
                    for (std::uint32_t n = 0; n < a.components; ++n) values[(*cells)[c] * a.components + n] = all[c * a.components + n];
                }
                if constexpr (std::is_arithmetic_v<T>) {
                    if (cells->size() < grid.cell_count()) spread.no_data = static_cast<double>(missing_value<T>(a));
                }
            },
            spread.values);
        std::erase_if(grid.info.attributes, [&](const Attribute& old) { return old.name == a.name && old.location == a.location; });
        grid.info.attributes.push_back(std::move(spread));
    }
    return {};
}

}  // namespace geomend::grid
