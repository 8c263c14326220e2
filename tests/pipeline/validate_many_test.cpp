// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/validate_many.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace geomend {
namespace {

FoundFiles files(const std::vector<std::string>& paths) {
    FoundFiles all;
    for (const std::string& path : paths) all.files.push_back({path, true});
    return all;
}

ManyOptions options(std::size_t threads, double seconds = 30) {
    ManyOptions o;
    o.worker = {GEOMEND_MISBEHAVING_WORKER, "validate"};
    o.threads = threads;
    o.seconds = seconds;
    return o;
}

Report run(const FoundFiles& all, const ManyOptions& o) {
    auto report = validate_many(all, o);
    EXPECT_TRUE(report.ok());
    return report ? *report : Report{};
}

TEST(ValidateMany, TakesWhatWorkersReport) {
    const Report report = run(files({"good.1", "bad.1"}), options(2));
    ASSERT_EQ(report.files.size(), 2u);
    EXPECT_EQ(report.files[0].file, "good.1");
    EXPECT_EQ(report.files[0].valid, true);
    EXPECT_EQ(report.files[0].tolerance, 0.25);
    EXPECT_EQ(report.files[1].valid, false);
    ASSERT_EQ(report.files[1].findings.size(), 1u);
    EXPECT_EQ(report.files[1].findings[0].code, "C03");
    EXPECT_EQ(report.summary->valid, 1u);
    EXPECT_EQ(report.summary->not_valid, 1u);
}

TEST(ValidateMany, ACrashIsAFindingOfItsFileAndTheOthersGoOn) {
    const Report report = run(files({"good.1", "crash.11", "good.2", "crash.6"}), options(2));
    ASSERT_EQ(report.files.size(), 4u);
    EXPECT_EQ(report.files[1].outcome, FileOutcome::crashed);
    ASSERT_EQ(report.files[1].findings.size(), 1u);
    EXPECT_EQ(report.files[1].findings[0].code, "F025");
    EXPECT_NE(report.files[1].findings[0].message.find("signal 11"), std::string::npos);
    EXPECT_NE(report.files[1].findings[0].message.find("about to fall over"), std::string::npos);
    EXPECT_EQ(report.files[2].valid, true);
    EXPECT_EQ(report.summary->crashed, 2u);
    EXPECT_EQ(report.summary->valid, 2u);
}

TEST(ValidateMany, WhatEarlierFilesLeftBehindIsNotReportedOfALaterOne) {
    const Report report = run(files({"good.1", "poisoned.1", "crash.11", "poisoned.2", "good.2"}), options(1));
    ASSERT_EQ(report.files.size(), 5u);
    for (const std::size_t i : {0u, 1u, 3u, 4u}) EXPECT_EQ(report.files[i].valid, true) << i;
    EXPECT_EQ(report.files[2].outcome, FileOutcome::crashed);
    EXPECT_EQ(report.summary->crashed, 1u);
}

TEST(ValidateMany, AHangIsAFindingOfItsFile) {
    const Report report = run(files({"hang.1", "good.1", "deaf.1"}), options(2, 0.3));
    EXPECT_EQ(report.files[0].outcome, FileOutcome::limit);
    EXPECT_EQ(report.files[0].findings[0].code, "F023");
    EXPECT_NE(report.files[0].findings[0].message.find("0.3 seconds"), std::string::npos) << report.files[0].findings[0].message;
    EXPECT_EQ(report.files[2].outcome, FileOutcome::limit);
    EXPECT_EQ(report.summary->limit, 2u);
}

TEST(ValidateMany, DoesNotBelieveWhatMakesNoSense) {
    for (const char* name : {"garbage.1", "swapped.1", "liar.1", "exit.0", "exit.1", "exit.3", "exit.70", "exit.99"}) {
        const Report report = run(files({name, "good.1"}), options(1));
        EXPECT_EQ(report.files[0].outcome, FileOutcome::crashed) << name;
        EXPECT_EQ(report.files[0].findings[0].code, "F025") << name;
        EXPECT_EQ(report.files[0].valid, false) << name;
        EXPECT_EQ(report.files[1].valid, true) << name;
    }
}

TEST(ValidateMany, MemoryThatIsRefusedIsALimit) {
    EXPECT_EQ(run(files({"exit.5"}), options(1)).files[0].outcome, FileOutcome::limit);
    // As the system ends processes when memory is short; tried once more, alone.
    EXPECT_EQ(run(files({"crash.9", "good.1"}), options(2)).files[0].outcome, FileOutcome::limit);
}

TEST(ValidateMany, KeepsTheOrderWhateverTheThreads) {
    std::vector<std::string> names;
    for (int i = 0; i < 40; ++i)
        names.push_back((i % 7 == 3 ? "bad." : "slow.") + std::to_string((40 - i) % 11 * 5) + "." + std::to_string(i));
    const std::string one = report_json(run(files(names), options(1)));
    EXPECT_EQ(one, report_json(run(files(names), options(2))));
    EXPECT_EQ(one, report_json(run(files(names), options(9))));
}

TEST(ValidateMany, EndsWhereAWorkerSaysThatTheCommandLineIsWrong) {
    const auto report = validate_many(files({"exit.2", "good.1"}), options(1));
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.why().kind, FailureKind::usage);
}

TEST(ValidateMany, StopsAllWhenItIsStopped) {
    std::atomic<bool> stop{false};
    Monitor monitor;
    monitor.stop = &stop;
    ManyOptions o = options(4);
    o.monitor = &monitor;
    const std::jthread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        stop = true;
    });
    const auto begin = std::chrono::steady_clock::now();
    const auto report = validate_many(files({"hang.1", "stubborn.1", "hang.2", "hang.3", "hang.4", "good.1"}), o);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.why().kind, FailureKind::cancelled);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(ValidateMany, TellsOfArgumentsThatStandForNothing) {
    FoundFiles all = files({"good.1"});
    all.nothing_there.push_back(unreadable("F017", {"*.vtu"}, "no file matches this pattern"));
    all.not_models = {"readme"};
    const Report report = run(all, options(1));
    ASSERT_EQ(report.files.size(), 2u);
    EXPECT_EQ(report.files[1].file, "*.vtu");
    EXPECT_EQ(report.files[1].outcome, FileOutcome::unreadable);
    EXPECT_EQ(report.summary->unreadable, 1u);
    EXPECT_EQ(summary_text(*report.summary), "2 files: 1 valid, 0 not valid, 1 not readable\n  left alone: 1 of no known format\n");
}

}  // namespace
}  // namespace geomend
