// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "base/wording.h"
#include "repair/border_pieces.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

/// A closed free border of a patch.
struct Loop {
    std::vector<std::uint32_t> edges;  ///< of FreeBorders, in their order
    std::uint32_t patch = 0;
    double length = 0;
};

double edge_length(const TriangleSoup& soup, const BorderEdge& e) {
    const Vec3 along = minus(soup.vertices[e.to], soup.vertices[e.from]);
    return std::sqrt(dot(along, along));
}

std::vector<Loop> closed_loops(const TriangleSoup& soup, const FreeBorders& borders) {
    std::vector<Loop> loops;
    std::vector<std::uint8_t> done(borders.edges.size(), 0);
    for (std::uint32_t start = 0; start < done.size(); ++start) {
        if (done[start] != 0) continue;
        Loop loop{{}, soup.patches[borders.edges[start].triangle], 0};
        std::uint32_t e = start;
        for (; e != no_index && done[e] == 0; e = borders.edges[e].next) {
            done[e] = 1;
            loop.edges.push_back(e);
            loop.length += edge_length(soup, borders.edges[e]);
        }
        if (e == start) loops.push_back(std::move(loop));
    }
    return loops;
}

/// Signed area of a corner of a loop seen along a normal.
double turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) { return dot(cross(minus(b, a), minus(c, b)), normal); }

/// Triangles over a closed loop, wound as it runs: ears are cut off where the loop turns the right way, the sharpest first.
std::vector<Triangle> filled(const TriangleSoup& soup, std::vector<std::uint32_t> loop) {
    Vec3 normal{};
    const Vec3 base = soup.vertices[loop[0]];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        normal = plus(normal, cross(minus(soup.vertices[loop[i]], base), minus(soup.vertices[loop[i + 1]], base)));
    }
    std::vector<Triangle> triangles;
    while (loop.size() > 3) {
        std::size_t best = 0;
        double least = INFINITY;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3 &a = soup.vertices[loop[(i + loop.size() - 1) % loop.size()]], &b = soup.vertices[loop[i]],
                       &c = soup.vertices[loop[(i + 1) % loop.size()]];
            const Vec3 across = minus(c, a);
            const double cost = turn(a, b, c, normal) > 0 ? dot(across, across) : 1e30 + dot(across, across);
            if (cost >= least) continue;
            least = cost;
            best = i;
        }
        triangles.push_back({loop[(best + loop.size() - 1) % loop.size()], loop[best], loop[(best + 1) % loop.size()]});
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(best));
    }
    triangles.push_back({loop[0], loop[1], loop[2]});
    return triangles;
}

/// A loop is a hole where it is not the longest of its patch, or where its patch is closed without it: a single triangle is missing.
std::vector<Loop> holes_of(const TriangleSoup& soup, const FreeBorders& borders, std::size_t patches) {
    auto loops = closed_loops(soup, borders);
    std::vector<double> longest(patches, 0);
    std::vector<std::uint32_t> triangles(patches, 0);
    for (const Loop& loop : loops) longest[loop.patch] = std::max(longest[loop.patch], loop.length);
    for (const std::uint32_t p : soup.patches) ++triangles[p];
    std::erase_if(loops, [&](const Loop& loop) {
        const bool one_missing = loop.edges.size() == 3 && triangles[loop.patch] > 3;
        return loop.length == longest[loop.patch] && !one_missing;
    });
    return loops;
}

}  // namespace

Result<StepOutcome> fill_holes(SurfaceModel& model, const SurfaceStepOptions& options) {
    const TriangleSoup& soup = model.model.soup;
    const double limit = gap_limit(model, options);
    const FreeBorders borders = free_borders(soup, edges_of(soup));
    TriangleSoup made = soup;
    Origin origin = identity_origin(soup);
    StepOutcome outcome;
    std::uint64_t holes = 0, left = 0;
    for (const Loop& loop : holes_of(soup, borders, model.model.patches.size())) {
        // Half the way around a hole is as wide as it can be.
        if (loop.edges.size() > 3 && loop.length > 2 * limit) {
            ++left;
            outcome.what.points.push_back(soup.vertices[borders.edges[loop.edges[0]].from]);
            continue;
        }
        std::vector<std::uint32_t> vertices;
        for (const std::uint32_t e : loop.edges) vertices.push_back(borders.edges[e].from);
        std::ranges::reverse(vertices);  // on the other side of its edges
        const std::uint32_t source = borders.edges[loop.edges[0]].triangle;
        for (const Triangle& t : filled(soup, vertices)) {
            made.triangles.push_back(t);
            made.patches.push_back(loop.patch);
            origin.triangles.push_back(source);
            ++outcome.changed;
        }
        ++holes;
    }
    outcome.what.message =
        holes == 0 ? std::string("no hole was filled")
                   : counted(holes, "hole was filled", "holes were filled") + " with " + counted(outcome.changed, "triangle", "triangles");
    if (left > 0) outcome.what.message += "; " + counted(left, "hole is", "holes are") + " wider than " + rounded(limit) + " and left";
    if (outcome.changed > 0) {
        const auto first = static_cast<std::uint32_t>(soup.triangles.size());
        take_soup(model, std::move(made), origin);
        mark_added(model, first);
    }
    return outcome;
}

}  // namespace geomend::repair
