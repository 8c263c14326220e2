// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::eclipse {

/// EGRID and FEGRID: the global grid, its local refinements, the connections that the file states.
Result<Dataset> read_egrid(const Input& input, const ReadOptions& options);

/// GRID and FGRID: every cell with its own eight corners. Pillars are found from the corners of the cells around
/// them; corners that are on no common line are a failure (F113) that names the cell.
Result<Dataset> read_old_grid(const Input& input, const ReadOptions& options);

/// Binary GRDECL: arrays with the names of keywords.
Result<Dataset> read_bgrdecl(const Input& input, const ReadOptions& options);

/// INIT and FINIT: properties. They stand on the grid of the file of the same name beside it (.EGRID, .FEGRID, .GRID,
/// .FGRID), or on a grid without pillars and depths where there is none.
Result<Dataset> read_init(const Input& input, const ReadOptions& options);

/// UNRST, FUNRST and single restart files: the arrays of the solution at each report step, named KEYWORD_YYYYMMDD.
/// The grid as for read_init.
Result<Dataset> read_restart(const Input& input, const ReadOptions& options);

}  // namespace geomend::eclipse
