// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/process_memory.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace geomend {

double peak_memory() {
    std::FILE* status = std::fopen("/proc/self/status", "re");
    if (status == nullptr) return 0;
    char line[256];
    unsigned long long kilobytes = 0;
    while (std::fgets(line, sizeof line, status) != nullptr && std::sscanf(line, "VmHWM: %llu", &kilobytes) != 1) {
    }
    std::fclose(status);
    return 1024.0 * static_cast<double>(kilobytes);
}

void forget_peak_memory() {
    const int file = ::open("/proc/self/clear_refs", O_WRONLY | O_CLOEXEC);
    if (file < 0) return;
    [[maybe_unused]] const auto written = ::write(file, "5", 1);
    ::close(file);
}

}  // namespace geomend
