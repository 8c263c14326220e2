// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/bounds.h"
#include "base/length.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "repair/border_pieces.h"
#include "repair/notches.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

/// A closed free border of a patch.
struct Loop {
    std::vector<std::uint32_t> edges;  ///< of FreeBorders, in their order
    std::uint32_t patch = 0;
    double length = 0;
};

/// The free border edges of a patch that begin at a vertex and are in no loop yet.
using Outgoing = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>>;

Outgoing outgoing_of(const TriangleSoup& soup, const FreeBorders& borders) {
    Outgoing from;
    for (std::uint32_t e = 0; e < borders.edges.size(); ++e)
        from[{soup.patches[borders.edges[e].triangle], borders.edges[e].from}].push_back(e);
    return from;
}

/// Whether triangles that fill a loop would face the way that those around it do: else it goes around them.
bool is_around_nothing(const TriangleSoup& soup, const FreeBorders& borders, const std::vector<std::uint32_t>& edges) {
    Vec3 filling{}, around{};
    const Vec3& origin = soup.vertices[borders.edges[edges[0]].from];
    for (const std::uint32_t e : edges) {
        const auto& [a, b, c] = soup.triangles[borders.edges[e].triangle];
        const Vec3 &from = soup.vertices[borders.edges[e].from], &to = soup.vertices[borders.edges[e].to];
        filling = plus(filling, cross(minus(to, origin), minus(from, origin)));
        around = plus(around, cross(minus(soup.vertices[b], soup.vertices[a]), minus(soup.vertices[c], soup.vertices[a])));
    }
    return dot(filling, around) > 0;
}

/// Loops that go through no vertex twice: holes that touch in a point are two. Of loops that touch others, those around nothing.
std::vector<Loop> closed_loops(const TriangleSoup& soup, const FreeBorders& borders) {
    std::vector<Loop> loops;
    Outgoing from = outgoing_of(soup, borders);
    std::vector<std::uint8_t> done(borders.edges.size(), 0);
    const auto take = [&](const std::vector<std::uint32_t>& edges, std::uint32_t patch) {
        const bool touches = std::ranges::any_of(edges, [&](std::uint32_t e) { return borders.edges[e].next == no_index; });
        if (touches && !is_around_nothing(soup, borders, edges)) return;
        Loop loop{edges, patch, 0};
        for (const std::uint32_t e : edges)
            loop.length += length(minus(soup.vertices[borders.edges[e].to], soup.vertices[borders.edges[e].from]));
        loops.push_back(std::move(loop));
    };
    for (std::uint32_t start = 0; start < done.size(); ++start) {
        const std::uint32_t patch = soup.patches[borders.edges[start].triangle];
        std::vector<std::uint32_t> way;
        for (std::uint32_t e = done[start] == 0 ? start : no_index; e != no_index;) {
            done[e] = 1;
            way.push_back(e);
            const std::uint32_t here = borders.edges[e].to;
            const auto again = std::ranges::find(way, here, [&](std::uint32_t k) { return borders.edges[k].from; });
            if (again != way.end()) {
                take({again, way.end()}, patch);
                way.erase(again, way.end());
            }
            const auto& all = from[{patch, here}];
            const auto next = std::ranges::find(all, 0, [&](std::uint32_t k) { return done[k]; });
            e = next == all.end() || (way.empty() && here != borders.edges[start].from) ? no_index : *next;
        }
    }
    return loops;
}

/// Per patch the length of the edges at which it ends on others.
std::vector<double> shared_lengths(const TriangleSoup& soup, const SoupEdges& edges, std::size_t patches) {
    std::vector<double> lengths(patches, 0);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto uses = edges[e];
        if (is_free(uses)) continue;
        for (const auto& use : uses) {
            const auto is_own = [&](const SoupEdges::Use& other) { return soup.patches[other.triangle] == soup.patches[use.triangle]; };
            if (std::ranges::count_if(uses, is_own) == 1)
                lengths[soup.patches[use.triangle]] += length(minus(soup.vertices[use.high], soup.vertices[use.low]));
        }
    }
    return lengths;
}

/// Per patch the size of the box around it.
std::vector<double> patch_sizes(const TriangleSoup& soup, std::size_t patches) {
    std::vector<Bounds> around(patches);
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        for (const std::uint32_t v : soup.triangles[t]) around[soup.patches[t]].add(soup.vertices[v]);
    }
    std::vector<double> sizes;
    for (const Bounds& box : around) sizes.push_back(box.empty() ? 0 : length(minus(box.high, box.low)));
    return sizes;
}

