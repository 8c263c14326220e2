// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/wording.h"
#include "geometry/box_tree.h"
#include "geometry/closest_points.h"
#include "repair/outer_boundary.h"
#include "repair/soup_edges.h"
#include "repair/soup_edit.h"
#include "repair/soup_measures.h"
#include "repair/surface_result.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

/// Where each patch ended before it was cut, to look for what is near.
class UncutBorders {
public:
    explicit UncutBorders(const SurfaceModel& model) : segments_(model.uncut_borders), tree_(boxes(model.uncut_borders)) {}

    /// How far a point is from where its patch ended; infinite where that is beyond a limit.
    double distance(const Vec3& p, std::uint32_t patch, double limit) const {
        BoxTree::Corners around{p, p};
        for (std::size_t k = 0; k < 3; ++k) {
            around[0][k] -= limit;
            around[1][k] += limit;
        }
        double least = std::numeric_limits<double>::infinity();
        tree_.visit(around, -1e-9 * limit, [&](std::uint32_t i) {
            const auto& s = segments_[i];
            if (s.patch == patch) least = std::min(least, closest_points(p, {s.from, s.to, s.to}).distance);
        });
        return least <= limit ? least : std::numeric_limits<double>::infinity();
    }

private:
    static std::vector<BoxTree::Corners> boxes(const std::vector<SurfaceModel::BorderSegment>& segments) {
        std::vector<BoxTree::Corners> all;
        all.reserve(segments.size());
        for (const auto& s : segments) {
            BoxTree::Corners box;
            for (std::size_t k = 0; k < 3; ++k) {
                box[0][k] = std::min(s.from[k], s.to[k]);
                box[1][k] = std::max(s.from[k], s.to[k]);
            }
            all.push_back(box);
        }
        return all;
    }

    const std::vector<SurfaceModel::BorderSegment>& segments_;
    BoxTree tree_;
};

/// What tells a tail of pieces between lines.
struct Piece {
    std::vector<std::uint32_t> triangles;
    double area = 0;
    bool has_line = false;
    bool is_open = false;  ///< ends freely
    bool follows = false;  ///< on a tail of its patch that was taken away
};

std::vector<Piece> gather(const TriangleSoup& soup, const SoupEdges& edges, const PatchPieces& pieces,
                          const std::vector<std::uint8_t>& removed) {
    std::vector<Piece> all(pieces.count());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (pieces.of[t] == no_index) continue;
        all[pieces.of[t]].triangles.push_back(t);
        all[pieces.of[t]].area += triangle_area(soup, t);
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto uses = edges[e];
        std::size_t left = 0;
        for (const auto& use : uses) left += removed[use.triangle] == 0 ? 1 : 0;
        for (const auto& use : uses) {
            const std::uint32_t piece = pieces.of[use.triangle];
            if (removed[use.triangle] != 0 || is_inner(soup, uses)) continue;
            all[piece].has_line |= uses.size() > 1;
            all[piece].is_open |= left == 1;
            all[piece].follows |= std::ranges::any_of(uses, [&](const auto& other) {
                return removed[other.triangle] != 0 && soup.patches[other.triangle] == soup.patches[use.triangle];
            });
        }
    }
    return all;
}

/// How far a piece reaches from where its patch ended; infinite where that is beyond a limit.
double reach_of(const TriangleSoup& soup, const Piece& piece, std::uint32_t patch, const UncutBorders& borders, double limit) {
    double most = 0;
    for (const std::uint32_t t : piece.triangles) {
        for (const std::uint32_t v : soup.triangles[t]) {
            most = std::max(most, borders.distance(soup.vertices[v], patch, limit));
            if (most > limit) return most;
        }
    }
    return most;
}

/// Regions that become one as what parts them is taken away. Two that are no mere slivers must not.
class JoinedRegions {
public:
    /// \param thin what is no thicker is a sliver
    JoinedRegions(const TriangleRegions& regions, double thin) : regions_(regions), sets_(regions.thickness.size() + 1) {
        for (const double thickness : regions.thickness) is_large_.push_back(thickness > thin ? 1 : 0);
        is_large_.push_back(1);  // the outside
    }
    bool may_join(std::uint32_t triangle) {
        const auto [a, b] = roots(triangle);
        return a == b || is_large_[a] == 0 || is_large_[b] == 0;
    }
    void join(std::uint32_t triangle) {
        const auto [a, b] = roots(triangle);
        const std::uint8_t large = is_large_[a] | is_large_[b];
        sets_.join(a, b);
        is_large_[sets_.root(a)] = large;
    }

private:
    std::array<std::uint32_t, 2> roots(std::uint32_t triangle) {
        const auto outside = static_cast<std::uint32_t>(regions_.thickness.size());
        const auto [front, back] = regions_.sides[triangle];
        return {sets_.root(std::min(front, outside)), sets_.root(std::min(back, outside))};
    }

