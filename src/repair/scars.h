// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "repair/surface_steps.h"

namespace geomend::repair {

/// When the traces of lines are taken away.
struct ScarRules {
    double angle = 45;    ///< degrees: two lips that bend by more are not stitched; for n lips at one edge 2 angle / n
    double distance = 0;  ///< no surface moves by more
    double flatness = 0;  ///< no new triangle is lower
};

/// What was done, and what was left and why.
struct ScarCounts {
    std::uint64_t lips = 0;      ///< edges at which two lips of a surface were stitched
    std::uint64_t bent = 0;      ///< edges of one surface that were left, since the lips bend by more than the angle
    std::uint64_t joined = 0;    ///< patches that became a part of another one
    std::uint64_t restored = 0;  ///< triangles that are again as they were read
    std::uint64_t erased = 0;    ///< vertices that are gone
    std::uint64_t needed = 0;    ///< of traces that stay: lines end, part or bend there
    std::uint64_t border = 0;    ///< ... a free border runs through them
    std::uint64_t not_flat = 0;  ///< ... the surface would move by more than the distance
    std::uint64_t changes() const { return lips + restored + erased; }
};

/// Stitches the lips of each surface: where all that ends at an edge is of one surface (one interface), and two of its
/// triangles there go on into each other, their patches become one, under the lower number. After N. Euler's association and suture
/// (thesis, 2.3.2-3); vertices are shared by number already. \param only edges, as vertices, the lower one first, ascending, of which alone
/// that is asked; nullptr: all \return the vertices of such edges, ascending. Cost: n log n.
std::vector<std::uint32_t> stitch_lips(SurfaceModel& model, const ScarRules& rules, ScarCounts& counts,
                                       const std::vector<std::array<std::uint32_t, 2>>* only = nullptr);

/// Gives triangles back that were cut in this run, as they were read, where nothing needs the cut any more: their corners are where
/// they were, all of their pieces are there, and all that stands on them or their edges is used by such triangles only.
/// \param trace vertices, which get the numbers that they have afterwards; those that are gone are left out. Cost: near-linear.
void restore_by_origin(SurfaceModel& model, std::vector<std::uint32_t>& trace, ScarCounts& counts);

/// Takes away the vertices of a trace that nothing needs, and fills their rings. \param trace ascending vertices, on lines, too
/// \param made also vertices that were made in this run, inside of surfaces
/// \return per vertex before the number that it has now, no_index where it is gone. Cost: n log n.
std::vector<std::uint32_t> erase_scars(SurfaceModel& model, std::span<const std::uint32_t> trace, bool made, const ScarRules& rules,
                                       ScarCounts& counts);

/// The rules of a run: nothing moves by more than the tolerance.
ScarRules scar_rules(const SurfaceModel& model, const SurfaceStepOptions& options);
/// What was done and left, for people. \param distance of the rules
std::string scars_text(const ScarCounts& counts, double distance);

/// The patch that the triangles of a patch belong to now; no_index: it was removed, as it was asked for.
std::uint32_t successor_of(const SurfaceModel& model, std::uint32_t patch);

}  // namespace geomend::repair
