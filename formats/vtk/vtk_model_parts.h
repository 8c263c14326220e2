// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "model/brep.h"
#include "model/dataset.h"

// The blocks of a model, once they are read, put together again. Used by vtk_model.cpp only.

namespace geomend::vtk {

/// Name of the point array that gives the model vertex of each point.
inline constexpr std::string_view model_vertex = "model_vertex";

/// Blocks by group, in file order, and everything else.
struct SortedBlocks {
    std::array<std::vector<Object>, 4> groups;  ///< Corners, Lines, Surfaces, Regions
    Dataset rest;
};
SortedBlocks sort_blocks(Dataset blocks);

/// One Surface for each list of surface blocks, which become its parts. Empty where the lists or blocks do not fit.
std::vector<Object> surfaces_of_blocks(SortedBlocks& blocks, const std::vector<std::vector<std::uint32_t>>& lists);

/// Corners, lines, surfaces and regions as the entities of a mesh, in this order; one point per model vertex, and more
/// where regions give one vertex different values. Nothing where the blocks do not fit.
std::optional<CellMesh> mesh_of_blocks(SortedBlocks& blocks, std::vector<CellMesh::Entity> entities, std::vector<Loss>& losses);

/// The entities that mesh_of_blocks makes, for a B-Rep.
std::vector<CellMesh::Entity> model_entities(const BrepData& brep);

}  // namespace geomend::vtk
