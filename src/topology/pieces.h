// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "model/brep.h"
#include "topology/face_edges.h"

namespace geomend::topology {

/// A part of a surface that hangs together.
struct Piece {
    BrepData::Surface surface;            ///< as the whole, without attributes; adjacency and lines are not filled
    std::vector<std::uint32_t> polygons;  ///< the numbers of its polygons in the whole
};

/// The pieces of a surface that hang together by its adjacency, in the order of their first polygons. Repeats go with the
/// polygon that they repeat, degenerate polygons with one that has most of their nodes; nodes that no polygon uses with the
/// first piece. Cost: linear.
std::vector<Piece> pieces_of(const BrepData::Surface& surface, const FaceEdges& face);

/// Per polygon the number of its piece; gives how many there are, at least 1.
std::uint32_t number_pieces(const BrepData::Surface& surface, const FaceEdges& face, std::vector<std::uint32_t>& piece_of);

}  // namespace geomend::topology
