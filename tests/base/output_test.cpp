// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/output.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

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
