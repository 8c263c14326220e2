// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "repair/border_pieces.h"
#include "repair/gap_search.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

/// What is to be done with a piece of a free border.
enum class GapDecision : std::uint8_t { left, closed, trimmed };
const char* to_string(GapDecision decision);

/// A piece of a free border and the surface that it should end on.
struct Contact {
    std::uint32_t piece = 0;           ///< of FreeBorders
    std::uint32_t patch = no_index;    ///< that the border belongs to
    std::uint32_t on = no_index;       ///< patch that most of the piece would meet; no_index: none
    double mean_gap = 0, max_gap = 0;  ///< along the surface, over the edges that meet something
    GapDecision decision = GapDecision::left;
    bool in_part = false;  ///< closed: only its edges that stop short of `on` are; the others end on it or stick through
    std::string why;
};

/// What the user decided about the borders of a patch.
struct PatchWish {
    std::uint32_t patch, on = no_index;  ///< on: no_index for any
    bool close = true;
};

/// Decides for each piece of the free borders, by votes of its edges weighted by length: closed where at least 60 % of it has a surface
/// ahead, and more of it has one ahead than sticks through one within the same limit (trimmed, once all is cut). A piece that
/// goes over from one side of a surface to the other, at least 60 % of it near that surface, is closed where it stops short.
/// \param wishes come before votes
/// \param hits per edge gets what lies ahead of its middle
std::vector<Contact> decide_contacts(const TriangleSoup& soup, const FreeBorders& borders, const GapSearch& search, double tolerance,
                                     std::span<const PatchWish> wishes, std::vector<GapHit>& hits);

/// The user's decisions by patch; names are of patches or of interfaces.
/// Failure (usage) where a name is of no surface, with where the recipe has it and the nearest one.
Result<std::vector<PatchWish>> patch_wishes(const SurfaceModel& model, std::span<const ContactWish> wishes);

}  // namespace geomend::repair
