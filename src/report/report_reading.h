// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "report/report.h"

namespace geomend {

/// Reads what report_json() writes. Every value is checked: a report comes from a process that may have gone wrong, or
/// from a file. Steps of repairs and the summary of a run are left out. Cost: linear.
/// \param name what messages call it
/// Failure (unreadable): F012 names the place where something else was expected.
Result<Report> read_report(std::string_view json, const std::string& name);

}  // namespace geomend
