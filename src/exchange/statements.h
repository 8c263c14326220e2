// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "model/brep.h"
#include "model/stated_model.h"

namespace geomend::exchange {

/// Where the face of a B-Rep surface stands in a Dataset.
struct FacePlace {
    SurfaceId surface;
    std::uint32_t object, part;
};

/// All that a StatedModel can say of a B-Rep: faces in the order of `places` (numbered from 1), regions with their
/// sides, layers, fault blocks, features and named corners.
/// \pre every surface has one place
StatedModel stated_model(const BrepData& brep, const std::vector<FacePlace>& places);

}  // namespace geomend::exchange
