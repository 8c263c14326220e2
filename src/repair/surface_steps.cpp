// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/surface_steps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/vectors.h"
#include "repair/borders_step.h"

namespace geomend::repair {

namespace {

constexpr std::array<std::string_view, 13> clean_mends = {"B01", "M02", "M03", "M04", "M05", "M08", "B26",
                                                          "M20", "M22", "M26", "M27", "M28", "M35"};
constexpr std::array<std::string_view, 16> cut_mends = {"B05", "B06", "B09", "B12", "B23", "B02", "B08", "B10",
                                                        "B11", "B20", "B22", "B26", "B27", "B28", "B32", "B33"};
constexpr std::array<std::string_view, 5> holes_mends = {"B05", "B06", "B12", "B29", "M07"};
constexpr std::array<std::string_view, 7> weld_mends = {"M01", "M03", "B05", "B07", "B11", "B12", "B27"};
constexpr std::array<std::string_view, 7> close_mends = {"B05", "B06", "B07", "B09", "B12", "B23", "B29"};
constexpr std::array<std::string_view, 12> tails_mends = {"B02", "B05", "B06", "B08", "B09", "B10",
                                                          "B11", "B12", "B16", "B20", "B22", "B23"};
constexpr std::array<std::string_view, 1> micro_mends = {"B15"};
constexpr std::array<std::string_view, 11> rebuild_mends = {"B03", "B05", "B06", "B12", "B13", "B14", "B18", "B19", "F106", "B30", "B31"};

constexpr std::array steps = {
    SurfaceStepRow{"edit",
                   "surfaces are added, replaced, moved or removed, as a recipe says, and what that affects is cut again",
                   {},
                   edit_surfaces,
                   false,
                   true,
                   true},
    SurfaceStepRow{"clean", "triangles without area, doubles and small stray parts are removed, cells turned and cleaned", clean_mends,
                   clean_surfaces},
    SurfaceStepRow{"box", "six sides are added around the surfaces, or as --box says", {}, add_box, true},
    SurfaceStepRow{"holes", "small holes and notches in a surface, and missing single triangles, are filled", holes_mends, fill_holes},
    SurfaceStepRow{"weld", "what lies within the tolerance of each other becomes one: points, and points on edges and faces", weld_mends,
                   weld_surfaces},
    SurfaceStepRow{"close", "borders that stop short of a surface are brought onto it along their own surface", close_mends, close_borders,
                   true},
    SurfaceStepRow{"cut", "all surfaces are cut along everything that they have in common", cut_mends, cut_surfaces},
    SurfaceStepRow{"tails", "what sticks through another surface by less than the limit, or out of a closed boundary, is removed",
                   tails_mends, remove_tails},
    SurfaceStepRow{"scars", "traces of lines that no surface needs any more are stitched and erased", {}, remove_scars},
    SurfaceStepRow{"micro", "regions smaller than a limit are merged into a neighbour", micro_mends, merge_micro_regions, false, true,
                   true},
    SurfaceStepRow{
        "borders", "lines of several surfaces get their coarsest common discretisation", {}, simplify_borders, false, false, true},
    SurfaceStepRow{"rebuild", "surfaces, lines, corners and regions are made anew; names are carried over", rebuild_mends,
                   rebuild_surfaces},
};

}  // namespace

std::span<const SurfaceStepRow> surface_steps() { return steps; }

const SurfaceStepRow* surface_step(std::string_view name) {
    const auto found = std::ranges::find(steps, name, &SurfaceStepRow::name);
    return found == steps.end() ? nullptr : &*found;
}

std::vector<double> gap_limits(const SurfaceModel& model, const SurfaceStepOptions& options) {
    std::vector<double> limits(model.model.patches.size(), gap_limit(model, options));
    for (std::size_t p = 0; p < std::min(limits.size(), model.source_patches.size()) && options.max_gap < 0; ++p) {
        if (const double own = model.source_patches[p].diameter; own > 0) limits[p] = 1e-3 * own;
    }
    return limits;
}

Displacement displacement(const TriangleSoup& before, const TriangleSoup& after, std::span<const std::uint32_t> becomes) {
    Displacement d;
    double sum = 0;
    for (std::size_t v = 0; v < becomes.size(); ++v) {
        if (becomes[v] == no_index) continue;
        const Vec3 move = minus(after.vertices[becomes[v]], before.vertices[v]);
        const double distance = std::sqrt(dot(move, move));
        if (distance == 0) continue;
        ++d.moved;
        sum += distance;
        d.largest = std::max(d.largest, distance);
    }
    if (d.moved > 0) d.mean = sum / static_cast<double>(d.moved);
    return d;
}

}  // namespace geomend::repair
