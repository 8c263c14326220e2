// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/input.h"
#include "pipeline/load.h"

namespace geomend {

/// Reads what a deck takes from files of other kinds and puts it onto the deck's grid: GDFILE gives geometry (and ACTNUM
/// where the deck has none), IMPORT a binary GRDECL with all it holds. Paths count from the deck, with '\' as '/'.
/// Failures: F010 where a file is missing, with the paths tried (--option includes=skip lists a loss instead), F008 where
/// its cells are not those of the deck, and whatever reading it finds wrong.
Result<void> follow_deck_companions(Dataset& dataset, const Input& deck, const LoadOptions& options);

}  // namespace geomend
