// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::wells {

// Paths of wells as tables: exports of Petrel ("# WELL TRACE FROM PETREL", facts of the well in comments, the names of the columns between
// two rulers), tables with one line of names of columns and any separator, and files of ResInsight ("WELLNAME: A", then x, y, depth
// and measured depth). A column WELL, or a line with a name, begins another well; -999 alone ends one.

int sniff_well_paths(std::string_view head, std::string_view base_name);
/// Columns beside measured depth and positions become logs. Surveys of angles without positions are F013. Options: z. Linear.
Result<Dataset> read_well_paths(const Input& input, const ReadOptions& options);

}  // namespace geomend::wells
