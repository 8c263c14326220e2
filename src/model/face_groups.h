// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "model/each_face.h"

namespace geomend {

/// A face of a cell, known by its three lowest corners and their number.
struct KnownFace {
    std::array<std::uint32_t, 3> lowest;
    std::uint32_t corners;
    CellFaceRef face;

    bool is_like(const KnownFace& other) const { return lowest == other.lowest && corners == other.corners; }
};

/// Calls visit(span<const KnownFace>) for each group of faces of cells that have the same three lowest corners and as many of them:
/// in a mesh these are the one or two cells at a face. Groups ascend by their corners, faces in them by their cells.
/// \param number_of the number of a vertex by which corners are compared: the vertex itself, or its place where several share one
/// \param numbers all numbers are less
/// Cost: linear (faces are put aside by their lowest corner first); memory: 24 bytes a face.
template <class NumberOf, class Visit>
void each_face_group(const VolumeMeshData& mesh, std::size_t numbers, const NumberOf& number_of, const Visit& visit) {
    const auto known = [&](const CellFaceRef& face, std::vector<std::uint32_t>& nodes) {
        for (std::uint32_t& node : nodes) node = number_of(node);
        std::partial_sort(nodes.begin(), nodes.begin() + 3, nodes.end());
        return KnownFace{{nodes[0], nodes[1], nodes[2]}, static_cast<std::uint32_t>(nodes.size()), face};
    };
    std::vector<std::size_t> start(numbers + 1, 0);
    for (const VolumeMeshData::Block& block : mesh.blocks) {
        each_face(mesh, block, [&](const CellFaceRef&, const std::vector<std::uint32_t>& nodes) {
            std::uint32_t lowest = number_of(nodes[0]);
            for (const std::uint32_t node : nodes) lowest = std::min(lowest, number_of(node));
            ++start[lowest + 1];
        });
    }
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    std::vector<KnownFace> faces(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (const VolumeMeshData::Block& block : mesh.blocks) {
        each_face(mesh, block, [&](const CellFaceRef& face, std::vector<std::uint32_t>& nodes) {
            const KnownFace one = known(face, nodes);
            faces[next[one.lowest[0]]++] = one;
        });
    }
    for (std::size_t i = 0; i < numbers; ++i) {
        const auto first = faces.begin() + static_cast<std::ptrdiff_t>(start[i]),
                   last = faces.begin() + static_cast<std::ptrdiff_t>(start[i + 1]);
        std::sort(first, last, [](const KnownFace& a, const KnownFace& b) {
            return std::tie(a.lowest, a.corners, a.face) < std::tie(b.lowest, b.corners, b.face);
        });
        for (auto group = first; group != last;) {
            const auto end = std::find_if(group, last, [&](const KnownFace& f) { return !f.is_like(*group); });
            visit(std::span<const KnownFace>(group, end));
            group = end;
        }
    }
}

/// The same by vertices.
template <class Visit>
void each_face_group(const VolumeMeshData& mesh, const Visit& visit) {
    each_face_group(
        mesh, mesh.vertices.size(), [](std::uint32_t vertex) { return vertex; }, visit);
}

}  // namespace geomend
