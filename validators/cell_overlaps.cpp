// SPDX-License-Identifier: AGPL-3.0-or-later
// Cells that lie in each other. Going from any place that two cells share outwards one comes to the outer face of one of them while
// still inside another: so it is enough to look around the cells that have an outer face, or a face that is not simply between two.
#include <algorithm>
#include <atomic>

#include "base/parallel.h"
#include "base/wording.h"
#include "geometry/box_tree.h"
#include "validators/cell_checks.h"
#include "validators/cell_hulls.h"

namespace geomend::validators {

namespace {

/// Cells on more others than that are not compared with all of them.
constexpr std::size_t most_partners = 256;

/// Whether two faces with the same nodes run around them in opposite senses, as those of cells on both sides do.
bool are_opposite(const CellScope& scope, const VolumeFace& a, const VolumeFace& b) {
    const auto first = scope.nodes_of(a), second = scope.nodes_of(b);
    const std::size_t n = first.size();
    const auto at = [&](std::span<const std::uint32_t> nodes, std::size_t i) { return scope.vertex_of()[nodes[i % n]]; };
    for (std::size_t i = 0; i < n; ++i) {
        if (at(second, i) == at(first, 0)) return at(second, i + n - 1) == at(first, 1);
    }
    return false;
}

/// Per face the cell on its other side, where there is just one and it winds the face the other way; else no_index.
std::vector<std::uint32_t> cells_across(const CellScope& scope) {
    std::vector<std::uint32_t> across(scope.faces().size(), no_index);
    const auto groups = scope.group_first();
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
        if (groups[g + 1] - groups[g] != 2) continue;
        const std::uint32_t f = scope.grouped()[groups[g]], h = scope.grouped()[groups[g] + 1];
        const VolumeFace &a = scope.faces()[f], &b = scope.faces()[h];
        const auto is_free = [&](std::uint32_t cell) { return scope.mesh().types[cell] == CellType::polyhedron; };
        if (!is_free(a.cell) && !is_free(b.cell) && !are_opposite(scope, a, b)) continue;
        across[f] = b.cell;
        across[h] = a.cell;
    }
    return across;
}

bool have_same_nodes(const CellScope& scope, std::uint32_t a, std::uint32_t b) {
    const auto sorted = [&](std::uint32_t cell) {
        std::vector<std::uint32_t> nodes;
        for (const std::uint32_t node : scope.mesh().cell_nodes(cell)) nodes.push_back(scope.vertex_of()[node]);
        std::ranges::sort(nodes);
        return nodes;
    };
    return scope.mesh().cell_nodes(a).size() == scope.mesh().cell_nodes(b).size() && sorted(a) == sorted(b);
}

}  // namespace

void check_cell_overlaps(const CellScope& scope, std::vector<Finding>& findings) {
    const auto cells = scope.volume_cells();
    if (cells.size() < 2) return;
    const auto across = cells_across(scope);
    std::vector<std::uint32_t> first_face;
    std::vector<std::uint8_t> asks(cells.size(), 0);
    for (std::size_t i = 0, f = 0; i < cells.size(); ++i) {
        first_face.push_back(static_cast<std::uint32_t>(f));
        for (; f < across.size() && scope.faces()[f].cell == cells[i]; ++f) {
            if (across[f] == no_index) asks[i] = 1;
        }
    }
    first_face.push_back(static_cast<std::uint32_t>(across.size()));
    std::vector<std::uint32_t> asking;
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
        if (asks[i] != 0) asking.push_back(i);
    }
    const CellHulls hulls(scope);
    const auto boxes = hulls.boxes();
    const BoxTree tree(boxes);
    const double tolerance = scope.lengths().tolerance;
    std::vector<std::atomic<std::uint8_t>> wrong(cells.size());
    std::atomic<std::uint64_t> pairs = 0;
    parallel_blocks(asking.size(), 256, [&](std::size_t first, std::size_t last) {
        CellHulls::Scratch scratch;
        for (std::size_t k = first; k < last && !scope.stopped(); ++k) {
            const std::uint32_t i = asking[k];
            const auto neighbours = std::span(across).subspan(first_face[i], first_face[i + 1] - first_face[i]);
            std::size_t partners = 0;
            tree.visit(boxes[i], tolerance, [&](std::uint32_t j) {
                if (j == i || (asks[j] != 0 && j < i) || partners >= most_partners) return;
                if (std::ranges::find(neighbours, cells[j]) != neighbours.end()) return;
                if (!hulls.overlap(i, j, tolerance, scratch) || have_same_nodes(scope, cells[i], cells[j])) return;
                ++partners;
                wrong[i].store(1, std::memory_order_relaxed);
                wrong[j].store(1, std::memory_order_relaxed);
            });
            pairs += partners;
        }
    });
    std::vector<std::uint32_t> listed;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (wrong[i].load(std::memory_order_relaxed) != 0) listed.push_back(cells[i]);
    }
    if (listed.empty()) return;
    Finding finding = cells_of_mesh_finding(
        scope, "M29", counted(listed.size(), "cell", "cells") + in_mesh(scope) + (listed.size() == 1 ? " lies" : " lie") + " in others",
        listed);
    finding.measures = {{"pairs_of_cells", static_cast<double>(pairs.load())}};
    findings.push_back(std::move(finding));
}

}  // namespace geomend::validators
