// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "volume/work_cells.h"

namespace geomend::volumes {

/// How much is tried.
struct VertexEffort {
    double factor = 1.5;        ///< the worst of new cells is to be so many times as good, by its least sine, as the worst that goes
    double bad = 0;             ///< cells with a smaller sine are bad,
    int more_bad = 0;           ///< and by no more than so many there may be more of them
    std::size_t patience = 12;  ///< by so many cells a cavity may grow beyond what was best
    std::size_t places = 3;     ///< of so many, the best ones, the vertex is moved to where it is best
};

/// Puts a vertex into or beside a bad cell: it and cells around it give way to cells between the faces of that cavity and the vertex, where
/// these are better. Facets and fixed edges stay; vertices inside of the cavity go with it.
/// \return whether that was done. Cost: some 0.2 ms.
/// Source: B. Klingner, J. Shewchuk, Aggressive tetrahedral mesh improvement (2008), 3.3, with a cavity that grows across its worst face.
bool insert_vertex(WorkCells& mesh, const FixedParts& fixed, std::uint32_t cell, const VertexEffort& effort);

}  // namespace geomend::volumes
