// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectors.h"

namespace geomend::remeshing {

CrossingWalk::CrossingWalk(const EdgeMesh& mesh, const Vec3& from, const Vec3& to, const SurfacePoint& start)
    : mesh_(mesh), from_(from), along_(minus(to, from)), square_(dot(along_, along_)), at_(start.triangle), entered_(no_index) {
    const auto t = mesh.triangle(at_);
    across_ = cross(along_, cross(minus(t[1], t[0]), minus(t[2], t[0])));
    if (!(square_ > 0) || !(dot(across_, across_) > 0)) at_ = no_index;
    for (std::uint32_t k = 0; k < 3; ++k) {
        if (start.weights[k] > 1 - 1e-9) first_vertex_ = mesh.corners[3 * std::size_t{start.triangle} + k];
    }
}

/// Leaves a triangle through the edge that the plane of the walk meets farthest on. \return false where it meets none farther on
bool CrossingWalk::leave(std::uint32_t triangle, std::uint32_t entered) {
    std::array<double, 3> side{};
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh_.corners[3 * std::size_t{triangle} + k];
        side[k] = v == first_vertex_ ? 0 : dot(across_, minus(mesh_.places[v], from_));
    }
    double farthest = way_ + 1e-9;
    std::uint32_t out = no_index;
    for (std::uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        const double a = side[h % 3], b = side[next_of(h) % 3];
        if (h == entered || (a < 0) == (b < 0)) continue;
        const Vec3& p = mesh_.places[mesh_.from(h)];
        const Vec3 q = minus(plus(p, times(a / (a - b), minus(mesh_.places[mesh_.to(h)], p))), from_);
        const double way = dot(q, along_) / square_;
        if (!(way > farthest)) continue;
        farthest = way;
        out = h;
        on_surface_ = plus(from_, q);
        on_edge_ = plus(from_, times(std::clamp(way, 0.0, 1.0), along_));
    }
    if (out == no_index || farthest >= 1) return false;
    way_ = farthest;
    triangle_ = triangle;
    entered_ = mesh_.twins[out];
    at_ = entered_ == no_index ? no_index : entered_ / 3;
    return true;
}

bool CrossingWalk::next() {
    if (at_ == no_index || ++steps_ > 100'000) return false;
    if (steps_ == 1 && first_vertex_ != no_index) {  // it begins at a vertex of the surface: through any triangle there
        bool found = false;
        visit_leaving(mesh_, first_vertex_, [&](std::uint32_t h) { found = found || leave(h / 3, no_index); });
        return found;
    }
    return leave(at_, entered_);
}

}  // namespace geomend::remeshing
