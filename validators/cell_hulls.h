// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "validators/cell_scope.h"

namespace geomend::validators {

/// Cells as convex pieces, to tell whether two of them have an inside in common. Coordinates are taken relative to a point near both,
/// so that map coordinates cost no digits.
class CellHulls {
public:
    explicit CellHulls(const CellScope& scope);

    /// Room for one thread that asks many times.
    struct Scratch {
        std::vector<Vec3> a, b, normals;
    };

    /// The box along the axes around the i-th of scope.volume_cells().
    std::array<Vec3, 2> box(std::uint32_t i) const;
    /// Those of all, for a tree. Cost: linear.
    std::vector<std::array<Vec3, 2>> boxes() const;
    /// Its faces.
    std::span<const VolumeFace> faces_of(std::uint32_t i) const {
        return scope_.faces().subspan(first_face_[i], first_face_[i + 1] - first_face_[i]);
    }
    /// True where the i-th and the j-th of scope.volume_cells() have a body in common that is thicker than the tolerance in each
    /// direction in which one of their pieces could be parted from one of the other: what touches only has none. Where faces are
    /// bent, it is to be thicker than what the triangles of both cells differ from their faces, too. Tetrahedra are
    /// judged by themselves; other cells by tetrahedra between their middle and the triangles of their faces.
    bool overlap(std::uint32_t i, std::uint32_t j, double tolerance, Scratch& scratch) const;
    /// True where a part of a triangle lies inside the i-th of scope.volume_cells(), farther than the tolerance, and than its faces are
    /// bent, from its faces.
    bool holds_part_of(std::uint32_t i, const std::array<Vec3, 3>& triangle, double tolerance) const;

private:
    using Tetrahedron = std::array<Vec3, 4>;
    /// By how much the faces of a cell with four corners are bent: the largest distance between the diagonals of one. What lies between
    /// them is the matter of how two cells split the face (M24), and no body that they have in common.
    double bend_of(std::uint32_t i) const;
    void points_of(std::uint32_t i, const Vec3& origin, std::vector<Vec3>& points) const;
    void normals_of(std::uint32_t i, std::vector<Vec3>& normals) const;
    std::vector<Tetrahedron> tetrahedra_of(std::uint32_t i, const Vec3& origin) const;

    const CellScope& scope_;
    std::vector<std::uint32_t> first_face_;  ///< per volume cell, into scope.faces()
};

}  // namespace geomend::validators
