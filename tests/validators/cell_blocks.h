// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "validators/registry.h"

// Blocks of cells, and what is found of them in other frames.

namespace geomend::testing {

using Codes = std::map<std::string, std::uint64_t>;

inline Codes codes_of(const CellMesh& mesh) {
    Dataset data;
    data.objects.emplace_back(mesh);
    auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    Codes codes;
    for (const Finding& f : checked->findings) codes[f.code] += f.count;
    return codes;
}

enum class Kind { hexahedra, wedges, tetrahedra };

/// A block of n x n x n cubes with its low corner at `low`, each a hexahedron, two wedges or six tetrahedra; nodes of its own.
inline void add_block(CellMesh& mesh, const Vec3& low, double size, std::uint32_t n, Kind kind) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    const double h = size / n;
    for (std::uint32_t k = 0; k <= n; ++k)
        for (std::uint32_t j = 0; j <= n; ++j)
            for (std::uint32_t i = 0; i <= n; ++i) mesh.points.push_back({low[0] + i * h, low[1] + j * h, low[2] + k * h});
    const auto at = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return first + (k * (n + 1) + j) * (n + 1) + i; };
    using Nodes = std::vector<std::uint32_t>;
    for (std::uint32_t k = 0; k < n; ++k) {
        for (std::uint32_t j = 0; j < n; ++j) {
            for (std::uint32_t i = 0; i < n; ++i) {
                const Nodes c{at(i, j, k),     at(i + 1, j, k),     at(i + 1, j + 1, k),     at(i, j + 1, k),
                              at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)};
                if (kind == Kind::hexahedra) mesh.add_cell(CellType::hexahedron, c);
                if (kind == Kind::wedges) {
                    mesh.add_cell(CellType::wedge, Nodes{c[0], c[2], c[1], c[4], c[6], c[5]});
                    mesh.add_cell(CellType::wedge, Nodes{c[0], c[3], c[2], c[4], c[7], c[6]});
                }
                if (kind != Kind::tetrahedra) continue;
                constexpr unsigned paths[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
                for (const auto& [a, b] : paths) mesh.add_cell(CellType::tetrahedron, Nodes{c[0], c[a], c[b], c[6]});
            }
        }
    }
}

/// Turned about two axes, scaled, moved, its nodes and cells in another order.
inline CellMesh in_another_frame(const CellMesh& mesh, unsigned seed, double scale, const Vec3& offset) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> angle(0, 6.28);
    const double a = angle(random), b = angle(random);
    std::vector<std::uint32_t> place(mesh.points.size()), order(mesh.cell_count());
    std::iota(place.begin(), place.end(), 0u);
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::shuffle(place, random);
    std::ranges::shuffle(order, random);
    CellMesh out;
    out.points.resize(mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const auto& [x, y, z] = mesh.points[i];
        const double u = std::cos(a) * x - std::sin(a) * y, v = std::sin(a) * x + std::cos(a) * y;
        out.points[place[i]] = {scale * u + offset[0], scale * (std::cos(b) * v - std::sin(b) * z) + offset[1],
                                scale * (std::sin(b) * v + std::cos(b) * z) + offset[2]};
    }
    for (const std::uint32_t c : order) {
        std::vector<std::uint32_t> nodes;
        for (const std::uint32_t node : mesh.cell_nodes(c)) nodes.push_back(place[node]);
        out.add_cell(mesh.types[c], nodes);
    }
    return out;
}

/// The codes with their counts, which must be the same in every frame. Nodes at one position (M27) need not stay so when turned.
inline Codes codes_in_all_frames(const CellMesh& mesh) {
    Codes codes = codes_of(mesh);
    codes.erase("M27");
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const bool far = seed % 2 == 0;
        Codes turned = codes_of(in_another_frame(mesh, seed, far ? 1.0 : 0.01, far ? Vec3{431000, 6521000, -2300} : Vec3{}));
        turned.erase("M27");
        EXPECT_EQ(turned, codes) << "seed " << seed;
    }
    return codes;
}

}  // namespace geomend::testing
