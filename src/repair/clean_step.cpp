// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectors.h"
#include "base/wording.h"
#include "repair/joined_nodes.h"
#include "repair/soup_edit.h"
#include "repair/soup_measures.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

bool has_no_area(const TriangleSoup& soup, std::uint32_t t) {
    const auto& [a, b, c] = soup.triangles[t];
    return a == b || b == c || c == a || triangle_normal(soup, t) == Vec3{0, 0, 0};
}

/// Marks triangles that use the same three vertices as an earlier one of their patch. \return how many
std::uint64_t drop_doubles(const TriangleSoup& soup, std::vector<std::uint8_t>& keep) {
    std::vector<std::uint32_t> order;
    std::vector<Triangle> key(soup.triangles.size());
    for (std::uint32_t t = 0; t < key.size(); ++t) {
        key[t] = soup.triangles[t];
        std::ranges::sort(key[t]);
        if (keep[t] != 0) order.push_back(t);
    }
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
        if (soup.patches[a] != soup.patches[b]) return soup.patches[a] < soup.patches[b];
        return key[a] != key[b] ? key[a] < key[b] : a < b;
    };
    std::ranges::sort(order, less);
    std::uint64_t dropped = 0;
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (soup.patches[order[i]] != soup.patches[order[i - 1]] || key[order[i]] != key[order[i - 1]]) continue;
        keep[order[i]] = 0;
        ++dropped;
    }
    return dropped;
}

/// Marks small stray parts: triangles of a patch that hang together, no wider than the tolerance times ten, beside others of
/// the patch that are.
std::uint64_t drop_stray_parts(const SurfaceModel& model, std::vector<std::uint8_t>& keep) {
    const TriangleSoup& soup = model.model.soup;
    const auto parts = parts_of(soup, keep);
    std::vector<std::array<Vec3, 2>> box(parts.count, {Vec3{INFINITY, INFINITY, INFINITY}, Vec3{-INFINITY, -INFINITY, -INFINITY}});
    std::vector<std::uint32_t> patch_of(parts.count, 0);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (keep[t] == 0) continue;
        patch_of[parts.of[t]] = soup.patches[t];
        for (const std::uint32_t v : soup.triangles[t]) {
            for (std::size_t k = 0; k < 3; ++k) {
                box[parts.of[t]][0][k] = std::min(box[parts.of[t]][0][k], soup.vertices[v][k]);
                box[parts.of[t]][1][k] = std::max(box[parts.of[t]][1][k], soup.vertices[v][k]);
            }
        }
    }
    const double limit = 10 * model.lengths.tolerance;
    std::vector<std::uint8_t> small(parts.count, 0), has_large(model.model.patches.size(), 0);
    for (std::uint32_t p = 0; p < parts.count; ++p) {
        const Vec3 size = minus(box[p][1], box[p][0]);
        small[p] = dot(size, size) <= limit * limit ? 1 : 0;
        if (small[p] == 0) has_large[patch_of[p]] = 1;
    }
    std::uint64_t dropped = 0;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (keep[t] == 0 || small[parts.of[t]] == 0 || has_large[patch_of[parts.of[t]]] == 0) continue;
        keep[t] = 0;
        ++dropped;
    }
    return dropped;
}

}  // namespace

Result<StepOutcome> clean_surfaces(SurfaceModel& model, const SurfaceStepOptions&) {
    const TriangleSoup& soup = model.model.soup;
    std::vector<std::uint8_t> keep(soup.triangles.size(), 1);
    std::uint64_t flat = 0;
    for (std::uint32_t t = 0; t < keep.size(); ++t) {
        if (!has_no_area(soup, t)) continue;
        keep[t] = 0;
        ++flat;
    }
    std::vector<std::uint8_t> noted(keep.size(), 1);
    note_removed(model, keep, noted, Removal::no_area);
    const std::uint64_t doubles = drop_doubles(soup, keep);
    note_removed(model, keep, noted, Removal::doubled);
    const std::uint64_t stray = drop_stray_parts(model, keep);
    note_removed(model, keep, noted, Removal::stray);
    StepOutcome outcome;
    outcome.changed = flat + doubles + stray;
    if (outcome.changed == 0) {
        outcome.what.message = "nothing to remove";
        return outcome;
    }
    outcome.what.message = "removed: " + counted(flat, "triangle", "triangles") + " without area, " +
                           counted(doubles, "double", "doubles") + ", " + counted(stray, "triangle", "triangles") +
                           " of stray parts within ten tolerances";
    keep_triangles(model, keep);
    return outcome;
}

Result<StepOutcome> rebuild_surfaces(SurfaceModel& model, const SurfaceStepOptions&) {
    StepOutcome outcome;
    outcome.changed = 1;
    outcome.what.message =
        "surfaces, lines, corners and regions were made anew from " + counted(model.model.soup.triangles.size(), "triangle", "triangles");
    const LoneTwins twins = join_lone_twins(model);
    if (twins.nodes == 0) return outcome;
    outcome.what.message += "; " + counted(twins.nodes, "doubled point was", "doubled points were") + " joined in " +
                            counted(twins.faces.size(), "surface that doubles", "surfaces that double") +
                            " points also where nothing cuts it, so that doubling states no cut in it";
    for (const std::uint32_t p : twins.faces) outcome.what.entities.push_back({"surface", model.model.patches[p].name, -1});
    outcome.what.points.push_back(twins.where);
    return outcome;
}

}  // namespace geomend::repair
