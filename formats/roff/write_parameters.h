// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "formats/roff/token_writer.h"
#include "model/corner_point.h"
#include "model/loss.h"

namespace geomend::roff {

/// Writes the cell attributes of a grid as parameters. Missing values become -999, of bytes 255, unless these stand for
/// something; several components go as a parameter each.
void write_parameters(TokenWriter& to, const CornerPointGrid& grid, std::vector<Loss>& losses);

}  // namespace geomend::roff
