// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <span>

#include "base/vec3.h"

namespace geomend::remeshing {

/// Sizes at vertices, and what they are between vertices that lie far apart: sizes grow with the way from each vertex, and are small again
/// at the next one. So a wall of two triangles with small edges at its corners is not filled with small triangles.
struct VertexSizes {
    std::span<const double> at;    ///< per vertex
    std::span<const double> most;  ///< per vertex: up to here sizes grow; empty: they do not
    double growth = 0;             ///< by no more than this share of the way
    /// No more at a point than this; null: anything.
    const std::function<double(const Vec3&)>* limit = nullptr;
};

}  // namespace geomend::remeshing
