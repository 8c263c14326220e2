// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/place_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/lattice_cells.h"
#include "geometry/vectors.h"
#include "grid/cell_mesh.h"
#include "model/cell_faces.h"

namespace geomend::gridding {

namespace {

constexpr double everywhere = std::numeric_limits<double>::infinity();

bool is_finite(const Vec3& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

/// Rows by which dot products with an offset give steps along the directions that have more than one sample: those of the
/// pseudoinverse of these steps. Nothing where they are not independent.
std::optional<std::array<Vec3, 3>> inverse_rows(const std::array<Vec3, 3>& step, const std::array<std::uint32_t, 3>& dims) {
    std::array<Vec3, 3> rows{};
    for (std::size_t a = 0; a < 3; ++a) {
        if (dims[a] < 2) continue;
        // What is left of a step without its shares along the other ones.
        Vec3 left = step[a];
        std::vector<Vec3> others;
        for (std::size_t b = 0; b < 3; ++b) {
            if (b == a || dims[b] < 2) continue;
            Vec3 other = step[b];
            for (const Vec3& done : others) other = across(other, done);
            if (!(dot(other, other) > 1e-18 * dot(step[b], step[b]))) return std::nullopt;
            others.push_back(other);
        }
        for (const Vec3& other : others) left = across(left, other);
        if (!(dot(left, left) > 1e-18 * dot(step[a], step[a]))) return std::nullopt;
        rows[a] = times(1 / dot(left, step[a]), left);
    }
    return rows;
}

/// Where a place is along one axis of a rectilinear lattice, in samples.
double along_axis(const std::vector<double>& at, double x) {
    if (at.size() < 2) return 0;
    const bool rising = at.front() < at.back();
    const auto after = rising ? std::ranges::upper_bound(at, x) : std::ranges::upper_bound(at, x, std::greater<>());
    const auto next = std::clamp<std::ptrdiff_t>(after - at.begin(), 1, static_cast<std::ptrdiff_t>(at.size()) - 1);
    const double from = at[static_cast<std::size_t>(next - 1)], to = at[static_cast<std::size_t>(next)];
    return static_cast<double>(next - 1) + (x - from) / (to - from);
}

bool in_tetrahedron(const Vec3& p, const Vec3& o, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = minus(a, o), v = minus(b, o), w = minus(c, o), q = minus(p, o);
    const double all = dot(u, cross(v, w));
    if (all == 0) return false;
    const double x = dot(q, cross(v, w)) / all, y = dot(u, cross(q, w)) / all, z = dot(u, cross(v, q)) / all;
    constexpr double slack = -1e-9;
    return x >= slack && y >= slack && z >= slack && x + y + z <= 1 - slack;
}

std::array<std::uint8_t, 8> vtk_order() { return {0, 1, 3, 2, 4, 5, 7, 6}; }

}  // namespace

std::optional<PlaceFinder> PlaceFinder::of_raster(const Raster& raster) {
    PlaceFinder finder;
    Lattice lattice;
    lattice.dims = raster.dims;
    lattice.origin = raster.origin;
    lattice.coordinates = raster.coordinates;
    const bool rectilinear = std::ranges::any_of(raster.coordinates, [](const auto& c) { return !c.empty(); });
    if (sample_count(raster.dims) >= no_index) return std::nullopt;
    if (rectilinear) {
        for (std::size_t a = 0; a < 3; ++a) {
            if (lattice.coordinates[a].size() != raster.dims[a]) return std::nullopt;
            finder.size_[a] = raster.dims[a] < 2
                                  ? everywhere
                                  : std::abs(lattice.coordinates[a].back() - lattice.coordinates[a].front()) / (raster.dims[a] - 1);
        }
    } else {
        const auto rows = inverse_rows(raster.step, raster.dims);
        if (!rows) return std::nullopt;
        lattice.rows = *rows;
        for (std::size_t x = 0; x < 3; ++x) {
            double samples = 0;  // a unit of length
            for (const Vec3& row : *rows) samples = std::max(samples, std::abs(row[x]));
            finder.size_[x] = samples > 0 ? 1 / samples : everywhere;
        }
    }
    finder.lattice_ = std::move(lattice);
    return finder;
}

std::optional<PlaceFinder> PlaceFinder::of(const Object& object) {
    if (const auto* raster = std::get_if<Raster>(&object)) return of_raster(*raster);
    PlaceFinder finder;
    if (const auto* mesh = std::get_if<CellMesh>(&object)) {
        finder.mesh_.points = mesh->points;
        finder.mesh_.types = mesh->types;
        finder.mesh_.offsets = mesh->offsets;
        finder.mesh_.nodes = mesh->nodes;
        finder.mesh_.cell_faces = mesh->cell_faces;
        finder.mesh_.face_offsets = mesh->face_offsets;
        finder.mesh_.face_nodes = mesh->face_nodes;
    } else if (const auto* grid = std::get_if<CornerPointGrid>(&object)) {
        if (grid->cylindrical || !misfit(*grid).empty() || grid->depths.empty()) return std::nullopt;
        CornerPointGrid bare = *grid;
        bare.info.attributes.clear();
        grid::Cells cells = grid::plain_cells(bare);
        finder.mesh_ = std::move(cells.mesh);
        finder.cell_rows_ = std::move(cells.source);
    } else if (const auto* lattice = std::get_if<StructuredGrid>(&object)) {
        if (std::ranges::any_of(lattice->dims, [](std::uint32_t n) { return n < 2; })) return std::nullopt;
        const LatticeCells cells(*lattice);
        const std::size_t nx = lattice->dims[0], ny = lattice->dims[1];
        for (std::size_t c = 0; c < cells.count(); ++c) {
            if (cells.is_dead(c)) continue;
            std::array<std::uint32_t, 8> nodes{};
            const auto corners = cells.corners(c);
            const auto [i, j, k] = cells.ijk(c);
            for (std::uint32_t n = 0; n < 8; ++n) {
                nodes[n] = static_cast<std::uint32_t>(finder.mesh_.points.size());
                finder.mesh_.points.push_back(corners[n]);
                const std::size_t q = n % 4, ri = i + (q == 1 || q == 2 ? 1 : 0), rj = j + (q / 2), rk = k + (n / 4);
                finder.point_rows_.push_back(static_cast<std::uint32_t>(ri + nx * (rj + ny * rk)));
            }
            finder.mesh_.add_cell(CellType::hexahedron, nodes);
            finder.cell_rows_.push_back(static_cast<std::uint32_t>(c));
        }
    } else {
        return std::nullopt;
    }
    finder.take_cells();
    if (finder.boxed_.empty()) return std::nullopt;
    return finder;
}

PlaceFinder PlaceFinder::of_cells(const CornerPointGrid& grid, std::span<const std::uint32_t> cells) {
    PlaceFinder finder;
    for (const std::uint32_t c : cells) {
        const auto [i, j, k] = grid.ijk(c);
        const auto corners = cell_corners(grid, i, j, k);
        std::array<std::uint32_t, 8> nodes{};
        for (std::size_t n = 0; n < 8; ++n) {
            const Vec3& p = corners[vtk_order()[n]];
            nodes[n] = static_cast<std::uint32_t>(finder.mesh_.points.size());
            finder.mesh_.points.push_back({p[0], p[1], -p[2]});
        }
        finder.mesh_.add_cell(CellType::hexahedron, nodes);
        finder.cell_rows_.push_back(c);
    }
    finder.take_cells();
    return finder;
}

void PlaceFinder::take_cells() {
    std::vector<BoxTree::Corners> boxes;
    std::array<double, 3> sum{};
    for (std::uint32_t c = 0; c < mesh_.cell_count(); ++c) {
        if (dimension(mesh_.types[c]) != 3) continue;
        BoxTree::Corners box{Vec3{1e300, 1e300, 1e300}, Vec3{-1e300, -1e300, -1e300}};
        bool sound = true;
        for (const std::uint32_t n : mesh_.cell_nodes(c)) {
            sound = sound && is_finite(mesh_.points[n]);
            for (std::size_t a = 0; a < 3 && sound; ++a) {
                box[0][a] = std::min(box[0][a], mesh_.points[n][a]);
                box[1][a] = std::max(box[1][a], mesh_.points[n][a]);
            }
        }
        if (!sound || mesh_.cell_nodes(c).empty()) continue;
        boxes.push_back(box);
        boxed_.push_back(c);
        for (std::size_t a = 0; a < 3; ++a) sum[a] += box[1][a] - box[0][a];
    }
    for (std::size_t a = 0; a < 3; ++a) size_[a] = boxes.empty() ? everywhere : sum[a] / static_cast<double>(boxes.size());
    tree_.emplace(boxes);
}

RowsAt PlaceFinder::in_lattice(const Vec3& place) const {
    const Lattice& l = *lattice_;
    const Vec3 offset = minus(place, l.origin);
    RowsAt rows;
    std::size_t point = 0, cell = 0, points = 1, cells = 1;
    bool has_point = true, has_cell = true;
    for (std::size_t a = 0; a < 3; ++a) {
        if (l.dims[a] < 2) continue;
        const double n = l.dims[a], u = l.coordinates[a].empty() ? dot(l.rows[a], offset) : along_axis(l.coordinates[a], place[a]);
        has_point = has_point && u >= -0.5 && u <= n - 0.5;
        has_cell = has_cell && u >= -1e-9 && u <= n - 1 + 1e-9;
        if (!has_point) return rows;
        point += points * static_cast<std::size_t>(std::clamp(std::floor(u + 0.5), 0.0, n - 1));
        cell += cells * static_cast<std::size_t>(std::clamp(std::floor(u), 0.0, n - 2));
        points *= l.dims[a];
        cells *= l.dims[a] - 1;
    }
    rows.point = static_cast<std::uint32_t>(point);
    if (has_cell) rows.cell = static_cast<std::uint32_t>(cell);
    return rows;
}

bool PlaceFinder::holds(std::uint32_t cell, const Vec3& place) const {
    const CellType type = mesh_.types[cell];
    auto nodes = mesh_.cell_nodes(cell);
    if (is_second_order(type)) nodes = nodes.first(node_count(linear_type(type)));
    Vec3 middle{};
    for (const std::uint32_t n : nodes) {
        for (std::size_t a = 0; a < 3; ++a) middle[a] += mesh_.points[n][a] / static_cast<double>(nodes.size());
    }
    // A face is a fan around its corner of the lowest row, for both cells that share it.
    const auto key = [&](std::uint32_t n) { return point_rows_.empty() ? n : point_rows_[n]; };
    const auto below_face = [&](std::span<const std::uint32_t> face) {
        const auto first = static_cast<std::size_t>(std::ranges::min_element(face, {}, key) - face.begin());
        const auto at = [&](std::size_t k) -> const Vec3& { return mesh_.points[face[(first + k) % face.size()]]; };
        for (std::size_t k = 2; k < face.size(); ++k) {
            if (in_tetrahedron(place, middle, at(0), at(k - 1), at(k))) return true;
        }
        return false;
    };
    if (type == CellType::polyhedron) {
        for (std::uint64_t f = mesh_.cell_faces[cell]; f < mesh_.cell_faces[cell + 1]; ++f) {
            const std::uint64_t first = mesh_.face_offsets[f], last = mesh_.face_offsets[f + 1];
            if (below_face({mesh_.face_nodes.data() + first, static_cast<std::size_t>(last - first)})) return true;
        }
        return false;
    }
    for (const LocalFace& local : faces_of(type)) {
        std::array<std::uint32_t, 6> face{};
        for (std::size_t k = 0; k < local.count; ++k) face[k] = nodes[local.numbers[k]];
        if (below_face({face.data(), local.count})) return true;
    }
    return false;
}

RowsAt PlaceFinder::at(const Vec3& place) const {
    if (lattice_) return in_lattice(place);
    std::uint32_t found = no_index;
    const double slack = 1e-9 * std::max({size_[0], size_[1], size_[2]});
    tree_->visit({place, place}, -slack, [&](std::uint32_t box) {
        const std::uint32_t cell = boxed_[box];
        if (cell < found && holds(cell, place)) found = cell;
    });
    if (found == no_index) return {};
    RowsAt rows;
    rows.cell = cell_rows_.empty() ? found : cell_rows_[found];
    double nearest = everywhere;
    for (const std::uint32_t n : mesh_.cell_nodes(found)) {
        const Vec3 offset = minus(mesh_.points[n], place);
        if (dot(offset, offset) >= nearest) continue;
        nearest = dot(offset, offset);
        rows.point = point_rows_.empty() ? n : point_rows_[n];
    }
    return rows;
}

}  // namespace geomend::gridding
