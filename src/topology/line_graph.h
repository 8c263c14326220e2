// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/brep.h"
#include "topology/face_edges.h"

namespace geomend::topology {

/// What a file states about lines and corners, over model vertices.
struct StatedLines {
    /// Edge of a stated line (one-dimensional entity); `line` tells which.
    struct Edge {
        std::uint32_t from, to, line;
    };
    std::vector<Edge> edges;
    std::vector<std::uint32_t> corners;       ///< always corners
    std::vector<std::uint32_t> corner_hints;  ///< where a closed line may have its corner
    /// All surfaces use one set of nodes, so that none can state a cut, or they are loose: where a line runs inside one it is cut.
    bool shared_nodes = false;
};

/// One use of a model edge by a surface, or by a stated line.
struct EdgeUse {
    std::uint32_t low, high;  ///< model vertices
    std::uint32_t surface;    ///< or no_index for a stated line
    std::uint32_t corner;     ///< where the surface's edge starts; the number of the stated line
    std::int8_t direction;    ///< +1 from low to high
    enum Kind : std::uint8_t { border, inside, stated } kind;
};

/// The uses of all edges on lines, and which line each edge belongs to.
struct LineGraph {
    std::vector<EdgeUse> uses;  ///< grouped by edge; edges ascend
    struct Edge {
        std::uint32_t first_use, last_use;  ///< into uses
        std::uint32_t line;
        std::int8_t direction;  ///< +1 where the line runs from the edge's low to its high vertex
    };
    std::vector<Edge> edges;
    std::vector<std::uint32_t> line_first_edge;  ///< per line: into line_edges
    std::vector<std::uint32_t> line_edges;       ///< edges of each line, in no special order
    std::vector<std::uint32_t> stated_line;      ///< per line: the stated line it is a part of, or no_index

    /// Net number of times that a surface's own sense of rotation runs along a line.
    struct Net {
        std::uint32_t line;
        std::int64_t net;
    };
    std::vector<std::vector<Net>> nets;  ///< per surface, lines ascend

    std::span<const EdgeUse> edge_uses(const Edge& e) const { return std::span(uses).subspan(e.first_use, e.last_use - e.first_use); }
};

/// Fills brep.lines, brep.corners and the lines of every surface, and cuts the surfaces' adjacency along lines.
/// The rules are in README.md. Corners ascend by vertex, lines by their lowest edge; a line starts at its lower
/// end. Cost: near-linear in nodes plus n log n in edges near lines.
LineGraph build_lines(BrepData& brep, std::span<const FaceEdges> faces, const StatedLines& stated);

}  // namespace geomend::topology
