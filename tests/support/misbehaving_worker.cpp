// SPDX-License-Identifier: AGPL-3.0-or-later
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "base/worker.h"
#include "report/report.h"

// A worker process that does what its last argument says: the name of a "file" up to the first dot, and what stands in
// the ending where it is a number. It stands in for the real one where tests need crashes and hangs.

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

int report_of(const std::string& path, bool valid) {
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
    std::fputs(report_json(report).c_str(), stdout);
    return valid ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string path = argc > 1 ? argv[argc - 1] : "", name = path.substr(path.rfind('/') + 1);
    const std::string what = name.substr(0, name.find('.'));
    const int number = name.find('.') == std::string::npos ? 0 : std::atoi(name.c_str() + name.find('.') + 1);
    if (what == "exit") return number;
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
    if (what == "garbage") {
        std::fputs("{\"schema\": 1, \"files\": [", stdout);
        return 0;
    }
    if (what == "swapped") return report_of("another file", true);
    if (what == "liar") return report_of(path, true) + 70;
    if (what == "slow") ::usleep(static_cast<unsigned>(number) * 1000);
    return report_of(path, what != "bad");
}
