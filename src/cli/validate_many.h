// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "cli/exit_status.h"
#include "pipeline/find_files.h"
#include "pipeline/validate_many.h"

namespace geomend::cli {

/// Limits of each file of a run over many, and whether this process is the worker for one of them.
struct WorkerArguments {
    double seconds = 600;
    double megabytes = 0;      ///< 0: none; where it is not given, four fifths of the machine's memory
    std::int64_t parent = 0;   ///< of a worker: the process that started it; 0: this is none
    std::size_t run_size = 1;  ///< of a worker: that the report will be about
    bool serves = false;       ///< of a worker: it is asked for one file after the other
    bool limits_given = false;
    bool is_worker() const { return parent != 0; }
};

void add_worker_arguments(CLI::App& command, WorkerArguments& arguments);

/// First of all in a worker: its limits. Nothing elsewhere.
void settle_worker(const WorkerArguments& arguments, std::size_t threads);

/// What a worker says of a file.
struct WorkerAnswer {
    ExitStatus status = ExitStatus::done;
    std::string report;
};

/// In a worker that serves: judges one file after the other as it is asked for them. It takes no further one when much
/// memory stays taken.
ExitStatus serve(const WorkerArguments& arguments, std::size_t threads, const std::function<WorkerAnswer(const std::string& path)>& judge);

/// Whether files go to workers: more than one, found in folders or by patterns, or under limits that were asked for.
bool need_workers(const FoundFiles& files, const WorkerArguments& arguments);

/// Judges them there, with the options that this command was given. The status gets the worst of those that could not be
/// judged, which are told on standard error.
Result<Report> judge_in_workers(const CLI::App& command, const FoundFiles& files, const WorkerArguments& arguments, std::size_t threads,
                                const Monitor* monitor, ExitStatus& status);

}  // namespace geomend::cli
