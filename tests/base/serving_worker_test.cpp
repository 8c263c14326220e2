// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/serving_worker.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>

namespace geomend {
namespace {

std::vector<std::string> fake() { return {GEOMEND_MISBEHAVING_WORKER, "--worker-serves"}; }

WorkerEnd ask(ServingWorker& worker, std::string_view request, double seconds = 30) {
    WorkerJob limits;
    limits.seconds = seconds;
    auto end = worker.ask(request, limits);
    EXPECT_TRUE(end.ok());
    return end ? *end : WorkerEnd{};
}

bool no_child_left() { return ::waitpid(-1, nullptr, WNOHANG) == -1; }

TEST(ServingWorker, IsOneProcessForManyRequests) {
    {
        ServingWorker worker(fake());
        EXPECT_TRUE(worker.is_fresh());
        const std::string first = ask(worker, "pid").output;
        EXPECT_FALSE(first.empty());
        EXPECT_FALSE(worker.is_fresh());
        for (int i = 0; i < 100; ++i) EXPECT_EQ(ask(worker, "pid").output, first);
        worker.end();
        EXPECT_NE(ask(worker, "pid").output, first);
    }
    EXPECT_TRUE(no_child_left());
}

TEST(ServingWorker, ThatDiesIsToldAndTheNextRequestGetsANewOne) {
    ServingWorker worker(fake());
    const std::string first = ask(worker, "pid").output;
    const WorkerEnd crash = ask(worker, "crash.11");
    EXPECT_EQ(crash.how, WorkerEnd::How::signalled);
    EXPECT_EQ(crash.number, SIGSEGV);
    EXPECT_EQ(crash.last_words, "about to fall over\n");
    EXPECT_TRUE(no_child_left());
    EXPECT_TRUE(worker.is_fresh());
    const WorkerEnd next = ask(worker, "pid");
    EXPECT_NE(next.output, first);
    EXPECT_EQ(next.last_words, "");
    const WorkerEnd left = ask(worker, "exit.42");
    EXPECT_EQ(left.how, WorkerEnd::How::exited);
    EXPECT_EQ(left.number, 42);
}

TEST(ServingWorker, ThatHangsIsKilledInTime) {
    ServingWorker worker(fake());
    for (const char* what : {"hang", "deaf", "stubborn"}) {
        ask(worker, "pid");
        const WorkerEnd end = ask(worker, what, 0.2);
        EXPECT_EQ(end.how, WorkerEnd::How::timed_out) << what;
        EXPECT_LT(end.seconds, 5) << what;
        EXPECT_TRUE(no_child_left()) << what;
    }
    EXPECT_EQ(ask(worker, "pid").how, WorkerEnd::How::exited);
}

TEST(ServingWorker, ThatCannotBeStartedIsAFailure) {
    ServingWorker worker({"/no/such/program"});
    const auto end = worker.ask("pid", {});
    ASSERT_FALSE(end.ok());
    EXPECT_EQ(end.why().error.code, "F023");
    EXPECT_TRUE(no_child_left());
}

}  // namespace
}  // namespace geomend
