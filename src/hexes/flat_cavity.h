// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "hexes/tet_mesh.h"

namespace geomend::hexes {

/// Tetrahedra that are nearly flat give way, each with those around it that leave room, to tetrahedra around one new vertex.
class FlatCavities {
public:
    /// \param mesh tets, across, region, cells and positions are used and changed
    /// \param is_wall whether a facet stays, by its number \param is_kept whether an edge between two vertices stays
    /// \pre both outlive this
    FlatCavities(TetMesh& mesh, std::function<bool(std::uint32_t)> is_wall, std::function<bool(std::uint32_t, std::uint32_t)> is_kept)
        : m_(mesh), is_wall_(std::move(is_wall)), is_kept_(std::move(is_kept)) {}

    /// A new vertex, behind all others in `positions`.
    struct Made {
        Vec3 position;
        std::array<std::uint32_t, 4> near;
        std::uint32_t region;
    };
    /// \return the new vertices in their order
    std::vector<Made> replace();

private:
    bool replace_at(std::uint32_t t, double least_shape, std::size_t most_facets);
    void find_border();
    bool place(double least_shape, Vec3& p) const;
    bool loses_something() const;
    std::uint32_t grow();
    void fill(const Vec3& p);
    double sine(std::uint32_t t) const;

    TetMesh& m_;
    std::function<bool(std::uint32_t)> is_wall_;
    std::function<bool(std::uint32_t, std::uint32_t)> is_kept_;
    std::vector<std::uint8_t> is_gone_;
    std::vector<std::uint32_t> cavity_, border_;  ///< tetrahedra; facets of them that no other one of them has
    std::vector<Made> made_;
};

}  // namespace geomend::hexes
