// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "base/vectors.h"
#include "model/each_face.h"
#include "model/volume_mesh.h"

namespace geomend::test {

using Tets = std::vector<std::array<std::uint32_t, 4>>;

/// A lattice of n x m x k cubes with its points in the order of x, then y, then z.
struct Lattice {
    std::array<std::uint32_t, 3> n;
    std::vector<Vec3> points;
    std::uint32_t at(std::uint32_t i, std::uint32_t j, std::uint32_t k) const { return i + (n[0] + 1) * (j + (n[1] + 1) * k); }
    /// The corners of a cube in VTK's order.
    std::array<std::uint32_t, 8> cube(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
        return {at(i, j, k),     at(i + 1, j, k),     at(i + 1, j + 1, k),     at(i, j + 1, k),
                at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)};
    }
};

inline Lattice lattice(std::array<std::uint32_t, 3> n) {
    Lattice l{n, {}};
    for (std::uint32_t k = 0; k <= n[2]; ++k) {
        for (std::uint32_t j = 0; j <= n[1]; ++j) {
            for (std::uint32_t i = 0; i <= n[0]; ++i) l.points.push_back({double(i), double(j), double(k)});
        }
    }
    return l;
}

/// Moves the inner points of a lattice by up to a part of its step.
inline void jitter(Lattice& l, double part) {
    std::uint32_t random = 12345;
    const auto next = [&] {
        random = random * 1664525u + 1013904223u;
        return 2.0 * (random >> 8) / (1 << 24) - 1;
    };
    for (std::uint32_t k = 1; k < l.n[2]; ++k) {
        for (std::uint32_t j = 1; j < l.n[1]; ++j) {
            for (std::uint32_t i = 1; i < l.n[0]; ++i) {
                for (double& x : l.points[l.at(i, j, k)]) x += part * next();
            }
        }
    }
}

/// Kuhn's cut of a cube into six tetrahedra about its diagonal from corner 0 to corner 6.
inline void cut_about_diagonal(const std::array<std::uint32_t, 8>& c, Tets& tets) {
    for (const auto& t : {std::array{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}})
        tets.push_back({c[t[0]], c[t[1]], c[t[2]], c[t[3]]});
}

inline Tets kuhn_tets(const Lattice& l) {
    Tets tets;
    for (std::uint32_t k = 0; k < l.n[2]; ++k) {
        for (std::uint32_t j = 0; j < l.n[1]; ++j) {
            for (std::uint32_t i = 0; i < l.n[0]; ++i) cut_about_diagonal(l.cube(i, j, k), tets);
        }
    }
    return tets;
}

/// A mesh of one region, or of several: \param region_of of a tetrahedron
inline VolumeMeshData mesh_data(std::vector<Vec3> points, const Tets& tets, const std::function<std::uint32_t(std::size_t)>& region_of = {},
                                std::uint32_t regions = 1) {
    VolumeMeshData d;
    d.name = "mesh";
    d.vertices = std::move(points);
    std::vector<std::vector<std::array<std::uint32_t, 4>>> by_region(regions);
    for (std::size_t t = 0; t < tets.size(); ++t) by_region[region_of ? region_of(t) : 0].push_back(tets[t]);
    for (std::uint32_t r = 0; r < regions; ++r) {
        d.regions.push_back("region " + std::to_string(r));
        if (by_region[r].empty()) continue;
        d.blocks.push_back(
            {r, CellType::tetrahedron, static_cast<std::uint32_t>(d.cell_count()), static_cast<std::uint32_t>(by_region[r].size())});
        for (const auto& t : by_region[r]) {
            d.cell_nodes.insert(d.cell_nodes.end(), t.begin(), t.end());
            d.cell_offsets.push_back(d.cell_nodes.size());
        }
    }
    return d;
}

}  // namespace geomend::test
