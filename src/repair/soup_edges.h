// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/triangle_soup.h"

namespace geomend::repair {

/// The edges of a soup and the triangles that use them, whatever their patches.
struct SoupEdges {
    struct Use {
        std::uint32_t low, high;  ///< vertices
        std::uint32_t triangle;
        std::uint8_t corner;  ///< 0..2: the edge runs from this corner of the triangle to the next one
    };
    std::vector<Use> uses;             ///< by edge, then by triangle
    std::vector<std::uint32_t> first;  ///< per edge its first use, and the end

    std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
    std::span<const Use> operator[](std::size_t e) const { return std::span(uses).subspan(first[e], first[e + 1] - first[e]); }
};

/// \param keep per triangle whether it is looked at; empty: all. Triangles that name a vertex twice are left out. n log n.
SoupEdges edges_of(const TriangleSoup& soup, std::span<const std::uint8_t> keep = {});

/// Pieces of patches between lines: triangles of a patch that hang together over edges that no other triangle uses.
struct PatchPieces {
    std::vector<std::uint32_t> of;     ///< per triangle its piece; no_index where it is not looked at
    std::vector<std::uint32_t> patch;  ///< per piece
    std::size_t count() const { return patch.size(); }
};
/// Pieces are numbered by their first triangles. Near-linear.
PatchPieces pieces_between_lines(const TriangleSoup& soup, const SoupEdges& edges);

/// Whether nothing else ends at an edge: one triangle uses it.
inline bool is_free(std::span<const SoupEdges::Use> uses) { return uses.size() == 1; }
/// Whether an edge lies inside a piece.
bool is_inner(const TriangleSoup& soup, std::span<const SoupEdges::Use> uses);

}  // namespace geomend::repair
