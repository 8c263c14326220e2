// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/pieces.h"

#include <algorithm>
#include <map>
#include <set>

namespace geomend::topology {

namespace {

/// Puts polygons without neighbours into a piece where they belong: repeats to the polygon that they repeat, degenerate ones to one
/// with most of their nodes.
void place_aside(const BrepData::Surface& surface, const FaceEdges& face, std::vector<std::uint32_t>& piece_of) {
    std::vector<std::uint32_t> aside = face.degenerate;
    aside.insert(aside.end(), face.duplicate.begin(), face.duplicate.end());
    std::ranges::sort(aside);
    std::multimap<std::uint32_t, std::uint32_t> at;  // node, place in aside
    std::vector<std::uint32_t> common(aside.size(), 0);
    for (std::uint32_t k = 0; k < aside.size(); ++k) {
        const auto polygon = surface.polygons[aside[k]];
        for (const std::uint32_t node : std::set<std::uint32_t>(polygon.begin(), polygon.end())) at.emplace(node, k);
    }
    std::map<std::uint32_t, std::uint32_t> here;  // per place in aside the nodes that one polygon has of it
    for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
        if (std::ranges::binary_search(aside, p)) continue;
        here.clear();
        for (const std::uint32_t node : surface.polygons[p]) {
            const auto [first, last] = at.equal_range(node);
            for (auto found = first; found != last; ++found) ++here[found->second];
        }
        for (const auto& [k, nodes] : here) {
            if (nodes <= common[k]) continue;
            common[k] = nodes;
            piece_of[aside[k]] = piece_of[p];
        }
    }
}

}  // namespace

std::uint32_t number_pieces(const BrepData::Surface& surface, const FaceEdges& face, std::vector<std::uint32_t>& piece_of) {
    const std::size_t count = surface.polygons.size();
    piece_of.assign(count, no_index);
    for (const std::uint32_t p : face.degenerate) piece_of[p] = 0;
    for (const std::uint32_t p : face.duplicate) piece_of[p] = 0;  // until all others are numbered
    std::uint32_t pieces = 0;
    std::vector<std::uint32_t> stack;
    for (std::uint32_t start = 0; start < count; ++start) {
        if (piece_of[start] != no_index) continue;
        piece_of[start] = pieces;
        stack.push_back(start);
        while (!stack.empty()) {
            const std::uint32_t p = stack.back();
            stack.pop_back();
            for (std::size_t c = surface.polygons.first_corner(p); c < surface.polygons.first_corner(p + 1); ++c) {
                const std::uint32_t q = surface.neighbours[c];
                if (q == no_index || piece_of[q] != no_index) continue;
                piece_of[q] = pieces;
                stack.push_back(q);
            }
        }
        ++pieces;
    }
    if (pieces > 1 && face.degenerate.size() + face.duplicate.size() > 0) place_aside(surface, face, piece_of);
    return std::max(pieces, 1u);
}

std::vector<Piece> pieces_of(const BrepData::Surface& surface, const FaceEdges& face) {
    std::vector<std::uint32_t> piece_of;
    std::vector<Piece> pieces(number_pieces(surface, face, piece_of));
    std::vector<std::uint32_t> node_here(surface.nodes.size(), no_index), owner(surface.nodes.size(), no_index);
    for (std::uint32_t k = 0; k < pieces.size(); ++k) {
        pieces[k].surface.name = surface.name;
        pieces[k].surface.role = surface.role;
        pieces[k].surface.role_text = surface.role_text;
        pieces[k].surface.source_object = surface.source_object;
        pieces[k].surface.source_part = surface.source_part;
    }
    for (std::uint32_t p = 0; p < piece_of.size(); ++p) pieces[piece_of[p]].polygons.push_back(p);
    std::vector<std::uint32_t> polygon;
    for (std::uint32_t k = 0; k < pieces.size(); ++k) {
        auto& made = pieces[k].surface;
        for (const std::uint32_t p : pieces[k].polygons) {
            polygon.clear();
            for (const std::uint32_t node : surface.polygons[p]) {
                if (owner[node] != k) {
                    owner[node] = k;
                    node_here[node] = static_cast<std::uint32_t>(made.nodes.size());
                    made.nodes.push_back(surface.nodes[node]);
                }
                polygon.push_back(node_here[node]);
            }
            made.polygons.push_back(polygon);
        }
    }
    for (std::size_t node = 0; node < owner.size(); ++node) {
        if (owner[node] == no_index) pieces[0].surface.nodes.push_back(surface.nodes[node]);  // no polygon uses it
    }
    return pieces;
}

}  // namespace geomend::topology
