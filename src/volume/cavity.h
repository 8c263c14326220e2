// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "volume/work_cells.h"

namespace geomend::volumes {

/// Puts a vertex into or beside a bad cell: it and cells around it give way to cells between the faces of that cavity and the vertex, where
/// the worst of them is `factor` times as good, by its least sine, as the worst that goes. Facets and fixed edges stay; vertices inside of
/// the cavity go with it. \return whether that was done. Cost: some 0.1 ms.
/// Source: B. Klingner, J. Shewchuk, Aggressive tetrahedral mesh improvement (2008), 3.3, with a cavity that grows across its worst face.
bool insert_vertex(WorkCells& mesh, const FixedParts& fixed, std::uint32_t cell, double factor);

}  // namespace geomend::volumes
