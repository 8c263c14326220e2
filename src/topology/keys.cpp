// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/keys.h"

namespace geomend::topology {

KeyMatch match_key(const BrepData::Surface& surface, const std::array<std::uint32_t, 3>& wanted) {
    for (const std::uint32_t vertex : wanted) {
        if (vertex == no_index) return KeyMatch::absent;
    }
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto polygon = surface.polygons[p];
        const std::size_t n = polygon.size();
        for (std::size_t i = 0; i < n; ++i) {
            if (surface.nodes[polygon[i]].value != wanted[0]) continue;
            // Three corners of a larger polygon may serve as a key, too.
            std::size_t second = n, third = n;
            for (std::size_t k = 1; k < n; ++k) {
                const std::uint32_t v = surface.nodes[polygon[(i + k) % n]].value;
                if (v == wanted[1]) second = k;
                if (v == wanted[2]) third = k;
            }
            if (second < n && third < n) return second < third ? KeyMatch::same : KeyMatch::reversed;
        }
    }
    return KeyMatch::absent;
}

}  // namespace geomend::topology
