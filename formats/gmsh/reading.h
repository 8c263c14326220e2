// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/format.h"
#include "formats/gmsh/element_types.h"
#include "formats/gmsh/scanner.h"
#include "formats/gmsh/sections.h"
#include "formats/gmsh/tag_index.h"

namespace geomend::gmsh {

/// (dimension, tag) of an entity or a physical group.
using DimTag = std::pair<int, std::int64_t>;

/// MSH 1 and 2 give each element a physical and an elementary tag; cells with the same three numbers are of one class.
struct ElementClass {
    int dimension = 0;
    std::int64_t elementary = 0;
    std::int64_t physical = 0;
    bool tagged = true;  ///< false where the element has no tags at all
    auto operator<=>(const ElementClass&) const = default;
};

/// An entity of $PartitionedEntities: its cells belong to the entity it was cut from.
struct Partitioned {
    std::uint32_t parent = no_index;  ///< entity of the same dimension, or no_index (interfaces between partitions)
    std::int64_t partition = 0;       ///< its first partition
    std::size_t partitions = 0;       ///< how many it belongs to
};

/// Elements whose further nodes are not kept, counted per MSH type.
using DroppedNodes = std::map<int, std::uint64_t>;

/// All that is known while a file is read.
struct Reading {
    Reading(const Input& file, const ReadOptions& how, MshLayout found) : input(file), options(how), layout(std::move(found)) {}

    const Input& input;
    const ReadOptions& options;
    MshLayout layout;

    CellMesh mesh;
    std::vector<Finding> findings;
    std::vector<Loss> losses;

    TagIndex nodes;
    TagIndex cells;
    bool cells_indexed = false;
    /// MSH 2: tags of elements that repeat a cell for another physical group -> that cell.
    std::unordered_map<std::int64_t, std::uint32_t> repeated;

    bool entities_stated = false;
    std::map<DimTag, std::uint32_t> entity_of;
    std::map<DimTag, std::uint32_t> group_of;
    std::map<DimTag, Partitioned> partitioned;
    std::vector<ElementClass> classes;  ///< MSH 1 and 2: cell_entity holds indices into this until they are made entities

    std::vector<std::int32_t> partitions;  ///< per cell, or empty
    DroppedNodes dropped_nodes;
    std::uint64_t degenerate = 0;
    std::vector<std::uint32_t> degenerate_cells;  ///< the first of them
    std::uint64_t attribute_bytes = 0;
};

inline constexpr std::size_t most_listed = 100;

/// Failure with the code for a stopped run.
Failure stopped(const Input& input);

/// A number of things that the head of a section of MSH 4 announces; its blocks say themselves how many they hold.
std::uint64_t announced(Scanner& s, const char* what);
/// Reports (F113) that the blocks of a section hold fewer things than were announced.
void report_fewer(Reading& r, const Scanner& s, std::uint64_t announced, std::uint64_t held, std::string_view what);

/// The entity of a tag, made where it is not there yet.
std::uint32_t entity_index(Reading& r, int dimension, std::int64_t tag);
/// The group of a tag, made where it is not there yet.
std::uint32_t group_index(Reading& r, int dimension, std::int64_t tag);

Result<void> read_physical_names(Reading& r, const Section& section);
Result<void> read_entities(Reading& r, const Section& section);
Result<void> read_partitioned_entities(Reading& r, const Section& section);
/// $NOD, $Nodes and $ParametricNodes of any version; makes r.nodes.
Result<void> read_nodes(Reading& r, const Section& section);
/// $ELM and $Elements of any version. \pre the nodes were read
Result<void> read_elements(Reading& r, const Section& section);
/// MSH 1 and 2: makes entities and groups of the elements' tags.
Result<void> entities_from_classes(Reading& r);
/// MSH 4 without $Entities: cuts surfaces that lie between several pairs of volumes, as no surface of a model does.
void cut_unstated_entities(Reading& r);
/// $NodeData, $ElementData and $ElementNodeData.
Result<void> read_data(Reading& r, const Section& section);
/// $Periodic, as annotations "gmsh.periodic" (text of MSH 4.1, one link each).
Result<void> read_periodic(Reading& r, const Section& section);
/// Sections that are not known: kept verbatim where they are small text, else listed.
void keep_unknown(Reading& r, const Section& section);

/// Text sections with one record per line, cut into pieces that are read at the same time. False where the layout
/// is not that regular: nothing was decided then, and the careful reader, which knows what to say, takes over.
bool read_nodes_by_lines(Reading& r, std::string_view content);
bool read_elements_by_lines(Reading& r, std::string_view content);

/// Nodes of an element in our order. \return whether a node is there twice
inline bool store_nodes(const ElementType& type, const std::uint32_t* file_nodes, std::uint32_t* to) {
    const std::uint32_t n = type.kept;
    if (type.order == nullptr) {
        for (std::uint32_t i = 0; i < n; ++i) to[i] = file_nodes[i];
    } else {
        for (std::uint32_t i = 0; i < n; ++i) to[i] = file_nodes[type.order[i]];
    }
    bool twice = false;
    for (std::uint32_t i = 1; i < n; ++i) {
        for (std::uint32_t j = 0; j < i; ++j) twice |= to[i] == to[j];
    }
    return twice;
}

/// Largest number of nodes of an element that is kept in full.
inline constexpr std::uint32_t most_kept_nodes = 27;

}  // namespace geomend::gmsh
