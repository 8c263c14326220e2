// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/narrow_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "volume/cell_quality.h"
#include "volume/forced_places.h"

namespace geomend::volumes {

NarrowCells narrow_cells(const RegionFacets& facets, const RegionCells& region, double size) {
    const double least = std::cos(5 * std::numbers::pi / 180);
    const auto known = facets.positions.size();
    const auto position = [&](std::uint32_t v) { return v < known ? facets.positions[v] : region.new_vertices[v - known]; };
    NarrowCells found;
    std::optional<ForcedPlaces> forced;  // most regions have no such cell
    for (const auto& c : region.cells) {
        if (dihedral_cosines({position(c[0]), position(c[1]), position(c[2]), position(c[3])}).of_least <= least) continue;
        ++found.all;
        if (!forced) forced.emplace(facets, size);
        if (std::ranges::any_of(c, [&](std::uint32_t v) { return forced->is_near(v, position(v)); })) ++found.forced;
    }
    return found;
}

}  // namespace geomend::volumes