/// A loop is a hole where it is not the longest border of its patch, which may be one that it shares with others; or where it is less
/// than half as wide as its patch, so that the patch goes on around it; or where a single triangle is missing.
std::vector<Loop> holes_of(const TriangleSoup& soup, const SoupEdges& edges, const FreeBorders& borders, std::size_t patches) {
    auto loops = closed_loops(soup, borders);
    std::vector<double> longest = shared_lengths(soup, edges, patches);
    const std::vector<double> sizes = patch_sizes(soup, patches);
    std::vector<std::uint32_t> triangles(patches, 0);
    for (const Loop& loop : loops) longest[loop.patch] = std::max(longest[loop.patch], loop.length);
    for (const std::uint32_t p : soup.patches) ++triangles[p];
    std::erase_if(loops, [&](const Loop& loop) {
        Bounds box;
        for (const std::uint32_t e : loop.edges) box.add(soup.vertices[borders.edges[e].from]);
        const bool is_small = length(minus(box.high, box.low)) < 0.5 * sizes[loop.patch];
        const bool one_missing = loop.edges.size() == 3 && triangles[loop.patch] > 3;
        return loop.length >= longest[loop.patch] && !one_missing && !is_small;
    });
    return loops;
}

std::string filled_text(std::uint64_t holes, const std::vector<Notch>& notches, const SurfaceModel& model, std::uint64_t triangles) {
    if (holes == 0 && notches.empty()) return "no hole was filled";
    std::string text;
    if (holes > 0) text = counted(holes, "hole was filled", "holes were filled");
    if (!notches.empty()) {
        text += (text.empty() ? "" : " and ") + counted(notches.size(), "notch at a border", "notches at borders") + " closed";
        std::set<std::string> names;
        for (const Notch& n : notches) names.insert(model.model.patches[n.patch].name);
        text += " in " + quoted(*names.begin());
        if (names.size() > 1) text += " and " + counted(names.size() - 1, "other surface", "other surfaces");
    }
    return text + " with " + counted(triangles, "triangle", "triangles");
}

}  // namespace

Result<StepOutcome> fill_holes(SurfaceModel& model, const SurfaceStepOptions& options) {
    const TriangleSoup& soup = model.model.soup;
    const auto limits = gap_limits(model, options);
    const SoupEdges edges = edges_of(soup);
    const FreeBorders borders = free_borders(soup, edges);
    TriangleSoup made = soup;
    Origin origin = identity_origin(soup);
    StepOutcome outcome;
    std::uint64_t holes = 0, left = 0;
    const auto add = [&](const std::vector<Triangle>& triangles, std::uint32_t patch, std::uint32_t source) {
        for (const Triangle& t : triangles) {
            made.triangles.push_back(t);
            made.patches.push_back(patch);
            origin.triangles.push_back(source);
            ++outcome.changed;
        }
    };
    for (const Loop& loop : holes_of(soup, edges, borders, model.model.patches.size())) {
        // Half the way around a hole is as wide as it can be.
        if (loop.edges.size() > 3 && loop.length > 2 * limits[loop.patch]) {
            ++left;
            outcome.what.points.push_back(soup.vertices[borders.edges[loop.edges[0]].from]);
            continue;
        }
        std::vector<std::uint32_t> vertices;
        for (const std::uint32_t e : loop.edges) vertices.push_back(borders.edges[e].from);
        std::ranges::reverse(vertices);  // on the other side of its edges
        add(filled_loop(soup, vertices), loop.patch, borders.edges[loop.edges[0]].triangle);
        ++holes;
    }
    const auto notches = notches_of(soup, edges, borders, limits);
    for (const Notch& notch : notches) add(notch.triangles, notch.patch, notch.source);
    outcome.what.message = filled_text(holes, notches, model, outcome.changed);
    if (left > 0)
        outcome.what.message +=
            "; " + counted(left, "hole is", "holes are") + " wider than " + rounded(gap_limit(model, options)) + " and left";
    if (outcome.changed > 0) {
        const auto first = static_cast<std::uint32_t>(soup.triangles.size());
        take_soup(model, std::move(made), origin);
        mark_added(model, first);
    }
    return outcome;
}

}  // namespace geomend::repair
