// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>

#include "model/triangle_soup.h"

namespace geomend::test {

/// How many pairs of triangles meet in more than the vertices and edges that they share by number, in fractions of the doubles as
/// they are. Triangles over the same three vertices count once. Slow and plain, and independent of the product's own search and predicates.
/// \param most stop counting there
std::size_t pairs_that_meet_exactly(const TriangleSoup& soup, std::size_t most = 10);

}  // namespace geomend::test
