// SPDX-License-Identifier: AGPL-3.0-or-later
// Everything that the program writes (see written_outputs.h), where one allocation fails, one write finds the disk full, or the process
// is killed before one rename: at exact places, which limits and clocks (writer_failures_test.cpp) meet by chance only.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <optional>

#include "cli/written_outputs.h"

namespace geomend::test {
namespace {

namespace fs = std::filesystem;

// One thread: the calls of a run then come in one order.
Written in_one_thread(const Written& output) {
    Written single = output;
    single.arguments.insert(single.arguments.begin() + 1, {"--threads", "1"});
    return single;
}

// "memory 5 faulted_grid.grdecl": the fifth since the input was opened.
std::string misfortune(const char* what, long number, const Written& output) {
    const auto input = std::ranges::find_if(output.arguments, [](const std::string& word) { return fs::is_regular_file(word); });
    return std::string(what) + ' ' + std::to_string(number) + ' ' + fs::path(*input).filename().string();
}

// How often a run without trouble does what can fail.
long calls_of(const char* what, const Written& output) {
    const TemporaryFolder folder;
    int status = 0;
    over_an_older_one(output, {.misfortune = misfortune(what, -1, output), .calls = folder / "calls"}, status);
    EXPECT_EQ(status, 0) << output.name;
    const std::string text = read_file(folder / "calls");
    long calls = 0;
    std::from_chars(text.data(), text.data() + text.size(), calls);
    EXPECT_GT(calls, 0) << what << ' ' << output.name;
    return calls;
}

bool has_the_sizes_of(const Contents& files, const Contents& good) {
    return std::ranges::equal(files, good,
                              [](const auto& a, const auto& b) { return a.first == b.first && a.second.size() == b.second.size(); });
}

// A report says so where a file was not judged for want of memory.
bool names_memory(const Contents& files, const Written& output) {
    return files.size() == 1 && files.contains(output.name) && files.at(output.name).find("not enough memory") != std::string::npos;
}

// Sanitisers want to be the first library themselves.
bool can_be_arranged() { return run_in_trouble({"--version"}, {.misfortune = "memory -1 none"}) == 0; }

TEST(Misfortunes, OneFailedAllocationLeavesTheOlderOutputOrAllOfTheNewOne) {
    if (!can_be_arranged()) GTEST_SKIP() << "no library can be loaded before the others here";
    constexpr long places = 10;
    for (const Written& written : all_outputs()) {
        const Written output = in_one_thread(written);
        const long calls = calls_of("memory", output);
        for (long place = 0; place < places; ++place) {
            const long number = (2 * place + 1) * calls / (2 * places);
            int status = 0;
            const auto left = over_an_older_one(output, {.misfortune = misfortune("memory", number, output)}, status);
            const std::string what = output.name + ": allocation " + std::to_string(number) + " of " + std::to_string(calls);
            EXPECT_TRUE(status == 0 || status == 4 || status == 5) << what << ": status " << status;
            EXPECT_TRUE((status != 0 && (left == untouched(output) || names_memory(left, output))) || has_the_sizes_of(left, output.good))
                << what;
        }
    }
}

TEST(Misfortunes, OneWriteThatFailsLeavesTheOlderOutput) {
    if (!can_be_arranged()) GTEST_SKIP() << "no library can be loaded before the others here";
    for (const Written& written : all_outputs()) {
        const Written output = in_one_thread(written);
        const long calls = calls_of("room", output);
        for (const long number : {0L, calls / 2, calls - 1}) {
            int status = 0;
            const auto left = over_an_older_one(output, {.misfortune = misfortune("room", number, output)}, status);
            EXPECT_EQ(status, 4) << output.name << ": write " << number << " of " << calls;
            EXPECT_EQ(left, untouched(output)) << output.name << ": write " << number << " of " << calls;
        }
    }
}

// Whatever else is new by then, the file that the user named is the older one until all that it speaks of is there.
TEST(Misfortunes, AKillBeforeARenameLeavesTheNamedFileAndNoneInParts) {
    if (!can_be_arranged()) GTEST_SKIP() << "no library can be loaded before the others here";
    for (const Written& written : all_outputs()) {
        const Written output = in_one_thread(written);
        const long calls = calls_of("death", output);
        for (const long number : {0L, calls / 2, calls - 1}) {
            int status = 0;
            const auto left = over_an_older_one(output, {.misfortune = misfortune("death", number, output)}, status);
            EXPECT_EQ(status, 128 + SIGKILL) << output.name;
            for (const auto& [name, bytes] : left) {
                const std::string what = output.name + " killed before rename " + std::to_string(number) + ": " + name;
                if (has_temporary({{name, {}}})) continue;
                const auto whole = output.good.find(name);
                ASSERT_NE(whole, output.good.end()) << what;
                EXPECT_TRUE(name == output.name ? bytes == "old" : bytes.size() == whole->second.size()) << what;
            }
            EXPECT_TRUE(left.contains(output.name)) << output.name;
        }
    }
}

// A folder of many files is no output of its own: what was made of it goes with the run.
TEST(Misfortunes, OneFailedAllocationLeavesNoDebris) {
    if (!can_be_arranged()) GTEST_SKIP() << "no library can be loaded before the others here";
    const Written debris{"debris", {"validate", sample("faulted_grid.grdecl"), "--threads", "1", "--fail-on", "never", "--debris"}, {}};
    const TemporaryFolder folder;
    const auto run = [&](const std::string& name, const Trouble& trouble) {
        auto arguments = debris.arguments;
        arguments.push_back((folder / name).string());
        return run_in_trouble(arguments, trouble);
    };
    ASSERT_EQ(run("good", {}), 0);
    const auto good = contents(folder / "good");
    ASSERT_FALSE(good.empty());
    constexpr long last = 3000;
    for (long number = 0; number < last; number += 97) {
        const std::string name = "debris" + std::to_string(number);
        const int status = run(name, {.misfortune = misfortune("memory", number, debris)});
        EXPECT_TRUE(status == 0 || status == 4 || status == 5) << "allocation " << number << ": status " << status;
        const auto left = fs::exists(folder / name) ? contents(folder / name) : Contents{};
        EXPECT_TRUE((status != 0 && left.empty()) || has_the_sizes_of(left, good)) << "allocation " << number << ": status " << status;
    }
}

}  // namespace
}  // namespace geomend::test
