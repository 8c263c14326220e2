// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::gocad {

/// Reads any Gocad ASCII file: all objects, groups, Model3d. Objects are read at the same time; what comes out does not
/// depend on the number of threads. Types that are not known are listed as losses.
Result<Dataset> read_gocad(const Input& input, const ReadOptions& options);

/// The key of the Dataset annotation that keeps the head of a group: the names of the groups from the outermost on,
/// joined by unit separators (0x1f), a line end, and the text from `GOCAD ...` up to BEGIN_MEMBERS.
inline constexpr std::string_view group_annotation = "gocad.group";
inline constexpr char group_separator = '\x1f';

}  // namespace geomend::gocad
