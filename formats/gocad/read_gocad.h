// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::gocad {

/// Reads any Gocad ASCII file: all objects, groups, Model3d. Objects are read at the same time; what comes out does not
/// depend on the number of threads. Types that are not known are listed as losses. The head of a group is its text from
/// `GOCAD ...` up to BEGIN_MEMBERS.
Result<Dataset> read_gocad(const Input& input, const ReadOptions& options);

}  // namespace geomend::gocad
