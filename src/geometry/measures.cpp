// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/measures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "base/bounds.h"
#include "base/length.h"
#include "base/parallel.h"
#include "geometry/cell_volume.h"
#include "geometry/curved_volume.h"
#include "geometry/lattice_cells.h"
#include "geometry/polyhedron_volume.h"

namespace geomend {

namespace {

constexpr std::size_t block_size = 4096;

/// Sum of measure(i) over 0..count: each fixed block in order, then the blocks in order.
template <class Measure>
double ordered_sum(std::size_t count, const Measure& measure) {
    std::vector<double> blocks((count + block_size - 1) / block_size);
    parallel_for_each_index(blocks.size(), [&](std::size_t block) {
        double sum = 0;
        const std::size_t last = std::min(count, (block + 1) * block_size);
        for (std::size_t i = block * block_size; i < last; ++i) sum += measure(i);
        blocks[block] = sum;
    });
    double sum = 0;
    for (const double block : blocks) sum += block;
    return sum;
}

double polygon_area(const std::vector<Vec3>& points, std::span<const std::uint32_t> polygon) {
    const std::size_t n = polygon.size();
    if (n < 3) return 0;
    if (n == 3) return triangle_area(points[polygon[0]], points[polygon[1]], points[polygon[2]]);
    const auto lowest = static_cast<std::size_t>(std::min_element(polygon.begin(), polygon.end()) - polygon.begin());
    const Vec3& apex = points[polygon[lowest]];
    const auto normal = [&](std::size_t k) {
        return cross(minus(points[polygon[(lowest + k) % n]], apex), minus(points[polygon[(lowest + k + 1) % n]], apex));
    };
    Vec3 total{};
    for (std::size_t k = 1; k + 1 < n; ++k) {
        const Vec3 part = normal(k);
        for (std::size_t axis = 0; axis < 3; ++axis) total[axis] += part[axis];
    }
    double sum = 0;
    for (std::size_t k = 1; k + 1 < n; ++k) {
        const Vec3 part = normal(k);
        sum += dot(part, total) < 0 ? -length(part) : length(part);
    }
    return 0.5 * std::abs(sum);
}

/// The corners of a surface-like cell, without the extra nodes of second-order types.
std::span<const std::uint32_t> cell_corners(const CellMesh& mesh, std::size_t cell) {
    const auto nodes = mesh.cell_nodes(cell);
    const std::uint32_t corners = node_count(linear_type(mesh.types[cell]));
    return corners == 0 || corners >= nodes.size() ? nodes : nodes.first(corners);
}

template <std::size_t N>
std::array<Vec3, N> corner_points(const CellMesh& mesh, std::span<const std::uint32_t> nodes) {
    std::array<Vec3, N> p;
    for (std::size_t i = 0; i < N; ++i) p[i] = mesh.points[nodes[i]];
    return p;
}

template <std::size_t N>
double prism(const CellMesh& mesh, std::span<const std::uint32_t> nodes) {
    const auto p = corner_points<N>(mesh, nodes);
    return prism_volume(p, nodes.first(N));
}

/// The box around what is added of finite points.
struct FiniteBox : Bounds {
    using Bounds::add;
    void add(const Vec3& p) {
        if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) Bounds::add(p);
    }
    std::optional<std::array<Vec3, 2>> result() const {
        if (empty()) return std::nullopt;
        return std::array<Vec3, 2>{low, high};
    }
};

FiniteBox box_of(const std::vector<Vec3>& points) {
    std::vector<FiniteBox> blocks((points.size() + block_size - 1) / block_size);
    parallel_for_each_index(blocks.size(), [&](std::size_t block) {
        const std::size_t last = std::min(points.size(), (block + 1) * block_size);
        for (std::size_t i = block * block_size; i < last; ++i) blocks[block].add(points[i]);
    });
    FiniteBox all;
    for (const FiniteBox& block : blocks) all.add(block);
    return all;
}

FiniteBox lattice_box(const Raster& raster) {
    FiniteBox box;
    if (!raster.coordinates[0].empty()) {
        Vec3 low, high;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [least, most] = std::ranges::minmax_element(raster.coordinates[axis]);
            low[axis] = *least;
            high[axis] = *most;
        }
        box.add(low);
        box.add(high);
        return box;
    }
    for (unsigned corner = 0; corner < 8; ++corner) {
        box.add(sample_position(raster, (corner & 1) != 0 ? raster.dims[0] - 1 : 0, (corner & 2) != 0 ? raster.dims[1] - 1 : 0,
                                (corner & 4) != 0 ? raster.dims[2] - 1 : 0));
    }
    return box;
}

/// The lattice of a horizon grid stretches from its lowest to its highest defined node, above the lattice's own z.
std::optional<std::array<Vec3, 2>> horizon_bounds(const Raster& raster) {
    const Attribute& height = raster.info.attributes[raster.height_attribute];
    FiniteBox box = lattice_box(raster), heights;
    const std::size_t count = value_count(height);
    for (std::size_t i = 0; i < count; ++i) {
        const double h = value_as_double(height, i);
        if (!is_no_data(height, h)) heights.add(Vec3{0, 0, h + raster.origin[2]});
    }
    if (!heights.result() || !box.result()) return std::nullopt;
    box.low[2] = heights.low[2];
    box.high[2] = heights.high[2];
    return box.result();
}

std::optional<std::array<Vec3, 2>> bounds_of(const Raster& raster) {
    if (raster.height_attribute < raster.info.attributes.size()) return horizon_bounds(raster);
    return lattice_box(raster).result();
}

