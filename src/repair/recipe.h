// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

/// All that decides what a repair does: kept in a file (TOML) it can be done again to the byte. What is not given is as by rule.
struct Recipe {
    std::vector<std::string> steps;
    std::optional<double> tolerance, near, max_gap, max_displacement;
    std::optional<std::array<Vec3, 2>> box;  ///< low and high corner
    bool automatic_box = false;
    std::vector<ContactWish> contacts;
    std::optional<double> scar_angle;  ///< degrees
    std::optional<double> micro_volume;
    std::vector<SurfaceEdit> edits;
};

/// Reads a recipe. Failure (usage): what is no TOML, a key that no recipe has, a step that there is not, a value of another kind;
/// with the line, and the file's name as given.
Result<Recipe> parse_recipe(std::string_view text, const std::string& file);

/// A recipe as parse_recipe() reads it. Numbers read back to the same double.
std::string recipe_text(const Recipe& recipe);

/// A box as --box states it: "auto", or x0,x1,y0,y1,z0,z1. Failure (usage) for others.
Result<void> parse_box(std::string_view text, Recipe& recipe);

}  // namespace geomend::repair
