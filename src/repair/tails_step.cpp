// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>

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

    bool near(const Vec3& p, std::uint32_t patch, double limit) const {
        BoxTree::Corners around{p, p};
        for (std::size_t k = 0; k < 3; ++k) {
            around[0][k] -= limit;
            around[1][k] += limit;
        }
        bool found = false;
        tree_.visit(around, -1e-9 * limit, [&](std::uint32_t i) {
            const auto& s = segments_[i];
            found = found || (s.patch == patch && closest_points(p, {s.from, s.to, s.to}).distance <= limit);
        });
        return found;
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

bool is_near_border(const TriangleSoup& soup, const Piece& piece, std::uint32_t patch, const UncutBorders& borders, double limit) {
    return std::ranges::all_of(piece.triangles, [&](std::uint32_t t) {
        return std::ranges::all_of(soup.triangles[t], [&](std::uint32_t v) { return borders.near(soup.vertices[v], patch, limit); });
    });
}

struct Removed {
    std::uint64_t pieces = 0, triangles = 0;
};

/// Per patch what it is measured by: its largest piece of those that part regions, or of all where none does.
std::vector<double> main_areas(const std::vector<Piece>& all, const PatchPieces& pieces, const std::vector<std::uint8_t>& parting,
                               std::size_t patches) {
    std::vector<double> main(patches, 0), largest(patches, 0);
    for (std::size_t p = 0; p < all.size(); ++p) {
        if (all[p].triangles.empty()) continue;
        double& area = (parting[all[p].triangles[0]] != 0 ? main : largest)[pieces.patch[p]];
        area = std::max(area, all[p].area);
    }
    for (std::size_t i = 0; i < patches; ++i) main[i] = main[i] > 0 ? main[i] : largest[i];
    return main;
}

/// Takes pieces away that end freely and lie within the limit of their patch of where their patch ended before it was cut; then those
/// behind them, until there are none. The main piece of a patch stays, and of what parts regions all that is no mere corner of it.
Result<Removed> drop_narrow(const SurfaceModel& model, const std::vector<double>& limits, std::vector<std::uint8_t>& keep) {
    constexpr double share_of_corner = 0.02;
    const TriangleSoup& soup = model.model.soup;
    const SoupEdges edges = edges_of(soup);
    const PatchPieces pieces = pieces_between_lines(soup, edges);
    const UncutBorders borders(model);
    std::vector<std::uint8_t> removed(soup.triangles.size(), 0), near(pieces.count(), 2);
    Removed sum;
    const auto first = gather(soup, edges, pieces, removed);
    if (std::ranges::none_of(first, [](const Piece& p) { return p.has_line && p.is_open; })) return sum;
    const auto parting = parting_triangles(model);
    if (!parting) return parting.why();
    const auto main = main_areas(first, pieces, *parting, model.model.patches.size());
    for (bool again = true; again;) {
        again = false;
        const auto all = gather(soup, edges, pieces, removed);
        for (std::size_t p = 0; p < all.size(); ++p) {
            const Piece& piece = all[p];
            if (piece.triangles.empty() || removed[piece.triangles[0]] != 0) continue;
            const double whole = main[pieces.patch[p]];
            const bool parts = !piece.is_open && (*parting)[piece.triangles[0]] != 0;
            if (!piece.has_line || !(piece.is_open || piece.follows) || piece.area == whole) continue;
            if (parts && piece.area > share_of_corner * whole) continue;
            if (near[p] == 2) near[p] = is_near_border(soup, piece, pieces.patch[p], borders, limits[pieces.patch[p]]) ? 1 : 0;
            if (near[p] == 0) continue;
            for (const std::uint32_t t : piece.triangles) removed[t] = 1;
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
    const auto narrow = drop_narrow(model, gap_limits(model, options), keep);
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
