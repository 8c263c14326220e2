// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/vtk/vtk_model.h"

// Several boundary representations in one .vtm: each has its blocks in a group of its own, and a text that tells them apart.

namespace geomend::vtk {

/// A name for the group of each model, all different: its own, or its number. `names` may repeat and be empty.
std::vector<std::string> groups_of_models(std::span<const std::string> names);

/// The text that brings several models back; the i-th has its blocks in the i-th group.
std::string models_text(std::span<const ModelBlocks> models, std::span<const std::string> groups);

/// What one model is made of: its group, the words of its dataset, and its structure.
struct ModelWords {
    std::string group, dataset, structure;
};

/// What models_text() wrote, model by model; nothing where the text is another.
std::optional<std::vector<ModelWords>> words_of_models(std::string_view structure);

/// The Dataset behind blocks that were read: that of each model (see model_from_blocks), one after the other, and then what is in no
/// group of one. The blocks of a model that does not fit them stay single objects, and its group is added to `misfits`.
Dataset models_from_blocks(std::span<const ModelWords> words, Dataset blocks, std::vector<std::string>& misfits);

}  // namespace geomend::vtk
