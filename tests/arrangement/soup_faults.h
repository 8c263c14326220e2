// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>

#include "model/triangle_soup.h"

namespace geomend::test {

/// What can be wrong with the cut of a soup, the worst first.
enum class SoupFault : std::uint8_t {
    none,
    crashed,         ///< the process that cut it died
    slow,            ///< not done in the time given
    refused,         ///< an error instead of a cut
    not_clean,       ///< the cut gave up
    crossing_pairs,  ///< two triangles of the result meet in more than what they share
    near_points,     ///< two points of the result are nearer than the tolerance
    bad_origin,      ///< what it says its pieces come from is not sound
    lost_area,       ///< pieces of a triangle do not add up to it, by more than the tolerance along its border may do
    changed_again    ///< a second cut changes something
};
std::string to_string(SoupFault fault);
/// \return the fault of that name; `none` where it is no name
SoupFault fault_named(const std::string& name);

/// Cuts a soup and judges the result from outside: pairs by exact fractions.
SoupFault fault_of(const TriangleSoup& soup, double tolerance);

/// The same in a process of its own, so that a crash or a hang is a verdict, too.
/// \param seconds of processor time
SoupFault fault_in_child(const TriangleSoup& soup, double tolerance, unsigned seconds);

}  // namespace geomend::test
