// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <string_view>

// Figures that were asked for, each printed as one line beside what was measured. Processor seconds of all threads of this
// process, kernel included; of several rounds the least counts, and what is compared takes turns, so that the figures hold on a
// machine that does other work. With the argument --asked a program prints these lines only.

namespace geomend::bench {

/// Processor seconds of this process so far, user and system.
inline double cpu_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds on the clock on the wall.
inline double wall_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The least of several rounds.
struct Least {
    double cpu = 1e300, wall = 1e300;
    template <class Body>
    void take(const Body& body) {
        const double cpu_start = cpu_seconds(), wall_start = wall_seconds();
        body();
        cpu = std::min(cpu, cpu_seconds() - cpu_start);
        wall = std::min(wall, wall_seconds() - wall_start);
    }
};

/// Prints what was asked and what was measured, as a ratio of processor seconds to those of a yardstick.
inline void print_ratio(const char* what, double asked, const Least& measured, const char* yardstick, const Least& other) {
    std::printf("%-44s asked %5.2f  measured %5.2f  x %s (%.3f s against %.3f s of processor; on the wall %.3f s against %.3f s)\n", what,
                asked, measured.cpu / other.cpu, yardstick, measured.cpu, other.cpu, measured.wall, other.wall);
}

/// The same of work and yardstick that take turns.
template <class Work, class Yardstick>
void compare(const char* what, double asked, const Work& work, const char* name, const Yardstick& yardstick, int rounds = 5) {
    Least own, other;
    for (int round = 0; round < rounds; ++round) {
        other.take(yardstick);
        own.take(work);
    }
    print_ratio(what, asked, own, name, other);
}

/// Prints what was asked and what was measured, in a unit.
inline void print_figure(const char* what, double asked, double measured, const char* unit) {
    std::printf("%-44s asked %5.2f  measured %5.2f %s\n", what, asked, measured, unit);
}

/// The least that a reader of a text has to do: turn every number into a value, on one thread.
inline void bare_from_chars(std::string_view text) {
    const char* p = text.data();
    const char* const end = p + text.size();
    double sum = 0;
    while (p != end) {
        if ((*p >= '0' && *p <= '9') || *p == '-' || *p == '+') {
            double value = 0;
            const auto [stop, error] = std::from_chars(p, end, value);
            sum += value;
            p = stop == p ? p + 1 : stop;
        } else {
            ++p;
        }
    }
    benchmark::DoNotOptimize(sum);
}

/// The main function of a program: its benchmarks, then print(), which prints the figures that were asked for.
template <class Print>
void run(int argc, char** argv, const Print& print) {
    const bool only_asked = argc == 2 && std::strcmp(argv[1], "--asked") == 0, everything = argc == 1;
    if (!only_asked) {
        benchmark::Initialize(&argc, argv);
        benchmark::RunSpecifiedBenchmarks();
    }
    if (only_asked || everything) print();
}

}  // namespace geomend::bench
