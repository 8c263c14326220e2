// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/wording.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

using Bounds = std::array<Vec3, 2>;  // low, high

Bounds bounds_of_patch(const TriangleSoup& soup, std::uint32_t patch) {
    Bounds b{Vec3{INFINITY, INFINITY, INFINITY}, Vec3{-INFINITY, -INFINITY, -INFINITY}};
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        if (soup.patches[t] != patch) continue;
        for (const std::uint32_t v : soup.triangles[t]) {
            for (std::size_t k = 0; k < 3; ++k) {
                b[0][k] = std::min(b[0][k], soup.vertices[v][k]);
                b[1][k] = std::max(b[1][k], soup.vertices[v][k]);
            }
        }
    }
    return b;
}

bool may_be_a_layer(FeatureRole role) { return role != FeatureRole::fault && role != FeatureRole::fracture; }

/// The bounds of each interface, all its patches together.
std::map<std::string, std::pair<Bounds, bool>> bounds_of_interfaces(const SurfaceModel& model) {
    std::map<std::string, std::pair<Bounds, bool>> all;
    for (std::uint32_t p = 0; p < model.model.patches.size(); ++p) {
        const auto& patch = model.model.patches[p];
        const Bounds b = bounds_of_patch(model.model.soup, p);
        auto [at, is_new] = all.try_emplace(patch.interface_name, b, may_be_a_layer(patch.role));
        for (std::size_t k = 0; k < 3 && !is_new; ++k) {
            at->second.first[0][k] = std::min(at->second.first[0][k], b[0][k]);
            at->second.first[1][k] = std::max(at->second.first[1][k], b[1][k]);
        }
    }
    return all;
}

/// What all widely spread surfaces that are no faults reach across, in plan, a hundredth less on each side; in height all there is
/// and a tenth more on each side.
Bounds automatic(const SurfaceModel& model) {
    const auto interfaces = bounds_of_interfaces(model);
    Bounds all{Vec3{INFINITY, INFINITY, INFINITY}, Vec3{-INFINITY, -INFINITY, -INFINITY}};
    for (const auto& [name, entry] : interfaces) {
        for (std::size_t k = 0; k < 3; ++k) {
            all[0][k] = std::min(all[0][k], entry.first[0][k]);
            all[1][k] = std::max(all[1][k], entry.first[1][k]);
        }
    }
    Bounds box = all;
    for (std::size_t k = 0; k < 2; ++k) {
        for (const auto& [name, entry] : interfaces) {
            const double width = entry.first[1][k] - entry.first[0][k];
            if (!entry.second || width < 0.5 * (all[1][k] - all[0][k])) continue;
            box[0][k] = std::max(box[0][k], entry.first[0][k]);
            box[1][k] = std::min(box[1][k], entry.first[1][k]);
        }
        const double inset = 0.01 * (box[1][k] - box[0][k]);
        box[0][k] += inset;
        box[1][k] -= inset;
    }
    const double height = std::max(all[1][2] - all[0][2], 0.1 * (all[1][0] - all[0][0]));
    box[0][2] -= 0.1 * height;
    box[1][2] += 0.1 * height;
    return box;
}

/// Failure (usage) where a box lies beside all surfaces.
Result<void> meets_surfaces(const SurfaceModel& model, const Bounds& box) {
    Bounds all{Vec3{INFINITY, INFINITY, INFINITY}, Vec3{-INFINITY, -INFINITY, -INFINITY}};
    for (const auto& [name, entry] : bounds_of_interfaces(model)) {
        for (std::size_t k = 0; k < 3; ++k) {
            all[0][k] = std::min(all[0][k], entry.first[0][k]);
            all[1][k] = std::max(all[1][k], entry.first[1][k]);
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        if (box[0][k] <= all[1][k] && all[0][k] <= box[1][k]) continue;
        const std::string axis(1, "xyz"[k]);
        return failure(FailureKind::usage, "F018", {},
                       "the box lies beside the surfaces: " + axis + " from " + rounded(box[0][k]) + " to " + rounded(box[1][k]) +
                           ", and theirs from " + rounded(all[0][k]) + " to " + rounded(all[1][k]));
    }
    return {};
}

constexpr std::array<std::string_view, 6> names = {"box_west", "box_east", "box_south", "box_north", "box_base", "box_top"};
/// Corners of each side, counter-clockwise from outside; bit k of a corner: high of axis k.
constexpr std::array<std::array<unsigned, 4>, 6> corners = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

void add_sides(SurfaceModel& model, const Bounds& box) {
    TriangleSoup soup = model.model.soup;
    Origin origin = identity_origin(soup);
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (unsigned c = 0; c < 8; ++c) {
        soup.vertices.push_back({box[c & 1][0], box[c >> 1 & 1][1], box[c >> 2 & 1][2]});
        origin.vertices.push_back({});
    }
    for (std::size_t s = 0; s < 6; ++s) {
        const auto patch = static_cast<std::uint32_t>(model.model.patches.size());
        topology::SoupModel::Patch side;
        side.name = side.interface_name = names[s];
        side.role = FeatureRole::boundary;
        side.source_object = 0;
        side.source_part = patch;
        model.model.patches.push_back(side);
        model.source_patches.push_back(
            {static_cast<std::uint32_t>(model.source.vertices.size()), static_cast<std::uint32_t>(model.source.triangles.size()), {}});
        for (std::size_t k = 2; k < 4; ++k) {
            soup.triangles.push_back({first + corners[s][0], first + corners[s][k - 1], first + corners[s][k]});
            soup.patches.push_back(patch);
            origin.triangles.push_back(no_index);
        }
    }
    take_soup(model, std::move(soup), origin);
}

}  // namespace

Result<StepOutcome> add_box(SurfaceModel& model, const SurfaceStepOptions& options) {
    StepOutcome outcome;
    if (!options.box && !options.automatic_box) {
        outcome.what.message = "no box was asked for";
        return outcome;
    }
    const Bounds box = options.box ? *options.box : automatic(model);
    for (std::size_t k = 0; k < 3; ++k) {
        if (box[0][k] < box[1][k]) continue;
        return failure(
            FailureKind::usage, "F018", {},
            "the box has no extent along " + std::string(1, "xyz"[k]) + ": from " + rounded(box[0][k]) + " to " + rounded(box[1][k]));
    }
    if (auto fits = meets_surfaces(model, box); !fits) return std::move(fits).why();
    const auto patches = static_cast<std::uint32_t>(model.model.patches.size());
    add_sides(model, box);
    measure_lengths(model, patches);
    outcome.changed = 6;
    outcome.what.message = "six sides were added: x " + rounded(box[0][0]) + " .. " + rounded(box[1][0]) + ", y " + rounded(box[0][1]) +
                           " .. " + rounded(box[1][1]) + ", z " + rounded(box[0][2]) + " .. " + rounded(box[1][2]);
    return outcome;
}

}  // namespace geomend::repair
