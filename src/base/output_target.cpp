// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/output_target.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <poll.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/number_text.h"

namespace geomend {

namespace fs = std::filesystem;

namespace {

constexpr int most_links = 40;  // as the system allows
constexpr int wait_milliseconds = 50;

// The number N of /dev/fd/N and /proc/self/fd/N.
std::optional<int> descriptor_of(const fs::path& path) {
    const std::string text = path.string();
    for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
        std::int64_t number = 0;
        if (text.starts_with(folder) && parse_integer(std::string_view(text).substr(folder.size()), number) == NumberStatus::ok &&
            number >= 0 && number <= INT_MAX)
            return static_cast<int>(number);
    }
    return std::nullopt;
}

// Links under /proc stand for open files, whatever their text says.
bool is_on_proc(const fs::path& path) {
    struct statfs about {};
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    return ::statfs(folder.c_str(), &about) == 0 && about.f_type == PROC_SUPER_MAGIC;
}

OutputTarget open_already(int descriptor) {
    OutputTarget target;
    target.kind = OutputTarget::Kind::descriptor;
    target.descriptor = descriptor;
    target.exists = true;
    return target;
}

// What stands at the end of the links.
OutputTarget look_at(fs::path path) {
    OutputTarget target;
    target.path = std::move(path);
    struct stat about {};
    if (::stat(target.path.c_str(), &about) != 0) {
        if (errno != ENOENT) target.error = errno;
        return target;
    }
    target.exists = true;
    target.mode = about.st_mode & 07777;
    target.owner = about.st_uid;
    target.group = about.st_gid;
    if (S_ISDIR(about.st_mode)) target.error = EISDIR;
    else if (!S_ISREG(about.st_mode)) target.kind = OutputTarget::Kind::stream;
    else if (::faccessat(AT_FDCWD, target.path.c_str(), W_OK, AT_EACCESS) != 0) target.error = errno;
    return target;
}

// Keeps SIGPIPE from a write of this thread, whatever the program has set for it.
class PipeSignalHeld {
public:
    PipeSignalHeld() {
        ::sigemptyset(&pipe_);
        ::sigaddset(&pipe_, SIGPIPE);
        sigset_t waiting;
        ::sigpending(&waiting);
        was_waiting_ = ::sigismember(&waiting, SIGPIPE) == 1;
        ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~PipeSignalHeld() {
        const timespec at_once{0, 0};
        if (!was_waiting_) ::sigtimedwait(&pipe_, nullptr, &at_once);
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    PipeSignalHeld(const PipeSignalHeld&) = delete;
    PipeSignalHeld& operator=(const PipeSignalHeld&) = delete;

private:
    sigset_t pipe_{}, before_{};
    bool was_waiting_ = false;
};

bool stopped(const Monitor* monitor) { return monitor != nullptr && monitor->stopped(); }

// Opening a pipe for writing fails with ENXIO until somebody reads it.
int open_stream(const fs::path& path, const Monitor* monitor, int& error) {
    struct stat about {};
    const bool pipe = ::stat(path.c_str(), &about) == 0 && S_ISFIFO(about.st_mode);
    for (;;) {
        const int fd = ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC | (pipe ? O_NONBLOCK : 0));
        if (fd >= 0) return fd;
        error = errno;
        if (error != EINTR && !(pipe && error == ENXIO)) return -1;
        if (stopped(monitor)) {
            error = ECANCELED;
            return -1;
        }
        if (error == ENXIO) ::poll(nullptr, 0, wait_milliseconds);
    }
}

// Waits until a little can be written without waiting.
int wait_for_reader(int to, const Monitor* monitor) {
    for (;;) {
        if (stopped(monitor)) return ECANCELED;
        pollfd one{to, POLLOUT, 0};
        const int ready = ::poll(&one, 1, wait_milliseconds);
        if (ready > 0) return 0;  // also for an error, which the write then names
        if (ready < 0 && errno != EINTR) return errno;
    }
}

// Where a reader may keep us waiting only as much is written at a time as goes in at once.
int write_patiently(int to, const char* bytes, std::size_t size, const Monitor* monitor) {
    struct stat about {};
    const bool waits = ::fstat(to, &about) == 0 && !S_ISREG(about.st_mode) && !S_ISBLK(about.st_mode);
    if (!waits) return write_all(to, bytes, size);
    while (size > 0) {
        if (const int error = wait_for_reader(to, monitor); error != 0) return error;
        const ssize_t put = ::write(to, bytes, size < PIPE_BUF ? size : PIPE_BUF);
        if (put < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (put < 0) return errno;
        bytes += put;
        size -= static_cast<std::size_t>(put);
    }
    return 0;
}

int copy_all(int file, int to, const Monitor* monitor) {
    if (::lseek(file, 0, SEEK_SET) < 0) return errno;
    std::vector<char> block(std::size_t{1} << 20);
    const PipeSignalHeld held;
    for (;;) {
        const ssize_t got = ::read(file, block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return errno;
        if (got == 0) return 0;
        if (const int error = write_patiently(to, block.data(), static_cast<std::size_t>(got), monitor); error != 0) return error;
    }
}

}  // namespace

int write_all(int file, const char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t put = ::write(file, bytes, size);
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return errno;
        bytes += put;
        size -= static_cast<std::size_t>(put);
    }
    return 0;
}

OutputTarget find_output_target(const fs::path& name) {
    if (name == "-") return open_already(STDOUT_FILENO);
    fs::path path = name;
    for (int links = 0; links <= most_links; ++links) {
        if (const auto descriptor = descriptor_of(path)) return open_already(*descriptor);
        std::error_code error;
        const fs::path next = fs::read_symlink(path, error);
        if (error) return look_at(path);  // no link: a file, something else, nothing, or what cannot be looked at
        if (is_on_proc(path)) {
            OutputTarget target = look_at(path);
            if (target.error == 0 && target.exists) target.kind = OutputTarget::Kind::stream;
            return target;
        }
        path = next.is_absolute() ? next : path.parent_path() / next;
    }
    OutputTarget target;
    target.path = name;
    target.error = ELOOP;
    return target;
}

void keep_permissions(int file, const OutputTarget& target) {
    struct stat about {};
    if (!target.exists || ::fstat(file, &about) != 0) return;
    mode_t mode = target.mode;
    if (about.st_uid != target.owner && ::fchown(file, target.owner, static_cast<gid_t>(-1)) != 0) mode &= ~static_cast<mode_t>(S_ISUID);
    if (about.st_gid != target.group && ::fchown(file, static_cast<uid_t>(-1), target.group) != 0)
        mode = (mode & ~static_cast<mode_t>(S_ISGID | S_IRWXG)) | ((mode & S_IRWXO) << 3);
    ::fchmod(file, mode);
}

int send_to_stream(int file, const OutputTarget& target, const Monitor* monitor) {
    if (target.kind == OutputTarget::Kind::descriptor) return copy_all(file, target.descriptor, monitor);
    int error = 0;
    const int to = open_stream(target.path, monitor, error);
    if (to < 0) return error;
    error = copy_all(file, to, monitor);
    if (::close(to) != 0 && error == 0) error = errno;
    return error;
}

}  // namespace geomend