    const TriangleRegions& regions_;
    DisjointSets sets_;
    std::vector<std::uint8_t> is_large_;
};

struct Removed {
    std::uint64_t pieces = 0, triangles = 0;
};

/// Per patch what it is measured by: its largest piece of those that part regions, or of all where none does.
std::vector<double> main_areas(const std::vector<Piece>& all, const PatchPieces& pieces, const TriangleRegions& regions,
                               std::size_t patches) {
    std::vector<double> main(patches, 0), largest(patches, 0);
    for (std::size_t p = 0; p < all.size(); ++p) {
        if (all[p].triangles.empty()) continue;
        double& area = (regions.parts(all[p].triangles[0]) ? main : largest)[pieces.patch[p]];
        area = std::max(area, all[p].area);
    }
    for (std::size_t i = 0; i < patches; ++i) main[i] = main[i] > 0 ? main[i] : largest[i];
    return main;
}

/// Takes pieces away that end freely and lie within the limit of their patch of where their patch ended before it was cut; then those
/// behind them, until there are none. The main piece of a patch stays. Of what parts regions only what is a mere corner of the patch goes,
/// which reaches hardly farther than what ended freely there, and no two regions become one that are more than slivers.
Result<Removed> drop_narrow(const SurfaceModel& model, const std::vector<double>& limits, double thin, std::vector<std::uint8_t>& keep) {
    constexpr double share_of_corner = 0.02, hardly_farther = 1.2;
    const TriangleSoup& soup = model.model.soup;
    const SoupEdges edges = edges_of(soup);
    const PatchPieces pieces = pieces_between_lines(soup, edges);
    const UncutBorders borders(model);
    std::vector<std::uint8_t> removed(soup.triangles.size(), 0);
    Removed sum;
    const auto first = gather(soup, edges, pieces, removed);
    if (std::ranges::none_of(first, [](const Piece& p) { return p.has_line && p.is_open; })) return sum;
    const auto regions = triangle_regions(model);
    if (!regions) return regions.why();
    const auto main = main_areas(first, pieces, *regions, model.model.patches.size());
    JoinedRegions joined(*regions, thin);
    std::vector<double> reach(pieces.count(), -1), reach_of_tails(model.model.patches.size(), 0);
    for (bool again = true; again;) {
        again = false;
        const auto all = gather(soup, edges, pieces, removed);
        for (std::size_t p = 0; p < all.size(); ++p) {
            const Piece& piece = all[p];
            if (piece.triangles.empty() || removed[piece.triangles[0]] != 0) continue;
            const std::uint32_t patch = pieces.patch[p], one = piece.triangles[0];
            const bool parts = !piece.is_open && regions->parts(one);
            if (!piece.has_line || !(piece.is_open || piece.follows) || piece.area == main[patch]) continue;
            if (parts && (piece.area > share_of_corner * main[patch] || !joined.may_join(one))) continue;
            if (reach[p] < 0) reach[p] = reach_of(soup, piece, patch, borders, limits[patch]);
            if (reach[p] > (parts ? std::min(limits[patch], hardly_farther * reach_of_tails[patch]) : limits[patch])) continue;
            if (!parts) reach_of_tails[patch] = std::max(reach_of_tails[patch], reach[p]);
            for (const std::uint32_t t : piece.triangles) removed[t] = 1;
            joined.join(one);
            ++sum.pieces;
            sum.triangles += piece.triangles.size();
            again = true;
        }
    }
    for (std::size_t t = 0; t < removed.size(); ++t) keep[t] = removed[t] != 0 ? 0 : 1;
    return sum;
}

}  // namespace

Result<StepOutcome> remove_tails(SurfaceModel& model, const SurfaceStepOptions& options) {
    const double limit = gap_limit(model, options);
    std::vector<std::uint8_t> keep(model.model.soup.triangles.size(), 1);
    const auto narrow = drop_narrow(model, gap_limits(model, options), limit, keep);
    if (!narrow) return narrow.why();
    auto outside = outside_of_boundary(model, keep);
    if (!outside) return std::move(outside).why();
    std::vector<std::uint8_t> noted(keep.size(), 1);
    note_removed(model, keep, noted, Removal::tail);
    for (const std::uint32_t t : *outside) keep[t] = 0;
    note_removed(model, keep, noted, Removal::outside);
    StepOutcome outcome;
    outcome.changed = narrow->triangles + outside->size();
    if (outcome.changed == 0) {
        outcome.what.message = "nothing sticks out by less than " + rounded(limit);
        return outcome;
    }
    outcome.what.message = counted(narrow->pieces, "piece", "pieces") + " narrower than " + rounded(limit) + " (" +
                           counted(narrow->triangles, "triangle", "triangles") + ") and " +
                           counted(outside->size(), "triangle", "triangles") + " outside of the closed boundary were removed";
    keep_triangles(model, keep);
    return outcome;
}

}  // namespace geomend::repair
