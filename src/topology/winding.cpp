// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/winding.h"

#include <algorithm>

#include "topology/face_edges.h"

namespace geomend::topology {

namespace {

/// Whether a polygon goes along the edge between two nodes from the first to the second.
bool goes_along(const Polygons& polygons, std::uint32_t polygon, std::uint32_t from, std::uint32_t to) {
    const auto nodes = polygons[polygon];
    std::uint32_t before = nodes.back();
    for (const std::uint32_t node : nodes) {
        if (before == from && node == to) return true;
        before = node;
    }
    return false;
}

/// Whether no polygon is wound as its neighbour across any edge, as in most surfaces.
bool is_coherent(const BrepData::Surface& surface) {
    for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
        const auto nodes = surface.polygons[p];
        const std::size_t first = surface.polygons.first_corner(p);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const std::uint32_t q = surface.neighbours[first + k];  // asked once, from the lower of the two
            if (q == no_index || q < p) continue;
            if (goes_along(surface.polygons, q, nodes[k], nodes[k + 1 == nodes.size() ? 0 : k + 1])) return false;
        }
    }
    return true;
}

}  // namespace

Winding winding_of(const BrepData::Surface& surface) {
    if (is_coherent(surface)) return {};
    const PolygonEdges edges(surface.polygons);
    const std::size_t count = surface.polygons.size();
    std::vector<std::int8_t> sign(count, 0);
    const auto same_way = [&](std::size_t corner, std::uint32_t q) {
        return goes_along(surface.polygons, q, edges.start_node(corner), edges.end_node(corner));
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
