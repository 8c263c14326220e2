// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/format.h"
#include "formats/grdecl/keywords.h"

namespace geomend::grdecl {

/// One deck while it is written.
struct DeckOutput {
    const Dataset& dataset;
    OutputSet& files;
    OutputFile& main;
    const Monitor* monitor = nullptr;
    bool deck = false;              ///< a whole deck: arrays go into the sections to which they belong
    bool all_inside = false;        ///< what simulators do not know stands in the main file, too
    OutputFile* further = nullptr;  ///< the companion file; made when something goes in
    std::string further_name = {};
    std::vector<Loss> losses = {};

    /// The companion file, at the place of a grid; nullptr (and `what` told as a loss) where there is none.
    OutputFile* companion(const CornerPointGrid& grid, const std::string& what);
    const CornerPointGrid* further_grid = nullptr;  ///< the local grid that the companion file is at
};

/// Name that stands in the file of properties beside the main one.
std::string companion_name(const OutputSet& files);

/// Keywords of the grid's head and geometry (write_grid.cpp).
void write_head(const CornerPointGrid& grid, DeckOutput& to);
void write_geometry(const CornerPointGrid& grid, DeckOutput& to);
void write_faults_and_connections(const CornerPointGrid& grid, DeckOutput& to, bool activity_too);
void write_local_grid_begin(const CornerPointGrid& grid, DeckOutput& to);
/// A radial grid as blocks: steps outwards from the inner radius and around from an angle of 0, tops of the first layer, heights of all
/// cells.
struct RadialBlocks {
    double inner = 0;
    std::vector<double> radii, angles, tops, heights;
};
/// What a grid is as such blocks (radial_writing.cpp); nothing where it is none: not radial, pillars that lean or are not in circles and
/// rays, cells that are not flat or do not lie on each other. Cost: linear.
std::optional<RadialBlocks> radial_blocks(const CornerPointGrid& grid);
void write_radial_blocks(const RadialBlocks& blocks, DeckOutput& to);
/// METRES, FEET or CM for a unit that is one of them however it is spelt; else empty.
std::string_view unit_word(std::string_view unit);

/// Cell attributes (write_properties.cpp). Section none: of an include, all that simulators take in GRID or REGIONS,
/// and the rest into the companion file.
void write_properties(const CornerPointGrid& grid, Section section, DeckOutput& to);

/// What section EDIT does to arrays that simulators compute, in its order.
void write_edit_operations(const CornerPointGrid& grid, OutputFile& out);

/// Records that were kept as text. `suffix` is "", ".edit" or ".regions".
void write_records(const CornerPointGrid& grid, std::string_view suffix, DeckOutput& to);

/// Writes the grid section as an include. Options: content=all|properties, properties=beside|inside.
Result<std::vector<Loss>> write_include(const Dataset& dataset, OutputSet& outputs, const WriteOptions& options);

/// Writes a whole deck with the sections that were read from one. Options as above.
Result<std::vector<Loss>> write_whole_deck(const Dataset& dataset, OutputSet& outputs, const WriteOptions& options);

}  // namespace geomend::grdecl
