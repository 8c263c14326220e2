// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/winding.h"

#include <algorithm>

#include "topology/face_edges.h"

namespace geomend::topology {

Winding winding_of(const BrepData::Surface& surface) {
    const PolygonEdges edges(surface.polygons);
    const std::size_t count = surface.polygons.size();
    std::vector<std::int8_t> sign(count, 0);
    const auto same_way = [&](std::size_t corner, std::uint32_t q) {
        const std::uint32_t from = edges.start_node(corner), to = edges.end_node(corner);
        for (std::size_t c = surface.polygons.first_corner(q); c < surface.polygons.first_corner(q + 1); ++c) {
            if (edges.start_node(c) == from && edges.end_node(c) == to) return true;
        }
        return false;
    };
    Winding result;
    std::vector<std::uint32_t> piece;
    for (std::uint32_t start = 0; start < count; ++start) {
        if (sign[start] != 0) continue;
        sign[start] = 1;
        piece.assign(1, start);
        std::size_t turned = 0;
        for (std::size_t k = 0; k < piece.size(); ++k) {
            const std::uint32_t p = piece[k];
            for (std::size_t c = surface.polygons.first_corner(p); c < surface.polygons.first_corner(p + 1); ++c) {
                const std::uint32_t q = surface.neighbours[c];
                if (q == no_index) continue;
                const auto wanted = static_cast<std::int8_t>(same_way(c, q) ? -sign[p] : sign[p]);
                if (sign[q] == 0) {
                    sign[q] = wanted;
                    turned += wanted < 0 ? 1 : 0;
                    piece.push_back(q);
                } else if (sign[q] != wanted) {
                    result.one_sided = true;
                }
            }
        }
        const std::int8_t minority = 2 * turned > piece.size() ? 1 : -1;
        for (const std::uint32_t p : piece) {
            if (sign[p] == minority) result.wrong.push_back(p);
        }
    }
    std::ranges::sort(result.wrong);
    return result;
}

void turn_polygon(BrepData::Surface& surface, std::uint32_t polygon) {
    const auto first = surface.polygons.corners.begin() + static_cast<std::ptrdiff_t>(surface.polygons.first_corner(polygon));
    std::reverse(first + 1, first + static_cast<std::ptrdiff_t>(surface.polygons[polygon].size()));
}

}  // namespace geomend::topology
