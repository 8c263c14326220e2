// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/vtk/vtk_cells.h"
#include "model/dataset.h"

// A boundary representation as named blocks, one per corner, line, surface and region, and back.

namespace geomend::vtk {

/// One block: `group` is "Corners", "Lines", "Surfaces" or "Regions".
struct ModelBlock {
    std::string group;
    std::string name;
    Object object;
};

/// The blocks of a B-Rep and the two texts that bring it back (dataset_text() of what model_from_blocks gives, and
/// the text that is_model_text() knows).
struct ModelBlocks {
    std::vector<ModelBlock> blocks;
    std::string dataset, structure;
};

/// Corners are points, lines polylines, surfaces polygons with the values of their nodes; a region is its cells or,
/// where it has none, its sides. Every point carries the number of its model vertex ("model_vertex").
ModelBlocks blocks_of_brep(const BrepData& brep);

bool is_model_text(std::string_view structure);

/// The Dataset behind blocks that were read: one Surface per interface (parts are the B-Rep's surfaces) or, where regions
/// hold cells, one CellMesh with entities; a StatedModel over them. Objects that are no blocks of the model follow.
/// Nothing where the blocks do not fit the text (the dataset is used up either way).
std::optional<Dataset> model_from_blocks(std::string_view structure, std::string_view dataset_words, Dataset blocks);

}  // namespace geomend::vtk
