// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace geomend::eclipse {

inline std::uint32_t big_endian(std::uint32_t v) {
    if constexpr (std::endian::native == std::endian::little) v = __builtin_bswap32(v);
    return v;
}
inline std::uint64_t big_endian(std::uint64_t v) {
    if constexpr (std::endian::native == std::endian::little) v = __builtin_bswap64(v);
    return v;
}

/// The big-endian word at a place.
inline std::uint32_t word_at(const char* p) {
    std::uint32_t v = 0;
    std::memcpy(&v, p, sizeof v);
    return big_endian(v);
}
inline std::uint64_t long_word_at(const char* p) {
    std::uint64_t v = 0;
    std::memcpy(&v, p, sizeof v);
    return big_endian(v);
}
inline void put_word(char* p, std::uint32_t v) {
    v = big_endian(v);
    std::memcpy(p, &v, sizeof v);
}
inline void put_long_word(char* p, std::uint64_t v) {
    v = big_endian(v);
    std::memcpy(p, &v, sizeof v);
}

}  // namespace geomend::eclipse
