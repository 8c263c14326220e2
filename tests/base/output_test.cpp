// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/output.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <string>
#include <vector>

#include "base/input.h"
#include "support/temporary_folder.h"

namespace geomend {
namespace {

namespace fs = std::filesystem;
using test::read_file;
using test::TemporaryFolder;
using test::write_file;

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator()));
}

TEST(OutputSet, ShowsNothingBeforeTheCommit) {
    const TemporaryFolder folder;
    write_file(folder / "a", "old");
    OutputSet set(folder / "a");
    set.main_file() << "new " << '!';
    set.main_file().number(0.5);
    EXPECT_EQ(read_file(folder / "a"), "old");
    ASSERT_TRUE(set.commit());
    EXPECT_EQ(read_file(folder / "a"), "new !0.5");
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(OutputSet, LeavesNoTraceWithoutACommit) {
    const TemporaryFolder folder;
    write_file(folder / "a", "old");
    {
        OutputSet set(folder / "a");
        set.main_file() << "new";
        set.companion("parts/one/b") << "piece";
    }
    EXPECT_EQ(read_file(folder / "a"), "old");
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(OutputSet, PutsAllFilesInPlaceTogether) {
    const TemporaryFolder folder;
    OutputSet set(folder / "a.vtm");
    set.main_file() << "main";
    set.companion("a/0.vtu") << "piece";
    ASSERT_TRUE(set.commit());
    EXPECT_EQ(read_file(folder / "a.vtm"), "main");
    EXPECT_EQ(read_file(folder / "a/0.vtu"), "piece");
}

// So that nothing is left of it, whatever ends the process meanwhile.
TEST(OutputSet, AFileThatIsBeingWrittenIsInNoFolder) {
    const TemporaryFolder folder;
    const int probe = ::open(folder.path().c_str(), O_TMPFILE | O_RDWR, 0600);
    if (probe < 0) GTEST_SKIP() << "this file system has no files without names";
    ::close(probe);
    for (const char* name : {"big.txt", "big.txt.gz"}) {
        OutputSet files(folder / name);
        for (int i = 0; i < 300000; ++i) files.main_file().number(1.0 / (i + 3)) << '\n';
        EXPECT_TRUE(fs::is_empty(folder.path())) << name;
        ASSERT_TRUE(files.commit().ok());
        EXPECT_EQ(files_in(folder.path()), 1u) << name;
        fs::remove(folder / name);
    }
}

TEST(OutputSet, NothingIsLeftOfAProcessThatEndsWhileItWrites) {
    const TemporaryFolder folder;
    const int probe = ::open(folder.path().c_str(), O_TMPFILE | O_RDWR, 0600);
    if (probe < 0) GTEST_SKIP() << "this file system has no files without names";
    ::close(probe);
    write_file(folder / "model.txt", "old");
    const pid_t child = ::fork();
    if (child == 0) {
        OutputSet files(folder / "model.txt");
        files.main_file() << std::string(1 << 20, 'x');
        files.companion("part.txt") << std::string(1 << 20, 'y');
        ::_exit(0);
    }
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    EXPECT_EQ(files_in(folder.path()), 1u);
    EXPECT_EQ(read_file(folder / "model.txt"), "old");
}

TEST(OutputSet, APlaceThatAKilledProcessLeftBehindIsNotInTheWay) {
    const TemporaryFolder folder;
    // Whatever number the next file gets.
    for (int i = 0; i < 1000; ++i)
        write_file(folder / ("a.txt.geomend-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp"), "left");
    OutputSet files(folder / "a.txt");
    files.main_file() << "new";
    ASSERT_TRUE(files.commit().ok());
    EXPECT_EQ(read_file(folder / "a.txt"), "new");
}

// A reader that finds the new index finds the new parts.
TEST(OutputSet, TheFileThatTheUserNamedAppearsLast) {
    const TemporaryFolder folder;
    OutputSet files(folder / "main.txt");
    files.main_file() << "main";
    for (const char* part : {"a.txt", "b.txt", "c.txt"}) files.companion(part) << part;
    const int events = ::inotify_init1(IN_CLOEXEC);
    ASSERT_GE(::inotify_add_watch(events, folder.path().c_str(), IN_MOVED_TO), 0);
    ASSERT_TRUE(files.commit().ok());
    std::array<char, 4096> bytes{};
    const ssize_t size = ::read(events, bytes.data(), bytes.size());
    ::close(events);
    std::vector<std::string> names;
    for (ssize_t at = 0; at < size;) {
        inotify_event event{};
        std::memcpy(&event, bytes.data() + at, sizeof event);
        names.emplace_back(bytes.data() + at + sizeof event);
        at += static_cast<ssize_t>(sizeof event + event.len);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"a.txt", "b.txt", "c.txt", "main.txt"}));
}

TEST(OutputSet, GzipsByTheName) {
    const TemporaryFolder folder;
    OutputSet set(folder / "a.ts.gz");
    const std::string text(1'000'000, 'x');
    set.main_file() << text;
    ASSERT_TRUE(set.commit());
    EXPECT_LT(fs::file_size(folder / "a.ts.gz"), 10'000u);
    EXPECT_EQ(Input::open((folder / "a.ts.gz").string())->bytes(), text);
}

TEST(OutputSet, RefusesAFolderAsTarget) {
    const TemporaryFolder folder;
    OutputSet set(folder.path());
    set.main_file() << "x";
    const auto committed = set.commit();
    ASSERT_FALSE(committed);
    EXPECT_EQ(committed.why().error.code, "F020");
    EXPECT_EQ(committed.why().kind, FailureKind::unwritable);
}

TEST(OutputSet, TellsAMissingFolder) {
    const TemporaryFolder folder;
    OutputSet set(folder / "none/a");
    set.main_file() << "x";
    EXPECT_FALSE(set.commit());
    EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST(OutputSet, AMissingFolderIsNotMadeForCompanionsEither) {
    const TemporaryFolder folder;
    OutputSet set(folder / "none/main.vtm");
    set.companion("parts/part.vtp") << "part";
    set.main_file() << "main";
    const auto done = set.commit();
    ASSERT_FALSE(done);
    EXPECT_EQ(done.why().error.code, "F020");
    EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}

// A limit on the file size stands for a full disk: both fail in write().
TEST(OutputSet, LeavesTheOldFileWhenTheDiskIsFull) {
    const TemporaryFolder folder;
    write_file(folder / "a", "old");
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100'000, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    bool ok = true;
    {
        OutputSet set(folder / "a");
        set.companion("b") << "small";
        set.main_file() << std::string(1'000'000, 'x');
        ok = set.commit().ok();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_FALSE(ok);
    EXPECT_EQ(read_file(folder / "a"), "old");
    EXPECT_EQ(files_in(folder.path()), 1u);
}

}  // namespace
}  // namespace geomend
