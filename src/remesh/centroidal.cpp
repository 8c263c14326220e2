// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/centroidal.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/length.h"
#include "base/vectors.h"
#include "remesh/polish.h"

namespace geomend::remeshing {

namespace {

constexpr double longer = 1.7;  ///< Lloyd's steps are so many times what they would be: fewer of them do

/// Shares of the corners in the centre of the circle around a triangle, but no point beyond an edge that is a border: cells end there.
Weights centre_weights(const EdgeMesh& mesh, std::uint32_t h, const std::array<Vec3, 3>& at) {
    std::array<double, 3> square{};  // of the edge opposite to each corner
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 d = minus(at[(k + 2) % 3], at[(k + 1) % 3]);
        square[k] = dot(d, d);
    }
    Weights weights{};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        weights[k] = square[k] * (square[(k + 1) % 3] + square[(k + 2) % 3] - square[k]);
        sum += weights[k];
    }
    if (!(sum > 0)) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
    for (double& w : weights) w /= sum;
    const std::array<std::uint32_t, 3> across{next_of(h), previous_of(h), h};  // edges opposite to the corners, from that at which h begins
    for (std::size_t k = 0; k < 3; ++k) {
        if (weights[k] >= 0 || mesh.twins[across[k]] != no_index) continue;
        const double others = weights[(k + 1) % 3] + weights[(k + 2) % 3];
        weights[k] = 0;
        weights[(k + 1) % 3] /= others;
        weights[(k + 2) % 3] /= others;
    }
    return weights;
}

/// The centroid of the part of a Voronoi cell that lies on some triangles, summed up.
struct CellSum {
    Vec3 moment{};
    double mass = 0;

    /// \param normal of the whole triangle: parts on the other side count as taken away
    void add(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal, double density) {
        const Vec3 n = cross(minus(b, a), minus(c, a));
        const double part = density * (dot(n, normal) < 0 ? -length(n) : length(n));
        moment = plus(moment, times(part / 3, plus(a, plus(b, c))));
        mass += part;
    }
};

/// Where the centroid of the cell of a vertex lies, kept in the plane of the vertex. \return false: the cell is none
bool centroid(const WorkSurface& work, std::uint32_t v, Vec3& place) {
    const EdgeMesh& mesh = work.mesh;
    const Vec3 at = mesh.places[v];
    CellSum cell;
    double all = 0;
    Vec3 facing{};
    visit_leaving(mesh, v, [&](std::uint32_t h) {
        const std::uint32_t i = mesh.to(h), j = mesh.tip(h);
        const std::array<Vec3, 3> p{Vec3{}, minus(mesh.places[i], at), minus(mesh.places[j], at)};
        const Vec3 normal = cross(p[1], p[2]);
        const Weights w = centre_weights(mesh, h, p);
        const Vec3 centre = plus(times(w[1], p[1]), times(w[2], p[2]));
        const double size = (2 * work.sizes[v] + work.sizes[i] + work.sizes[j]) / 4, density = 1 / (size * size * size * size);
        cell.add(p[0], times(0.5, p[1]), centre, normal, density);
        cell.add(p[0], centre, times(0.5, p[2]), normal, density);
        all += density * length(normal);
        facing = plus(facing, normal);
    });
    if (!(cell.mass > 0.05 * all)) return false;
    Vec3 step = times(1 / cell.mass, cell.moment);
    const double square = dot(facing, facing);
    if (square > 0) step = minus(step, times(dot(step, facing) / square, facing));
    place = plus(at, step);
    return std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]);
}

}  // namespace

std::size_t move_to_centroids(WorkSurface& work, double share) {
    std::size_t far = 0;
    for (std::uint32_t v = 0; v < work.kinds.size() && !work.stopped_at(v); ++v) {
        if (work.kinds[v] != VertexKind::inner || !work.mesh.has_vertex(v)) continue;
        Vec3 place{};
        if (!centroid(work, v, place)) continue;
        const Vec3 from = work.mesh.places[v], step = minus(place, from);
        if (!try_move(work, v, plus(from, times(longer, step)), false) && !try_move(work, v, place, false)) continue;
        if (length(minus(work.mesh.places[v], from)) > share * work.sizes[v]) ++far;
    }
    return far;
}

void remesh_centroidal(WorkSurface& work, const CentroidalRules& rules) {
    even_out(work, rules.start);
    for (unsigned round = 1; round <= rules.most_rounds && !work.stopped(); ++round) {
        const std::size_t far = move_to_centroids(work, rules.least_step);
        flip_edges(work);
        if (100 * far <= work.kinds.size()) break;
        if (round % 12 != 0 || round + 12 > rules.most_rounds) continue;
        while (split_long_edges(work) > 0) flip_edges(work);  // where there are too few vertices, or too many
        collapse_short_edges(work);
        flip_edges(work);
    }
    polish_triangles(work, rules.polished_below);
}

}  // namespace geomend::remeshing
