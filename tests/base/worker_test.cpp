// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/worker.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <atomic>
#include <csignal>

#include <chrono>
#include <thread>

#include "base/sanitisers.h"

namespace geomend {
namespace {

WorkerJob job(const char* what) {
    WorkerJob j;
    j.command = {GEOMEND_MISBEHAVING_WORKER, what};
    return j;
}

WorkerEnd run(const WorkerJob& j, const Monitor* monitor = nullptr) {
    auto end = run_worker(j, monitor);
    EXPECT_TRUE(end.ok());
    return end ? *end : WorkerEnd{};
}

bool any_child_left() {
    return ::waitpid(-1, nullptr, WNOHANG) != -1;  // -1: there is none
}

TEST(Worker, TellsItsExitStatusAndItsLastWords) {
    const WorkerEnd end = run(job("exit.42"));
    EXPECT_EQ(end.how, WorkerEnd::How::exited);
    EXPECT_EQ(end.number, 42);
    EXPECT_EQ(end.output, "");
}

TEST(Worker, GivesAllOfALargeOutput) { EXPECT_EQ(run(job("big.1000000")).output.size(), 16000000u); }

TEST(Worker, ThatCrashesIsToldBySignal) {
    const WorkerEnd end = run(job("crash.6"));
    EXPECT_EQ(end.how, WorkerEnd::How::signalled);
    EXPECT_EQ(end.number, SIGABRT);
    EXPECT_EQ(end.last_words, "about to fall over\n");
    EXPECT_EQ(signal_text(SIGABRT), "signal 6 (Aborted)");
}

TEST(Worker, ThatHangsIsKilledInTime) {
    for (const char* what : {"hang", "deaf", "stubborn"}) {
        WorkerJob j = job(what);
        j.seconds = 0.2;
        const WorkerEnd end = run(j);
        EXPECT_EQ(end.how, WorkerEnd::How::timed_out) << what;
        EXPECT_LT(end.seconds, 5) << what;
        EXPECT_FALSE(any_child_left()) << what;
    }
}

TEST(Worker, ThatFloodsUsIsKilled) {
    WorkerJob j = job("flood");
    j.most_output = 1u << 20;
    const WorkerEnd end = run(j);
    EXPECT_EQ(end.how, WorkerEnd::How::too_much_output);
    EXPECT_LT(end.output.size(), 4u << 20);
}

TEST(Worker, MayLeaveAProcessThatHoldsItsPipes) {
    const WorkerEnd end = run(job("orphan"));
    EXPECT_EQ(end.how, WorkerEnd::How::exited);
    EXPECT_LT(end.seconds, 5);
}

TEST(Worker, HasAnEmptyStandardInput) { EXPECT_EQ(run(job("echo")).output, ""); }

TEST(Worker, IsRefusedMemoryBeyondItsLimit) {
    if (with_address_sanitiser) GTEST_SKIP() << "the address sanitiser reserves terabytes";
    const WorkerEnd end = run(job("eat.256"));
    EXPECT_EQ(end.number, 5);
    EXPECT_EQ(end.last_words, "refused\n");
    EXPECT_EQ(run(job("eat.0")).number, 0);
}

TEST(Worker, ThatSpinsEndsByItsOwnLimit) {
    const WorkerEnd end = run(job("spin.1"));
    EXPECT_EQ(end.how, WorkerEnd::How::signalled);
    EXPECT_EQ(end.number, SIGXCPU);
}

TEST(Worker, ThatCannotBeStartedIsAFailure) {
    WorkerJob j;
    j.command = {"/no/such/program"};
    const auto end = run_worker(j);
    ASSERT_FALSE(end.ok());
    EXPECT_EQ(end.why().kind, FailureKind::limit);
}

TEST(Worker, StopsWithUs) {
    for (const char* what : {"hang", "stubborn"}) {
        std::atomic<bool> stop{false};
        Monitor monitor;
        monitor.stop = &stop;
        const std::jthread later([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            stop = true;
        });
        const WorkerEnd end = run(job(what), &monitor);
        EXPECT_EQ(end.how, WorkerEnd::How::stopped) << what;
        EXPECT_LT(end.seconds, 6) << what;
        EXPECT_FALSE(any_child_left()) << what;
    }
}

TEST(Worker, ManyAtOnceDoNotMixTheirOutputs) {
    std::vector<std::jthread> all;
    std::array<std::size_t, 8> sizes{};
    for (std::size_t t = 0; t < sizes.size(); ++t) {
        all.emplace_back([&sizes, t] {
            const std::string what = "big." + std::to_string(1000 * (t + 1));
            sizes[t] = run(job(what.c_str())).output.size();
        });
    }
    all.clear();
    for (std::size_t t = 0; t < sizes.size(); ++t) EXPECT_EQ(sizes[t], 16000 * (t + 1));
}

}  // namespace
}  // namespace geomend
