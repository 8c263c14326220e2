// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hexes/tet_mesh.h"

namespace geomend::hexes {

/// The quadrangles that two facets with a common edge make, by corner: for a vertex and two of its neighbours the vertices that may be
/// opposite. Only those that faces of cells may have: convex, every angle with at least a given sine, its halves on the same walls with
/// no line between them, or on none with its diagonal on none.
class QuadTable {
public:
    /// \param least_sine of each angle; the scaled determinant of a cell's corner is no larger than that of its faces' angles
    /// Cost: n log n in the tetrahedra, times the squared number of facets around an edge.
    QuadTable(const TetMesh& mesh, double least_sine);

    /// A corner: neighbours x < y, and the vertex opposite.
    struct Corner {
        std::uint32_t x, y, opposite;
        auto operator<=>(const Corner&) const = default;
    };
    /// All at one vertex, ascending.
    std::span<const Corner> at(std::uint32_t vertex) const {
        return {corners_.data() + offsets_[vertex], corners_.data() + offsets_[vertex + 1]};
    }
    /// Those with two given neighbours, in either order.
    std::span<const Corner> at(std::uint32_t vertex, std::uint32_t x, std::uint32_t y) const;

private:
    std::vector<std::uint64_t> offsets_;
    std::vector<Corner> corners_;
};

/// Whether the two triangles a, b, c and a, c, d may be one face of a cell: the conditions above.
/// \param first, second the walls that they lie on
bool may_be_quad(const TetMesh& mesh, std::uint32_t a, std::uint32_t c, std::uint32_t first, std::uint32_t second);

}  // namespace geomend::hexes
