// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"
#include "base/serving_worker.h"
#include "base/worker.h"

namespace geomend::volumes {

/// Child processes that stay for one region after the other, so that not each of many small ones starts a program: for each question one
/// of them forks, so limits of memory hold for that alone, and nothing that goes wrong is left behind. One that crashes, runs out of time
/// or is stopped is gone, and a new one takes its place. As many as there are threads that ask at the same time; all end with this.
class TetrahedraWorkers {
public:
    /// \param program the command to which arguments are added; empty: this program
    explicit TetrahedraWorkers(std::vector<std::string> program = {});

    /// Asks one that nobody else asks. How it came to its end is as of run_worker(); `limits.command` is not used.
    Result<WorkerEnd> ask(std::string_view request, const WorkerJob& limits, const Monitor* monitor);

private:
    std::vector<std::string> command_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<ServingWorker>> idle_;
};

/// What one of them is asked: to fill what stands in a file.
struct TetrahedraRequest {
    std::string switches, path;
    std::uint64_t memory_bytes = 0;
};
std::string request_text(const TetrahedraRequest& request);
/// \pre a text of request_text()
TetrahedraRequest request_of(const std::string& text);

}  // namespace geomend::volumes
