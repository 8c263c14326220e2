// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

// What decks say that is neither geometry nor an attribute of cells, on its way into other formats.

namespace geomend {

/// Pore volumes of all active cells of the grids that have PORV for some of them, or on which section EDIT acts, as
/// simulators compute them: in an INIT file 0 means that a cell is not active. Grids of two porosities stay as they are.
void complete_pore_volumes(Dataset& dataset);

/// Parts of decks that are kept as text go into decks only: elsewhere what they do to the grid is lost, and reported.
void list_text_losses(Dataset& dataset, const Format& target);

}  // namespace geomend
