// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "formats/gmsh/element_types.h"
#include "model/dataset.h"

namespace geomend::gmsh {

/// Tags of nodes or elements to be written: first, first+1, ... where `ids` is empty.
struct WriteTags {
    std::int64_t first = 1;
    std::vector<std::int64_t> ids;
    bool renumbered = false;
    std::int64_t operator[](std::size_t i) const { return ids.empty() ? first + static_cast<std::int64_t>(i) : ids[i]; }
};

/// A mesh as it goes out: only cells that MSH has, each with an entity; entities and groups with valid, unique tags, in
/// ascending order of dimension and tag. Arrays that need no change are those of the source.
struct WritePlan {
    std::span<const Vec3> points;
    std::span<const CellType> types;
    std::span<const std::uint64_t> offsets;
    std::span<const std::uint32_t> nodes;
    std::vector<std::uint32_t> cell_entity;
    WriteTags point_tags, cell_tags;
    std::vector<CellMesh::Entity> entities;
    std::vector<CellMesh::Group> groups;
    std::vector<std::uint32_t> entity_from;  ///< source entity of each entity, or no_index
    std::vector<bool> loose;                 ///< entities made for cells that had none

    /// Where points and cells come from; empty: the same numbers.
    std::vector<std::uint32_t> point_source, cell_source;
    CellMesh storage;  ///< arrays that had to be made anew

    std::size_t cell_count() const { return types.size(); }
    std::span<const std::uint32_t> cell_nodes(std::size_t i) const { return nodes.subspan(offsets[i], offsets[i + 1] - offsets[i]); }
    std::size_t source_of_point(std::size_t i) const { return point_source.empty() ? i : point_source[i]; }
    std::size_t source_of_cell(std::size_t i) const { return cell_source.empty() ? i : cell_source[i]; }
};

/// \param mesh lives as long as the plan
/// \param left_out cells and points that do not go out (see Combined); may be empty
/// \param second_order whether second-order cells go out as they are; else by their corners (a substance loss)
/// \param wedges_by_sign wedges that Gmsh would take for turned inside out are turned; false: where MSH numbered them already
/// \param largest_tag of nodes and elements
WritePlan plan_mesh(const CellMesh& mesh, std::span<const std::uint8_t> left_out, std::span<const std::uint8_t> left_out_points,
                    bool second_order, bool wedges_by_sign, std::int64_t largest_tag, std::vector<Loss>& losses);

}  // namespace geomend::gmsh
