// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/mapped_pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cinttypes>
#include <cstdint>
#include <cstdio>

namespace geomend {

namespace {

bool is_read_only_file(std::uintptr_t first, std::uintptr_t last) {
    std::FILE* maps = std::fopen("/proc/self/maps", "re");
    if (maps == nullptr) return false;
    char line[4352];
    bool found = false;
    while (!found && std::fgets(line, sizeof line, maps) != nullptr) {
        std::uintptr_t begin = 0, end = 0;
        char mode[5] = {};
        unsigned long inode = 0;
        if (std::sscanf(line, "%" SCNxPTR "-%" SCNxPTR " %4s %*s %*s %lu", &begin, &end, mode, &inode) != 4) continue;
        if (begin > first || end <= first) continue;
        found = end >= last && inode != 0 && mode[0] == 'r' && mode[1] == '-';
        break;
    }
    std::fclose(maps);
    return found;
}

}  // namespace

void release_mapped_pages(std::string_view part) {
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<std::uintptr_t>(part.data());
    const std::uintptr_t first = (begin + page - 1) & ~(page - 1), last = (begin + part.size()) & ~(page - 1);
    if (first >= last || !is_read_only_file(first, last)) return;
    static_cast<void>(::madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED));
}

}  // namespace geomend
