// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "formats/eclipse/arrays.h"
#include "model/dataset.h"

namespace geomend::eclipse {

/// A grid of which arrays are still to come, and where those that came stand.
struct GridParts {
    CornerPointGrid grid;
    const Array* dims = nullptr;
    const Array* pillars = nullptr;
    const Array* depths = nullptr;
    const Array* activity = nullptr;
    std::int32_t number = 0;  ///< what the file calls it by: 0 is the global one
    std::size_t pillar_sets = 1;
};

/// Sets the numbers of cells. Failure F014 where they are not positive or where the file is too short for so many.
Result<void> set_dims(const ArrayFile& file, const Array& array, std::int32_t nx, std::int32_t ny, std::int32_t nz, GridParts& parts);

/// Takes an array that EGRID, GRID and binary GRDECL have in common: MAPUNITS, MAPAXES, GRIDUNIT, GDORIENT, COORD,
/// ZCORN, ACTNUM. False where it is another one.
Result<bool> take_grid_array(const ArrayFile& file, const Array& array, GridParts& parts);

/// COORDSYS: six numbers a set of coordinate lines.
Result<void> take_coordinate_systems(const ArrayFile& file, const Array& array, GridParts& parts);

/// Tests the lengths of what was taken, and turns elevations into depths. Failure F008 or F012.
Result<CornerPointGrid> finish_grid(const ArrayFile& file, GridParts&& parts, std::vector<Finding>& findings);

/// Name of the file without folder, ".gz" and extension.
std::string stem_of(const Input& input);

/// Where the corner depths of the active cells decrease with k and are negative they are elevations: their sign is
/// turned, in memory, and a finding (F132) says so.
void turn_elevations(CornerPointGrid& grid, const Location& where, std::vector<Finding>& findings);

}  // namespace geomend::eclipse
