// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/wide_loops.h"

#include <algorithm>
#include <bit>

#include "formats/eclipse/byte_order.h"

// Compiled with -O3 (CMakeLists.txt). Sanitisers do not get along with functions that are chosen while a program is loaded.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__clang__)
#define GEOMEND_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define GEOMEND_WIDE
#endif

namespace geomend::eclipse {

GEOMEND_WIDE bool widen(const char* bytes, std::size_t count, double* to) {
    constexpr std::uint32_t exponent = 0x7f800000u;  // all of its bits are set where a real is not finite
    std::uint32_t most = 0;
    for (std::size_t i = 0; i != count; ++i) {
        const std::uint32_t word = word_at(bytes + 4 * i);
        most = std::max(most, word & exponent);
        to[i] = static_cast<double>(std::bit_cast<float>(word));
    }
    return most != exponent;
}

GEOMEND_WIDE std::uint32_t narrow(const char* bytes, std::size_t count, std::uint8_t* to) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i != count; ++i) {
        const std::uint32_t word = word_at(bytes + 4 * i);
        bits |= word;
        to[i] = static_cast<std::uint8_t>(word);
    }
    return bits;
}

}  // namespace geomend::eclipse
