// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/worker_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>

extern char** environ;

namespace geomend {

namespace {

std::string reason(int error) { return std::error_code(error, std::generic_category()).message(); }

// What posix_spawn is given; its parts are set up and torn down together.
struct SpawnParts {
    posix_spawn_file_actions_t actions{};
    posix_spawnattr_t attributes{};

    SpawnParts() {
        ::posix_spawn_file_actions_init(&actions);
        ::posix_spawnattr_init(&attributes);
    }
    ~SpawnParts() {
        ::posix_spawn_file_actions_destroy(&actions);
        ::posix_spawnattr_destroy(&attributes);
    }
    SpawnParts(const SpawnParts&) = delete;
    SpawnParts& operator=(const SpawnParts&) = delete;
};

}  // namespace

bool DescriptorPair::open() { return ::pipe2(ends.data(), O_CLOEXEC) == 0; }

bool DescriptorPair::open_socket() { return ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0; }

void DescriptorPair::close_end(std::size_t end) {
    if (ends[end] >= 0) ::close(ends[end]);
    ends[end] = -1;
}

Result<pid_t> start_process(const StartPlan& plan) {
    SpawnParts parts;
    short flags = POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF;
    sigset_t none, usual;
    ::sigemptyset(&none);
    ::sigemptyset(&usual);
    for (const int s : {SIGINT, SIGTERM, SIGPIPE}) ::sigaddset(&usual, s);
    ::posix_spawnattr_setsigmask(&parts.attributes, &none);
    ::posix_spawnattr_setsigdefault(&parts.attributes, &usual);
    if (plan.in >= 0) ::posix_spawn_file_actions_adddup2(&parts.actions, plan.in, STDIN_FILENO);
    else if (plan.own_group) ::posix_spawn_file_actions_addopen(&parts.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&parts.actions, plan.out, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&parts.actions, plan.err, STDERR_FILENO);
    if (plan.own_group) {
        ::posix_spawnattr_setpgroup(&parts.attributes, 0);
        flags |= POSIX_SPAWN_SETPGROUP;
    }
    ::posix_spawnattr_setflags(&parts.attributes, flags);
    std::vector<std::string> texts = plan.command;
    std::vector<char*> arguments;
    for (std::string& text : texts) arguments.push_back(text.data());
    arguments.push_back(nullptr);
    pid_t child = -1;
    const int error = ::posix_spawn(&child, arguments[0], &parts.actions, &parts.attributes, arguments.data(), environ);
    if (error != 0) return failure(FailureKind::limit, "F023", {}, "cannot start a worker process: " + reason(error));
    return child;
}

Failure no_pipe() { return failure(FailureKind::limit, "F023", {}, "cannot open a pipe to a worker process: " + reason(errno)); }

}  // namespace geomend
