// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

extern char** environ;

namespace geomend::test {

/// What a run of the program came to.
struct ProgramRun {
    int status = -1;  ///< exit status; 128 + signal where a signal ended it
    std::string out, err;
};

/// Runs geomend as a user would, with standard output and error kept. `input` is its standard input.
inline ProgramRun run_geomend(const std::vector<std::string>& arguments, const std::filesystem::path& input = "/dev/null") {
    const TemporaryFolder folder;
    const auto out = folder / "out", err = folder / "err";
    const pid_t child = ::fork();
    if (child == 0) {
        const int in_fd = ::open(input.c_str(), O_RDONLY);
        const int out_fd = ::open(out.c_str(), O_WRONLY | O_CREAT, 0600);
        const int err_fd = ::open(err.c_str(), O_WRONLY | O_CREAT, 0600);
        ::dup2(in_fd, 0);
        ::dup2(out_fd, 1);
        ::dup2(err_fd, 2);
        std::vector<std::string> all{GEOMEND_PROGRAM};
        all.insert(all.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& a : all) argv.push_back(a.data());
        argv.push_back(nullptr);
        ::alarm(120);  // a run that hangs is ended by SIGALRM
        ::execve(argv[0], argv.data(), environ);
        ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ProgramRun run;
    run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    run.out = read_file(out);
    run.err = read_file(err);
    return run;
}

/// info --json of one file: its object in the array, or null where the program failed.
inline nlohmann::json info(const std::filesystem::path& file, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"info", "--json", file.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_geomend(arguments);
    if (run.status != 0) return nullptr;
    const auto all = nlohmann::json::parse(run.out, nullptr, false);
    return all.is_array() && all.size() == 1 ? all[0] : nlohmann::json(nullptr);
}

}  // namespace geomend::test
