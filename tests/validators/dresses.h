// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "base/finding.h"
#include "model/dataset.h"

// One model in many dresses: shuffled, turned over, rotated, in map coordinates, with finer triangles, without region lists, as loose
// surfaces, without roles and names, and as files of several formats, also as other programs write them.

namespace geomend::testing {

/// How much of what the model states is left in a dress: all; no lists of regions; roles and names only; nothing but triangles.
enum class Left { all, no_lists, no_model, no_roles };

struct Dress {
    const char* name;
    Left left;
    /// What is found of a model of surfaces in this dress. \param folder an empty one, for files
    std::function<std::vector<Finding>(const Dataset& data, const std::filesystem::path& folder)> judge;
};

/// The first is the model as it was made.
const std::vector<Dress>& dresses();

}  // namespace geomend::testing
