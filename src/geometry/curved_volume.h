// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>

#include "model/objects.h"

namespace geomend {

/// The volume of a cell without its sign, of second-order cells between their curved faces: exact but for rounding, since the flux of the
/// position through a face is a polynomial that Gauss' rules integrate as it is. Of all others as cell_volume() has it.
double unsigned_volume(const CellMesh& mesh, std::size_t cell);

}  // namespace geomend
