// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "repair/surface_model.h"

namespace geomend::repair {

/// What steps did to a model, place by place: for those who draw it. Positions are elevation-up.
struct ModelChanges {
    /// A point of the result that is not where it was: a vertex that was read, or one that a cut made in what moved.
    struct Moved {
        std::uint32_t surface = 0;  ///< of `surfaces`: points on a contact may have moved in one surface only
        Vec3 at{};
        double by = 0;  ///< from where it was in that surface; above 0
    };
    std::vector<std::string> surfaces;  ///< names of interfaces of the result; an empty one: any that is not named
    std::vector<Moved> moved;
    std::vector<std::array<Vec3, 3>> added;  ///< triangles of the result that steps made: strips, fillings, a box, what an edit added

    /// An edge at which surfaces of the result meet, and did not when they were read.
    struct Line {
        Vec3 from{}, to{};
        bool joined = false;  ///< borders that lay along each other; else something was cut
    };
    std::vector<Line> lines;

    /// What was left out, in pieces.
    struct Removed {
        std::string surface;
        RemovedPiece piece;
    };
    std::vector<Removed> removed;
    std::vector<std::array<Vec3, 2>> erased_edges;  ///< of what was read: traces of lines

    // Of the vertices that were read and are still there, each surface with its own.
    std::uint64_t vertices = 0, moved_vertices = 0;
    double largest = 0, mean = 0;  ///< of those that moved
};

/// What became of a model. \param new_objects of the Dataset: what an edit brought in, ascending. Cost: n log n.
ModelChanges changes_of(const SurfaceModel& model, std::span<const std::uint32_t> new_objects);

}  // namespace geomend::repair
