// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/serving_worker.h"

#include <malloc.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "base/worker_process.h"

namespace geomend {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_words = 4096;
constexpr double grace_seconds = 2;

// What stands before an answer. Both ends are the same program on the same machine.
struct AnswerHead {
    std::uint64_t size = 0;
    std::int32_t status = 0;
    std::int32_t last = 0;
};

bool send_all(int socket, const char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t sent = ::send(socket, bytes, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        bytes += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receive_all(int socket, char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t got = ::read(socket, bytes, size);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        bytes += got;
        size -= static_cast<std::size_t>(got);
    }
    return true;
}

// What there is to read now, a megabyte of it at most; false where the other end is closed.
bool read_what_is_there(int descriptor, std::string& to) {
    std::array<char, 1u << 16> buffer;
    for (int part = 0; part < 16; ++part) {
        const ssize_t got = ::recv(descriptor, buffer.data(), buffer.size(), MSG_DONTWAIT);
        if (got <= 0) return got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
        to.append(buffer.data(), static_cast<std::size_t>(got));
    }
    return true;
}

}  // namespace

// Waits for one answer.
class ServingWorker::Wait {
public:
    Wait(ServingWorker& worker, const WorkerJob& limits, const Monitor* monitor) : worker_(worker), limits_(limits), monitor_(monitor) {}

    WorkerEnd run() {
        std::string bytes;
        bool open = true;
        for (;;) {
            std::array<pollfd, 2> ends{pollfd{open ? worker_.talk_->ends[0] : -1, POLLIN, 0},
                                       pollfd{words_open_ ? worker_.words_->ends[0] : -1, POLLIN, 0}};
            const int ready = ::poll(ends.data(), ends.size(), open ? 50 : 2);
            if (open) open = read_what_is_there(worker_.talk_->ends[0], bytes);
            take_words();
            if (take_answer(bytes)) return finished();
            // A process that it has started may hold the line open.
            if ((!open || ready == 0) && is_over()) return ended(open);
            if (bytes.size() > limits_.most_output) kill_for(WorkerEnd::How::too_much_output);
            look_at_the_clock();
        }
    }

private:
    double elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

    void take_words() {
        if (words_open_) words_open_ = read_what_is_there(worker_.words_->ends[0], end_.last_words);
        if (end_.last_words.size() > most_words) end_.last_words.erase(0, end_.last_words.size() - most_words);
    }

    bool take_answer(std::string& bytes) {
        AnswerHead head;
        if (killed_ || bytes.size() < sizeof head) return false;
        std::memcpy(&head, bytes.data(), sizeof head);
        if (bytes.size() - sizeof head != head.size) return false;
        end_.how = WorkerEnd::How::exited;
        end_.number = head.status;
        end_.output = bytes.substr(sizeof head);
        ++worker_.answered_;
        if (head.last != 0) worker_.end();
        return true;
    }

    WorkerEnd finished() {
        end_.seconds = elapsed();
        return std::move(end_);
    }

    bool is_over() {
        const pid_t got = ::waitpid(worker_.child_, &status_, WNOHANG);
        return got == worker_.child_ || (got < 0 && errno != EINTR);
    }

    WorkerEnd ended(bool line_is_held) {
        take_words();
        if (line_is_held) ::kill(-worker_.child_, SIGKILL);
        worker_.child_ = -1;
        worker_.end();
        end_.how = WIFEXITED(status_) ? WorkerEnd::How::exited : WorkerEnd::How::signalled;
        end_.number = WIFEXITED(status_) ? WEXITSTATUS(status_) : WTERMSIG(status_);
        if (killed_) end_.how = killed_for_;
        return finished();
    }

    void kill_for(WorkerEnd::How why) {
        if (!killed_) killed_for_ = why;
        killed_ = true;
        ::kill(-worker_.child_, SIGKILL);
    }

