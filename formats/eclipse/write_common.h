// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/eclipse/array_writer.h"
#include "formats/eclipse/cell_arrays.h"
#include "formats/format.h"

namespace geomend::eclipse {

/// The grids of a Dataset that go into one file: the global one and its refinements, hosts before the refined.
struct ChosenGrids {
    const CornerPointGrid* global = nullptr;
    std::vector<const CornerPointGrid*> local;
};

/// Chooses, and lists everything else of the Dataset as lost. `title` names the format in messages.
/// Failure F021 where there is none, or where its arrays do not fit each other.
/// \param with_geometry pillars and depths are needed
Result<ChosenGrids> choose_grids(const Dataset& dataset, std::string_view title, bool with_local, bool with_geometry, const OutputSet& out,
                                 std::vector<Loss>& losses);

/// What goes into a file besides pillars, depths and activity.
struct GridKept {
    std::string_view title;
    bool name = false;
    bool attributes = false;
    bool connections = false;
    bool transmissibilities = false;
    bool porosity = false;
    bool map = true;       ///< axes, units, orientation
    bool sets = true;      ///< several sets of coordinate lines
    bool corsnum = false;  ///< the attribute CORSNUM goes along though others do not
    bool unit_system = false;
};

/// Lists what of one grid does not go in.
void add_grid_losses(const CornerPointGrid& grid, const GridKept& kept, const OutputSet& out, std::vector<Loss>& losses);

/// COORD and ZCORN; elevations where the file that the grid is from had them. Failure (cannot_hold) where a coordinate is beyond
/// single precision.
Result<void> write_geometry(ArrayWriter& writer, const CornerPointGrid& grid, std::string_view title, std::vector<Loss>& losses);

/// MAPUNITS, MAPAXES, GRIDUNIT, GDORIENT, where they are stated.
void write_map(ArrayWriter& writer, const CornerPointGrid& grid, std::string_view title, std::vector<Loss>& losses);

/// COORDSYS of grids with several sets of coordinate lines, or with one that is not the usual one.
void write_coordinate_systems(ArrayWriter& writer, const CornerPointGrid& grid);

/// Writes the cell attributes of a grid, one array a component, with names of at most eight characters, each once.
/// \param active_only leaves out inactive cells
void write_cell_arrays(ArrayWriter& writer, const CornerPointGrid& grid, const CellOrder& order, bool active_only, std::string_view title,
                       std::vector<Loss>& losses);

}  // namespace geomend::eclipse
