// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "report/json.h"
#include "report/report.h"

// Only for sources of this room.

namespace geomend {

/// A file with its findings, worst first, `most` of them at most, as the JSON report has it.
Json file_json(const ReportedFile& file, std::size_t most);

/// Where a finding is: "(1, 2, -300)"; of several places the first, "(1, 2, -300), the first of 7". Heights as the file has them. Empty
/// where it has no place.
std::string place_text(const ReportedFile& file, const Finding& finding);

/// A finding of a file in words, as the text report has it, a line for each thing that is said of it.
std::string finding_text(const ReportedFile& file, const Finding& finding);

}  // namespace geomend
