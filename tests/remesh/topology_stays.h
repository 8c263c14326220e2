// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "made_surfaces.h"

namespace geomend::test {

/// Remeshes a wavy sheet to any size: holes and borders stay as many, and vertices lie on the surface. For properties of rapidcheck.
template <class Remesh>
void check_topology_stays(const Remesh& remesh) {
    const double wave = *rc::gen::inRange(0, 300) / 100.0, length = *rc::gen::inRange(2, 12), size = *rc::gen::inRange(40, 600) / 100.0;
    const auto reference = sheet(14, 11, [&](double x, double y) { return wave * std::sin(x / length) * std::cos(y / length); });
    const std::vector<double> sizes(reference.places.size(), size);
    remeshing::WorkSurface work = with_fixed_borders(reference, sizes);
    remesh(work);
    RC_ASSERT(is_consistent(work.mesh));
    RC_ASSERT(numbers_of(work.mesh).euler == numbers_of(reference).euler);
    RC_ASSERT(numbers_of(work.mesh).border_edges == numbers_of(reference).border_edges);
    for (std::uint32_t v = 0; v < work.mesh.places.size(); ++v) {
        if (work.mesh.has_vertex(v) && work.kinds[v] == remeshing::VertexKind::inner)
            RC_ASSERT(closest_point(reference, work.mesh.places[v], work.triangles[v]).distance < 0.3 * size);
    }
}

}  // namespace geomend::test
