// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/horizon_checks.h"

#include <algorithm>

#include "base/place_words.h"
#include "base/wording.h"

namespace geomend::gridding {

namespace {

Finding repeated(const Horizon& horizon, const Net& net, const SplitPillars& split, const NodeDepths& depths) {
    Point low{1e300, 1e300}, high{-1e300, -1e300};
    for (const std::uint32_t n : depths.repeated) {
        const Point p = net.at(split.pillar_of[n], depths.depths[n]);
        for (std::size_t a = 0; a < 2; ++a) {
            low[a] = std::min(low[a], p[a]);
            high[a] = std::max(high[a], p[a]);
        }
    }
    const std::uint32_t first = depths.repeated.front();
    const Point at = net.at(split.pillar_of[first], depths.depths[first]);
    Finding f =
        make_finding("F027",
                     "horizon " + quoted(horizon.name) + " is met more than once by " +
                         counted(depths.repeated.size(), "pillar", "pillars") + ", first at x " + coordinate(at[0]) + ", y " +
                         coordinate(at[1]) + ", depth " + coordinate(depths.depths[first]) + "; they lie within x " + coordinate(low[0]) +
                         " .. " + coordinate(high[0]) + ", y " + coordinate(low[1]) + " .. " + coordinate(high[1]),
                     {}, depths.repeated.size());
    f.entities.push_back({"horizon", horizon.name});
    return f;
}

}  // namespace

Result<void> refuse_repeated(const Structure& structure, const Net& net, const SplitPillars& split, std::span<const NodeDepths> depths,
                             bool allowed) {
    if (allowed) return {};
    std::vector<Finding> found;
    for (std::size_t h = 0; h < depths.size(); ++h) {
        if (!depths[h].repeated.empty()) found.push_back(repeated(structure.horizons[h], net, split, depths[h]));
    }
    if (found.empty()) return {};
    Failure why =
        failure(FailureKind::cannot_hold, "F027", {},
                "a corner-point grid holds each horizon once on every pillar: beds that are overturned or repeated must be left out");
    why.also = std::move(found);
    return why;
}

}  // namespace geomend::gridding
