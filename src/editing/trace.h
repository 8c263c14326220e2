// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "editing/ring_fill.h"
#include "editing/soup_mesh.h"

namespace geomend::editing {

struct TraceRules {
    RingRules rings;
    bool lines = true;          ///< also vertices through which a line runs straight
    bool free_borders = false;  ///< also where all that ends at the line is of one surface: a free border, or lips that stay
    std::span<const std::uint32_t> surfaces{};  ///< per patch the surface that it is of; empty: each is one by itself
};

/// Why a vertex stays, or that it is gone.
enum class Erasure : std::uint8_t {
    erased,
    needed,    ///< lines end, part or bend at it, or something is embedded there
    border,    ///< a border of one surface runs through it (Euler's clause: it may be shared with others)
    not_flat,  ///< no triangles fill its ring within the rules
};

/// Takes a vertex away from all surfaces through it, where it is inside of one, or where one line runs straight through it: each
/// surface that ends at the line is filled by itself. Nothing else moves. \param on_trace per vertex of the mesh 1 where it is to be taken
/// away
Erasure erase_vertex(SoupMesh& mesh, std::uint32_t v, const TraceRules& rules, std::span<const std::uint8_t> on_trace);

struct ErasedTrace {
    std::uint64_t erased = 0, small_rings = 0;  ///< small: at most four triangles around it, each side of a line
    std::uint64_t needed = 0, border = 0, not_flat = 0;
};

/// Takes vertices away in Euler's reducing order (thesis, 2.3.4): those with at most four triangles around them first, since
/// each such step takes a triangle from its neighbours on the trace; only where there is none a larger ring is filled. What cannot be
/// taken away is tried again where something around it changed.
/// \param trace ascending vertices. Cost: n log n in them.
ErasedTrace erase_trace(SoupMesh& mesh, std::span<const std::uint32_t> trace, const TraceRules& rules);

}  // namespace geomend::editing
