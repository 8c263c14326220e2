// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "base/monitor.h"
#include "pipeline/find_files.h"
#include "report/report.h"

namespace geomend {

/// How many files are validated, in processes that take one after the other.
struct ManyOptions {
    /// Starts a worker: program and arguments. "--worker-serves", "--threads", a number, "--" and "-" are put behind. It
    /// validates each file that it is asked for (base/serving_worker.h) and answers with worker_report() and the status that
    /// its outcome has. For standard input "--worker-serves" is left out: worker_report() goes to standard output.
    std::vector<std::string> worker;
    std::size_t threads = 0;  ///< for all workers together; 0: the number of processors
    double seconds = 0;       ///< of time for each file; 0: no limit
    const Monitor* monitor = nullptr;
};

/// What a worker says: report_json() of its one file, and behind a NUL its scene where there is one.
std::string worker_report(const Report& report);

/// Validates files in worker processes, as many at a time as there are threads. A worker that crashes, hangs or gives no
/// report that makes sense is a finding of its file (F025, F023); the others go on. Where a worker fails that has had other
/// files before, the file is given to a new one, whose outcome counts: no file has an influence on another. Files come back in the order
/// given, whatever the number of threads; what was found in folders and is read as a part of another file is left out and named in the
/// summary, which is always there. Failure: stopped (cancelled), or a worker says that the command line is wrong (usage).
Result<Report> validate_many(const FoundFiles& files, const ManyOptions& options);

}  // namespace geomend