    void look_at_the_clock() {
        const double now = elapsed();
        if (limits_.seconds > 0 && now > limits_.seconds) kill_for(WorkerEnd::How::timed_out);
        if (monitor_ == nullptr || !monitor_->stopped() || killed_) return;
        if (asked_at_ < 0) {
            asked_at_ = now;
            ::kill(-worker_.child_, SIGTERM);
        }
        if (now > asked_at_ + grace_seconds) kill_for(WorkerEnd::How::stopped);
    }

    ServingWorker& worker_;
    const WorkerJob& limits_;
    const Monitor* monitor_;
    Clock::time_point begin_ = Clock::now();
    WorkerEnd end_;
    bool killed_ = false, words_open_ = true;
    WorkerEnd::How killed_for_ = WorkerEnd::How::exited;
    double asked_at_ = -1;
    int status_ = 0;
};

ServingWorker::ServingWorker(std::vector<std::string> command) : command_(std::move(command)) {}

ServingWorker::~ServingWorker() { end(); }

Result<void> ServingWorker::start() {
    talk_ = std::make_unique<DescriptorPair>();
    words_ = std::make_unique<DescriptorPair>();
    if (!talk_->open_socket() || !words_->open_socket()) return no_pipe();
    auto started = start_process({command_, talk_->ends[1], words_->ends[1], words_->ends[1], true});
    if (!started) return std::move(started).why();
    child_ = *started;
    answered_ = 0;
    talk_->close_end(1);
    words_->close_end(1);
    return {};
}

void ServingWorker::end() {
    talk_.reset();
    words_.reset();
    answered_ = 0;
    if (child_ < 0) return;
    ::kill(-child_, SIGKILL);  // it has answered all that it was asked
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
}

Result<WorkerEnd> ServingWorker::ask(std::string_view request, const WorkerJob& limits, const Monitor* monitor) {
    if (child_ < 0) {
        if (auto started = start(); !started) {
            end();
            return std::move(started).why();
        }
    }
    const std::uint64_t size = request.size();
    // Where this fails, the process is gone, and the wait says how it ended.
    if (send_all(talk_->ends[0], reinterpret_cast<const char*>(&size), sizeof size))
        send_all(talk_->ends[0], request.data(), request.size());
    WorkerEnd end = Wait(*this, limits, monitor).run();
    if (monitor != nullptr && monitor->stopped()) end.how = WorkerEnd::How::stopped;
    return end;
}

std::optional<std::string> next_request() {
    std::uint64_t size = 0;
    constexpr std::uint64_t most = std::uint64_t{1} << 24;
    if (!receive_all(STDIN_FILENO, reinterpret_cast<char*>(&size), sizeof size) || size > most) return std::nullopt;
    std::string request(size, '\0');
    if (!receive_all(STDIN_FILENO, request.data(), request.size())) return std::nullopt;
    return request;
}

bool answer_request(int status, std::string_view output, bool last) {
    const AnswerHead head{output.size(), status, last ? 1 : 0};
    return send_all(STDIN_FILENO, reinterpret_cast<const char*>(&head), sizeof head) &&
           send_all(STDIN_FILENO, output.data(), output.size());
}

void renew_processor_time(double seconds) {
    rusage used{};
    rlimit limit{};
    if (seconds <= 0 || ::getrusage(RUSAGE_SELF, &used) != 0 || ::getrlimit(RLIMIT_CPU, &limit) != 0) return;
    const auto whole = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1;
    limit.rlim_cur = std::min(limit.rlim_max, whole + static_cast<rlim_t>(std::ceil(seconds)));
    ::setrlimit(RLIMIT_CPU, &limit);
}

std::uint64_t memory_held() {
    ::malloc_trim(0);
    std::FILE* file = std::fopen("/proc/self/statm", "re");
    if (file == nullptr) return 0;
    unsigned long pages = 0;
    const int got = std::fscanf(file, "%*u %*u %*u %*u %*u %lu", &pages);
    std::fclose(file);
    return got == 1 ? std::uint64_t{pages} * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

}  // namespace geomend
