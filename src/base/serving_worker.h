// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"
#include "base/worker.h"

namespace geomend {

struct DescriptorPair;

/// A worker process that takes one request after the other, so that not each of many small ones starts a program. It is
/// started when the first request comes, and anew when it has ended. One thread at a time uses it, the same from start to
/// end: the process dies with the thread that started it.
class ServingWorker {
public:
    /// \pre `command` is a program that calls next_request() and answer_request().
    explicit ServingWorker(std::vector<std::string> command);
    ~ServingWorker();
    ServingWorker(const ServingWorker&) = delete;
    ServingWorker& operator=(const ServingWorker&) = delete;

    /// Whether the next request will be the first one of its process, on which nothing earlier has an influence.
    bool is_fresh() const { return answered_ == 0; }

    /// Sends a request and waits for its answer: `exited` with the status and output that the worker answered with. Where the
    /// process ends without an answer, that is how it came to its end, with no output; it is killed after `limits.seconds`
    /// or `limits.most_output`, and stopped with the monitor. Failure (limit) where no process can be started.
    Result<WorkerEnd> ask(std::string_view request, const WorkerJob& limits, const Monitor* monitor = nullptr);

    /// Ends the process; the next request gets a new one.
    void end();

private:
    class Wait;
    std::vector<std::string> command_;
    std::unique_ptr<DescriptorPair> talk_, words_;
    pid_t child_ = -1;
    std::size_t answered_ = 0;

    Result<void> start();
};

/// In the worker: waits for a request; nothing when there will be no more.
std::optional<std::string> next_request();

/// In the worker: answers the last request. `last`: it takes no other one, and ends. False where nobody listens.
bool answer_request(int status, std::string_view output, bool last);

/// In the worker, before each request: its processor time begins anew; 0 is no limit.
void renew_processor_time(double seconds);

/// Bytes of memory that this process may write to, after what is free has been given back. 0 where it is not known.
std::uint64_t memory_held();

}  // namespace geomend
