// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/cell_hulls.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "geometry/cell_volume.h"
#include "geometry/vectors.h"
#include "topology/faces_from_mesh.h"

namespace geomend::validators {

namespace {

/// True where, along a direction, two sets of points have no more than the tolerance in common.
bool parted_along(const Vec3& direction, std::span<const Vec3> a, std::span<const Vec3> b, double tolerance) {
    const double length = std::sqrt(dot(direction, direction));
    if (!(length > 0)) return false;
    const auto range = [&](std::span<const Vec3> points) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const Vec3& p : points) {
            const double x = dot(p, direction);
            low = std::min(low, x);
            high = std::max(high, x);
        }
        return std::array{low, high};
    };
    const auto [low_a, high_a] = range(a);
    const auto [low_b, high_b] = range(b);
    return std::min(high_a, high_b) - std::max(low_a, low_b) <= tolerance * length;
}

Vec3 mean(std::span<const Vec3> points) {
    Vec3 sum{};
    for (const Vec3& p : points) sum = plus(sum, p);
    return times(1.0 / static_cast<double>(points.size()), sum);
}

/// Whether two tetrahedra have a body in common: no normal of a face and no direction at right angles to an edge of each parts them.
bool tetrahedra_overlap(const std::array<Vec3, 4>& a, const std::array<Vec3, 4>& b, double tolerance) {
    constexpr std::array<std::array<unsigned, 3>, 4> faces{{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}};
    constexpr std::array<std::array<unsigned, 2>, 6> edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
    for (const auto* t : {&a, &b}) {
        for (const auto& f : faces) {
            const Vec3 normal = cross(minus((*t)[f[1]], (*t)[f[0]]), minus((*t)[f[2]], (*t)[f[0]]));
            if (parted_along(normal, a, b, tolerance)) return false;
        }
    }
    for (const auto& e : edges) {
        const Vec3 u = minus(a[e[1]], a[e[0]]);
        for (const auto& f : edges) {
            const Vec3 v = minus(b[f[1]], b[f[0]]);
            const Vec3 normal = cross(u, v);
            if (dot(normal, normal) <= 1e-20 * dot(u, u) * dot(v, v)) continue;  // parallel: a normal of a face does it
            if (parted_along(normal, a, b, tolerance)) return false;
        }
    }
    return true;
}

/// What of a flat polygon lies farther than a distance inside of a plane; the normal points inside.
std::vector<Vec3> part_inside(std::span<const Vec3> polygon, const Vec3& on_plane, const Vec3& normal, double distance) {
    const double length = std::sqrt(dot(normal, normal));
    std::vector<Vec3> part;
    if (!(length > 0)) return part;
    const auto height = [&](const Vec3& p) { return dot(minus(p, on_plane), normal) / length - distance; };
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const double a = height(p), b = height(q);
        if (a > 0) part.push_back(p);
        if ((a > 0) != (b > 0)) part.push_back(plus(p, times(a / (a - b), minus(q, p))));
    }
    return part;
}

/// Whether a part of a triangle lies inside a tetrahedron, however that is wound, and farther than a distance from all of its faces, or
/// from that opposite to its first corner: the others may be between pieces of one cell, and what lies in such a face is inside the cell.
bool holds_part(const std::array<Vec3, 4>& t, std::span<const Vec3> triangle, double distance, bool is_piece) {
    constexpr std::array<std::array<unsigned, 4>, 4> faces{{{0, 1, 2, 3}, {0, 1, 3, 2}, {1, 2, 3, 0}, {0, 2, 3, 1}}};  // the last: across
    std::vector<Vec3> part(triangle.begin(), triangle.end());
    for (const auto& f : faces) {
        Vec3 normal = cross(minus(t[f[1]], t[f[0]]), minus(t[f[2]], t[f[0]]));
        if (dot(normal, minus(t[f[3]], t[f[0]])) < 0) normal = times(-1, normal);
        const bool is_between = is_piece && f[3] != 0;
        part = part_inside(part, t[f[0]], normal, is_between ? -1e-3 * distance : distance);
        if (part.empty()) return false;
    }
    return true;
}

}  // namespace

CellHulls::CellHulls(const CellScope& scope) : scope_(scope) {
    const auto cells = scope.volume_cells();
    const auto faces = scope.faces();
    std::size_t f = 0;
    for (const std::uint32_t cell : cells) {
        first_face_.push_back(static_cast<std::uint32_t>(f));
        while (f < faces.size() && faces[f].cell == cell) ++f;
    }
    first_face_.push_back(static_cast<std::uint32_t>(f));
}

void CellHulls::points_of(std::uint32_t i, const Vec3& origin, std::vector<Vec3>& points) const {
    const CellMesh& mesh = scope_.mesh();
    points.clear();
    for (const std::uint32_t node : topology::corner_nodes(mesh, scope_.volume_cells()[i]))
        points.push_back(minus(mesh.points[node], origin));
}

void CellHulls::normals_of(std::uint32_t i, std::vector<Vec3>& normals) const {
    normals.clear();
    const auto& points = scope_.mesh().points;
    for (const VolumeFace& face : faces_of(i)) {
        const auto n = scope_.nodes_of(face);
        if (n.size() < 3) continue;
        // Of quadrangles the diagonals span the middle plane.
        const Vec3 u = minus(points[n[n.size() == 4 ? 2 : 1]], points[n[0]]);
        const Vec3 v = n.size() == 4 ? minus(points[n[3]], points[n[1]]) : minus(points[n[2]], points[n[0]]);
        normals.push_back(cross(u, v));
    }
}

