// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "model/loss.h"
#include "model/volume_mesh.h"

namespace geomend {

/// Kinds of cells as bits.
enum CellKinds : std::uint8_t {
    tetrahedra = 1,
    pyramids = 2,
    wedges = 4,
    hexahedra = 8,
    prisms = 16,  ///< over pentagons and hexagons
    polyhedra = 32,
    simple_cells = tetrahedra | pyramids | wedges | hexahedra,
    all_cells = simple_cells | prisms | polyhedra
};

/// The kind of a type of volume cell. \pre dimension(type) is 3
CellKinds kind_of(CellType type);
/// Whether a second-order type has nodes in the middle of faces or of the cell.
bool has_middle_nodes(CellType type);

enum class CellOrder : std::uint8_t { any, by_type, by_region, by_region_and_type };
/// Along which surfaces the mesh must be doubled.
enum class Splitting : std::uint8_t { none, as_given, on_faults, on_all_surfaces };
enum class CornerOrder : std::uint8_t { outward, either };
/// How a target calls regions and sets: by numbers; by words (letters, digits, '_' and '-', a letter first, either case the same); by
/// any text.
enum class Naming : std::uint8_t { numbers, words, texts };

/// What a target can keep of a mesh and what it asks for. One row a target; a writer prints what was prepared for its row.
struct MeshNeeds {
    std::string_view target;
    CellKinds cells;
    std::uint8_t order;  ///< highest order of cells, 1 or 2
    CellOrder sorted;
    Splitting splitting;
    CornerOrder winding;
    bool middle_nodes;  ///< of second-order cells: nodes in the middle of faces and of cells, beside those on edges
    Naming names;       ///< of regions and sets; numbers alone lose the names
    bool face_sets, face_sides, edge_sets, node_sets;
    bool point_values, cell_values;
    std::uint16_t longest_name;   ///< characters; 0: as long as they are
    bool network = false;         ///< volumes and centres of cells, and connections, are wanted
    bool faces_once = false;      ///< a face is in one face set at most
    bool one_name_space = false;  ///< regions, face sets and edge sets have no name in common
};

/// All rows, ascending by target.
std::span<const MeshNeeds> mesh_needs();
/// The row of a target, or nullptr.
const MeshNeeds* find_mesh_needs(std::string_view target);

/// What of a mesh a target cannot keep, whatever is prepared: cells of kinds it does not know, second order, sets, sides, names,
/// values. Nothing that preparing mends (order of cells, splitting). Linear in the numbers of blocks, sets and attributes.
std::vector<Loss> losses(const VolumeMesh& mesh, const MeshNeeds& needs);

}  // namespace geomend
