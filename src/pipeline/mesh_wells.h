// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "formats/format.h"
#include "model/dataset.h"
#include "volume/cut_by_wells.h"

namespace geomend {

/// A well, or another line, that became a chain of edges of cells.
struct MeshWell {
    std::string name;
    double length = 0;              ///< of its path
    double inside = 0;              ///< of its edges
    double repeated = 0;            ///< where it runs along edges that it has already; what is left lies outside of the model
    std::uint64_t edges = 0;        ///< of cells
    std::uint64_t on_surfaces = 0;  ///< of these, on surfaces
    std::uint64_t crossings = 0;    ///< vertices on surfaces
};

/// The objects of a Dataset that are to be edges. \param which "all" wells, "none", or names of wells and polylines between commas
/// Failure (usage, F018) where a name is none of theirs, with the nearest one.
Result<std::vector<std::uint32_t>> chosen_wells(const Dataset& dataset, const std::string& which);

/// Their paths: several for polylines of more than one piece. Where two have one name the second gets a number, which is listed.
std::vector<volumes::WellPath> paths_of(const Dataset& dataset, std::span<const std::uint32_t> chosen, std::vector<Loss>& losses);

/// Whether a mesh in this format can have edges: others get wells beside it.
bool has_edges(const Format& target);

/// Adds chains to a mesh, as a line for each name. \pre the mesh has the vertices of the model as points
void add_wells(CellMesh& mesh, std::span<const volumes::WellChain> chains);

/// What wells say besides the way that they run, which edges do not.
void list_well_losses(const Object& well, std::vector<Loss>& losses);

/// The chains of each name, summed up.
std::vector<MeshWell> mesh_wells(std::span<const volumes::WellChain> chains);

/// One line for each.
std::string wells_text(std::span<const MeshWell> wells);

}  // namespace geomend
