// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/place_words.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

using Bounds = std::array<Vec3, 2>;  // low, high

/// All patches of one name.
struct Interface {
    Bounds bounds{Vec3{INFINITY, INFINITY, INFINITY}, Vec3{-INFINITY, -INFINITY, -INFINITY}};
    bool is_horizon = true, is_fault = false;  ///< by role; neither: it is not said
    double area = 0, area_in_plan = 0;
};

bool has_fault_role(FeatureRole role) { return role == FeatureRole::fault || role == FeatureRole::fracture; }

std::map<std::string, Interface> interfaces_of(const SurfaceModel& model) {
    const TriangleSoup& soup = model.model.soup;
    std::map<std::string, Interface> all;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const auto& patch = model.model.patches[soup.patches[t]];
        Interface& own = all[patch.interface_name];
        own.is_horizon = own.is_horizon && patch.role != FeatureRole::unknown && !has_fault_role(patch.role);
        own.is_fault = own.is_fault || has_fault_role(patch.role);
        const auto at = [&](std::size_t k) -> const Vec3& { return soup.vertices[soup.triangles[t][k]]; };
        for (std::size_t corner = 0; corner < 3; ++corner) {
            for (std::size_t k = 0; k < 3; ++k) {
                own.bounds[0][k] = std::min(own.bounds[0][k], at(corner)[k]);
                own.bounds[1][k] = std::max(own.bounds[1][k], at(corner)[k]);
            }
        }
        const Vec3 normal = cross(minus(at(1), at(0)), minus(at(2), at(0)));
        own.area += 0.5 * std::sqrt(dot(normal, normal));
        own.area_in_plan += 0.5 * std::abs(normal[2]);
    }
    return all;
}

Bounds bounds_of(const std::map<std::string, Interface>& interfaces) {
    Bounds all = Interface{}.bounds;
    for (const auto& [name, one] : interfaces) {
        for (std::size_t k = 0; k < 3; ++k) {
            all[0][k] = std::min(all[0][k], one.bounds[0][k]);
            all[1][k] = std::max(all[1][k], one.bounds[1][k]);
        }
    }
    return all;
}

/// Whether a surface is spread over a model as a layer is: over half of it along both axes, and, where its role is not said, flatter
/// than steep: a long fault is none.
bool is_spread_as_a_layer(const Interface& one, const Bounds& all) {
    if (one.is_fault || (!one.is_horizon && one.area_in_plan < 0.7 * one.area)) return false;
    for (std::size_t k = 0; k < 2; ++k) {
        if (one.bounds[1][k] - one.bounds[0][k] < 0.5 * (all[1][k] - all[0][k])) return false;
    }
    return true;
}

/// What all widely spread layers reach across, in plan, a hundredth less on each side, or, without any, all there is; in height all
/// there is and a tenth more on each side.
Bounds automatic(const SurfaceModel& model) {
    const auto interfaces = interfaces_of(model);
    const Bounds all = bounds_of(interfaces);
    Bounds box = all;
    bool has_layers = false;
    for (const auto& [name, one] : interfaces) {
        if (!is_spread_as_a_layer(one, all)) continue;
        has_layers = true;
        for (std::size_t k = 0; k < 2; ++k) {
            box[0][k] = std::max(box[0][k], one.bounds[0][k]);
            box[1][k] = std::min(box[1][k], one.bounds[1][k]);
        }
    }
    for (std::size_t k = 0; k < 2; ++k) {
        const double inset = (has_layers ? 0.01 : -0.01) * (box[1][k] - box[0][k]);
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
    const Bounds all = bounds_of(interfaces_of(model));
    for (std::size_t k = 0; k < 3; ++k) {
        if (box[0][k] <= all[1][k] && all[0][k] <= box[1][k]) continue;
        const std::string axis(1, "xyz"[k]);
        return failure(FailureKind::usage, "F018", {},
                       "the box lies beside the surfaces: " + axis + " from " + coordinate(box[0][k]) + " to " + coordinate(box[1][k]) +
                           ", and theirs from " + coordinate(all[0][k]) + " to " + coordinate(all[1][k]));
    }
    return {};
}

/// A box around all there is would be one around points that are no part of it.
Failure stray_points(const std::vector<SurfaceModel::StrayPoint>& stray) {
    const Vec3& at = stray[0].at;
    return failure(FailureKind::usage, "F018", {},
                   "no box fits these surfaces: " + counted(stray.size(), "point lies", "points lie") + " far off, of " +
                       quoted(stray[0].surface) + " at " + place_words(at) +
                       "; give such points their heights or remove them, or give the sides of the box");
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
    if (!options.box && !model.stray.empty()) return stray_points(model.stray);
    const Bounds box = options.box ? *options.box : automatic(model);
    for (std::size_t k = 0; k < 3; ++k) {
        if (box[0][k] < box[1][k]) continue;
        return failure(
            FailureKind::usage, "F018", {},
            "the box has no extent along " + std::string(1, "xyz"[k]) + ": from " + coordinate(box[0][k]) + " to " + coordinate(box[1][k]));
    }
    if (auto fits = meets_surfaces(model, box); !fits) return std::move(fits).why();
    const auto patches = static_cast<std::uint32_t>(model.model.patches.size());
    add_sides(model, box);
    measure_lengths(model, patches);
    outcome.changed = 6;
    outcome.what.message = "six sides were added: x " + coordinate(box[0][0]) + " .. " + coordinate(box[1][0]) + ", y " +
                           coordinate(box[0][1]) + " .. " + coordinate(box[1][1]) + ", z " + coordinate(box[0][2]) + " .. " +
                           coordinate(box[1][2]);
    return outcome;
}

}  // namespace geomend::repair
