// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "model/dataset.h"

namespace geomend::grdecl {

/// What a dataset that was read from a deck holds as text alone, and matters: only decks take it along. Linear in the kept
/// records.
std::vector<Loss> losses_of_text(const Dataset& dataset);

}  // namespace geomend::grdecl
