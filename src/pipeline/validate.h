// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <span>

#include "base/result.h"
#include "model/dataset.h"
#include "pipeline/load.h"
#include "report/report.h"
#include "validators/registry.h"

namespace geomend {

/// Runs the checks that apply to each object; what the reader noticed is in the report, too. The file is not called valid
/// where an object holds nothing that a check looks at (F160), where the reader left something out that it could not read, or
/// where the options leave out checks that might find something in it.
/// Failure: a code of the options is of no check (usage), or stopped (cancelled).
/// \param judged where not null: takes the boundary representations that findings are about
Result<ReportedFile> validate(const std::string& path, const Dataset& dataset, const validators::CheckOptions& options,
                              std::vector<Brep>* judged = nullptr);

/// Looks at a dataset, the B-Reps that were judged and what was found in them before they are gone: to draw them, to write
/// debris. May change the report; its failure ends the work.
using Inspect = std::function<Result<void>(const Dataset&, std::span<const Brep>, ReportedFile&)>;

/// Reads a file and validates it. Failure as of load().
Result<ReportedFile> validate(const std::string& path, const LoadOptions& load, const validators::CheckOptions& options,
                              const Inspect& inspect = {});

/// A file that could not be read, for a report: not valid, with what stopped the reader as its findings.
ReportedFile unreadable_file(const std::string& path, const Failure& why);

}  // namespace geomend
