// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "arrangement/near_features.h"
#include "arrangement/spaced_points.h"
#include "base/monitor.h"
#include "geometry/triangle_pair.h"

namespace geomend::arrangement {

/// Triangles over points of the grid while they are being cut.
struct CutState {
    SpacedPoints points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> source;                ///< per triangle the one of the soup that it is a piece of
    std::vector<std::uint8_t> is_new;                 ///< per triangle: made since it was last looked at
    std::span<const std::uint32_t> patches;           ///< per triangle of the soup
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< embedded edges
    std::vector<std::uint32_t> edge_source;           ///< per edge the one of the soup that it is a piece of
    struct Layer {
        std::uint32_t source;  ///< triangle of the soup
        bool turned;           ///< it faces the other way
    };
    struct Stack {
        std::vector<Layer> layers;  ///< ascending
        Vec3 normal;                ///< that its pieces turn around counter-clockwise
    };
    std::vector<Stack> stacks;  ///< triangles that lie upon each other and are cut as one: a source from the soup's number on
    double reach = 0;           ///< nearer features are one; less than the distance that points keep
    unsigned rounds = 0;        ///< done so far
    std::size_t most_points = std::numeric_limits<std::size_t>::max();  ///< that a round may find; where it finds more it cuts nothing
    std::size_t found_points = 0;                                       ///< by the last round; more than may be: it cut nothing
    std::uint64_t laid = 0;                                             ///< triangles of the soup in stacks
    std::uint64_t doubled = 0;                                          ///< triangles left out since their patch had the same already
    std::uint64_t merged = 0;                                           ///< points that gave way to others after they were made
    std::vector<std::array<std::uint32_t, 2>> gave_way{};               ///< those points, and the one that each became then
};

/// Whether pieces of two sources that have the same corners are one.
inline bool are_of_one_patch(const CutState& state, std::uint32_t source, std::uint32_t other) {
    if (source >= state.patches.size() || other >= state.patches.size()) return source == other;
    return state.patches[source] == state.patches[other];
}

/// Lets the points of triangles and edges become others; what has no area or length any more is left out, what changed is new.
void rename_points(CutState& state, const std::vector<std::uint32_t>& becomes);

/// Looks for what triangles have in common and cuts them there, once. True where nothing was found, so that nothing changed. False, and
/// nothing changed, where more was found than may be.
/// Cost: near-linear; the number of rounds is 2 to 4 for most models.
bool cut_round(CutState& state, const Monitor* monitor);

/// Cuts triangles at what was found, once. False where that is nothing.
bool cut_at(CutState& state, const NearFeatures& found);

}  // namespace geomend::arrangement
