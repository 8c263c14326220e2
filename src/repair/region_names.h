// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "repair/surface_model.h"
#include "repair/surface_result.h"

namespace geomend::repair {

/// One side of a triangle of the soup: what a region of the mended model is bounded by.
struct TriangleSide {
    std::uint32_t triangle;
    bool front;  ///< as the triangle is wound in the soup
};

/// Names the regions of a mended model after those that were read: one takes the name of that of which it has the largest volume,
/// where the triangles of a region stand for its volume by their area: of two that were merged the larger one gives its name, however
/// much of its border went with the merging. Layers and fault blocks get their members' successors.
/// \param sides per region of the data the sides that it has
/// Cost: n log n in sides.
std::vector<NameChange> carry_region_names(const SurfaceModel& model, const std::vector<std::vector<TriangleSide>>& sides, BrepData& data);

}  // namespace geomend::repair
