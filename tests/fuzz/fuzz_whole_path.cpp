// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <cstring>
#include <string>

#include "mutator.h"
#include "whole_path.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static_cast<void>(geomend::test::run_whole_path({reinterpret_cast<const char*>(data), size}));
    return 0;
}

// libFuzzer's own changes of bytes seldom get behind a parser: two of three changes are ours.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most) __attribute__((weak));
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    if (seed % 3 == 0 && LLVMFuzzerMutate != nullptr) return LLVMFuzzerMutate(data, size, most);
    geomend::test::FuzzRandom random(seed);
    std::string bytes = geomend::test::mutated({reinterpret_cast<const char*>(data), size}, {}, random);
    if (bytes.size() > most) bytes.resize(most);
    std::memcpy(data, bytes.data(), bytes.size());
    return bytes.size();
}
extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* a, std::size_t size_a, const std::uint8_t* b, std::size_t size_b,
                                                 std::uint8_t* out, std::size_t most, unsigned seed) {
    geomend::test::FuzzRandom random(seed);
    const std::string other(reinterpret_cast<const char*>(b), size_b);
    std::string bytes = geomend::test::mutated({reinterpret_cast<const char*>(a), size_a}, {&other, 1}, random);
    if (bytes.size() > most) bytes.resize(most);
    std::memcpy(out, bytes.data(), bytes.size());
    return bytes.size();
}
