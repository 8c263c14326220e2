// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "base/large_pages.h"
#include "base/parallel.h"

namespace geomend {

/// Gives a large array its length, with zeros. The same as resize(), but its pages are fetched by several threads,
/// since for arrays of hundreds of megabytes that costs more than filling them. They are large ones where enough are free.
/// \pre array.empty()
template <class T>
void make_big(std::vector<T>& array, std::size_t count) {
    array.reserve(count);
    ask_for_large_pages(array);
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
    constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
    const std::size_t bytes = count * sizeof(T);
    if (bytes >= 8 * page) {
        const auto begin = reinterpret_cast<std::uintptr_t>(array.data());
        const std::uintptr_t first = (begin + page - 1) & ~(page - 1), last = (begin + bytes) & ~(page - 1);
        // Only advice: where the kernel does not take it, resize() below fetches the pages.
        parallel_blocks((last - first) / page, 4, [&](std::size_t from, std::size_t to) {
            static_cast<void>(::madvise(reinterpret_cast<void*>(first + from * page), (to - from) * page, MADV_POPULATE_WRITE));
        });
    }
#endif
    array.resize(count);
}

}  // namespace geomend
