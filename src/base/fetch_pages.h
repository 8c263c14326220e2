// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace geomend {

/// Has the system fetch the memory behind the values [first, first + count) of an array that is reserved but not yet that
/// long: all its pages together, which costs less than one after the other as they are touched. Done piece by piece, each
/// smaller than the cache and filled right after, it costs less than make_big() (base/big_array.h), which is for arrays
/// that several threads fill. Only advice: where the system does not take it, the pages come when they are touched.
/// \pre first + count <= array.capacity()
template <class T>
void fetch_pages(std::vector<T>& array, std::size_t first, std::size_t count) {
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
    constexpr std::uintptr_t page = 4096;
    const auto begin = reinterpret_cast<std::uintptr_t>(array.data());
    const std::uintptr_t from = (begin + first * sizeof(T) + page - 1) & ~(page - 1),
                         to = (begin + (first + count) * sizeof(T)) & ~(page - 1);
    if (to > from) static_cast<void>(::madvise(reinterpret_cast<void*>(from), to - from, MADV_POPULATE_WRITE));
#else
    static_cast<void>(array), static_cast<void>(first), static_cast<void>(count);
#endif
}

}  // namespace geomend
