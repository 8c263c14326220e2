// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/scene.h"

namespace geomend {

/// A piece of what was read that a step of a repair left out.
struct ReportedRemoval {
    std::string step;
    std::string word;                 ///< why, in a word: tail, outside, overlap, ...
    std::string why;                  ///< and in a sentence, without a full stop
    ScenePart part;                   ///< named after its surface
    std::vector<std::string> debris;  ///< files that it was written to; empty where none were
};

/// What a repair did to a model, for the page that shows it before and after. What moved and what was added is told by the parts
/// of the scene of the result.
struct ReportedChanges {
    Scene before;                                          ///< as read, with what was left out as parts of their own
    std::uint64_t errors_before = 0, warnings_before = 0;  ///< found in what was read
    std::uint64_t vertices = 0, moved = 0;                 ///< that were read and are still there; of them those that moved
    double largest = 0, mean = 0;                          ///< how far those moved
    std::uint64_t added = 0;                               ///< triangles
    std::uint64_t cut_edges = 0, joined_edges = 0;         ///< where surfaces meet that did not
    std::vector<ReportedRemoval> removed;
};

}  // namespace geomend
