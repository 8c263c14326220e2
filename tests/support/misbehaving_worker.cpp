// SPDX-License-Identifier: AGPL-3.0-or-later
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "base/serving_worker.h"
#include "base/worker.h"
#include "report/report.h"

// A worker process that does what its last argument says: the name of a "file" up to the first dot, and what stands in
// the ending where it is a number. It stands in for the real one where tests need crashes and hangs. With "--worker-serves"
// it does so for one request after the other.

namespace {

using namespace geomend;

// Memory is touched, so that it is really taken.
int eat() {
    std::vector<std::unique_ptr<std::vector<char>>> all;
    try {
        for (int block = 0; block < 512; ++block) all.push_back(std::make_unique<std::vector<char>>(1u << 20, 'x'));
    } catch (const std::bad_alloc&) {
        std::fputs("refused\n", stderr);
        return 5;
    }
    return 0;
}

[[noreturn]] void hang() {
    for (;;) ::pause();
}

int spin() {
    volatile unsigned long n = 0;
    for (;;) n = n + 1;
}

// Leaves a process behind that holds the pipes.
int leave_a_child() {
    if (::fork() == 0) hang();
    return 0;
}

// How many requests this process has had, and whether it answers them.
int requests = 0;
bool serves = false;

int say(const std::string& text, int status) {
    if (serves) return answer_request(status, text, false) ? 0 : 1;
    std::fputs(text.c_str(), stdout);
    return status;
}

int report_of(const std::string& path, bool valid, int more_status = 0) {
    Report report;
    report.tool = "geomend test";
    ReportedFile& file = report.files.emplace_back();
    file.file = path;
    file.valid = valid;
    file.tolerance = 0.25;
    if (!valid) {
        Finding& f = file.findings.emplace_back();
        f.code = "C03";
        f.severity = Severity::error;
        f.message = "made up";
    }
    return say(report_json(report), (valid ? 0 : 1) + more_status);
}

/// \return the exit status; of one that serves, whether it has to end
int act(const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    const std::string what = name.substr(0, name.find('.'));
    const int number = name.find('.') == std::string::npos ? 0 : std::atoi(name.c_str() + name.find('.') + 1);
    if (what == "exit") {
        if (serves) std::exit(number);
        return number;
    }
    if (what == "pid") return say(std::to_string(::getpid()), 0);
    // What earlier requests have broken shows in a later one.
    if (what == "poisoned" && requests > 1) std::abort();
    if (what == "hang") hang();
    if (what == "stubborn") {
        std::signal(SIGTERM, SIG_IGN);
        hang();
    }
    if (what == "deaf") {
        ::close(1);
        ::close(2);
        hang();
    }
    if (what == "crash") {
        std::fputs("about to fall over\n", stderr);
        std::fflush(stderr);
        std::signal(number, SIG_DFL);
        ::raise(number);
    }
    if (what == "orphan") return leave_a_child();
    if (what == "eat") {
        become_worker({0, std::uint64_t(number) << 20, 0});
        return eat();
    }
    if (what == "spin") {
        become_worker({double(number), 0, 0});
        return spin();
    }
    if (what == "flood") {
        for (;;) std::fputs("more and more and more\n", stdout);
    }
    if (what == "echo") {
        for (int c = std::getchar(); c != EOF; c = std::getchar()) std::putchar(c);
        return 0;
    }
    if (what == "big") {
        for (int i = 0; i < number; ++i) std::fputs("0123456789abcdef", stdout);
        return 0;
    }
    if (what == "garbage") return say("{\"schema\": 1, \"files\": [", 0);
    if (what == "swapped") return report_of("another file", true);
    if (what == "liar") return report_of(path, true, 70);
    if (what == "slow") ::usleep(static_cast<unsigned>(number) * 1000);
    return report_of(path, what != "bad");
}

}  // namespace

int main(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) serves = serves || std::string_view(argv[i]) == "--worker-serves";
    if (!serves) return act(argc > 1 ? argv[argc - 1] : "");
    while (const auto path = next_request()) {
        ++requests;
        if (act(*path) != 0) return 1;
    }
    return 0;
}
