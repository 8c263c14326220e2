// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

#include "formats/format.h"

namespace geomend::meshes {

/// Whether bytes begin as a binary Medit file.
bool is_medit_binary(std::string_view head);

/// Vertices, edges, faces and cells of first order of a binary Medit file, versions 1 to 4, of either byte order, with their numbers.
/// Other sections are listed as lost. Failure (unreadable) with the place in bytes.
Result<Dataset> read_medit_binary(const Input& input, const ReadOptions& options);

}  // namespace geomend::meshes
