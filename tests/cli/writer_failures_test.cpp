// SPDX-License-Identifier: AGPL-3.0-or-later
// Every format that is written, every kind of report and debris: what happens when the disk is full, memory runs out or somebody
// stops the program. The older output stays, nothing is left behind, the exit status says why. The formats are those of the table,
// so that a new one is tested with the others.
#include <gtest/gtest.h>

#include <csignal>

#include "cli/written_outputs.h"

namespace geomend::test {
namespace {

TEST(WriterFailures, AFullDiskLeavesTheOlderOutputAndNothingElse) {
    for (const Written& output : all_outputs()) {
        for (const std::size_t room : {std::size_t{0}, largest(output.good) / 2, largest(output.good) - 1}) {
            int status = 0;
            const auto left = over_an_older_one(output, {.file_bytes = room}, status);
            EXPECT_EQ(status, 4) << output.name << " with room for " << room;
            EXPECT_EQ(left, untouched(output)) << output.name << " with room for " << room;
        }
    }
}

TEST(WriterFailures, AFullDiskLeavesNoDebris) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"validate", sample("faulted_grid.grdecl").string(), "--fail-on", "never", "--debris"};
    arguments.push_back((folder / "good").string());
    ASSERT_EQ(run_in_trouble(arguments, {}), 0);
    const auto good = contents(folder / "good");
    ASSERT_FALSE(good.empty());
    arguments.back() = (folder / "full").string();
    EXPECT_EQ(run_in_trouble(arguments, {.file_bytes = largest(good) - 1}), 4);
    EXPECT_TRUE(contents(folder / "full").empty());
}

// The memory at which a run fails is not known before: from too little to enough, each run is whole or leaves all as it was.
TEST(WriterFailures, ExhaustedMemoryLeavesTheOlderOutputAndNothingElse) {
    if (run_in_trouble({"--version"}, {.memory_bytes = rlim_t{1} << 32}) != 0) GTEST_SKIP() << "memory cannot be limited here";
    for (const Written& output : all_outputs()) {
        auto arguments = output.arguments;
        arguments.insert(arguments.begin() + 1, {"--threads", "1"});
        const Written single{output.name, arguments, output.good};
        for (rlim_t megabytes = 80; megabytes <= 640; megabytes *= 2) {
            int status = 0;
            const auto left = over_an_older_one(single, {.memory_bytes = megabytes << 20}, status);
            if (status == 0) {
                EXPECT_EQ(left.size(), output.good.size()) << output.name << " with " << megabytes << " MB";
            } else {
                EXPECT_EQ(left, untouched(output)) << output.name << " with " << megabytes << " MB, status " << status;
            }
        }
    }
}

TEST(WriterFailures, AStopLeavesTheOlderOutputOrAllOfTheNewOne) {
    for (const Written& output : all_outputs()) {
        for (const int signal : {SIGTERM, SIGINT}) {
            for (const int milliseconds : {20, 30, 40, 60}) {
                int status = 0;
                const auto left = over_an_older_one(output, {.signal = signal, .after = std::chrono::milliseconds(milliseconds)}, status);
                const std::string what =
                    output.name + " stopped after " + std::to_string(milliseconds) + " ms, status " + std::to_string(status);
                EXPECT_TRUE(status == 0 || status == 130 || status == 128 + signal) << what;
                EXPECT_FALSE(has_temporary(left)) << what;
                if (status == 0) {
                    EXPECT_EQ(left.size(), output.good.size()) << what;
                } else {
                    EXPECT_EQ(left, untouched(output)) << what;
                }
            }
        }
    }
}

TEST(WriterFailures, AKillLeavesTheOlderOutputOrTheNewOne) {
    for (const Written& output : all_outputs()) {
        for (const int milliseconds : {15, 25, 35, 50}) {
            int status = 0;
            const auto left = over_an_older_one(output, {.signal = SIGKILL, .after = std::chrono::milliseconds(milliseconds)}, status);
            ASSERT_TRUE(left.contains(output.name)) << output.name;
            const std::string& main = left.at(output.name);
            EXPECT_TRUE(main == "old" || main.size() == output.good.at(output.name).size()) << output.name;
        }
    }
}

}  // namespace
}  // namespace geomend::test
