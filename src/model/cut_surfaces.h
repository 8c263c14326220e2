// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/objects.h"

namespace geomend {

/// A surface of a mesh that was cut, and the entities that it is now: itself first.
struct CutSurface {
    std::vector<std::uint32_t> pieces;
};

/// Cuts surface entities whose faces lie between several pairs of regions, as sets for boundary conditions do, into one entity for each
/// pair: the regions are the entities of the cells on both sides of a face. The first pair keeps the entity, the others get copies of it
/// behind all entities, with tags behind all tags. Pieces of a surface without a name are called after its tag, all the same.
/// \param may_be_cut per entity whether it is such a set; \pre cell_entity has an entity or no_index for each cell
/// \return the surfaces that were cut, by entity. Cost: linear in the cells.
std::vector<CutSurface> cut_surfaces_by_regions(CellMesh& mesh, std::span<const std::uint8_t> may_be_cut);

}  // namespace geomend
