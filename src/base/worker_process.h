// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <array>
#include <string>
#include <vector>

#include "base/result.h"

namespace geomend {

/// A pair of descriptors of which a program that is started gets what it is given and no more; closed at its end.
struct DescriptorPair {
    std::array<int, 2> ends{-1, -1};

    DescriptorPair() = default;
    DescriptorPair(const DescriptorPair&) = delete;
    DescriptorPair& operator=(const DescriptorPair&) = delete;
    ~DescriptorPair() {
        close_end(0);
        close_end(1);
    }
    bool open();         ///< a pipe, from end 1 to end 0
    bool open_socket();  ///< both ways
    void close_end(std::size_t end);
};

/// A program to start, and what its standard streams are.
struct StartPlan {
    std::vector<std::string> command;
    int in = -1;  ///< standard input; -1: ours where it stays in our group, else nothing
    int out = -1, err = -1;
    bool own_group = true;  ///< so that it is we who stop it; one that reads the terminal must stay in ours
};

/// Starts a program by posix_spawn, with no signal blocked and none ignored that we ignore. Failure: limit.
Result<pid_t> start_process(const StartPlan& plan);

/// What is said where not even a pipe can be opened (errno).
Failure no_pipe();

}  // namespace geomend
