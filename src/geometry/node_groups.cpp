// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/node_groups.h"

namespace geomend {

NodeGroups::NodeGroups(std::span<const std::uint32_t> groups, std::size_t levels) : groups_(levels) {
    std::span<const std::uint32_t> below = groups;
    for (std::vector<std::uint32_t>& nodes : groups_) {
        nodes.resize((below.size() + 3) / 4);
        for (std::size_t i = 0; i < below.size(); ++i) {
            if (i % 4 == 0) nodes[i / 4] = below[i];
            if (nodes[i / 4] != below[i]) nodes[i / 4] = mixed;
        }
        below = nodes;
    }
}

}  // namespace geomend
