// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"
#include "model/origin.h"
#include "model/triangle_soup.h"

namespace geomend::arrangement {

struct ArrangeOptions {
    double tolerance = 0;       ///< above 0: what is nearer to each other than this becomes one point; in the unit of the coordinates
    double reach = 1.0 / 32;    ///< share of the tolerance within which a vertex becomes a part of an edge or a face; below 1
    unsigned most_rounds = 12;  ///< before what has not settled is cut anew, as sheets or shaken
    bool sheets = true;         ///< false: what has not settled then stays as it is
    const Monitor* monitor = nullptr;
};

/// A soup of which no two triangles have more in common than vertices and edges that they share by number.
struct Arrangement {
    TriangleSoup soup;
    Origin origin;                       ///< of its triangles and vertices, in the soup that was cut
    std::uint64_t cut = 0;               ///< triangles that were cut or bent
    std::uint64_t made = 0;              ///< vertices that none of the soup was
    std::uint64_t merged = 0;            ///< vertices that became another one that is nearer than the tolerance
    std::uint64_t collapsed = 0;         ///< triangles that have no area left: thinner than the tolerance
    std::uint64_t doubled = 0;           ///< triangles left out since their patch has the same already
    double largest_move = 0;             ///< of a vertex of the soup
    std::uint64_t laid = 0;              ///< triangles that were put into the plane of others, since they could not be cut otherwise
    std::vector<std::uint32_t> becomes;  ///< per vertex of the soup the one that it is now, or is a part of; no_index: nothing uses it
    unsigned rounds = 0;
    bool clean = true;  ///< false: after the last round something still crosses, or the work was stopped
};

/// Cuts all triangles of a soup along everything that they have in common: crossings, contacts, overlaps, with others or within
/// a patch. Vertices nearer than the tolerance become one (the first keeps its place); vertices within its `reach`
/// of an edge or a face become a part of it, which then bends that much; edges that pierce faces get a vertex there. All positions
/// lie on a grid of powers of two, some 500 times finer than the tolerance, apart from vertices that were there before and keep
/// their own to the bit. The result is looked through again until nothing is found, so that nothing crosses in doubles, and cutting
/// again changes nothing. What is still found after some rounds is looked at ever more coarsely: there, and only there, new points keep
/// up to 32 tolerances from others. Where that does not end, planes next to parallel above all, the soup is cut anew, and triangles that
/// had not settled and lie upon each other within a width are put into one plane and cut there as one sheet: the width grows from half a
/// tolerance to 32 until the cut is clean, and `largest_move` says how far vertices went. What does not end then either is shaken, by up to
/// a tolerance along each axis, a few times. Where even that does not suffice `clean` says so. Triangles of several patches that lie on
/// each other stay, one for each patch, over the same vertices. Same input, same bytes, whatever the number of threads. After N. Euler's
/// "découpage franc" (thesis, 3.1), by features within a tolerance instead of exact points. Fails (unusable) where positions are not finite
/// or the tolerance is not above 0. Cost: near-linear in triangles and cuts.
Result<Arrangement> arrange(const TriangleSoup& soup, const ArrangeOptions& options);

}  // namespace geomend::arrangement
