// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"

namespace geomend {

/// Work for a process of its own.
struct WorkerJob {
    std::vector<std::string> command;                ///< the program's path and its arguments
    bool reads_standard_input = false;               ///< else its standard input is empty
    double seconds = 0;                              ///< time on the wall after which it is killed; 0: no limit
    std::size_t most_output = std::size_t{1} << 29;  ///< bytes of standard output after which it is killed
};

/// How a worker came to its end.
struct WorkerEnd {
    enum class How : std::uint8_t {
        exited,           ///< `number` is its exit status
        signalled,        ///< `number` is the signal, which we did not send
        timed_out,        ///< killed by us after `seconds`
        too_much_output,  ///< killed by us
        stopped           ///< the monitor stopped us, and we stopped it
    };
    How how = How::exited;
    int number = 0;
    std::string output;      ///< what it wrote to standard output
    std::string last_words;  ///< the end of what it wrote to standard error, at most 4 KiB
    double seconds = 0;      ///< how long it took
};

/// Starts a program (posix_spawn, never a fork that goes on) in a process group of its own, and waits for its end. When
/// the monitor stops, the worker gets SIGTERM, and SIGKILL two seconds later. No process is left behind. May be called
/// from several threads at once. Failure (limit) where no process can be started.
Result<WorkerEnd> run_worker(const WorkerJob& job, const Monitor* monitor = nullptr);

/// The path by which this very executable is started anew, even where its file has been replaced since.
std::string this_program();

/// What a worker imposes on itself.
struct OwnLimits {
    double processor_seconds = 0;    ///< of all its threads; 0: no limit
    std::uint64_t memory_bytes = 0;  ///< of memory that it writes to, mapped files not counted; 0: no limit
    std::int64_t parent = 0;         ///< number of the process that started it; 0: not known
};

/// For a worker, first of all: sets its limits, so that memory beyond them is refused (std::bad_alloc) and time ends with
/// SIGXCPU; writes no core file; dies with its parent, at once where that is gone already; and asks the system to end it
/// before others when memory is short. In builds with address sanitiser the memory limit is left out, because that
/// reserves terabytes.
void become_worker(const OwnLimits& limits);

/// Memory of the machine in bytes; 0 where it is not known.
std::uint64_t machine_memory();

/// "signal 11 (Segmentation fault)".
std::string signal_text(int signal);

}  // namespace geomend
