// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "base/monitor.h"
#include "pipeline/find_files.h"
#include "report/report.h"

namespace geomend {

/// How many files are validated, each in a process of its own.
struct ManyOptions {
    /// Starts the worker: program and arguments. "--threads", a number, "--" and the file are put behind. It validates
    /// that file, writes worker_report() to standard output, and exits with the status that its outcome has.
    std::vector<std::string> worker;
    std::size_t threads = 0;  ///< for all workers together; 0: the number of processors
    double seconds = 0;       ///< of time for each file; 0: no limit
    const Monitor* monitor = nullptr;
};

/// What a worker says: report_json() of its one file, and behind a NUL its scene where there is one.
std::string worker_report(const Report& report);

/// Validates files in worker processes, as many at a time as there are threads. A worker that crashes, hangs or gives no
/// report that makes sense is a finding of its file (F025, F023); the others go on. Files come back in the order given,
/// whatever the number of threads; what was found in folders and is read as a part of another file is left out and named
/// in the summary, which is always there.
/// Failure: stopped (cancelled), or a worker says that the command line is wrong (usage).
Result<Report> validate_many(const FoundFiles& files, const ManyOptions& options);

}  // namespace geomend
