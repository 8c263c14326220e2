// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::eclipse {

// Writers of corner-point grids. All store single precision; what rounding changes is a loss. The first grid without a
// host is the global one; its local refinements go along where the format has a place for them.
// Failure F021 (cannot_hold) where there is no corner-point grid, or one without the arrays that the format needs.

Result<std::vector<Loss>> write_egrid(const Dataset& dataset, OutputSet& out, const WriteOptions& options);
Result<std::vector<Loss>> write_fegrid(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

/// Properties of the global grid's active cells. Heads and tables that were read from such a file go back; else
/// INTEHEAD, LOGIHEAD and DOUBHEAD say what is known: units, numbers of cells, porosities. ACTNUM goes along where
/// there is no PORV to tell which cells are active.
Result<std::vector<Loss>> write_init(const Dataset& dataset, OutputSet& out, const WriteOptions& options);
Result<std::vector<Loss>> write_finit(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

Result<std::vector<Loss>> write_bgrdecl(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::eclipse
