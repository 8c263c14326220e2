// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/worker.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>

#include "base/sanitisers.h"
#include "base/worker_process.h"

namespace geomend {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kept_words = 4096;
constexpr double seconds_to_stop = 2;

class Watch {
public:
    Watch(pid_t child, const WorkerJob& job, const Monitor* monitor) : child_(child), job_(job), monitor_(monitor) {}

    WorkerEnd until_the_end(DescriptorPair& out, DescriptorPair& err) {
        int status = 0;
        while (!ended(status)) {
            take(out, err);
            look_at_the_clock();
        }
        drain(out, err);
        end_.seconds = elapsed();
        if (killed_) {
            end_.how = killed_for_;
            return std::move(end_);
        }
        end_.how = WIFEXITED(status) ? WorkerEnd::How::exited : WorkerEnd::How::signalled;
        end_.number = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
        return std::move(end_);
    }

private:
    double elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

    bool ended(int& status) const {
        const pid_t got = ::waitpid(child_, &status, WNOHANG);
        return got == child_ || (got < 0 && errno != EINTR);
    }

    void signal(int number) const { ::kill(job_.reads_standard_input ? child_ : -child_, number); }

    void kill_for(WorkerEnd::How why) {
        if (!killed_) killed_for_ = why;
        killed_ = true;
        signal(SIGKILL);
    }

    // One end is open as long as the process lives, unless it closes both itself.
    void take(DescriptorPair& out, DescriptorPair& err) {
        std::array<pollfd, 2> ends{pollfd{out.ends[0], POLLIN, 0}, pollfd{err.ends[0], POLLIN, 0}};
        const bool both_closed = out.ends[0] < 0 && err.ends[0] < 0;
        if (::poll(ends.data(), ends.size(), both_closed ? 2 : 50) <= 0) return;
        if (ends[0].revents != 0) read_some(out, end_.output);
        if (ends[1].revents != 0) read_some(err, end_.last_words);
        if (end_.last_words.size() > 2 * kept_words) end_.last_words.erase(0, end_.last_words.size() - kept_words);
        if (end_.output.size() > job_.most_output) kill_for(WorkerEnd::How::too_much_output);
    }

    static bool read_some(DescriptorPair& pipe, std::string& to) {
        std::array<char, 1u << 16> buffer;
        const ssize_t got = ::read(pipe.ends[0], buffer.data(), buffer.size());
        if (got > 0) to.append(buffer.data(), static_cast<std::size_t>(got));
        else if (got == 0 || (errno != EINTR && errno != EAGAIN)) pipe.close_end(0);
        return got > 0;
    }

    // What is still in the pipes; never waits, for a process that the worker started may hold them open. That one is
    // ended, too.
    void drain(DescriptorPair& out, DescriptorPair& err) {
        for (DescriptorPair* pipe : {&out, &err}) {
            if (pipe->ends[0] < 0) continue;
            ::fcntl(pipe->ends[0], F_SETFL, O_NONBLOCK);
            std::string& to = pipe == &out ? end_.output : end_.last_words;
            while (to.size() <= job_.most_output && pipe->ends[0] >= 0 && read_some(*pipe, to)) {
            }
        }
        if ((out.ends[0] >= 0 || err.ends[0] >= 0) && !job_.reads_standard_input) signal(SIGKILL);
        if (end_.last_words.size() > kept_words) end_.last_words.erase(0, end_.last_words.size() - kept_words);
    }

    void look_at_the_clock() {
        const double now = elapsed();
        if (job_.seconds > 0 && now > job_.seconds) kill_for(WorkerEnd::How::timed_out);
        if (monitor_ == nullptr || !monitor_->stopped() || killed_) return;
        if (asked_at_ < 0) {
            asked_at_ = now;
            signal(SIGTERM);
        }
        if (now > asked_at_ + seconds_to_stop) kill_for(WorkerEnd::How::stopped);
    }

    pid_t child_;
    const WorkerJob& job_;
    const Monitor* monitor_;
    Clock::time_point begin_ = Clock::now();
    WorkerEnd end_;
    bool killed_ = false;
    WorkerEnd::How killed_for_ = WorkerEnd::How::exited;
    double asked_at_ = -1;
};

void set_limit(decltype(RLIMIT_CPU) which, rlim_t soft, rlim_t hard) {
    rlimit limit{};
    if (::getrlimit(which, &limit) != 0) return;
    limit.rlim_max = std::min(hard, limit.rlim_max);
    limit.rlim_cur = std::min(soft, limit.rlim_max);
    ::setrlimit(which, &limit);
}

void be_first_when_memory_is_short() {
    const int fd = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
    if (fd < 0) return;
    const ssize_t written = ::write(fd, "500", 3);
    static_cast<void>(written);  // only a wish
    ::close(fd);
}

}  // namespace

Result<WorkerEnd> run_worker(const WorkerJob& job, const Monitor* monitor) {
    DescriptorPair out, err;
    if (!out.open() || !err.open()) return no_pipe();
    StartPlan plan{job.command, -1, out.ends[1], err.ends[1], !job.reads_standard_input};
    auto started = start_process(plan);
    if (!started) return std::move(started).why();
    const pid_t child = *started;
    out.close_end(1);
    err.close_end(1);
    WorkerEnd end = Watch(child, job, monitor).until_the_end(out, err);
    if (monitor != nullptr && monitor->stopped()) end.how = WorkerEnd::How::stopped;
    return end;
}

std::string this_program() { return "/proc/self/exe"; }

void become_worker(const OwnLimits& limits) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (limits.parent != 0 && ::getppid() != limits.parent) ::raise(SIGKILL);  // it died before we asked
    set_limit(RLIMIT_CORE, 0, 0);
    if (limits.processor_seconds > 0) {
        const auto seconds = static_cast<rlim_t>(std::ceil(limits.processor_seconds));
        set_limit(RLIMIT_CPU, seconds, seconds + 5);
    }
    if (limits.memory_bytes > 0 && !with_address_sanitiser) set_limit(RLIMIT_DATA, limits.memory_bytes, limits.memory_bytes);
    be_first_when_memory_is_short();
}

std::uint64_t machine_memory() {
    const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
    return pages > 0 && size > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size) : 0;
}

std::string signal_text(int signal) {
    const char* words = ::sigdescr_np(signal);
    return "signal " + std::to_string(signal) + (words != nullptr ? " (" + std::string(words) + ")" : std::string());
}

}  // namespace geomend