double CellHulls::bend_of(std::uint32_t i) const {
    const auto& points = scope_.mesh().points;
    double most = 0;
    for (const VolumeFace& face : faces_of(i)) {
        const auto n = scope_.nodes_of(face);
        if (n.size() != 4) continue;
        // From the middle of one diagonal to that of the other, along the normal of the middle plane.
        const Vec3 u = minus(points[n[2]], points[n[0]]), v = minus(points[n[3]], points[n[1]]), normal = cross(u, v);
        const double length = std::sqrt(dot(normal, normal));
        if (!(length > 0)) continue;
        const Vec3 apart = minus(plus(minus(points[n[1]], points[n[0]]), times(0.5, v)), times(0.5, u));
        most = std::max(most, std::abs(dot(apart, normal)) / length);
    }
    return most;
}

std::vector<CellHulls::Tetrahedron> CellHulls::tetrahedra_of(std::uint32_t i, const Vec3& origin) const {
    const CellMesh& mesh = scope_.mesh();
    const CellType type = mesh.types[scope_.volume_cells()[i]];
    std::vector<Vec3> own;
    points_of(i, origin, own);
    if (linear_type(type) == CellType::tetrahedron) return {{own[0], own[1], own[2], own[3]}};
    const Vec3 middle = mean(own);
    const auto at = [&](std::uint32_t node) { return minus(mesh.points[node], origin); };
    std::vector<Tetrahedron> pieces;
    std::vector<double> volumes;
    double sum = 0;
    for (const VolumeFace& face : faces_of(i)) {
        const auto nodes = scope_.nodes_of(face);
        std::size_t lowest = 0;
        for (std::size_t k = 1; k < nodes.size(); ++k) {
            if (scope_.vertex_of()[nodes[k]] < scope_.vertex_of()[nodes[lowest]]) lowest = k;
        }
        for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
            const auto corner = [&](std::size_t step) { return at(nodes[(lowest + step) % nodes.size()]); };
            pieces.push_back({middle, corner(0), corner(k), corner(k + 1)});
            volumes.push_back(tetrahedron_volume(pieces.back()[0], pieces.back()[1], pieces.back()[2], pieces.back()[3]));
            sum += volumes.back();
        }
    }
    if (type == CellType::polyhedron) return pieces;  // faces may be wound any way
    // Where the middle does not see a face, its tetrahedron is to be taken away from the others: it counts for nothing here.
    std::size_t kept = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (volumes[k] * sum > 0) pieces[kept++] = pieces[k];
    }
    pieces.resize(kept);
    return pieces;
}

std::array<Vec3, 2> CellHulls::box(std::uint32_t i) const {
    const std::uint32_t cell = scope_.volume_cells()[i];
    const auto nodes = scope_.mesh().cell_nodes(cell);
    std::array<Vec3, 2> box{scope_.mesh().points[nodes[0]], scope_.mesh().points[nodes[0]]};
    for (const std::uint32_t node : nodes) {
        const Vec3& p = scope_.mesh().points[node];
        for (std::size_t k = 0; k < 3; ++k) {
            box[0][k] = std::min(box[0][k], p[k]);
            box[1][k] = std::max(box[1][k], p[k]);
        }
    }
    return box;
}

std::vector<std::array<Vec3, 2>> CellHulls::boxes() const {
    std::vector<std::array<Vec3, 2>> all(scope_.volume_cells().size());
    parallel_blocks(all.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) all[i] = box(static_cast<std::uint32_t>(i));
    });
    return all;
}

bool CellHulls::overlap(std::uint32_t i, std::uint32_t j, double tolerance, Scratch& scratch) const {
    const Vec3 origin = scope_.mesh().points[scope_.mesh().cell_nodes(scope_.volume_cells()[i])[0]];
    auto& [a, b, normals] = scratch;
    points_of(i, origin, a);
    points_of(j, origin, b);
    if (parted_along(minus(mean(b), mean(a)), a, b, tolerance)) return false;
    for (const std::uint32_t cell : {i, j}) {
        normals_of(cell, normals);
        for (const Vec3& normal : normals) {
            if (parted_along(normal, a, b, tolerance)) return false;
        }
    }
    tolerance += bend_of(i) + bend_of(j);
    const auto of_b = tetrahedra_of(j, origin);
    for (const auto& s : tetrahedra_of(i, origin)) {
        const Vec3 normal = cross(minus(s[2], s[1]), minus(s[3], s[1]));  // of its face of the cell
        if (parted_along(normal, s, b, tolerance)) continue;
        for (const auto& t : of_b) {
            if (tetrahedra_overlap(s, t, tolerance)) return true;
        }
    }
    return false;
}

bool CellHulls::holds_part_of(std::uint32_t i, const std::array<Vec3, 3>& triangle, double tolerance) const {
    const Vec3 origin = scope_.mesh().points[scope_.mesh().cell_nodes(scope_.volume_cells()[i])[0]];
    const std::array near{minus(triangle[0], origin), minus(triangle[1], origin), minus(triangle[2], origin)};
    const double distance = tolerance + bend_of(i);
    const bool is_one = linear_type(scope_.mesh().types[scope_.volume_cells()[i]]) == CellType::tetrahedron;
    return std::ranges::any_of(tetrahedra_of(i, origin), [&](const Tetrahedron& t) { return holds_part(t, near, distance, !is_one); });
}

}  // namespace geomend::validators
