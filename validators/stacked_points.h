// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "model/dataset.h"
#include "topology/lengths.h"

namespace geomend::validators {

/// Points without a height that stand above each other are at one position, although they are not one point. Gives them positions of
/// their own: numbers next to each other, so that they are told apart. Of one position those stay together that the most positions
/// link them to are the same for, but never two of one part of an object, unless the file says that they are one. Positions with very
/// many points are left alone. Key triangles follow their triangles. Cost: near-linear in the objects that have such points.
void part_stacked_points(Dataset& dataset, std::span<const topology::OutlyingPoint> outlying);

}  // namespace geomend::validators
