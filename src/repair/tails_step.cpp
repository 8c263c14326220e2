// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>

#include "base/wording.h"
#include "geometry/box_tree.h"
#include "geometry/closest_points.h"
#include "repair/outer_boundary.h"
#include "repair/soup_edges.h"
#include "repair/soup_edit.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

/// What tells a tail: its edges on lines, its free edges, and its vertices away from lines.
struct Piece {
    std::vector<std::array<Vec3, 2>> lines;
    std::uint32_t free_edges = 0;
    std::vector<std::uint32_t> triangles;
};

std::vector<Piece> gather(const TriangleSoup& soup, const SoupEdges& edges, const PatchPieces& pieces) {
    std::vector<Piece> all(pieces.count());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (pieces.of[t] != no_index) all[pieces.of[t]].triangles.push_back(t);
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto uses = edges[e];
        if (is_inner(soup, uses)) continue;
        if (is_free(uses)) {
            ++all[pieces.of[uses[0].triangle]].free_edges;
            continue;
        }
        std::uint32_t last = no_index;
        for (const auto& use : uses) {
            const std::uint32_t piece = pieces.of[use.triangle];
            if (piece != last) all[piece].lines.push_back({soup.vertices[use.low], soup.vertices[use.high]});
            last = piece;
        }
    }
    return all;
}

double distance_to(const Vec3& p, const std::array<Vec3, 2>& segment) {
    return closest_points(p, {segment[0], segment[1], segment[1]}).distance;
}

/// Whether all vertices of a piece are within a distance of its lines.
bool is_narrow(const TriangleSoup& soup, const Piece& piece, double limit) {
    std::vector<BoxTree::Corners> boxes;
    boxes.reserve(piece.lines.size());
    for (const auto& line : piece.lines) {
        BoxTree::Corners box;
        for (std::size_t k = 0; k < 3; ++k) {
            box[0][k] = std::min(line[0][k], line[1][k]) - limit;
            box[1][k] = std::max(line[0][k], line[1][k]) + limit;
        }
        boxes.push_back(box);
    }
    const BoxTree tree(boxes);
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t t : piece.triangles) vertices.insert(vertices.end(), soup.triangles[t].begin(), soup.triangles[t].end());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return std::ranges::all_of(vertices, [&](std::uint32_t v) {
        bool near = false;
        const Vec3& p = soup.vertices[v];
        tree.visit({p, p}, -1e-300, [&](std::uint32_t i) { near = near || distance_to(p, piece.lines[i]) <= limit; });
        return near;
    });
}

struct Removed {
    std::uint64_t pieces = 0, triangles = 0;
};

/// Takes narrow pieces with a free border away, until there are none; a patch never goes whole.
Removed drop_narrow(const TriangleSoup& soup, double limit, std::vector<std::uint8_t>& keep) {
    Removed removed;
    for (bool again = true; again;) {
        again = false;
        const SoupEdges edges = edges_of(soup, keep);
        const PatchPieces pieces = pieces_between_lines(soup, edges);
        const auto all = gather(soup, edges, pieces);
        std::vector<std::uint32_t> left(soup.patches.empty() ? 0 : *std::ranges::max_element(soup.patches) + 1, 0);
        for (const std::uint32_t patch : pieces.patch) ++left[patch];
        for (std::size_t p = 0; p < all.size(); ++p) {
            if (all[p].free_edges == 0 || all[p].lines.empty() || left[pieces.patch[p]] == 1 || !is_narrow(soup, all[p], limit)) continue;
            --left[pieces.patch[p]];
            for (const std::uint32_t t : all[p].triangles) keep[t] = 0;
            ++removed.pieces;
            removed.triangles += all[p].triangles.size();
            again = true;
        }
    }
    return removed;
}

}  // namespace

Result<StepOutcome> remove_tails(SurfaceModel& model, const SurfaceStepOptions& options) {
    const double limit = options.max_gap >= 0 ? options.max_gap : 1e-3 * model.lengths.diameter;
    std::vector<std::uint8_t> keep(model.model.soup.triangles.size(), 1);
    const Removed narrow = drop_narrow(model.model.soup, limit, keep);
    auto outside = outside_of_boundary(model, keep);
    if (!outside) return std::move(outside).why();
    for (const std::uint32_t t : *outside) keep[t] = 0;
    StepOutcome outcome;
    outcome.changed = narrow.triangles + outside->size();
    if (outcome.changed == 0) {
        outcome.what.message = "nothing sticks out by less than " + rounded(limit);
        return outcome;
    }
    outcome.what.message = counted(narrow.pieces, "piece", "pieces") + " narrower than " + rounded(limit) + " (" +
                           counted(narrow.triangles, "triangle", "triangles") + ") and " +
                           counted(outside->size(), "triangle", "triangles") + " outside of the closed boundary were removed";
    keep_triangles(model, keep);
    return outcome;
}

}  // namespace geomend::repair
