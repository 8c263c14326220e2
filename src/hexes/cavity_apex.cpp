// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/cavity_apex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/vectors.h"
#include "hexes/half_spaces.h"
#include "hexes/jacobian.h"
#include "hexes/uphill.h"

namespace geomend::hexes {

namespace {

/// The least shape of the cells that a vertex at p makes, or something below `enough` where it is below that.
double least_shape_at(const CavityBorder& border, const Vec3& p, double enough) {
    double least = 2;
    const Vec3 across = minus(border.quads.front()[2], border.quads.front()[0]);
    for (const HalfSpace& h : border.also) least = std::min(least, h.depth(p) / std::sqrt(dot(across, across)));
    for (const auto& q : border.quads) {
        if (least <= enough) return least;
        least = std::min(least, scaled_jacobian(CellType::pyramid, std::array{q[0], q[1], q[2], q[3], p}));
    }
    for (const auto& t : border.triangles) {
        if (least <= enough) return least;
        least = std::min(least, scaled_jacobian(CellType::tetrahedron, std::array{t[0], t[1], t[2], p}));
    }
    return least;
}

/// The half spaces in front of faces, with the triangles that they are of; no_index for those of quadrangles.
struct Insides {
    std::vector<HalfSpace> all;
    std::vector<std::uint32_t> triangle;
};

Insides insides_of(const CavityBorder& border) {
    Insides in;
    for (const auto& q : border.quads) {
        for (std::size_t k = 0; k < 4; ++k) add_half_space(q[k], q[(k + 1) % 4], q[(k + 3) % 4], in.all);
    }
    in.all.insert(in.all.end(), border.also.begin(), border.also.end());
    in.triangle.assign(in.all.size(), no_index);
    for (std::uint32_t i = 0; i < border.triangles.size(); ++i) {
        const auto& t = border.triangles[i];
        add_half_space(t[0], t[1], t[2], in.all);
        in.triangle.resize(in.all.size(), i);
    }
    return in;
}

std::optional<DeepestPlace> deepest_in(const CavityBorder& border, const Insides& in, double& size) {
    const Vec3 middle = border.quads.front()[0];
    double square = 0;
    for (const auto& t : border.triangles) {
        for (const Vec3& p : t) square = std::max(square, dot(minus(p, middle), minus(p, middle)));
    }
    size = std::sqrt(square);
    return deepest_place(in.all, middle, 10 * size);
}

}  // namespace

Room room_in(const CavityBorder& border) {
    const Insides in = insides_of(border);
    double size = 0;
    const auto deepest = deepest_in(border, in, size);
    if (!deepest) return {-HUGE_VAL, {}};
    Room room{deepest->depth / size, {}};
    for (const std::uint32_t t : deepest->tight) {
        if (t != no_index && in.triangle[t] != no_index) room.in_the_way.push_back(in.triangle[t]);
    }
    return room;
}

ApexPlace place_for_apex(const CavityBorder& border) {
    ApexPlace best{{}, -1};
    double size = 0;
    const auto deepest = deepest_in(border, insides_of(border), size);
    if (!deepest || !(deepest->depth > 0)) return best;
    best = {deepest->place, least_shape_at(border, deepest->place, 0)};
    go_uphill(0.1 * size, best, [&](const Vec3& p, ApexPlace& now) {
        const double shape = least_shape_at(border, p, now.quality);
        if (shape > now.quality) now = {p, shape};
    });
    return best;
}

}  // namespace geomend::hexes
