// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/large_pages.h"

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace geomend {

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21;

/// How many large pages are free in one piece, by the system's list of free blocks: per zone the numbers of blocks of 1, 2, 4, ... pages
/// of 4 KiB; 512 of them are a large page. 0 where the system has no such list.
std::size_t free_large_pages() {
    constexpr std::size_t words_before = 4, order_of_large = 9;  // "Node 0, zone Normal"
    std::ifstream list("/proc/buddyinfo");
    std::size_t pages = 0;
    for (std::string line; std::getline(list, line);) {
        std::istringstream words(line);
        std::string word;
        for (std::size_t i = 0; i < words_before; ++i) words >> word;
        std::size_t order = 0;
        for (std::size_t blocks = 0; words >> blocks; ++order) {
            if (order >= order_of_large) pages += blocks << (order - order_of_large);
        }
    }
    return pages;
}

}  // namespace

bool ask_for_large_pages(const void* begin, std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    constexpr std::size_t least = 32;  // fewer are not worth a look at the list
    const auto at = reinterpret_cast<std::uintptr_t>(begin);
    const std::uintptr_t first = (at + large_page - 1) & ~(large_page - 1), last = (at + bytes) & ~(large_page - 1);
    if (last < first + least * large_page || free_large_pages() < 2 * ((last - first) / large_page)) return false;
    return ::madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE) == 0;
#else
    static_cast<void>(begin), static_cast<void>(bytes);
    return false;
#endif
}

}  // namespace geomend
