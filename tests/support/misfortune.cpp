// SPDX-License-Identifier: AGPL-3.0-or-later
// A library that is loaded before all others (LD_PRELOAD): at one exact place of a run memory or room on the disk runs out, or the
// process dies. GEOMEND_MISFORTUNE is "WHAT NUMBER AFTER": WHAT is memory, room or death, and befalls call NUMBER (from 0; -1: none) of
// its kind (allocation by new; write to a file; rename) since a file whose name ends with AFTER was opened for the first time. With
// GEOMEND_CALLS=FILE the number of such calls is left in FILE when the program ends.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

enum class What { nothing, memory, room, death };

struct Plan {
    What what = What::nothing;
    long number = -1;
    char after[200] = {};
};

std::atomic<bool> begun{false};
std::atomic<long> calls{0};

const Plan& plan() {
    static const Plan read = [] {
        Plan p;
        char what[20] = {};
        const char* text = std::getenv("GEOMEND_MISFORTUNE");
        if (text == nullptr || std::sscanf(text, "%19s %ld %199s", what, &p.number, p.after) != 3) return p;
        if (std::strcmp(what, "memory") == 0) p.what = What::memory;
        if (std::strcmp(what, "room") == 0) p.what = What::room;
        if (std::strcmp(what, "death") == 0) p.what = What::death;
        return p;
    }();
    return read;
}

bool befalls(What what) { return begun.load(std::memory_order_relaxed) && plan().what == what && calls++ == plan().number; }

void opened(const char* path) {
    if (begun || plan().what == What::nothing) return;
    const std::size_t whole = std::strlen(path), end = std::strlen(plan().after);
    if (whole >= end && std::strcmp(path + whole - end, plan().after) == 0) begun = true;
}

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

void* allocate(std::size_t size) {
    void* p = befalls(What::memory) ? nullptr : std::malloc(size == 0 ? 1 : size);
    if (p == nullptr) throw std::bad_alloc();
    return p;
}

__attribute__((destructor)) void leave_calls() {
    const char* path = std::getenv("GEOMEND_CALLS");
    if (path == nullptr) return;
    char text[32];
    const int size = std::snprintf(text, sizeof text, "%ld", calls.load());
    const int fd = ::open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (fd >= 0 && ::write(fd, text, static_cast<std::size_t>(size)) == size) ::close(fd);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }

extern "C" {

int open(const char* path, int flags, ...) {
    mode_t mode = 0;
    if ((flags & (O_CREAT | O_TMPFILE)) != 0) {
        va_list more;
        va_start(more, flags);
        mode = va_arg(more, mode_t);
        va_end(more);
    }
    opened(path);
    return next<int(const char*, int, ...)>("open")(path, flags, mode);
}

ssize_t write(int fd, const void* bytes, size_t size) {
    if (fd > STDERR_FILENO && befalls(What::room)) {
        errno = ENOSPC;
        return -1;
    }
    return next<ssize_t(int, const void*, size_t)>("write")(fd, bytes, size);
}

int rename(const char* from, const char* to) noexcept {
    if (befalls(What::death)) std::raise(SIGKILL);
    return next<int(const char*, const char*)>("rename")(from, to);
}

}  // extern "C"