std::optional<std::array<Vec3, 2>> bounds_of(const StructuredGrid& grid) {
    FiniteBox box = box_of(grid.points);
    for (const StructuredGrid::Split& split : grid.splits) box.add(split.position);
    return box.result();
}

/// Of the active cells, or of all where none is active; elevation-up like every other box.
std::optional<std::array<Vec3, 2>> bounds_of(const CornerPointGrid& grid) {
    FiniteBox box;
    if (!misfit(grid).empty()) return box.result();  // properties without geometry
    const bool all = active_count(grid) == 0;
    for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
        for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
            for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
                if (!all && !grid.is_active(grid.cell(i, j, k))) continue;
                for (const Vec3& p : cell_corners(grid, i, j, k)) box.add(Vec3{p[0], p[1], 0.0 - p[2]});
            }
        }
    }
    return box.result();
}

std::optional<std::array<Vec3, 2>> bounds_of(const Well& well) {
    if (!well.path.empty()) return box_of(well.path).result();
    FiniteBox box;
    box.add(well.head);
    return box.result();
}

template <class Thing>
std::optional<std::array<Vec3, 2>> bounds_of(const Thing& thing) {
    return box_of(thing.points).result();
}

}  // namespace

double area(const Surface& surface) {
    return ordered_sum(surface.polygons.size(), [&](std::size_t i) { return polygon_area(surface.points, surface.polygons[i]); });
}

double area(const CellMesh& mesh) {
    return ordered_sum(mesh.cell_count(), [&](std::size_t i) {
        return dimension(mesh.types[i]) == 2 ? polygon_area(mesh.points, cell_corners(mesh, i)) : 0.0;
    });
}

double cell_volume(const CellMesh& mesh, std::size_t cell) {
    const auto nodes = mesh.cell_nodes(cell);
    const auto& p = mesh.points;
    switch (linear_type(mesh.types[cell])) {
        case CellType::tetrahedron:
            return tetrahedron_volume(p[nodes[0]], p[nodes[1]], p[nodes[2]], p[nodes[3]]);
        case CellType::hexahedron:
            return hexahedron_volume(corner_points<8>(mesh, nodes));
        case CellType::pyramid:
            return pyramid_volume(corner_points<5>(mesh, nodes));
        case CellType::wedge:
            return -prism<6>(mesh, nodes);
        case CellType::pentagonal_prism:
            return prism<10>(mesh, nodes);
        case CellType::hexagonal_prism:
            return prism<12>(mesh, nodes);
        case CellType::polyhedron:
            return polyhedron_volume(mesh, cell);
        default:
            return 0;
    }
}

double volume(const CellMesh& mesh) {
    return ordered_sum(mesh.cell_count(), [&](std::size_t i) { return unsigned_volume(mesh, i); });
}

namespace {

double split_hexahedron(const std::array<Vec3, 8>& p) {
    return tetrahedron_volume(p[0], p[1], p[3], p[4]) + tetrahedron_volume(p[1], p[2], p[3], p[6]) +
           tetrahedron_volume(p[1], p[4], p[5], p[6]) + tetrahedron_volume(p[3], p[4], p[6], p[7]) +
           tetrahedron_volume(p[1], p[3], p[4], p[6]);
}

double split_pyramid(const std::array<Vec3, 5>& p) {
    const Vec3 a = minus(p[2], p[0]), b = minus(p[3], p[1]);
    if (dot(a, a) < dot(b, b)) return tetrahedron_volume(p[0], p[1], p[2], p[4]) + tetrahedron_volume(p[0], p[2], p[3], p[4]);
    return tetrahedron_volume(p[0], p[1], p[3], p[4]) + tetrahedron_volume(p[1], p[2], p[3], p[4]);
}

}  // namespace

double volume_by_tetrahedra(const CellMesh& mesh) {
    return ordered_sum(mesh.cell_count(), [&](std::size_t i) {
        const auto nodes = mesh.cell_nodes(i);
        const CellType type = linear_type(mesh.types[i]);
        if (type == CellType::hexahedron) return std::abs(split_hexahedron(corner_points<8>(mesh, nodes)));
        if (type == CellType::pyramid) return std::abs(split_pyramid(corner_points<5>(mesh, nodes)));
        return unsigned_volume(mesh, i);
    });
}

double volume(const StructuredGrid& grid) {
    if (grid.dims[0] < 2 || grid.dims[1] < 2 || grid.dims[2] < 2) return 0;
    const LatticeCells cells(grid);
    return ordered_sum(cells.count(),
                       [&](std::size_t cell) { return cells.is_dead(cell) ? 0.0 : std::abs(hexahedron_volume(cells.corners(cell))); });
}

double volume(const Raster& raster) {
    if (raster.dims[0] < 2 || raster.dims[1] < 2 || raster.dims[2] < 2) return 0;
    if (!raster.coordinates[0].empty()) {
        double product = 1;
        for (const std::vector<double>& axis : raster.coordinates) product *= std::abs(axis.back() - axis.front());
        return product;
    }
    const double cell = std::abs(flux6(raster.step[0], raster.step[1], raster.step[2]));
    return cell * static_cast<double>(lattice_cell_count(raster.dims));
}

std::optional<std::array<Vec3, 2>> bounds(const Object& object) {
    return std::visit([](const auto& thing) { return bounds_of(thing); }, object);
}

}  // namespace geomend
