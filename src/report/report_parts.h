// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "report/json.h"
#include "report/report.h"

// Only for sources of this room.

namespace geomend {

/// A file with its findings, worst first, `most` of them at most, as the JSON report has it.
Json file_json(const ReportedFile& file, std::size_t most);

/// A finding in words, as the text report has it, a line for each thing that is said of it.
std::string finding_text(const Finding& finding);

}  // namespace geomend
