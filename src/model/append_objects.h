// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "model/dataset.h"

namespace geomend {

/// Puts the objects of a dataset behind those of another, and its models, which then stand on them; nothing else of it. Cost: linear in
/// objects and faces of models.
inline void append_objects(Dataset& into, Dataset& more) {
    const auto shift = static_cast<std::uint32_t>(into.objects.size());
    for (StatedModel& model : more.models) {
        for (StatedModel::Face& face : model.faces) {
            if (face.object != no_index) face.object += shift;
        }
        into.models.push_back(std::move(model));
    }
    std::ranges::move(more.objects, std::back_inserter(into.objects));
}

}  // namespace geomend
