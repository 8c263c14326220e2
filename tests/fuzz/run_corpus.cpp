// SPDX-License-Identifier: AGPL-3.0-or-later
// Runs a fuzz target over its seeds and fixed changes of them where there is no libFuzzer: run_corpus FOLDER.
// A crash tells which change of which seed made it, and leaves those bytes in crash-<target>.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "mutations.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace {

// What is being tried now, for the handler of signals, which may only read plain memory.
const std::string* current_bytes = nullptr;
char current_story[512];
char crash_file[256];

void put(int file, std::string_view text) {
    if (::write(file, text.data(), text.size()) < 0) return;
}

void tell_what_was_tried() {
    put(STDERR_FILENO, "\ncrashed by ");
    put(STDERR_FILENO, current_story);
    put(STDERR_FILENO, "\n");
    if (current_bytes == nullptr) return;
    const int file = ::open(crash_file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0) return;
    put(file, *current_bytes);
    ::close(file);
}

void on_signal(int signal) {
    tell_what_was_tried();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void watch_crashes() {
    for (const int signal : {SIGABRT, SIGTERM}) std::signal(signal, &on_signal);
    if (__sanitizer_set_death_callback != nullptr) {
        __sanitizer_set_death_callback(&tell_what_was_tried);
        return;
    }
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, &on_signal);
    // The seeds are small: whoever asks for gigabytes believes a count that no bytes stand behind.
    const rlimit limit{std::uint64_t{3} << 30, std::uint64_t{3} << 30};
    if (::setrlimit(RLIMIT_AS, &limit) != 0) std::perror("setrlimit");
}

std::vector<std::filesystem::path> seeds_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> seeds;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (entry.is_regular_file()) seeds.push_back(entry.path());
    }
    std::sort(seeds.begin(), seeds.end());
    return seeds;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: fuzz_<reader> FOLDER\n", stderr);
        return 2;
    }
    std::snprintf(crash_file, sizeof crash_file, "crash-%s", std::filesystem::path(arguments[0]).filename().c_str());
    watch_crashes();
    const auto seeds = seeds_in(arguments[1]);
    if (seeds.empty()) {
        std::fprintf(stderr, "no seeds in %s\n", arguments[1]);
        return 1;
    }
    std::size_t runs = 0;
    for (const auto& path : seeds) {
        std::ifstream file(path, std::ios::binary);
        const std::string seed{std::istreambuf_iterator<char>(file), {}};
        geomend::test::for_each_mutation(seed, [&](const std::string& bytes, std::string_view change) {
            std::snprintf(current_story, sizeof current_story, "%s: %.*s", path.filename().c_str(), static_cast<int>(change.size()),
                          change.data());
            current_bytes = &bytes;
            LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
            current_bytes = nullptr;
            ++runs;
        });
    }
    std::printf("%zu seeds, %zu runs\n", seeds.size(), runs);
    return 0;
}
