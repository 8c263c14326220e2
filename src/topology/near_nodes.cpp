// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/near_nodes.h"

#include <algorithm>
#include <utility>

#include "base/bounds.h"
#include "base/length.h"
#include "topology/near_weld.h"

namespace geomend::topology {

namespace {

constexpr double least_share = 1e-7;  // of the size, below which a length is none

/// Per node, whether it is the first of a cluster that lies across a cell: has two of its nodes that are apart.
std::vector<std::uint8_t> clusters_across_cells(const CellMesh& mesh, const std::vector<std::uint32_t>& first, double apart) {
    std::vector<std::uint8_t> across(first.size(), 0);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> nodes;  // by cluster
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        nodes.clear();
        for (const std::uint32_t node : mesh.cell_nodes(c)) nodes.emplace_back(first[node], node);
        std::ranges::sort(nodes);
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
            for (std::size_t j = i + 1; j < nodes.size() && nodes[j].first == nodes[i].first; ++j) {
                if (length(minus(mesh.points[nodes[i].second], mesh.points[nodes[j].second])) > apart) across[nodes[i].first] = 1;
            }
        }
    }
    return across;
}

}  // namespace

std::vector<std::uint32_t> near_nodes(const CellMesh& mesh, double tolerance) {
    auto first = clusters_within(mesh.points, tolerance);
    const Bounds around = bounds_around(mesh.points);
    const double least = around.empty() ? 0 : least_share * length(minus(around.high, around.low));
    if (!(least > 0) || tolerance <= 4 * least) return first;  // the tolerance of the size: it is based on a sphere around the mesh
    const auto across = clusters_across_cells(mesh, first, least);
    if (std::ranges::find(across, 1) == across.end()) return first;
    const auto closer = clusters_within(mesh.points, least);
    for (std::size_t n = 0; n < first.size(); ++n) {
        if (across[first[n]] != 0) first[n] = closer[n];
    }
    return first;
}

}  // namespace geomend::topology
