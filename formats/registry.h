// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "formats/mesh_format.h"

namespace geomend {

/// All formats, in the order in which they are listed for people.
std::span<const Format> all_formats();

/// What writes a mesh in a format that takes a prepared VolumeMesh; nullptr for formats that take a Dataset.
const MeshFormat* mesh_format(const Format& format);

/// The format of a name (--from, --to), or nullptr. A family name ("gocad") finds its first row.
const Format* format_by_name(std::string_view name);

/// The format that the first bytes (at most 64 KiB, inflated) or else the extension speak for, among those that can be
/// read; nullptr when none does. `base_name` without folder and ".gz".
const Format* claiming_format(std::string_view head, std::string_view base_name);

/// The format to read with: by content, then by extension. Failure F003 when nothing is sure, F002 when the
/// input is empty.
Result<const Format*> format_for_reading(const Input& input);

/// The format to write with, by the extension of the path (".gz" is ignored). Failure (usage) names the
/// extensions that are known.
Result<const Format*> format_for_writing(const std::string& path);

}  // namespace geomend
