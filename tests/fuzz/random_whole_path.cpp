// SPDX-License-Identifier: AGPL-3.0-or-later
// Runs random changes of seeds through the whole path: random_whole_path FOUND FIRST COUNT SEEDS...
// Input number i of FIRST .. FIRST+COUNT-1 is made from i and the seeds alone; the lowest numbers are the seeds themselves. They run in a
// child process; one that it dies of, or that takes longer than it may, is left in the folder FOUND as I.pack beside what was said, I.log,
// and a new child goes on behind it. random_whole_path --one FILE runs one input in this process; --make I SEEDS... prints input number I.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <new>
#include <string>
#include <vector>

#include "base/sanitisers.h"
#include "mutator.h"
#include "whole_path.h"

namespace {

namespace fs = std::filesystem;
using namespace geomend::test;
using geomend::with_address_sanitiser;

// Set where another program watches over this one (valgrind): processor seconds that one input may take then.
const char* watched_seconds() { return std::getenv("GEOMEND_FUZZ_SECONDS"); }

// CPU seconds that one input may take, and seconds without progress after which a child is ended.
int most_seconds() { return watched_seconds() != nullptr ? std::atoi(watched_seconds()) : with_address_sanitiser ? 40 : 10; }
constexpr int most_wait = 300;

// What parent and child share.
struct Progress {
    std::atomic<std::uint64_t> current;
    std::atomic<std::uint64_t> slowest;
    std::atomic<double> slowest_seconds;
    std::atomic<std::uint64_t> over_a_second;
    std::atomic<std::uint64_t> read;
};

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> seeds_in(const std::vector<std::string>& folders) {
    std::vector<fs::path> paths;
    for (const std::string& folder : folders) {
        for (const auto& entry : fs::directory_iterator(folder)) {
            if (entry.path().extension() == ".pack") paths.push_back(entry.path());
        }
    }
    std::ranges::sort(paths);
    std::vector<std::string> seeds;
    for (const fs::path& path : paths) seeds.push_back(bytes_of(path));
    return seeds;
}

// The first numbers are the seeds as they are.
std::string input_number(std::uint64_t i, const std::vector<std::string>& seeds) {
    if (i < seeds.size()) return seeds[i];
    FuzzRandom random(i);
    const std::string& seed = seeds[random.below(seeds.size())];
    return mutated(seed, seeds, random);
}

void set_timer(int seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = seconds;
    ::setitimer(ITIMER_PROF, &timer, nullptr);  // its signal ends the process
}

double cpu_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void limit_memory() {
    if (with_address_sanitiser || watched_seconds() != nullptr) return;  // whose shadow takes terabytes of addresses
    const rlimit limit{std::uint64_t{3} << 30, std::uint64_t{3} << 30};
    if (::setrlimit(RLIMIT_AS, &limit) != 0) std::perror("setrlimit");
}

void work(Progress& progress, std::uint64_t end, const std::vector<std::string>& seeds) {
    limit_memory();
    for (std::uint64_t i = progress.current; i < end; ++i) {
        progress.current = i;
        const std::string bytes = input_number(i, seeds);
        const double before = cpu_seconds();
        set_timer(most_seconds());
        if (run_whole_path(bytes)) ++progress.read;
        set_timer(0);
        const double seconds = cpu_seconds() - before;
        if (seconds > progress.slowest_seconds) {
            progress.slowest_seconds = seconds;
            progress.slowest = i;
        }
        if (seconds > 1) ++progress.over_a_second;
    }
    progress.current = end;
}

// Waits for a child; one that makes no progress for long is ended. Returns its status.
int wait_for(pid_t child, const Progress& progress) {
    std::uint64_t last = progress.current;
    int waited = 0;
    for (;;) {
        int status = 0;
        if (::waitpid(child, &status, WNOHANG) == child) return status;
        ::usleep(100000);
        const std::uint64_t now = progress.current;
        waited = now == last ? waited + 1 : 0;
        last = now;
        if (waited > 10 * most_wait) ::kill(child, SIGKILL);
    }
}

// What a log says in one line, without its numbers: findings of one kind are listed once.
std::string kind_of(const std::string& log, int status) {
    std::string kind;
    for (const char* mark : {"BROKEN: ", "SUMMARY: ", "runtime error: ", "what(): ", "Assertion"}) {
        const std::size_t at = log.find(mark);
        if (at == std::string::npos) continue;
        kind = log.substr(at, log.find('\n', at) - at);
        break;
    }
    if (kind.empty()) kind = WIFSIGNALED(status) ? std::string("signal ") + ::strsignal(WTERMSIG(status)) : "exit status";
    return kind.substr(0, 200);
}

std::string without_digits(std::string text) {
    std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
    return text;
}

int run_many(const fs::path& found, std::uint64_t first, std::uint64_t count, const std::vector<std::string>& seeds) {
    fs::create_directories(found);
    void* shared = ::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) return 2;
    auto& progress = *new (shared) Progress{};
    progress.current = first;
    std::map<std::string, int> kinds;
    int crashes = 0;
    const std::string log = (found / ("log-" + std::to_string(first))).string();
    const std::time_t start = std::time(nullptr);
    while (progress.current < first + count) {
        const pid_t child = ::fork();
        if (child == 0) {
            const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
            if (file >= 0) ::dup2(file, STDERR_FILENO);
            work(progress, first + count, seeds);
            ::_exit(0);
        }
        const int status = wait_for(child, progress);
        std::error_code ignored;
        for (const char* memory : {"/dev/shm", "/tmp"})
            fs::remove_all(fs::path(memory) / ("geomend-fuzz-" + std::to_string(child)), ignored);
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
        const std::uint64_t i = progress.current;
        ++crashes;
        const std::string kind = kind_of(bytes_of(log), status);
        if (++kinds[without_digits(kind)] <= 3) {
            const std::string bytes = input_number(i, seeds);
            std::ofstream(found / (std::to_string(i) + ".pack"), std::ios::binary) << bytes;
            fs::copy_file(log, found / (std::to_string(i) + ".log"), fs::copy_options::overwrite_existing, ignored);
            std::printf("%llu: %s [%s]\n", static_cast<unsigned long long>(i), kind.c_str(), plan_text(unpack(bytes)).c_str());
            std::fflush(stdout);
        }
        progress.current = i + 1;
    }
    std::printf("%llu inputs from %zu seeds in %lld s: %llu could be read, %d failed; slowest %llu with %.2f s, %llu over one second\n",
                static_cast<unsigned long long>(count), seeds.size(), static_cast<long long>(std::time(nullptr) - start),
                static_cast<unsigned long long>(progress.read.load()), crashes, static_cast<unsigned long long>(progress.slowest.load()),
                progress.slowest_seconds.load(), static_cast<unsigned long long>(progress.over_a_second.load()));
    for (const auto& [kind, times] : kinds) std::printf("%6d  %s\n", times, kind.c_str());
    // Hostile inputs that stop at the door say nothing about the house.
    const bool too_few = count >= 100 && 10 * progress.read < count;
    if (too_few) std::puts("fewer than one in ten could be read");
    return crashes == 0 && !too_few ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
    const std::vector<std::string> arguments(words + 1, words + count);
    if (arguments.size() == 2 && arguments[0] == "--one") {
        const std::string bytes = bytes_of(arguments[1]);
        std::fprintf(stderr, "%s\n", plan_text(unpack(bytes)).c_str());
        limit_memory();
        std::fputs(run_whole_path(bytes) ? "read\n" : "cannot be read\n", stderr);
        return 0;
    }
    if (arguments.size() >= 3 && arguments[0] == "--make") {
        const auto seeds = seeds_in({arguments.begin() + 2, arguments.end()});
        const std::string bytes = input_number(std::strtoull(arguments[1].c_str(), nullptr, 10), seeds);
        return std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() ? 0 : 1;
    }
    if (arguments.size() < 4) {
        std::fputs("usage: random_whole_path FOUND FIRST COUNT SEEDS...\n", stderr);
        return 2;
    }
    const auto seeds = seeds_in({arguments.begin() + 3, arguments.end()});
    if (seeds.empty()) {
        std::fputs("no seeds (*.pack) there\n", stderr);
        return 2;
    }
    return run_many(arguments[0], std::strtoull(arguments[1].c_str(), nullptr, 10), std::strtoull(arguments[2].c_str(), nullptr, 10),
                    seeds);
}
