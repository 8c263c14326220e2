// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "report/scene.h"

namespace geomend {

/// A scene as text, for the process that puts reports of many files together.
std::string scene_text(const Scene& scene);

/// The scene back; nothing where the text is not one: each value is checked, and that triangles and lines use points
/// that are there. Of the coordinate system only the sign and names of axes come back, which is what pages show.
std::optional<Scene> scene_from_text(std::string_view text);

}  // namespace geomend
