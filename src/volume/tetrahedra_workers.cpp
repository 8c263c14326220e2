// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/tetrahedra_workers.h"

#include <unistd.h>

#include <cstdlib>
#include <utility>

#include "volume/tetrahedra.h"

namespace geomend::volumes {

TetrahedraWorkers::TetrahedraWorkers(std::vector<std::string> program) : command_(std::move(program)) {
    if (command_.empty()) command_.push_back(this_program());
    command_.insert(command_.end(), {worker_word, std::to_string(::getpid())});
}

Result<WorkerEnd> TetrahedraWorkers::ask(std::string_view request, const WorkerJob& limits, const Monitor* monitor) {
    std::unique_ptr<ServingWorker> worker;
    {
        const std::scoped_lock lock(mutex_);
        if (!idle_.empty()) {
            worker = std::move(idle_.back());
            idle_.pop_back();
        }
    }
    if (!worker) worker = std::make_unique<ServingWorker>(command_);
    auto end = worker->ask(request, limits, monitor);
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(worker));
    return end;
}

std::string request_text(const TetrahedraRequest& request) {
    return request.switches + '\n' + std::to_string(request.memory_bytes) + '\n' + request.path;
}

TetrahedraRequest request_of(const std::string& text) {
    const std::size_t first = text.find('\n'), second = text.find('\n', first + 1);
    return {text.substr(0, first), text.substr(second + 1), std::strtoull(text.c_str() + first + 1, nullptr, 10)};
}

}  // namespace geomend::volumes
