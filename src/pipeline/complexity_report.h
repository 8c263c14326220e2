// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "complexity/complexity.h"
#include "model/dataset.h"
#include "pipeline/load.h"

namespace geomend {

/// What --option sites=N, size=L and angle=A ask of the complexity measures. Failure (usage) for values out of bounds.
Result<complexity::ComplexityOptions> complexity_options(const FormatOptions& options, const Monitor* monitor);

/// A short table for people.
std::string complexity_text(const complexity::Complexity& complexity);

/// The cells' sites as points of an object named `name`, with the attributes corners, lines, surfaces, regions and elements
/// (their sum). \pre complexity.cells
PointSet complexity_sites(const complexity::Complexity& complexity, const std::string& name);

/// Writes objects with the format that the path's ending asks for. Failure (usage) where none does, (unwritable) where it
/// cannot, (cannot_hold) where that format cannot hold them.
Result<void> write_objects(Dataset data, const std::string& path);

}  // namespace geomend
