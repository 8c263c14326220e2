// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::roff {

/// The grid that goes into the file: the first global one, else the first. Everything else is listed as lost.
/// Failure F021 where there is none, or where its arrays do not fit each other.
Result<const CornerPointGrid*> choose_grid(const Dataset& dataset, const OutputSet& out, std::vector<Loss>& losses);

/// Lists what of a grid ROFF files have no place for.
void add_grid_losses(const CornerPointGrid& grid, const OutputSet& out, std::vector<Loss>& losses);

/// Lists what rounding did to coordinates: a matter of identity as long as it is within single precision.
void add_rounding_loss(const CornerPointGrid& grid, std::uint64_t changed, double largest, std::vector<Loss>& losses);

}  // namespace geomend::roff
